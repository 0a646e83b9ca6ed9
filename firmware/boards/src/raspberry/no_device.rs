//! No device: samples come over the line, and the force is only reported.

use stiction_firmware::pantograph::GeometryError;
use stiction_firmware::safety::{Limits, Passivity};

use super::Wired;
pub(super) use super::no_device as numbers;
use crate::work::{NO_DEVICE, NoDevice};

/// None.
pub type Device = NoDevice;
pub(super) const LIMITS: Limits = Limits::DEFAULT;
pub(super) const PASSIVITY: Option<Passivity> = None;

/// Leaves all pins as they are.
///
/// # Errors
/// Never; the type is that of the devices.
pub(super) fn start(_: Wired<'_>) -> Result<Device, GeometryError> {
    Ok(NO_DEVICE)
}
