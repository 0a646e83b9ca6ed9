//! The emulated Pico on its own clock and its client, in one thread.

use crate::chip as board;
use stiction_host_sim::firmware::image::flashed;
use stiction_lab::pico::{Chip, FLASH, MEGAHERTZ};
use stiction_tests::station::client::{Client, Said};
use stiction_wire::{Command, Health, Reason, Reply};

/// Cycles of a ms.
pub(crate) const MS: u64 = MEGAHERTZ as u64 * 1_000;
/// No answer takes longer (ms).
pub(crate) const PATIENCE: u32 = 2_000;

/// A chip and its client, in one thread: time goes on only here.
pub(crate) struct Bench {
    pub(crate) chip: Chip,
    pub(crate) client: Client,
}

impl Bench {
    /// From power-up; nothing where something is missing.
    pub(crate) fn start(board: &board::Chip) -> Option<Self> {
        let image = board.image()?;
        Some(Self::of(flashed(&image.path, FLASH).unwrap()))
    }

    /// From power-up, with the contents of its flash.
    pub(crate) fn of(flash: Vec<u8>) -> Self {
        let mut bench = Self {
            chip: Chip::new(flash),
            client: Client::default(),
        };
        bench.wait(|said| matches!(said, Said::Pose(_)).then_some(()));
        bench
    }

    pub(crate) fn pass(&mut self) {
        self.chip.run(MS);
        self.client.listen(&self.chip.gone());
    }

    pub(crate) fn send(&mut self, command: Command<'_>) {
        let bytes = self.client.encode(command);
        self.chip.bring(&bytes);
    }

    /// Waits for a report; those before it are passed over.
    pub(crate) fn wait<T>(&mut self, mut wanted: impl FnMut(&Said) -> Option<T>) -> T {
        for _ in 0..PATIENCE {
            while let Some(received) = self.client.inbox.pop_front() {
                if let Some(found) = wanted(&received.said) {
                    return found;
                }
            }
            self.pass();
        }
        panic!("no answer in {PATIENCE} ms: {:?}", self.chip)
    }

    pub(crate) fn ask(&mut self, command: Command<'_>) -> Reply<'static> {
        let sequence = self.client.sequence;
        self.send(command);
        self.wait(|said| match said {
            Said::Reply(answer) if answer.command.sequence == sequence => Some(*answer),
            _ => None,
        })
    }

    pub(crate) fn done(&mut self, command: Command<'_>) {
        assert_eq!(self.ask(command).reason, Reason::Done);
    }

    pub(crate) fn health(&mut self) -> Health {
        self.client.inbox.clear();
        self.wait(|said| match said {
            Said::Health(health) => Some(*health),
            _ => None,
        })
    }
}
