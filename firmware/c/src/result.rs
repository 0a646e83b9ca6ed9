//! The result of a function, and the error of a scene.

use stiction_core::{Parameter as Of, SceneError};

/// The result of a function. Unless it is `STICTION_RESULT_OK`, nothing was done and nothing written, except the error of a scene.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Result {
    /// Success.
    Ok = 0,
    /// A pointer that must not be is null.
    Null = -1,
    /// A pointer is not aligned for what it points to.
    Unaligned = -2,
    /// The library does not match the header: another version, number type, or with obstacles or without.
    Abi = -3,
    /// The memory is smaller than `sizeof(stiction)`, or a snapshot smaller than `sizeof(stiction_snapshot)`.
    Size = -4,
    /// The memory holds no solver: `stiction_init` has not been called, or has failed.
    NotInitialised = -5,
    /// The solver has no run: `stiction_start` has not been called.
    NotStarted = -6,
    /// The scene cannot be used; `stiction_error` says why.
    Scene = -7,
    /// The choice does not exist.
    Choice = -8,
    /// The snapshot holds no run of this library.
    NoSnapshot = -9,
}

/// The parameter of a scene that an error is about.
#[repr(u8)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Parameter {
    /// None: there is no error.
    #[default]
    None = 0,
    /// The number of vertices.
    VertexCount,
    /// Vertex `index`: where it is, or that it makes the polygon not strictly convex or not counter-clockwise.
    Vertex,
    /// The start pose.
    Start,
    /// The weight.
    Weight,
    /// The holding point.
    HoldingPoint,
    /// The reach of the grasp.
    Reach,
    /// The translational stiffness.
    StiffnessTranslation,
    /// The rotational stiffness.
    StiffnessRotation,
    /// The number of surfaces.
    SurfaceCount,
    /// The normal of surface `index`.
    Normal,
    /// The offset of surface `index`.
    Offset,
    /// The static friction of surface `index`.
    FrictionStatic,
    /// The dynamic friction of surface `index`.
    FrictionDynamic,
    /// The memory length of surface `index`.
    Memory,
    /// At the start vertex `second` is inside surface `index`.
    Penetration,
    /// The number of obstacles.
    ObstacleCount,
    /// The number of corners of all obstacles together.
    CornerCount,
    /// The number of corners of obstacle `index`.
    Corners,
    /// Corner `second` of obstacle `index`.
    Corner,
    /// The length of side `second` of obstacle `index`.
    Side,
    /// The static friction of obstacle `index`.
    ObstacleFrictionStatic,
    /// The dynamic friction of obstacle `index`.
    ObstacleFrictionDynamic,
    /// The memory length of obstacle `index`.
    ObstacleMemory,
    /// At the start the body is inside obstacle `index`.
    Overlap,
}

/// Why a scene cannot be used. `stiction_error_text` turns it into a sentence.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Error {
    /// Which parameter: a `stiction_parameter`.
    pub parameter: u8,
    /// Index of the vertex, surface or obstacle that it belongs to, from 0; 0 if there is none.
    pub index: u8,
    /// Index of the vertex, corner or side in it, from 0; 0 if there is none.
    pub second: u8,
    /// Its value, in the unit of the parameter; for a count the count, for a penetration or an overlap the depth (m).
    pub value: f32,
    /// What is allowed, in words, and its number of bytes: it is not terminated by 0.
    pub allowed: *const u8,
    /// See `allowed`.
    pub allowed_length: usize,
}

impl Error {
    pub(crate) fn of(error: &SceneError<f32>) -> Self {
        let (parameter, [index, second]) = Parameter::of(error.parameter);
        let index_of = |index| u8::try_from(index).unwrap_or(u8::MAX);
        Self {
            parameter: parameter as u8,
            index: index_of(index),
            second: index_of(second),
            value: error.value,
            allowed: error.allowed.as_ptr(),
            allowed_length: error.allowed.len(),
        }
    }
}

/// Each parameter with its indices, as in the core.
macro_rules! parameters {
    ($($name:ident [$($index:ident),*] = $of:tt)*) => {
        impl Parameter {
            fn of(parameter: Of) -> (Self, [usize; 2]) {
                match parameter {
                    $(parameters!(@ $of) => (Self::$name, two(&[$($index),*])),)*
                }
            }

            /// The parameter of a code, with these indices; `None` for no error, and for an invalid code.
            pub(crate) fn named(code: u8, indices: [usize; 2]) -> Option<Of> {
                $(if code == Self::$name as u8 {
                    let [$($index,)* ..] = indices;
                    return Some(parameters!(@ $of));
                })*
                None
            }
        }
    };
    (@ ($($of:tt)+)) => { $($of)+ };
}

parameters! {
    VertexCount [] = (Of::VertexCount)
    Vertex [i] = (Of::Vertex(i))
    Start [] = (Of::Start)
    Weight [] = (Of::Weight)
    HoldingPoint [] = (Of::HoldingPoint)
    Reach [] = (Of::Reach)
    StiffnessTranslation [] = (Of::StiffnessTranslation)
    StiffnessRotation [] = (Of::StiffnessRotation)
    SurfaceCount [] = (Of::SurfaceCount)
    Normal [i] = (Of::Normal(i))
    Offset [i] = (Of::Offset(i))
    FrictionStatic [i] = (Of::FrictionStatic(i))
    FrictionDynamic [i] = (Of::FrictionDynamic(i))
    Memory [i] = (Of::Memory(i))
    Penetration [surface, vertex] = (Of::Penetration { surface, vertex })
    ObstacleCount [] = (Of::ObstacleCount)
    CornerCount [] = (Of::CornerCount)
    Corners [i] = (Of::Corners(i))
    Corner [obstacle, corner] = (Of::Corner { obstacle, corner })
    Side [obstacle, side] = (Of::Side { obstacle, side })
    ObstacleFrictionStatic [i] = (Of::ObstacleFrictionStatic(i))
    ObstacleFrictionDynamic [i] = (Of::ObstacleFrictionDynamic(i))
    ObstacleMemory [i] = (Of::ObstacleMemory(i))
    Overlap [i] = (Of::Overlap(i))
}

fn two(indices: &[usize]) -> [usize; 2] {
    let at = |i: usize| indices.get(i).copied().unwrap_or(0);
    [at(0), at(1)]
}
