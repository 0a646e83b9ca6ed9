//! Gives a thread priority over all others, if the system permits it: on Linux for root, and for users with a limit of real-time
//! priority.

use thread_priority::ThreadPriority;
#[cfg(unix)]
use thread_priority::unix::{
    RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
    thread_native_id,
};

/// Gives this thread priority over others from now on.
#[cfg(unix)]
pub(super) fn hurry() {
    // The lowest of these priorities is above all ordinary ones.
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    // Without it, ticks are late more often under load.
    let _ = set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Min, policy);
}

#[cfg(not(unix))]
pub(super) fn hurry() {
    // Without it, ticks are late more often under load.
    let _ = thread_priority::set_current_thread_priority(ThreadPriority::Max);
}
