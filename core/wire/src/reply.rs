//! The answer to a command on the wire (FRAME 5.4): done, or the reason why not.

use crate::Reference;
use crate::fault::{Fault, FaultKind};
use crate::field::{Field, Fields, Sink};
use crate::knob::KnobNumber;
use crate::layout::coded;
use crate::list::Text;
use stiction_core::{Parameter, SceneError};

coded! {
    /// Done, or the reason why not.
    pub enum Reason {
        /// The command was carried out.
        Done = "done",
        /// The frame is of another version of this format.
        Version = "version",
        /// No command has this type.
        UnknownType = "unknown-type",
        /// Not the length that the command has.
        Length = "length",
        /// A field holds a code without a meaning.
        Code = "code",
        /// A number is not allowed; the reply names it and says what is allowed.
        Number = "number",
        /// The stiffness, or the damping of a knob, would make the haptic device unstable: b > K (T/2 + delay) does not hold.
        NotPassive = "not-passive",
        /// The board has no time, no room or no use for it.
        Unsupported = "unsupported",
        /// Not now: the board is stopped by a fault, another command is under way, or the body cannot settle where it is.
        NotNow = "not-now",
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
    /// A number of the board's knob.
    Knob(KnobNumber),
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
    /// The nearest value that is allowed, or, for [`Reason::NotPassive`], the bound that a stiffness must stay below and a damping above, if
    /// the board knows it; otherwise NaN.
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
        self.command.put(sink);
        self.reason.put(sink);
        self.subject.code().put(sink);
        [self.value, self.limit].put(sink);
        self.allowed.write(sink);
    }

    /// Reads the payload of a reply (FRAME 5.4).
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(Self::HEAD_BYTES)?;
        let (command, reason) = (fields.get()?, fields.get()?);
        Ok(Self {
            command,
            reason,
            subject: Subject::of(fields.get()?).ok_or(FaultKind::Value)?,
            value: fields.get()?,
            limit: fields.get()?,
            allowed: Text::read(fields)?,
        })
    }
}

/// Codes of parameters, each with the indices that belong to it.
macro_rules! parameters {
    ($($code:literal = $name:ident $(($one:ident))? $({ $first:ident, $second:ident })?,)+) => {
        /// The code of a parameter, and its indices.
        const fn parameter_code(parameter: Parameter) -> [usize; 3] {
            match parameter {
                $(Parameter::$name $(($one))? $({ $first, $second })? => {
                    parameters!(@code $code $($one)? $($first $second)?)
                })+
            }
        }

        /// The parameter of a code and its indices, the inverse of [`parameter_code`]; `None` for other codes.
        const fn parameter_of([code, a, b]: [usize; 3]) -> Option<Parameter> {
            // Most parameters have fewer indices.
            let _ = (a, b);
            Some(match code {
                $($code => {
                    $(let $one = a;)?
                    $(let ($first, $second) = (a, b);)?
                    Parameter::$name $(($one))? $({ $first, $second })?
                })+
                _ => return None,
            })
        }
    };
    (@code $code:literal) => { [$code, 0, 0] };
    (@code $code:literal $one:ident) => { [$code, $one, 0] };
    (@code $code:literal $first:ident $second:ident) => { [$code, $first, $second] };
}

parameters! {
    1 = VertexCount,
    2 = Vertex(i),
    3 = Start,
    4 = Weight,
    5 = HoldingPoint,
    6 = Reach,
    7 = StiffnessTranslation,
    8 = StiffnessRotation,
    9 = SurfaceCount,
    10 = Normal(i),
    11 = Offset(i),
    12 = FrictionStatic(i),
    13 = FrictionDynamic(i),
    14 = Penetration { surface, vertex },
    15 = Memory(i),
    16 = ObstacleCount,
    17 = CornerCount,
    18 = Corners(i),
    19 = Corner { obstacle, corner },
    20 = Side { obstacle, side },
    21 = ObstacleFrictionStatic(i),
    22 = ObstacleFrictionDynamic(i),
    23 = ObstacleMemory(i),
    24 = Overlap(i),
}

const TICK_RATE: usize = 32;
const LINE_RATE: usize = 33;
/// Of the first number of a knob; the others follow in their order.
const KNOB: usize = 48;

impl Subject {
    /// The code, and the indices that belong to it.
    const fn code(self) -> [usize; 3] {
        match self {
            Self::Command => [0; 3],
            Self::Scene(parameter) => parameter_code(parameter),
            Self::TickRate => [TICK_RATE, 0, 0],
            Self::LineRate => [LINE_RATE, 0, 0],
            Self::Knob(number) => [KNOB.saturating_add(number as usize), 0, 0],
        }
    }

    /// The subject of a code and its indices; `None` if the code has no meaning.
    fn of(code: [usize; 3]) -> Option<Self> {
        match code {
            [0, ..] => Some(Self::Command),
            [TICK_RATE, ..] => Some(Self::TickRate),
            [LINE_RATE, ..] => Some(Self::LineRate),
            [number, ..] if number >= KNOB => {
                let number = KnobNumber::ALL.get(number.saturating_sub(KNOB));
                number.copied().map(Self::Knob)
            }
            _ => parameter_of(code).map(Self::Scene),
        }
    }
}
