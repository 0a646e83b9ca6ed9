//! Why a command is refused (FRAME 5.4): converts the errors of the control loop to reason, subject, value, limit and words.

use crate::device::Refusal;
use crate::knob::KnobError;
use crate::safety::{Allowed, LimitError, LimitParameter};
use stiction_core::{Parameter, SceneError};
use stiction_wire::{Reason, Reference, Reply, Subject, Text};

/// A reply that has no address yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trouble {
    pub(super) reason: Reason,
    pub(super) subject: Subject,
    /// The value that is refused; 0 if there is none.
    pub(super) value: f32,
    /// The nearest value that is allowed; NaN if it is not known.
    pub(super) limit: f32,
    pub(super) allowed: &'static str,
}

impl Trouble {
    pub(super) const fn whole(reason: Reason, allowed: &'static str) -> Self {
        Self {
            reason,
            subject: Subject::Command,
            value: 0.0,
            limit: f32::NAN,
            allowed,
        }
    }

    pub(super) const fn reply(&self, command: Reference) -> Reply<'static> {
        Reply {
            command,
            reason: self.reason,
            subject: self.subject,
            value: self.value,
            limit: self.limit,
            allowed: Text::new(self.allowed),
        }
    }

    pub(super) const fn of_knob(reason: Reason, error: &KnobError) -> Self {
        Self {
            reason,
            subject: Subject::Knob(error.number),
            value: error.value,
            limit: error.limit,
            allowed: error.allowed,
        }
    }

    /// For a board with room for V vertices and S surfaces and C corners of obstacles.
    pub(super) fn of<const V: usize, const S: usize, const C: usize>(refusal: &Refusal) -> Self {
        match refusal {
            Refusal::Scene(error) => scene::<V, S, C>(error),
            Refusal::Limit(error) => limit(error),
            Refusal::Unsettled(_) => Self::whole(
                Reason::NotNow,
                "the body cannot settle where it is: reset it, or release it",
            ),
            Refusal::OutOfReach => Self::whole(
                Reason::NotNow,
                "the hold of the hand would be out of reach: reset the body, or release it",
            ),
        }
    }
}

/// A scene that is wrong, or right but too large for the board.
fn scene<const V: usize, const S: usize, const C: usize>(error: &SceneError<f32>) -> Trouble {
    let value = error.value;
    let room = match error.parameter {
        Parameter::VertexCount => Some(V as f32),
        Parameter::SurfaceCount => Some(S as f32),
        Parameter::ObstacleCount | Parameter::CornerCount => Some(C as f32),
        _ => None,
    };
    let beyond = room.filter(|room| value > *room);
    Trouble {
        reason: match beyond {
            Some(_) => Reason::Unsupported,
            None => Reason::Number,
        },
        subject: Subject::Scene(error.parameter),
        value,
        limit: beyond.unwrap_or(f32::NAN),
        allowed: error.allowed,
    }
}

/// A stiffness that the device cannot display passively. The limits themselves are those of the setup and of checked modes.
fn limit(error: &LimitError) -> Trouble {
    let subject = match error.parameter {
        LimitParameter::StiffnessTranslation => Subject::Scene(Parameter::StiffnessTranslation),
        LimitParameter::StiffnessRotation => Subject::Scene(Parameter::StiffnessRotation),
        _ => Subject::Command,
    };
    match error.allowed {
        Allowed::PassiveBelow(bound) => Trouble {
            reason: Reason::NotPassive,
            subject,
            value: error.value,
            limit: bound,
            allowed: "0, or less than this limit, at and above which the device is not passive",
        },
        Allowed::Within(..) => Trouble::whole(Reason::Unsupported, "other limits of the device"),
    }
}
