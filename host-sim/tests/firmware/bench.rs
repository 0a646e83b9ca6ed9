//! A chip on its own clock and its client, in one thread.

use crate::chip as board;
use stiction_tests::station::client::{Client, Known, Said};
use stiction_tools::image::flashed;
use stiction_wire::{Command, Health, Reason};

/// A chip whose time goes on when it is asked to.
pub(crate) trait Clocked: std::fmt::Debug {
    /// Where its flash is.
    const FLASH: u32;
    /// Cycles of a ms.
    const MS: u64;
    /// At power-up, with what lies in its flash.
    fn power_up(flash: Vec<u8>) -> Self;
    /// Goes on for so many cycles.
    fn run(&mut self, cycles: u64);
    /// Bytes come over its line from now on.
    fn bring(&mut self, bytes: &[u8]);
    /// What has left it since the last call.
    fn gone(&mut self) -> Vec<u8>;
}

#[cfg(feature = "cycles")]
pub(crate) use stiction_emulated_pico::Chip as Pico;

/// Cycles of a ms.
#[cfg(feature = "cycles")]
pub(crate) const MS: u64 = Pico::MS;

#[cfg(feature = "cycles")]
impl Clocked for Pico {
    const FLASH: u32 = stiction_emulated_pico::FLASH;
    const MS: u64 = stiction_emulated_pico::MEGAHERTZ as u64 * 1_000;

    fn power_up(flash: Vec<u8>) -> Self {
        Self::new(flash)
    }

    fn run(&mut self, cycles: u64) {
        self.run(cycles);
    }

    fn bring(&mut self, bytes: &[u8]) {
        self.bring(bytes);
    }

    fn gone(&mut self) -> Vec<u8> {
        self.gone()
    }
}
/// No answer takes longer (ms).
pub(crate) const PATIENCE: u32 = 2_000;

/// A chip and its client, in one thread: time goes on only here.
pub(crate) struct Bench<C> {
    pub(crate) chip: C,
    pub(crate) client: Client,
}

impl<C: Clocked> Bench<C> {
    /// From power-up; nothing where something is missing.
    pub(crate) fn start(board: &board::Chip) -> Option<Self> {
        let image = board.image()?;
        let mut bench = Self {
            chip: C::power_up(flashed(&image.path, C::FLASH).unwrap()),
            client: Client::default(),
        };
        bench.wait(|said| matches!(said, Said::Pose(_)).then_some(()));
        Some(bench)
    }

    /// A ms goes by.
    pub(crate) fn pass(&mut self) {
        self.chip.run(C::MS);
        self.client.listen(&self.chip.gone());
    }

    pub(crate) fn send(&mut self, command: Command<'_>) {
        let bytes = self.client.encode(command);
        self.chip.bring(&bytes);
    }

    /// Waits for a report; those before it are passed over.
    pub(crate) fn wait<T>(&mut self, mut wanted: impl FnMut(&Said) -> Option<T>) -> T {
        let found = self.hear(|_, said| wanted(said));
        found.unwrap_or_else(|| panic!("no answer in {PATIENCE} ms: {:?}", self.chip))
    }

    /// The same with the time of the report (µs), and nothing if none comes in time.
    pub(crate) fn hear<T>(&mut self, mut wanted: impl FnMut(u32, &Said) -> Option<T>) -> Option<T> {
        for _ in 0..PATIENCE {
            while let Some(received) = self.client.inbox.pop_front() {
                if let Some(found) = wanted(received.time, &received.said) {
                    return Some(found);
                }
            }
            self.pass();
        }
        None
    }

    /// Sends a command that the board executes.
    pub(crate) fn done(&mut self, command: Command<'_>) {
        let sequence = self.client.sequence;
        self.send(command);
        let reason = self.wait(|said| match said {
            Said::Reply(answer) if answer.command.sequence == sequence => Some(answer.reason),
            _ => None,
        });
        assert_eq!(reason, Reason::Done);
    }

    /// What it says of itself.
    pub(crate) fn info(&mut self) -> Known {
        self.send(Command::Hello);
        self.wait(|said| match said {
            Said::Info(info) => Some(info.clone()),
            _ => None,
        })
    }

    pub(crate) fn health(&mut self) -> Health {
        self.client.inbox.clear();
        self.wait(|said| match said {
            Said::Health(health) => Some(*health),
            _ => None,
        })
    }
}
