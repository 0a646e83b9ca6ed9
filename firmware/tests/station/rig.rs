//! A station with a client, a line between them, a device and a clock, all on this machine.

use crate::with;
use std::collections::VecDeque;
use stiction_core::{Hand, Real, Wrench};
use stiction_firmware::device::{Actuators, FromLine, NoActuators, Servo, Source};
use stiction_firmware::safety::{Limits, Passivity};
use stiction_firmware::station::{Link, Setup, Station};
use stiction_tests::station::BOX;
use stiction_tests::station::client::{Client, Received, Said};
use stiction_wire::{
    Command, Health, Info, Message, Mode, NumberType, Pose, Reason, Reply, frame_bytes, scene_bytes,
};

pub(crate) const V: usize = 8;
pub(crate) const S: usize = 4;
const LONGEST: usize = frame_bytes(scene_bytes([V, S, 0, 0]));

pub(crate) fn setup() -> Setup {
    Setup {
        name: "bench",
        number: NumberType::F32,
        line_rate: 92_160,
        fastest_tick: 5_000,
        work_rate: 4_000_000_000,
        limits: Limits::DEFAULT,
        passivity: None,
        mode: Mode::DEFAULT,
        scene: BOX,
        knob: None,
    }
}

/// One with motors, passive below 2 b / T = 4000 N/m and 1.95 N·m/rad at 1 kHz.
pub(crate) fn driven() -> Setup {
    Setup {
        passivity: Some(Passivity {
            damping_translation: 2.0,
            damping_rotation: 1.0 / 1024.0,
            hold_us: 1_000,
            delay_us: 0,
            turn_us: 0,
        }),
        ..setup()
    }
}

pub(crate) struct Line {
    pub(crate) to_board: VecDeque<u8>,
    pub(crate) from_board: Vec<u8>,
    /// Bytes that fit into the queue to the client.
    pub(crate) room: usize,
    /// Bytes taken in this tick.
    pub(crate) taken: usize,
    ns: u32,
}

impl Link for Line {
    fn take(&mut self) -> Option<u8> {
        let byte = self.to_board.pop_front();
        self.taken += usize::from(byte.is_some());
        byte
    }
    fn send(&mut self, frame: &[u8]) -> bool {
        let fits = frame.len() <= self.room;
        if fits {
            self.room -= frame.len();
            self.from_board.extend(frame);
        }
        fits
    }
    fn now_ns(&mut self) -> u32 {
        self.ns = self.ns.wrapping_add(1_000);
        self.ns
    }
}

pub(crate) type Nothing = (FromLine, NoActuators);

pub(crate) struct Rig<R: Real = f32, const C: usize = 0, D = Nothing, const N: usize = LONGEST> {
    pub(crate) station: Station<R, V, S, C, N>,
    pub(crate) client: Client,
    pub(crate) line: Line,
    pub(crate) servo: Servo<D>,
    pub(crate) now_us: u32,
    pub(crate) force: Wrench<f32>,
}

impl<R: Real<Si = f32>, const C: usize, const N: usize> Rig<R, C, Nothing, N> {
    pub(crate) fn of(setup: Setup) -> Self {
        Self::with(setup, (FromLine, NoActuators))
    }

    pub(crate) fn new() -> Self {
        Self::of(setup())
    }
}

impl<R: Real<Si = f32>, const C: usize, D: Source + Actuators, const N: usize> Rig<R, C, D, N> {
    pub(crate) fn with(setup: Setup, device: D) -> Self {
        Self {
            station: Station::new(Box::leak(Box::new(setup))).unwrap(),
            client: Client::default(),
            line: Line {
                to_board: VecDeque::new(),
                from_board: Vec::new(),
                room: usize::MAX,
                taken: 0,
                ns: u32::MAX - 10_000,
            },
            servo: Servo::new(device),
            // The clock wraps during the test.
            now_us: u32::MAX - 50_000,
            force: Wrench::default(),
        }
    }

    /// Sends a command; returns its sequence number.
    pub(crate) fn send<'a>(&mut self, message: impl Message<'a>) -> u8 {
        let sequence = self.client.sequence;
        let bytes = self.client.encode(message);
        self.line.to_board.extend(bytes);
        sequence
    }

    /// The next tick of the board's clock, and its turn.
    pub(crate) fn tick(&mut self) -> Wrench<f32> {
        self.line.taken = 0;
        self.force = self
            .station
            .tick(self.now_us, &mut self.line, &mut self.servo);
        let period_us = 1_000_000 / u32::from(self.station.mode().tick_rate);
        self.now_us = self.now_us.wrapping_add(period_us);
        let bytes = std::mem::take(&mut self.line.from_board);
        self.client.listen(&bytes);
        self.force
    }

    pub(crate) fn hand(&mut self, hand: Hand<f32>) -> Wrench<f32> {
        self.send(Command::Hand(hand));
        self.tick()
    }

    pub(crate) fn stay(&mut self, hand: Hand<f32>, ticks: u32) -> Wrench<f32> {
        for _ in 0..ticks {
            self.hand(hand);
        }
        self.force
    }

    pub(crate) fn received(&mut self) -> Vec<Received> {
        self.client.inbox.drain(..).collect()
    }

    pub(crate) fn reports(&mut self) -> impl Iterator<Item = Said> {
        self.received().into_iter().map(|received| received.said)
    }

    pub(crate) fn poses(&mut self) -> Vec<Pose> {
        let poses = self.reports().filter_map(|said| match said {
            Said::Pose(pose) => Some(pose),
            _ => None,
        });
        poses.collect()
    }

    /// The newest pose, after a tick that sends one.
    pub(crate) fn pose(&mut self) -> Pose {
        *self.poses().last().expect("a pose")
    }

    /// The answer to a command: there is one, in the tick in which the command arrived.
    pub(crate) fn ask<'a>(&mut self, message: impl Message<'a>) -> Reply<'static> {
        let (code, sequence) = (message.code(), self.send(message));
        self.client.inbox.clear();
        self.tick();
        while !self.line.to_board.is_empty() {
            // A tick takes a part of a long frame.
            self.tick();
        }
        let answers = self
            .client
            .inbox
            .iter()
            .filter_map(|received| match &received.said {
                Said::Reply(answer) => Some(answer),
                _ => None,
            });
        let answers: Vec<_> = answers.collect();
        let [answer] = answers[..] else {
            panic!("{answers:?}")
        };
        let command = answer.command;
        assert_eq!((command.code, command.sequence), (code, sequence));
        *answer
    }

    /// A command that is carried out.
    pub(crate) fn done<'a>(&mut self, message: impl Message<'a>) {
        let answer = self.ask(message);
        assert_eq!(answer.reason, Reason::Done, "{answer:?}");
    }

    /// All answers to hello.
    pub(crate) fn hello(&mut self) -> Vec<Said> {
        self.send(Command::Hello);
        self.client.inbox.clear();
        self.tick();
        self.reports().collect()
    }

    pub(crate) fn info(&mut self) -> Info<'static> {
        let mut answers = self.hello().into_iter();
        let info = answers.find_map(|said| match said {
            Said::Info(info) => Some(info),
            _ => None,
        });
        info.expect("info")
    }

    pub(crate) fn health(&self) -> Health {
        self.station.health()
    }

    /// The mode after power-up, changed.
    pub(crate) fn mode(&mut self, change: impl FnOnce(&mut Mode)) {
        self.done(Command::Mode(with(Mode::DEFAULT, change)));
    }
}
