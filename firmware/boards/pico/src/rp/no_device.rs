//! No device: samples come over the line, and the force is only reported.

use stiction_firmware::device::{FromLine, NoActuators};
use stiction_firmware::pantograph::GeometryError;
use stiction_firmware::safety::{Limits, Passivity};

use super::Parts;

pub(crate) type Device = (FromLine, NoActuators);
pub(crate) const LIMITS: Limits = Limits::DEFAULT;
pub(crate) const PASSIVITY: Option<Passivity> = None;

/// Leaves all pins as they are.
///
/// # Errors
/// Never; the type is that of the devices.
pub(crate) fn start(_: Parts<'_>) -> Result<Device, GeometryError> {
    Ok((FromLine, NoActuators))
}
