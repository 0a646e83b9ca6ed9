//! Motors that record their inputs.

use core::convert::Infallible;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::pwm::{self, SetDutyCycle};
use std::cell::RefCell;
use std::rc::Rc;

/// The last input of a motor.
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
