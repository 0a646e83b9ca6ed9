//! The messages about obstacles between a board and its client (FRAME 8): all messages of [`Command`] and [`Report`], and those that a
//! scene with obstacles needs in addition.

use crate::command::Command;
use crate::fault::FaultKind;
use crate::fields::{Fields, Sink};
use crate::forces::Forces;
use crate::list::Item;
use crate::message::Wire;
use crate::obstacles::SceneAmong;
use crate::reply::{Reply, is_of_obstacles};
use crate::report::{LONGEST_REPORT, REPLY, Report};
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
            Self::SceneAmong(scene) => scene.write(sink),
        }
    }

    fn read(code: u8, fields: Fields<'a>) -> Result<Self, FaultKind> {
        match code {
            SCENE_AMONG => SceneAmong::read(&fields).map(Self::SceneAmong),
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
            Self::Common(Report::Reply(reply)) if is_of_obstacles(reply.subject) => VERSION_AMONG,
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
            Self::Common(Report::Reply(reply)) => reply.write_among(sink),
            Self::Common(report) => report.write(sink),
            Self::Room(room) => sink.put(&[room.obstacles, room.corners]),
            Self::ForcesAmong(forces) => forces.write(sink),
        }
    }

    fn read(code: u8, mut fields: Fields<'a>) -> Result<Self, FaultKind> {
        match code {
            REPLY => Reply::read_among(&mut fields).map(|reply| Self::Common(Report::Reply(reply))),
            ROOM => {
                fields.exactly(2)?;
                let [obstacles, corners] = fields.take();
                Ok(Self::Room(Room { obstacles, corners }))
            }
            FORCES_AMONG => Forces::read(&mut fields).map(Self::ForcesAmong),
            _ => Report::read(code, fields).map(Self::Common),
        }
    }
}

/// Stands for a half-plane in the place of an obstacle.
const HALF_PLANE: u8 = u8::MAX;
/// Marks a side of the body that a corner of an obstacle touches.
const BODY_SIDE: u8 = 0x80;

/// The three bytes of a touch: vertex or side of the body, obstacle, and which of its sides or corners, or which half-plane. `None` if an
/// index is too large for them.
fn touch_bytes(touch: Touch) -> Option<[u8; 3]> {
    let of_body = |index: usize| u8::try_from(index).ok().filter(|byte| *byte < BODY_SIDE);
    let of_obstacle = |index: usize| u8::try_from(index).ok().filter(|byte| *byte < HALF_PLANE);
    Some(match touch {
        Touch::Surface { vertex, surface } => {
            [of_body(vertex)?, HALF_PLANE, u8::try_from(surface).ok()?]
        }
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => [
            of_body(vertex)?,
            of_obstacle(obstacle)?,
            u8::try_from(side).ok()?,
        ],
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => [
            of_body(body_side)? | BODY_SIDE,
            of_obstacle(obstacle)?,
            u8::try_from(corner).ok()?,
        ],
    })
}

/// A half-plane has no corner.
const fn is_touch([of_body, obstacle]: [u8; 2]) -> bool {
    of_body & BODY_SIDE == 0 || obstacle != HALF_PLANE
}

/// The touch of three bytes, the inverse of [`touch_bytes`]; they have already been validated.
fn touch([of_body, obstacle, index]: [u8; 3]) -> Touch {
    let [on_body, obstacle_index, index] = [of_body & !BODY_SIDE, obstacle, index].map(usize::from);
    if obstacle == HALF_PLANE {
        Touch::Surface {
            vertex: on_body,
            surface: index,
        }
    } else if of_body & BODY_SIDE == 0 {
        Touch::Side {
            vertex: on_body,
            obstacle: obstacle_index,
            side: index,
        }
    } else {
        Touch::Corner {
            obstacle: obstacle_index,
            corner: index,
            body_side: on_body,
        }
    }
}

impl Item for ContactAmong {
    const BYTES: usize = 28;
    fn put(&self, sink: &mut impl Sink) {
        match touch_bytes(self.touch) {
            Some(bytes) => sink.put(&bytes),
            None => sink.refuse(),
        }
        sink.f32s(&self.direction);
        sink.f32s(&self.point);
        sink.f32s(&[self.normal, self.friction]);
        sink.byte(self.sliding.cast_unsigned());
    }
    /// Reads a contact in the order of FRAME 5.9; its bytes have already been validated.
    fn get(fields: &mut Fields<'_>) -> Self {
        let touch = touch(fields.take());
        let (direction, point) = (fields.f32s(), fields.f32s());
        let [normal, friction] = fields.f32s();
        Self {
            touch,
            direction,
            point,
            normal,
            friction,
            sliding: fields.u8().cast_signed(),
        }
    }
    fn valid(bytes: &[u8]) -> bool {
        let is_one = bytes.first_chunk().is_some_and(|touch| is_touch(*touch));
        let sliding = bytes.last().map(|byte| byte.cast_signed());
        is_one && sliding.is_some_and(|sign| (-1..=1).contains(&sign))
    }
}
