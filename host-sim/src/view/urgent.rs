//! A thread that goes before all others, where the system lets it: on Linux for root, and for whom a limit of real-time
//! priority is set.

use thread_priority::ThreadPriority;
#[cfg(unix)]
use thread_priority::unix::{
    RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
    thread_native_id,
};

/// From now on this thread goes before others. Whether the system lets it.
#[cfg(unix)]
pub(super) fn hurry() -> bool {
    // The least of them is before all that are not.
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Min, policy).is_ok()
}

/// From now on this thread goes before others. Whether the system lets it.
#[cfg(not(unix))]
pub(super) fn hurry() -> bool {
    thread_priority::set_current_thread_priority(ThreadPriority::Max).is_ok()
}
