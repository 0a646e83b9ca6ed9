//! An emulated board: its emulator started with its image, its serial line a socket, its RAM read when asked for.

use crate::chip::{Chip, Image, PICO};
use std::fs;
use std::io::{ErrorKind, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::time::{Duration, Instant};
use stiction_host_sim::firmware::board::RunningBoard;
use stiction_host_sim::trade::chip::Chip as Processor;
use stiction_tests::station::client::{Client, Said};
use stiction_wire::{Command, Health, Info};

/// Nothing takes longer.
const PATIENCE: Duration = Duration::from_secs(180);
/// What is not answered is sent again.
pub(crate) const AGAIN: Duration = Duration::from_secs(5);

pub(crate) struct Board {
    pub(crate) chip: &'static Chip,
    pub(crate) image: Image,
    emulator: RunningBoard,
    line: UnixStream,
    /// Came while something was sent.
    came: Vec<u8>,
    pub(crate) client: Client,
}

impl Board {
    /// From power-up; nothing where something is missing.
    pub(crate) fn start(chip: &'static Chip) -> Option<Self> {
        Self::start_image(chip, chip.image()?)
    }

    /// From power-up, an image of the board.
    pub(crate) fn start_image(chip: &'static Chip, image: Image) -> Option<Self> {
        let clock = format!("shift={}", chip.shift);
        let emulator = RunningBoard::start(chip.board, &image.path, &clock, false).unwrap();
        let line = connected(&emulator.line());
        line.set_nonblocking(true).unwrap();
        let mut board = Self {
            chip,
            image,
            emulator,
            line,
            came: Vec::new(),
            client: Client::default(),
        };
        // Before its line is open, bytes are lost.
        board.wait(|_, said| matches!(said, Said::Pose(_)).then_some(()));
        Some(board)
    }

    pub(crate) fn send_bytes(&mut self, mut bytes: &[u8]) {
        let begun = Instant::now();
        while !bytes.is_empty() {
            match self.line.write(bytes) {
                Ok(count) => bytes = &bytes[count..],
                Err(error) if error.kind() == ErrorKind::WouldBlock => {
                    let more = read(&mut self.line);
                    self.came.extend(more);
                }
                Err(error) => panic!("{error}"),
            }
            assert!(begun.elapsed() < PATIENCE);
        }
    }

    /// Sends bytes as fast as a line brings them, by the board's clock: what comes in a tick, piece by piece. The emulator takes them
    /// faster: on a machine that does other work besides, it may keep the board in the interrupt of its line for many ticks, which no
    /// line does. What was not sent in time is not made up for.
    pub(crate) fn send_at_line_rate(&mut self, bytes: &[u8]) {
        let tick_rate = u32::from(self.info().mode.tick_rate);
        let piece = self.chip.line_rate / tick_rate;
        for piece in bytes.chunks(piece as usize) {
            let begun = self.wait(|time, _| Some(time));
            self.send_bytes(piece);
            let tick_us = 1_000_000 / tick_rate;
            self.wait(|time, _| (time.wrapping_sub(begun) >= tick_us).then_some(()));
        }
    }

    /// The number of the last command.
    pub(crate) fn last(&self) -> u8 {
        self.client.sequence.wrapping_sub(1)
    }

    pub(crate) fn send(&mut self, command: Command<'_>) {
        let bytes = self.client.encode(command);
        self.send_bytes(&bytes);
    }

    /// What has come meanwhile.
    pub(crate) fn bytes(&mut self) -> Vec<u8> {
        let mut bytes = std::mem::take(&mut self.came);
        bytes.extend(read(&mut self.line));
        bytes
    }

    pub(crate) fn listen(&mut self) {
        let bytes = self.bytes();
        self.client.listen(&bytes);
    }

    /// Waits until no answer is outstanding: later answers belong to later messages.
    pub(crate) fn settle(&mut self) {
        for _ in 0..20 {
            std::thread::sleep(Duration::from_millis(25));
            self.listen();
        }
        self.client.inbox.clear();
    }

    /// Waits for a report of a kind; those before it are passed over.
    pub(crate) fn wait<T>(&mut self, wanted: impl FnMut(u32, &Said) -> Option<T>) -> T {
        let found = self.listen_for(PATIENCE, wanted);
        found.unwrap_or_else(|| panic!("{} does not answer", self.chip.name()))
    }

    /// Waits for a report of a kind; nothing if it does not come in time.
    pub(crate) fn listen_for<T>(
        &mut self,
        time: Duration,
        mut wanted: impl FnMut(u32, &Said) -> Option<T>,
    ) -> Option<T> {
        let begun = Instant::now();
        loop {
            while let Some(received) = self.client.inbox.pop_front() {
                if let Some(found) = wanted(received.time, &received.said) {
                    return Some(found);
                }
            }
            if begun.elapsed() >= time {
                return None;
            }
            self.listen();
        }
    }

    /// Sends a command that the board executes. It is sent again as long as there is no answer: between a board's samples it may be lost,
    /// or its answer.
    pub(crate) fn done(&mut self, command: Command<'_>) {
        let (reason, allowed) = self.answer(command, |sequence, said| match said {
            Said::Reply(answer) if answer.command.sequence == sequence => {
                Some((answer.reason, answer.allowed))
            }
            _ => None,
        });
        assert_eq!(reason, stiction_wire::Reason::Done, "{allowed}");
    }

    /// What it says of itself.
    pub(crate) fn info(&mut self) -> Info<'static> {
        self.answer(Command::Hello, |_, said| match said {
            Said::Info(info) => Some(*info),
            _ => None,
        })
    }

    /// Sends a command until what is wanted comes, which may be the answer to its number; what comes before it is passed over.
    fn answer<T>(
        &mut self,
        command: Command<'_>,
        mut wanted: impl FnMut(u8, &Said) -> Option<T>,
    ) -> T {
        let begun = Instant::now();
        loop {
            let sequence = self.client.sequence;
            self.send(command);
            let found = self.listen_for(AGAIN, |_, said| wanted(sequence, said));
            if let Some(found) = found {
                return found;
            }
            assert!(
                begun.elapsed() < PATIENCE,
                "{} does not answer",
                self.chip.name()
            );
        }
    }

    pub(crate) fn health(&mut self) -> Health {
        self.wait(|_, said| match said {
            Said::Health(health) => Some(*health),
            _ => None,
        })
    }

    /// Time on the board's clock as instructions; of the Pico, whose instructions take their time, as cycles.
    pub(crate) fn instructions(&self, ns: u32) -> u32 {
        if self.chip.board == PICO.board {
            let cycles = u64::from(ns) * u64::from(Processor::CortexM0Plus.megahertz()) / 1_000;
            cycles as u32
        } else {
            ns >> self.chip.shift
        }
    }

    /// The longest tick so far (instructions; of the Pico, cycles), without its entry.
    pub(crate) fn longest_tick(&mut self) -> u32 {
        let symbols = &self.image.contents.symbols;
        let (_, place) = (symbols.iter())
            .find(|(name, _)| name.contains("LONGEST_TICK"))
            .expect("the board measures its ticks");
        let bytes = self.memory(*place, 4);
        self.instructions(u32::from_le_bytes(bytes.try_into().unwrap()))
    }

    /// A piece of its memory as it is now.
    fn memory(&mut self, from: u64, size: usize) -> Vec<u8> {
        let begun = Instant::now();
        let Self {
            emulator,
            line,
            came,
            ..
        } = self;
        // A line that nobody reads holds the emulator up.
        let mut monitor = connected(&emulator.monitor());
        writeln!(monitor, "memsave {from} {size} memory").unwrap();
        let file = emulator.monitor().with_file_name("memory");
        loop {
            let bytes = fs::read(&file).unwrap_or_default();
            if bytes.len() == size {
                fs::remove_file(&file).unwrap();
                return bytes;
            }
            assert!(begun.elapsed() < PATIENCE);
            came.extend(read(line));
        }
    }

    /// How deep the stack has been so far (bytes): RAM is zero at power-up, so the zeros at its lowest end are a little more
    /// than what was never touched.
    pub(crate) fn stack(&mut self) -> usize {
        let ram = self.chip.board.ram;
        let size = usize::try_from(self.image.contents.stack_top.unwrap() - ram).unwrap();
        let ram = self.memory(ram, size);
        size - ram.iter().take_while(|byte| **byte == 0).count()
    }
}

/// What has come over a line; a moment later where nothing has.
fn read(line: &mut UnixStream) -> Vec<u8> {
    let mut bytes = vec![0; 4096];
    match line.read(&mut bytes) {
        Ok(count) => {
            assert_ne!(count, 0, "the emulator ended");
            bytes.truncate(count);
            bytes
        }
        Err(error) if error.kind() == ErrorKind::WouldBlock => {
            std::thread::sleep(Duration::from_millis(1));
            Vec::new()
        }
        Err(error) => panic!("{error}"),
    }
}

/// A line to where the emulator opens one soon.
pub(crate) fn connected(path: &Path) -> UnixStream {
    let begun = Instant::now();
    loop {
        if let Ok(stream) = UnixStream::connect(path) {
            return stream;
        }
        assert!(begun.elapsed() < PATIENCE, "{}", path.display());
        std::thread::sleep(Duration::from_millis(10));
    }
}
