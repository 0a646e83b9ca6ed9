//! Messages from the board (FRAME 5).

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink};
use crate::forces::{Events, Forces};
use crate::health::Health;
use crate::info::Info;
use crate::knob::KnobInfo;
use crate::layout::layout;
use crate::message::Wire;
use crate::pose::Pose;
use crate::reply::Reply;

/// A message from the board. Poses, forces and events of one step have the same time.
///
/// ```
/// use stiction_core::{Evolution, Hand, Scene, Solver, State};
/// # use stiction_core::{Description, SurfaceDescription};
/// use stiction_wire::{EventSet, Frame, Pose, Report};
///
/// # let scene: Scene<f32, 1, 1> = Scene::new(&Description {
/// #     vertices: &[[0.0, 0.0]], start: [0.0; 3], weight: 0.0, holding_point: Some([0.0; 2]), reach: 0.0,
/// #     stiffness_translation: 500.0, stiffness_rotation: 0.0, surfaces: &[], obstacles: &[],
/// # })?;
/// let solver = Solver::new(scene, Evolution::Path);
/// let (mut state, _) = solver.start(Hand::new(0.0, 0.05, 0.0));
/// let output = solver.step(&mut state, Hand::new(0.0, 0.04, 0.0));
///
/// let pose = Pose::new(&output, EventSet::of(output.events()), 17);
/// let frame = Frame { sequence: 0, time: 1000, message: Report::Pose(pose) };
/// assert_eq!(frame.encode(&mut [0; 33]).map(<[u8]>::len), Some(33));
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Report<'a> {
    /// The pose after a step.
    Pose(Pose),
    /// The forces after a step.
    Forces(Forces<'a>),
    /// What happened in a step, in order.
    Events(Events<'a>),
    /// A command was carried out or refused.
    Reply(Reply<'a>),
    /// What the board is and its present settings.
    Info(Info<'a>),
    /// The condition of the board.
    Health(Health),
    /// The answer to a ping.
    Pong(Pong),
    /// The numbers of the board's knob.
    KnobInfo(KnobInfo),
}

/// The answer to [`Command::Ping`](crate::Command::Ping). The time in its header shows the difference of the clocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pong {
    /// Sequence number of the ping.
    pub sequence: u8,
    /// The time in its header (µs).
    pub time: u32,
}

layout! { Pong { sequence: u8, time: u32 } }

/// The longest payload that a board sends (bytes): [`wire_bytes`](crate::wire_bytes) of it is the room that the board needs to encode its
/// reports.
pub const LONGEST_REPORT: usize = {
    let (one, other) = (Reply::LONGEST, Forces::LONGEST);
    let one = if one > other { one } else { other };
    if one > Info::LONGEST {
        one
    } else {
        Info::LONGEST
    }
};

const _: () = assert!(
    Events::LONGEST <= LONGEST_REPORT
        && Health::BYTES <= LONGEST_REPORT
        && KnobInfo::BYTES <= LONGEST_REPORT,
    "they take no more room than other reports"
);

/// The contact state is added to it.
const POSE: u8 = 0x80;
const FORCES: u8 = 0x90;
const EVENTS: u8 = 0x91;
const REPLY: u8 = 0x92;
const INFO: u8 = 0x93;
const HEALTH: u8 = 0x94;
const PONG: u8 = 0x95;
const KNOB_INFO: u8 = 0x96;
/// Types of poses: one for each contact state.
const LAST_POSE: u8 = POSE + 5;

impl Report<'_> {
    /// The name of the message.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Pose(_) => "pose",
            Self::Forces(_) => "forces",
            Self::Events(_) => "events",
            Self::Reply(_) => "reply",
            Self::Info(_) => "info",
            Self::Health(_) => "health",
            Self::Pong(_) => "pong",
            Self::KnobInfo(_) => "knob-info",
        }
    }
}

impl<'a> Wire<'a> for Report<'a> {
    fn code(&self) -> u8 {
        match self {
            Self::Pose(pose) => POSE.wrapping_add(pose.state_code()),
            Self::Forces(_) => FORCES,
            Self::Events(_) => EVENTS,
            Self::Reply(_) => REPLY,
            Self::Info(_) => INFO,
            Self::Health(_) => HEALTH,
            Self::Pong(_) => PONG,
            Self::KnobInfo(_) => KNOB_INFO,
        }
    }

    /// Writes the payload of each report in the order of its table in FRAME 5.
    fn write(&self, sink: &mut impl Sink) {
        match self {
            Self::Pose(pose) => pose.write(sink),
            Self::Forces(forces) => forces.write(sink),
            Self::Events(events) => events.write(sink),
            Self::Reply(reply) => reply.write(sink),
            Self::Info(info) => info.write(sink),
            Self::Health(health) => health.put(sink),
            Self::Pong(pong) => pong.put(sink),
            Self::KnobInfo(info) => info.put(sink),
        }
    }

    /// Reads the payload of a type; fails if the type is unknown, the length is wrong, or a value is not permitted.
    fn read(code: u8, mut fields: Fields<'a>) -> Result<Self, FaultKind> {
        match code {
            POSE..=LAST_POSE => Pose::read(code & 7, &mut fields).map(Self::Pose),
            FORCES => Forces::read(&mut fields).map(Self::Forces),
            EVENTS => Events::read(&mut fields).map(Self::Events),
            REPLY => Reply::read(&mut fields).map(Self::Reply),
            INFO => Info::read(&mut fields).map(Self::Info),
            HEALTH => fields.only().map(Self::Health),
            PONG => fields.only().map(Self::Pong),
            KNOB_INFO => fields.only().map(Self::KnobInfo),
            _ => Err(FaultKind::UnknownType),
        }
    }
}
