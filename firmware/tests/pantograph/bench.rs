//! Mechanics once more, in f64, and motors that keep what they were told. Shared with the tests of the whole board.

use core::convert::Infallible;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::pwm::{self, SetDutyCycle};
use std::cell::RefCell;
use std::rc::Rc;
use stiction_firmware::pantograph::{Geometry, HandleMount};

/// The forward kinematics once more, in f64: the hand by the cosine rule, its orientation.
pub(crate) fn reference(g: &Geometry, [q1, q2, q3]: [f64; 3]) -> [f64; 3] {
    let [ox, oy] = g.origin.map(f64::from);
    let half = f64::from(g.base) / 2.0;
    let ([l1, l2], [r1, r2]) = (g.proximal.map(f64::from), g.distal.map(f64::from));
    let (x1, y1) = (ox - half + l1 * q1.cos(), oy + l1 * q1.sin());
    let (x2, y2) = (ox + half + l2 * q2.cos(), oy + l2 * q2.sin());
    let apart = (x2 - x1).hypot(y2 - y1);
    let at_left = ((r1 * r1 + apart * apart - r2 * r2) / (2.0 * r1 * apart)).acos();
    let link = (y2 - y1).atan2(x2 - x1) + at_left;
    let (x, y) = (x1 + r1 * link.cos(), y1 + r1 * link.sin());
    let phi = match g.handle {
        HandleMount::Base => q3,
        HandleMount::LeftLink => q3 + link,
        HandleMount::RightLink => q3 + (y - y2).atan2(x - x2),
    };
    [x, y, phi]
}

/// What a motor was told, last.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bench {
    pub(crate) duty: Rc<RefCell<u16>>,
    pub(crate) high: Rc<RefCell<bool>>,
    pub(crate) broken: Rc<RefCell<bool>>,
}

#[derive(Debug)]
pub(crate) struct Broken;

impl pwm::Error for Broken {
    fn kind(&self) -> pwm::ErrorKind {
        pwm::ErrorKind::Other
    }
}

impl pwm::ErrorType for Bench {
    type Error = Broken;
}

impl SetDutyCycle for Bench {
    fn max_duty_cycle(&self) -> u16 {
        8_400
    }
    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Broken> {
        if *self.broken.borrow() && duty > 0 {
            return Err(Broken);
        }
        *self.duty.borrow_mut() = duty;
        Ok(())
    }
}

impl digital::ErrorType for Bench {
    type Error = Infallible;
}

impl OutputPin for Bench {
    fn set_low(&mut self) -> Result<(), Infallible> {
        assert_eq!(
            *self.duty.borrow(),
            0,
            "the direction changes without torque"
        );
        *self.high.borrow_mut() = false;
        Ok(())
    }
    fn set_high(&mut self) -> Result<(), Infallible> {
        assert_eq!(
            *self.duty.borrow(),
            0,
            "the direction changes without torque"
        );
        *self.high.borrow_mut() = true;
        Ok(())
    }
}
