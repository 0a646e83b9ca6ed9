//! A thread that goes before all others, where the system lets it: on Linux for root, and for whom a limit of real-time
//! priority is set.

use thread_priority::ThreadPriority;
#[cfg(unix)]
use thread_priority::unix::{
    RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
    thread_native_id,
};

/// From now on this thread goes before others.
#[cfg(unix)]
pub(super) fn hurry() {
    // The least of them is before all that are not.
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    // Without it, ticks are late more often under load.
    let _ = set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Min, policy);
}

/// From now on this thread goes before others.
#[cfg(not(unix))]
pub(super) fn hurry() {
    // Without it, ticks are late more often under load.
    let _ = thread_priority::set_current_thread_priority(ThreadPriority::Max);
}
