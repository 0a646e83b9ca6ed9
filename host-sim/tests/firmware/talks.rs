//! A board that a client talks to, whatever runs it: what a test asks of it is the same.

use crate::bench::{Bench, Clocked};
use crate::board::{AGAIN, Board};
use stiction_tests::station::client::{Known, Said};
use stiction_wire::{Command, Health};

pub(crate) trait Talks {
    fn send(&mut self, command: Command<'_>);
    /// Sends a command that the board executes.
    fn done(&mut self, command: Command<'_>);
    /// What it says of itself.
    fn info(&mut self) -> Known;
    /// Waits for a report of a kind; those before it are passed over.
    fn wait<T>(&mut self, wanted: impl FnMut(u32, &Said) -> Option<T>) -> T;
    /// The same, nothing if it does not come before a command would be sent again.
    fn hear<T>(&mut self, wanted: impl FnMut(u32, &Said) -> Option<T>) -> Option<T>;
    /// The number of the last command.
    fn last(&self) -> u8;

    /// The next health.
    fn health(&mut self) -> Health {
        self.wait(|_, said| match said {
            Said::Health(health) => Some(*health),
            _ => None,
        })
    }
}

impl Talks for Board {
    fn send(&mut self, command: Command<'_>) {
        self.send(command);
    }

    fn done(&mut self, command: Command<'_>) {
        self.done(command);
    }

    fn info(&mut self) -> Known {
        self.info()
    }

    fn wait<T>(&mut self, wanted: impl FnMut(u32, &Said) -> Option<T>) -> T {
        self.wait(wanted)
    }

    fn hear<T>(&mut self, wanted: impl FnMut(u32, &Said) -> Option<T>) -> Option<T> {
        self.listen_for(AGAIN, wanted)
    }

    fn last(&self) -> u8 {
        self.client.sequence.wrapping_sub(1)
    }
}

impl<C: Clocked> Talks for Bench<C> {
    fn send(&mut self, command: Command<'_>) {
        self.send(command);
    }

    fn done(&mut self, command: Command<'_>) {
        self.done(command);
    }

    fn info(&mut self) -> Known {
        self.info()
    }

    fn wait<T>(&mut self, wanted: impl FnMut(u32, &Said) -> Option<T>) -> T {
        let found = self.hear(wanted);
        found.unwrap_or_else(|| panic!("no answer: {:?}", self.chip))
    }

    fn hear<T>(&mut self, wanted: impl FnMut(u32, &Said) -> Option<T>) -> Option<T> {
        self.hear(wanted)
    }

    fn last(&self) -> u8 {
        self.client.sequence.wrapping_sub(1)
    }
}
