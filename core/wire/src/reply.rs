//! The answer to a command on the wire (FRAME 5.4): done, or the reason why not.

use crate::Reference;
use crate::fault::{Fault, FaultKind};
use crate::fields::{Fields, Sink};
use crate::list::Text;
use stiction_core::{Parameter, SceneError};

/// Done, or the reason why not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reason {
    /// The command was carried out.
    #[default]
    Done,
    /// The frame is of another version of this format.
    Version,
    /// No command has this type.
    UnknownType,
    /// Not the length that the command has.
    Length,
    /// A field holds a code without a meaning.
    Code,
    /// A number is not allowed; the reply names it and says what is allowed.
    Number,
    /// The stiffness would make the haptic device unstable: b > K (T/2 + delay) does not hold.
    NotPassive,
    /// The board has no time, no room or no use for it.
    Unsupported,
    /// Not now: the board is stopped by a fault, another command is under way, or the body cannot settle where it is.
    NotNow,
}

impl Reason {
    /// All reasons, in the order of their codes.
    pub const ALL: [Self; 9] = [
        Self::Done,
        Self::Version,
        Self::UnknownType,
        Self::Length,
        Self::Code,
        Self::Number,
        Self::NotPassive,
        Self::Unsupported,
        Self::NotNow,
    ];

    /// The name in a log.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Version => "version",
            Self::UnknownType => "unknown-type",
            Self::Length => "length",
            Self::Code => "code",
            Self::Number => "number",
            Self::NotPassive => "not-passive",
            Self::Unsupported => "unsupported",
            Self::NotNow => "not-now",
        }
    }
}

/// What a refusal is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// The command as a whole.
    #[default]
    Command,
    /// A parameter of the scene.
    Scene(Parameter),
    /// The ticks per second (Hz).
    TickRate,
    /// The reports would not fit the line (bytes per second).
    LineRate,
}

/// The answer to a command.
///
/// ```
/// use stiction_core::{Parameter, SceneError};
/// use stiction_wire::{Reason, Reference, Reply};
///
/// let command = Reference { code: 0x03, sequence: 9 };
/// let error = SceneError { parameter: Parameter::StiffnessTranslation, value: -1.0, allowed: "more than 0" };
/// let reply = Reply::refused_scene(command, &error);
/// assert_eq!(reply.reason, Reason::Number);
/// assert_eq!(reply.allowed, "more than 0");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply<'a> {
    /// The command that is answered.
    pub command: Reference,
    /// Done, or the reason why not.
    pub reason: Reason,
    /// What the refusal is about.
    pub subject: Subject,
    /// The value that is refused, in the unit of the subject; otherwise 0.
    pub value: f32,
    /// The nearest value that is allowed, or, for [`Reason::NotPassive`], the bound that the value must stay below, if the board knows it;
    /// otherwise NaN.
    pub limit: f32,
    /// What is allowed, in words; may be empty.
    pub allowed: Text<'a>,
}

impl<'a> Reply<'a> {
    /// The command was carried out.
    pub const fn done(command: Reference) -> Self {
        Self::refused(command, Reason::Done)
    }

    /// The command was refused as a whole.
    pub const fn refused(command: Reference, reason: Reason) -> Self {
        Self {
            command,
            reason,
            subject: Subject::Command,
            value: 0.0,
            limit: f32::NAN,
            allowed: Text::new(""),
        }
    }

    /// The command would make a scene that cannot be used.
    pub const fn refused_scene(command: Reference, error: &SceneError<f32>) -> Self {
        Self {
            command,
            reason: Reason::Number,
            subject: Subject::Scene(error.parameter),
            value: error.value,
            limit: f32::NAN,
            allowed: Text::new(error.allowed),
        }
    }

    /// For a frame that arrived undamaged but is no command. `None` for one that arrived damaged: what it was is unknown.
    pub const fn to_fault(fault: &Fault) -> Option<Self> {
        let reason = match fault.kind {
            FaultKind::Version => Reason::Version,
            FaultKind::UnknownType => Reason::UnknownType,
            FaultKind::Length => Reason::Length,
            FaultKind::Value => Reason::Code,
            FaultKind::TooLong | FaultKind::Cobs | FaultKind::Crc => return None,
        };
        match fault.frame {
            Some(frame) => Some(Self::refused(frame, reason)),
            None => None,
        }
    }

    /// The command was carried out.
    pub fn is_done(&self) -> bool {
        self.reason == Reason::Done
    }

    const HEAD_BYTES: usize = 14;
    /// With the longest text.
    pub(crate) const LONGEST: usize = Self::HEAD_BYTES + Text::LONGEST;

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        self.write_about(subject_code, sink);
    }

    /// Like [`Self::write`], for a board with room for obstacles.
    pub(crate) fn write_among(&self, sink: &mut impl Sink) {
        self.write_about(
            |subject| obstacle_code(subject).unwrap_or(subject_code(subject)),
            sink,
        );
    }

    fn write_about(&self, code: impl FnOnce(Subject) -> (u8, [usize; 2]), sink: &mut impl Sink) {
        self.command.write(sink);
        sink.code(&Reason::ALL, &self.reason);
        let (code, [first, second]) = code(self.subject);
        sink.byte(code);
        sink.count(first);
        sink.count(second);
        sink.f32s(&[self.value, self.limit]);
        self.allowed.write(sink);
    }

    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        Self::read_about(fields, subject)
    }

    /// Like [`Self::read`], for a board with room for obstacles.
    pub(crate) fn read_among(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        Self::read_about(fields, |about| match obstacle_subject(about) {
            Some(parameter) => Ok(Subject::Scene(parameter)),
            None => subject(about),
        })
    }

    /// Reads the payload of a reply (FRAME 5.4), with `subject` for the three bytes of the subject and its indices.
    fn read_about(
        fields: &mut Fields<'a>,
        subject: impl FnOnce([u8; 3]) -> Result<Subject, FaultKind>,
    ) -> Result<Self, FaultKind> {
        fields.at_least(Self::HEAD_BYTES)?;
        let command = Reference::read(fields);
        let reason = fields.code(&Reason::ALL)?;
        let subject = subject(fields.take())?;
        let [value, limit] = fields.f32s();
        Ok(Self {
            command,
            reason,
            subject,
            value,
            limit,
            allowed: Text::read(fields.remaining()).ok_or(FaultKind::Value)?,
        })
    }
}

/// The code of a subject and the indices that belong to it.
const fn subject_code(subject: Subject) -> (u8, [usize; 2]) {
    match subject {
        Subject::Command => (0, [0; 2]),
        Subject::Scene(parameter) => match parameter {
            Parameter::VertexCount => (1, [0; 2]),
            Parameter::Vertex(i) => (2, [i, 0]),
            Parameter::Start => (3, [0; 2]),
            Parameter::Weight => (4, [0; 2]),
            Parameter::HoldingPoint => (5, [0; 2]),
            Parameter::Reach => (6, [0; 2]),
            Parameter::StiffnessTranslation => (7, [0; 2]),
            Parameter::StiffnessRotation => (8, [0; 2]),
            Parameter::SurfaceCount => (9, [0; 2]),
            Parameter::Normal(i) => (10, [i, 0]),
            Parameter::Offset(i) => (11, [i, 0]),
            Parameter::FrictionStatic(i) => (12, [i, 0]),
            Parameter::FrictionDynamic(i) => (13, [i, 0]),
            Parameter::Penetration { surface, vertex } => (14, [surface, vertex]),
            Parameter::Memory(i) => (15, [i, 0]),
            // Subjects about obstacles, for which most boards have no room: see `obstacle_code`.
            _ => (0, [0; 2]),
        },
        Subject::TickRate => (32, [0; 2]),
        Subject::LineRate => (33, [0; 2]),
    }
}

/// The subject of a code and its indices, in a reply without obstacles; the inverse of [`subject_code`].
fn subject([code, first, second]: [u8; 3]) -> Result<Subject, FaultKind> {
    let (i, j) = (usize::from(first), usize::from(second));
    let parameter = match code {
        0 => return Ok(Subject::Command),
        1 => Parameter::VertexCount,
        2 => Parameter::Vertex(i),
        3 => Parameter::Start,
        4 => Parameter::Weight,
        5 => Parameter::HoldingPoint,
        6 => Parameter::Reach,
        7 => Parameter::StiffnessTranslation,
        8 => Parameter::StiffnessRotation,
        9 => Parameter::SurfaceCount,
        10 => Parameter::Normal(i),
        11 => Parameter::Offset(i),
        12 => Parameter::FrictionStatic(i),
        13 => Parameter::FrictionDynamic(i),
        14 => Parameter::Penetration {
            surface: i,
            vertex: j,
        },
        15 => Parameter::Memory(i),
        32 => return Ok(Subject::TickRate),
        33 => return Ok(Subject::LineRate),
        _ => return Err(FaultKind::Value),
    };
    Ok(Subject::Scene(parameter))
}

/// The refusal is about an obstacle.
pub(crate) const fn is_of_obstacles(subject: Subject) -> bool {
    obstacle_code(subject).is_some()
}

/// Like [`subject_code`], for the parameters of an obstacle.
const fn obstacle_code(subject: Subject) -> Option<(u8, [usize; 2])> {
    let Subject::Scene(parameter) = subject else {
        return None;
    };
    Some(match parameter {
        Parameter::ObstacleCount => (16, [0; 2]),
        Parameter::CornerCount => (17, [0; 2]),
        Parameter::Corners(i) => (18, [i, 0]),
        Parameter::Corner { obstacle, corner } => (19, [obstacle, corner]),
        Parameter::Side { obstacle, side } => (20, [obstacle, side]),
        Parameter::ObstacleFrictionStatic(i) => (21, [i, 0]),
        Parameter::ObstacleFrictionDynamic(i) => (22, [i, 0]),
        Parameter::ObstacleMemory(i) => (23, [i, 0]),
        Parameter::Overlap(i) => (24, [i, 0]),
        _ => return None,
    })
}

/// The parameter of an obstacle for a code and its indices, the inverse of [`obstacle_code`]; `None` for other codes.
fn obstacle_subject([code, first, second]: [u8; 3]) -> Option<Parameter> {
    let (obstacle, index) = (usize::from(first), usize::from(second));
    Some(match code {
        16 => Parameter::ObstacleCount,
        17 => Parameter::CornerCount,
        18 => Parameter::Corners(obstacle),
        19 => Parameter::Corner {
            obstacle,
            corner: index,
        },
        20 => Parameter::Side {
            obstacle,
            side: index,
        },
        21 => Parameter::ObstacleFrictionStatic(obstacle),
        22 => Parameter::ObstacleFrictionDynamic(obstacle),
        23 => Parameter::ObstacleMemory(obstacle),
        24 => Parameter::Overlap(obstacle),
        _ => return None,
    })
}
