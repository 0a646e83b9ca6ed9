//! The messages about obstacles between a board and its client (FRAME 8): all messages of [`Command`] and [`Report`], and those that a
//! scene with obstacles needs in addition.

use crate::command::Command;
use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink, is_sliding_sign, require};
use crate::forces::Forces;
use crate::layout::layout;
use crate::message::Wire;
use crate::reply::Reply;
use crate::report::{LONGEST_REPORT, REPLY, Report};
use crate::scene::{SceneAmong, SceneCommand};
use crate::{VERSION, VERSION_AMONG};
use stiction_core::{Contact, Touch, Touching};

/// A message to a board with room for obstacles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CommandAmong<'a> {
    /// One that every board knows.
    Common(Command<'a>),
    /// A new scene among obstacles. The body starts again. Answered by [`Report::Reply`].
    SceneAmong(SceneAmong<'a>),
}

/// A message from a board with room for obstacles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReportAmong<'a> {
    /// One that every board sends.
    Common(Report<'a>),
    /// The room for obstacles; sent before the answer to [`Command::Hello`].
    Room(Room),
    /// The forces after a step in a scene with obstacles.
    ForcesAmong(Forces<'a, ContactAmong>),
}

/// The room of a board for obstacles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Room {
    /// The number of obstacles.
    pub obstacles: u8,
    /// The number of corners of all obstacles together.
    pub corners: u8,
}

layout! { Room { obstacles: u8, corners: u8 } }

/// A contact among obstacles: a [`Contact`] with what touches what, and the direction of its normal. SI units, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactAmong {
    /// What touches what.
    pub touch: Touch,
    /// The unit normal n towards the body.
    pub direction: [f32; 2],
    /// Where they touch (m).
    pub point: [f32; 2],
    /// Reaction N >= 0 on the body along n (N).
    pub normal: f32,
    /// Friction T on the body along the tangent t = (n_y, -n_x) (N).
    pub friction: f32,
    /// 0 if it sticks, 1 or -1 if it slides along t or against it with the hand.
    pub sliding: i8,
}

layout! {
    ContactAmong {
        touch: Touch, direction: [f32; 2], point: [f32; 2], normal: f32, friction: f32, sliding: i8
    } if |contact| is_sliding_sign(contact.sliding)
}

impl ContactAmong {
    /// From a contact of a state and the corresponding item of [`Solver::touches`](stiction_core::Solver::touches).
    pub const fn new(contact: &Contact<f32>, touching: &Touching<f32>) -> Self {
        Self {
            touch: touching.touch,
            direction: touching.direction,
            point: contact.point,
            normal: contact.normal,
            friction: contact.friction,
            sliding: contact.sliding,
        }
    }
}

const SCENE_AMONG: u8 = 0x09;
const ROOM: u8 = 0x96;
const FORCES_AMONG: u8 = 0x97;

const _: () = assert!(
    Forces::<ContactAmong>::LONGEST <= LONGEST_REPORT,
    "they take no more room than other reports"
);

impl CommandAmong<'_> {
    /// The name of the message.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Common(command) => command.name(),
            Self::SceneAmong(_) => "scene-among",
        }
    }
}

impl<'a> From<Command<'a>> for CommandAmong<'a> {
    fn from(command: Command<'a>) -> Self {
        Self::Common(command)
    }
}

impl<'a> Wire<'a> for CommandAmong<'a> {
    const NEWEST: u8 = VERSION_AMONG;

    fn version(&self) -> u8 {
        match self {
            Self::Common(_) => VERSION,
            Self::SceneAmong(_) => VERSION_AMONG,
        }
    }

    fn code(&self) -> u8 {
        match self {
            Self::Common(command) => command.code(),
            Self::SceneAmong(_) => SCENE_AMONG,
        }
    }

    fn write(&self, sink: &mut impl Sink) {
        match self {
            Self::Common(command) => command.write(sink),
            Self::SceneAmong(among) => among.scene.write(Some(&among.obstacles), sink),
        }
    }

    fn read(code: u8, mut fields: Fields<'a>) -> Result<Self, FaultKind> {
        match code {
            SCENE_AMONG => {
                let (scene, obstacles) = SceneCommand::read_among(&mut fields)?;
                Ok(Self::SceneAmong(SceneAmong { scene, obstacles }))
            }
            _ => Command::read(code, fields).map(Self::Common),
        }
    }
}

impl ReportAmong<'_> {
    /// The name of the message.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Common(report) => report.name(),
            Self::Room(_) => "room",
            Self::ForcesAmong(_) => "forces-among",
        }
    }
}

impl<'a> From<Report<'a>> for ReportAmong<'a> {
    fn from(report: Report<'a>) -> Self {
        Self::Common(report)
    }
}

impl<'a> Wire<'a> for ReportAmong<'a> {
    const NEWEST: u8 = VERSION_AMONG;

    fn version(&self) -> u8 {
        match self {
            Self::Common(Report::Reply(reply)) if reply.subject.is_of_obstacles() => VERSION_AMONG,
            // A client that does not know the room goes on without it.
            Self::Common(_) | Self::Room(_) => VERSION,
            Self::ForcesAmong(_) => VERSION_AMONG,
        }
    }

    fn code(&self) -> u8 {
        match self {
            Self::Common(report) => report.code(),
            Self::Room(_) => ROOM,
            Self::ForcesAmong(_) => FORCES_AMONG,
        }
    }

    fn write(&self, sink: &mut impl Sink) {
        match self {
            Self::Common(Report::Reply(reply)) => reply.write(true, sink),
            Self::Common(report) => report.write(sink),
            Self::Room(room) => room.put(sink),
            Self::ForcesAmong(forces) => forces.write(sink),
        }
    }

    fn read(code: u8, mut fields: Fields<'a>) -> Result<Self, FaultKind> {
        match code {
            REPLY => {
                let reply = Reply::read(&mut fields, true)?;
                Ok(Self::Common(Report::Reply(reply)))
            }
            ROOM => fields.only().map(Self::Room),
            FORCES_AMONG => Forces::read(&mut fields).map(Self::ForcesAmong),
            _ => Report::read(code, fields).map(Self::Common),
        }
    }
}

/// Stands for a half-plane in the place of an obstacle.
const HALF_PLANE: u8 = u8::MAX;
/// Marks a side of the body that a corner of an obstacle touches.
const BODY_SIDE: u8 = 0x80;

/// Vertex or side of the body; obstacle; which of its sides or corners, or which half-plane.
impl Field for Touch {
    const BYTES: usize = 3;
    fn put(&self, sink: &mut impl Sink) {
        let (mark, of_body, obstacle, index) = match *self {
            Self::Surface { vertex, surface } => (0, vertex, None, surface),
            Self::Side {
                vertex,
                obstacle,
                side,
            } => (0, vertex, Some(obstacle), side),
            Self::Corner {
                obstacle,
                corner,
                body_side,
            } => (BODY_SIDE, body_side, Some(obstacle), corner),
        };
        let of_body = u8::try_from(of_body).ok().filter(|&i| i < BODY_SIDE);
        let obstacle = match obstacle {
            Some(obstacle) => u8::try_from(obstacle).ok().filter(|&i| i < HALF_PLANE),
            None => Some(HALF_PLANE),
        };
        match (of_body, obstacle) {
            (Some(of_body), Some(obstacle)) => {
                sink.put(&[of_body | mark, obstacle]);
                index.put(sink);
            }
            (None, _) | (_, None) => sink.refuse(),
        }
    }
    fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        let [of_body, obstacle] = fields.take();
        let index: usize = fields.get()?;
        let (is_corner, of_body) = (of_body & BODY_SIDE != 0, usize::from(of_body & !BODY_SIDE));
        let is_half_plane = obstacle == HALF_PLANE;
        let obstacle = usize::from(obstacle);
        // A half-plane has no corner.
        require(!(is_corner && is_half_plane), FaultKind::Value)?;
        Ok(if is_half_plane {
            Self::Surface {
                vertex: of_body,
                surface: index,
            }
        } else if is_corner {
            Self::Corner {
                obstacle,
                corner: index,
                body_side: of_body,
            }
        } else {
            Self::Side {
                vertex: of_body,
                obstacle,
                side: index,
            }
        })
    }
}
