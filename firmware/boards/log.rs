//! The log, by defmt where a feature turns it on. Nothing is logged in the tick or in the serial interrupt.

#[cfg(feature = "rtt")]
use defmt_rtt as _;
#[cfg(feature = "semihosting")]
use defmt_semihosting as _;

#[cfg(any(feature = "rtt", feature = "semihosting"))]
pub(crate) use defmt::{error, info};

/// Nothing.
#[cfg(not(any(feature = "rtt", feature = "semihosting")))]
macro_rules! nothing {
    ($format:literal $(, $value:expr)*) => {{ $( let _ = $value; )* }};
}
#[cfg(not(any(feature = "rtt", feature = "semihosting")))]
pub(crate) use {nothing as error, nothing as info};
