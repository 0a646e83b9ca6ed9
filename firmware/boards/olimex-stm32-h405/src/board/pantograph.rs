//! The pantograph at the pins of this board: encoders at three timers and a hold switch in, PWM and direction pins out.

use crate::device::{GEOMETRY, MOTORS};
use crate::log::error;
use stiction_firmware::pantograph::{Counters, GeometryError, Motor, Pantograph};
use stm32f4xx_hal::gpio::{Input, Output, PA1, PA5, PA6, PA7, PA8, PA9, PA10, Pull};
use stm32f4xx_hal::gpio::{PB6, PB7, PB12, PB13, PB14, PB15};
use stm32f4xx_hal::pac::{TIM1, TIM2, TIM3, TIM4};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::qei::Qei;
use stm32f4xx_hal::rcc::Rcc;
use stm32f4xx_hal::timer::PwmChannel;

/// Above the range that a hand feels and an ear hears (Hz).
const PWM: u32 = 20_000;

/// The device of this board.
pub(crate) type Device = Pantograph<Encoders, Motors>;
type Motors = (
    Motor<PwmChannel<TIM1, 0>, PB12<Output>>,
    Motor<PwmChannel<TIM1, 1>, PB13<Output>>,
    Motor<PwmChannel<TIM1, 2>, PB14<Output>>,
);

/// Its parts: left, right, handle in each tuple.
pub(super) struct Parts {
    pub(super) counters: (TIM2, TIM3, TIM4),
    /// Both tracks of each encoder.
    pub(super) encoders: ((PA5, PA1), (PA6, PA7), (PB6, PB7)),
    pub(super) hold: PB15,
    pub(super) pwm: TIM1,
    pub(super) duties: (PA8, PA9, PA10),
    pub(super) directions: (PB12, PB13, PB14),
}

/// Three counters that follow their encoders in hardware, and the hold switch.
pub(crate) struct Encoders {
    left: Qei<TIM2>,
    right: Qei<TIM3>,
    handle: Qei<TIM4>,
    hold: PB15<Input>,
    /// Otherwise the position of the mechanism is unknown, and it never outputs force.
    at_home: bool,
}

impl Counters for Encoders {
    fn counts(&mut self) -> Option<[u16; 3]> {
        // TIM2 has 32 bits; the lower half of them counts like the others.
        let left = self.left.count() as u16;
        let counts = [left, self.right.count(), self.handle.count()];
        self.at_home.then_some(counts)
    }
    fn held(&mut self) -> bool {
        self.hold.is_low()
    }
}

impl Parts {
    /// Starts the counters, and the motors without torque.
    ///
    /// # Errors
    /// An error in the numbers in `firmware/devices/pantograph.rs`.
    pub(super) fn start(self, rcc: &mut Rcc) -> Result<Device, GeometryError> {
        let (left, right, handle) = self.encoders;
        // A track that is not connected does not move.
        let left = (
            left.0.into_alternate::<1>().internal_resistor(Pull::Up),
            left.1.into_alternate::<1>().internal_resistor(Pull::Up),
        );
        let right = (
            right.0.into_alternate::<2>().internal_resistor(Pull::Up),
            right.1.into_alternate::<2>().internal_resistor(Pull::Up),
        );
        let handle = (
            handle.0.into_alternate::<2>().internal_resistor(Pull::Up),
            handle.1.into_alternate::<2>().internal_resistor(Pull::Up),
        );
        let encoders = Encoders {
            left: self.counters.0.qei(left, rcc),
            right: self.counters.1.qei(right, rcc),
            handle: self.counters.2.qei(handle, rcc),
            hold: self.hold.into_pull_up_input(),
            at_home: is_at_home(rcc),
        };
        let motors = motors(self.pwm, self.duties, self.directions, rcc)?;
        Pantograph::new(&GEOMETRY, encoders, motors)
    }
}

/// It was switched on, or reset by hand, in the home position defined in `firmware/devices/pantograph.rs`. After a reset by the watchdog,
/// which is remembered until power is lost, the mechanism may be anywhere.
fn is_at_home(rcc: &Rcc) -> bool {
    let at_home = rcc.csr().read().wdgrstf().bit_is_clear();
    if !at_home {
        error!("stopped before: no force until it is switched on again in its home position");
    }
    at_home
}

/// Three channels of one PWM at duty 0, with their pins low even if no channel drives them.
fn motors(
    pwm: TIM1,
    duties: (PA8, PA9, PA10),
    directions: (PB12, PB13, PB14),
    rcc: &mut Rcc,
) -> Result<Motors, GeometryError> {
    let (_, (left, right, handle, _)) = pwm.pwm_hz(PWM.Hz(), rcc);
    let mut left = left.with(duties.0.into_alternate::<1>().internal_resistor(Pull::Down));
    let mut right = right.with(duties.1.into_alternate::<1>().internal_resistor(Pull::Down));
    let mut handle = handle.with(duties.2.into_alternate::<1>().internal_resistor(Pull::Down));
    left.enable();
    right.enable();
    handle.enable();
    let [of_left, of_right, of_handle] = MOTORS;
    Ok((
        Motor::new(left, directions.0.into_push_pull_output(), of_left)?,
        Motor::new(right, directions.1.into_push_pull_output(), of_right)?,
        Motor::new(handle, directions.2.into_push_pull_output(), of_handle)?,
    ))
}
