//! The log, by defmt if a feature turns it on. Nothing is logged in ticks, turns or the interrupt of the line.

#[cfg(feature = "rtt")]
use defmt_rtt as _;
#[cfg(feature = "semihosting")]
use defmt_semihosting as _;

#[cfg(any(feature = "rtt", feature = "semihosting"))]
pub(crate) use defmt::{error, info};

/// Expands to nothing.
#[cfg(not(any(feature = "rtt", feature = "semihosting")))]
macro_rules! nothing {
    ($format:literal $(, $value:expr)*) => {{ $( let _ = $value; )* }};
}
#[cfg(not(any(feature = "rtt", feature = "semihosting")))]
pub(crate) use {nothing as error, nothing as info};

use stiction_firmware::station::News;

/// Logs the news of a board. `longest_tick`: its longest tick (ns); `lost`: the number of bytes that arrived when there was no room for
/// them.
pub(crate) fn report(news: News, longest_tick: u32, lost: u32) {
    match news {
        News::Force(force) => info!("force: {=str}", force),
        News::Reset => info!("everything reset"),
        News::Counts(seen) => info!(
            "ticks: {=u32}, {=u32} missed, longest {=u32} ns, longest turn {=u32} ns; samples: {=u32}; frames: {=u32} lost, {=u32} faulty, {=u32} not sent; bytes: {=u32} lost",
            seen.ticks,
            seen.missed_ticks,
            longest_tick,
            seen.worst_tick,
            seen.samples,
            seen.lost_frames,
            seen.faults,
            seen.unsent,
            lost
        ),
    }
}

/// Logs that the watchdog has reset the board since it was switched on: the mechanism of its device may be anywhere.
pub fn not_at_home() {
    error!("stopped before: no force until it is switched on again in its home position");
}
