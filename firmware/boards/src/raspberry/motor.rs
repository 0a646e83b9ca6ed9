//! The pins of a motor: a PWM of 20 kHz, above the range that hands feel and ears perceive, and a
//! direction.

use stiction_firmware::pantograph::{GeometryError, Motor, MotorConstants};

use super::chip::CLOCK;
use super::hal::gpio::{FunctionPwm, FunctionSioOutput, Pin, PinId, PullDown, ValidFunction};
use super::hal::pwm::{A, Channel, FreeRunning, Slice, SliceId, ValidPwmOutputPin};
use super::pins::Free;

/// Frequency of the PWM (Hz).
const PWM: u32 = 20_000;
/// Counts of a period, less one.
const TOP: u16 = (CLOCK / PWM - 1) as u16;

/// A motor at the first channel of a slice.
pub(super) type MotorAt<S, D> =
    Motor<Channel<Slice<S, FreeRunning>, A>, Pin<D, FunctionSioOutput, PullDown>>;

/// A motor without torque. The chip pulls its pins down only while it runs.
///
/// # Errors
/// An error in the constants.
pub(super) fn motor<S, P, D>(
    mut slice: Slice<S, FreeRunning>,
    duty: Free<P>,
    direction: Free<D>,
    constants: MotorConstants,
) -> Result<MotorAt<S, D>, GeometryError>
where
    S: SliceId,
    P: PinId + ValidFunction<FunctionPwm> + ValidPwmOutputPin<S, A>,
    D: PinId + ValidFunction<FunctionSioOutput>,
{
    slice.default_config();
    slice.set_top(TOP);
    slice.enable();
    slice.channel_a.output_to(duty);
    Motor::new(
        slice.channel_a,
        direction.into_push_pull_output(),
        constants,
    )
}
