//! The pantograph at the pins of this board: encoders at three timers and a hold switch in, PWM and direction pins out.

use stiction_boards::log::not_at_home;
use stiction_boards::{Joints, Tracks};
use stiction_firmware::devices::pantograph::{GEOMETRY, MOTORS};
use stiction_firmware::pantograph::{Counters, GeometryError, Motor, Pantograph};
use stm32f4xx_hal::gpio::{Input, Output, PA1, PA5, PA6, PA7, PA8, PA9, PA10, Pull};
use stm32f4xx_hal::gpio::{PB6, PB7, PB12, PB13, PB14, PB15};
use stm32f4xx_hal::pac::{TIM1, TIM2, TIM3, TIM4};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::qei::Qei;
use stm32f4xx_hal::rcc::Rcc;
use stm32f4xx_hal::timer::PwmChannel;

/// Above the range that hands feel and ears perceive (Hz).
const PWM: u32 = 20_000;

/// The device of this board.
pub type Device = Pantograph<Encoders, Motors>;
/// Left, right, handle.
pub type Motors = (
    Motor<PwmChannel<TIM1, 0>, PB12<Output>>,
    Motor<PwmChannel<TIM1, 1>, PB13<Output>>,
    Motor<PwmChannel<TIM1, 2>, PB14<Output>>,
);

/// What it is wired to.
pub struct Wired {
    pub counters: Joints<TIM2, TIM3, TIM4>,
    pub encoders: Joints<Tracks<PA5, PA1>, Tracks<PA6, PA7>, Tracks<PB6, PB7>>,
    pub hold: PB15,
    pub pwm: TIM1,
    pub duties: Joints<PA8, PA9, PA10>,
    pub directions: Joints<PB12, PB13, PB14>,
}

/// Three counters that follow their encoders in hardware, and the hold switch.
pub struct Encoders {
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

impl Wired {
    /// Starts the counters, and the motors without torque.
    ///
    /// # Errors
    /// An error in the numbers in `firmware/src/devices/pantograph.rs`.
    pub fn start(self, rcc: &mut Rcc) -> Result<Device, GeometryError> {
        let Joints {
            left,
            right,
            handle,
        } = self.encoders;
        // A track that is not connected does not move.
        let left = (
            left.a.into_alternate::<1>().internal_resistor(Pull::Up),
            left.b.into_alternate::<1>().internal_resistor(Pull::Up),
        );
        let right = (
            right.a.into_alternate::<2>().internal_resistor(Pull::Up),
            right.b.into_alternate::<2>().internal_resistor(Pull::Up),
        );
        let handle = (
            handle.a.into_alternate::<2>().internal_resistor(Pull::Up),
            handle.b.into_alternate::<2>().internal_resistor(Pull::Up),
        );
        let encoders = Encoders {
            left: self.counters.left.qei(left, rcc),
            right: self.counters.right.qei(right, rcc),
            handle: self.counters.handle.qei(handle, rcc),
            hold: self.hold.into_pull_up_input(),
            at_home: is_at_home(rcc),
        };
        let motors = motors(self.pwm, self.duties, self.directions, rcc)?;
        Pantograph::new(&GEOMETRY, encoders, motors)
    }
}

/// It was switched on, or reset by hand, in the home position defined in `firmware/src/devices/pantograph.rs`. After a reset by the watchdog,
/// which is remembered until power is lost, the mechanism may be anywhere.
fn is_at_home(rcc: &Rcc) -> bool {
    let at_home = rcc.csr().read().wdgrstf().bit_is_clear();
    if !at_home {
        not_at_home();
    }
    at_home
}

/// Three channels of one PWM at duty 0, with their pins low even if no channel drives them.
fn motors(
    pwm: TIM1,
    duties: Joints<PA8, PA9, PA10>,
    directions: Joints<PB12, PB13, PB14>,
    rcc: &mut Rcc,
) -> Result<Motors, GeometryError> {
    let (_, (left, right, handle, _)) = pwm.pwm_hz(PWM.Hz(), rcc);
    let mut left = left.with(
        duties
            .left
            .into_alternate::<1>()
            .internal_resistor(Pull::Down),
    );
    let mut right = right.with(
        duties
            .right
            .into_alternate::<1>()
            .internal_resistor(Pull::Down),
    );
    let mut handle = handle.with(
        duties
            .handle
            .into_alternate::<1>()
            .internal_resistor(Pull::Down),
    );
    left.enable();
    right.enable();
    handle.enable();
    let [of_left, of_right, of_handle] = MOTORS;
    Ok((
        Motor::new(left, directions.left.into_push_pull_output(), of_left)?,
        Motor::new(right, directions.right.into_push_pull_output(), of_right)?,
        Motor::new(handle, directions.handle.into_push_pull_output(), of_handle)?,
    ))
}
