//! A client of a station: from commands to bytes, ticks of a clock, from bytes to the board's reports.

use std::collections::VecDeque;
use stiction_core::{Contact, Description, Event, Hand, Wrench};
use stiction_wire::{
    Command, Decoder, Faults, Forces, Frame, Health, Info, KnobInfo, Message, Pose, Reply, Report,
    SceneCommand, Text,
};

/// Reports of a board that own their data; FRAME.md describes them.
#[allow(missing_docs)]
#[derive(Clone, Debug, PartialEq)]
pub enum Said {
    Pose(Pose),
    Forces {
        wrench: Wrench<f32>,
        feedback: Wrench<f32>,
        turns: i32,
        contacts: Vec<Contact<f32>>,
    },
    Events {
        slips: u32,
        longest_slip: f32,
        list: Vec<Event>,
    },
    Reply(Reply<'static>),
    Info(Info<'static>),
    Health(Health),
    Pong {
        sequence: u8,
        time: u32,
    },
    KnobInfo(KnobInfo),
}

impl From<Report<'_>> for Said {
    fn from(report: Report<'_>) -> Self {
        match report {
            Report::Pose(pose) => Self::Pose(pose),
            Report::Forces(forces) => said_forces(&forces),
            Report::Events(events) => Self::Events {
                slips: events.slips,
                longest_slip: events.longest_slip,
                list: events.list.iter().collect(),
            },
            Report::Reply(reply) => Self::Reply(Reply {
                allowed: stored(reply.allowed),
                ..reply
            }),
            Report::Info(info) => Self::Info(Info {
                name: stored(info.name),
                ..info
            }),
            Report::Health(health) => Self::Health(health),
            Report::Pong(pong) => Self::Pong {
                sequence: pong.sequence,
                time: pong.time,
            },
            Report::KnobInfo(info) => Self::KnobInfo(info),
        }
    }
}

fn said_forces(forces: &Forces<'_>) -> Said {
    Said::Forces {
        wrench: forces.wrench,
        feedback: forces.feedback,
        turns: forces.turns,
        contacts: forces.contacts.iter().collect(),
    }
}

/// A text that outlives the buffer of the decoder: a test receives few of them, and none is ever freed.
fn stored(text: Text<'_>) -> Text<'static> {
    Text::new(text.to_string().leak())
}

/// A report with its header.
#[allow(missing_docs)]
#[derive(Clone, Debug, PartialEq)]
pub struct Received {
    pub sequence: u8,
    pub time: u32,
    pub said: Said,
}

/// Numbers commands, and receives reports.
#[derive(Debug)]
pub struct Client {
    /// The sequence number of the next command.
    pub sequence: u8,
    decoder: Decoder<512>,
    /// What was received and not yet taken.
    pub inbox: VecDeque<Received>,
}

impl Default for Client {
    fn default() -> Self {
        Self {
            sequence: 0,
            decoder: Decoder::new(),
            inbox: VecDeque::new(),
        }
    }
}

impl Client {
    /// The next command as it is sent over the wire.
    pub fn encode<'a>(&mut self, message: impl Message<'a>) -> Vec<u8> {
        let sequence = self.sequence;
        self.sequence = sequence.wrapping_add(1);
        let mut wire = [0; 1024];
        let frame = Frame {
            sequence,
            time: 7,
            message,
        };
        frame.encode(&mut wire).unwrap().to_vec()
    }

    /// Bytes from the board.
    pub fn listen(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            if let Some(Ok(frame)) = self.decoder.push::<Report>(byte) {
                self.inbox.push_back(Received {
                    sequence: frame.sequence,
                    time: frame.time,
                    said: frame.message.into(),
                });
            }
        }
    }

    /// Frames of the board that were not accepted.
    pub fn faults(&self) -> &Faults {
        self.decoder.faults()
    }
}

/// The command of a scene.
pub fn scene(description: &'static Description<'static, f32>) -> Command<'static> {
    Command::Scene(SceneCommand::from(description))
}

/// A path of the hand along keyframes (s; m, m, rad): pressing, dragging, turning, releasing and grasping again.
pub fn hand_path(samples: u32) -> Vec<Hand<f32>> {
    const KEYS: [(f32, [f32; 3]); 9] = [
        (0.0, [0.0, 0.055, 0.0]),
        (0.1, [0.0, 0.042, 0.0]),
        (0.3, [0.08, 0.041, 0.1]),
        (0.45, [0.05, 0.060, 0.9]),
        (0.55, [0.04, 0.045, 1.2]),
        (0.7, [-0.06, 0.043, 1.7]),
        (0.8, [-0.06, 0.075, 3.0]),
        (0.9, [-0.02, 0.050, 6.1]),
        (1.0, [0.0, 0.055, 6.3]),
    ];
    (0..samples)
        .map(|i| {
            let t = i as f32 / samples as f32;
            let next = KEYS.iter().position(|(at, _)| *at > t).unwrap();
            let ((from, a), (to, b)) = (KEYS[next - 1], KEYS[next]);
            let part = (t - from) / (to - from);
            let [x, y, phi]: [f32; 3] = std::array::from_fn(|k| a[k] + (b[k] - a[k]) * part);
            let hand = Hand {
                depth: 0.3 * t,
                ..Hand::new(x, y, phi)
            };
            if (0.60..0.63).contains(&t) {
                hand.released()
            } else {
                hand
            }
        })
        .collect()
}
