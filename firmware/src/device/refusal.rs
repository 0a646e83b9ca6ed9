//! Why something cannot be used: converts the errors of the scene and of the limits to one reason for a client.

use crate::safety::LimitError;
use core::fmt;
use stiction_core::{CarryError, SceneError, Status};

/// Why a scene, a parameter or a limit was refused. Nothing has changed then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// The scene, or the body's present pose in it.
    Scene(SceneError<f32>),
    /// A limit of the device, or a stiffness that it cannot display passively.
    Limit(LimitError),
    /// The body cannot be held at its present pose.
    Unsettled(Status),
    /// The point at which the hand holds the body would be out of reach.
    OutOfReach,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Limit(error) => error.fmt(f),
            Self::Unsettled(status) => {
                write!(f, "the body cannot settle where it is: {}", status.name())
            }
            Self::OutOfReach => f.write_str("the hand's hold on the body would be out of reach"),
        }
    }
}

impl core::error::Error for Refusal {}

impl From<SceneError<f32>> for Refusal {
    fn from(error: SceneError<f32>) -> Self {
        Self::Scene(error)
    }
}

impl From<CarryError<Self>> for Refusal {
    fn from(error: CarryError<Self>) -> Self {
        match error {
            CarryError::Scene(refusal) => refusal,
            CarryError::Unsettled(status) => Self::Unsettled(status),
            CarryError::OutOfReach => Self::OutOfReach,
        }
    }
}

impl From<LimitError> for Refusal {
    fn from(error: LimitError) -> Self {
        Self::Limit(error)
    }
}
