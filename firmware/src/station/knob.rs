//! The numbers of a board's knob (FRAME 4.9): asked for, or replaced. Numbers that are accepted take effect in one way only, at a start: the
//! device is off, the reply is sent, the board stores them and restarts.

use super::command::{Next, STOPPED};
use super::refusal::Trouble;
use super::{Desk, Link};
use crate::device::{Actuators, LockServo, Servo, Source};
use stiction_core::Real;
use stiction_wire::{KnobNumbers, Reason, Reference, Reply, Report};

/// For a board without a knob, or whose numbers cannot be replaced.
pub(super) const NO_KNOB: Trouble =
    Trouble::whole(Reason::Unsupported, "for a board with a knob at its pins");

pub(super) const RESTARTS: Trouble = Trouble::whole(
    Reason::NotNow,
    "hello and ping: the board restarts with other numbers of its knob",
);

/// The time for the reply to leave (µs): a full queue of 1 kB takes 11 ms at 921 600 baud, and a computer takes a packet from USB every ms.
const LEAVING_US: u32 = 50_000;

/// Numbers that were accepted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Restart {
    command: Reference,
    numbers: KnobNumbers,
    /// When the device was off and the reply was sent (µs).
    replied_us: Option<u32>,
    is_due: bool,
}

impl Restart {
    /// The numbers, once the reply has left.
    pub(super) fn due(&self) -> Option<&KnobNumbers> {
        self.is_due.then_some(&self.numbers)
    }
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Desk<R, V, S, C> {
    /// Answers with the present numbers.
    #[inline(never)]
    pub(super) fn tell_knob(&mut self, to: Reference, now_us: u32, link: &mut impl Link) -> Next {
        let report = match self.setup.knob {
            Some(info) => Report::KnobInfo(info),
            None => Report::Reply(NO_KNOB.reply(to)),
        };
        self.say(now_us, report, link);
        Next::Enough
    }

    /// Takes other numbers, or refuses them; the reply to those that are taken follows when the device is off.
    #[inline(never)]
    pub(super) fn replace_knob(
        &mut self,
        numbers: &KnobNumbers,
        command: Reference,
        now_us: u32,
        link: &mut impl Link,
    ) -> Next {
        match self.accepts(numbers) {
            Ok(()) => {
                self.restart = Some(Restart {
                    command,
                    numbers: *numbers,
                    replied_us: None,
                    is_due: false,
                });
            }
            Err(trouble) => {
                self.say(now_us, Report::Reply(trouble.reply(command)), link);
            }
        }
        Next::Enough
    }

    fn accepts(&self, numbers: &KnobNumbers) -> Result<(), Trouble> {
        if self.setup.knob.is_none() {
            return Err(NO_KNOB);
        }
        if self.restart.is_some() {
            return Err(RESTARTS);
        }
        if self.latched {
            return Err(STOPPED);
        }
        self.setup.admits(numbers)
    }

    /// At the end of a turn: with new numbers the device is off before the reply is sent, and stays off.
    pub(super) fn stop_for_restart<D: Source + Actuators>(
        &mut self,
        now_us: u32,
        link: &mut impl Link,
        servo: &mut impl LockServo<D>,
    ) {
        let Some(mut restart) = self.restart else {
            return;
        };
        servo.lock(Servo::latch);
        match restart.replied_us {
            Some(at) => restart.is_due = now_us.wrapping_sub(at) >= LEAVING_US,
            None => {
                let reply = Report::Reply(Reply::done(restart.command));
                // A line without room gets it in a later turn.
                restart.replied_us = self.say(now_us, reply, link).then_some(now_us);
            }
        }
        self.restart = Some(restart);
    }
}
