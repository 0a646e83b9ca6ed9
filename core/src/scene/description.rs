//! The scene as it is given, in SI units, and what is said of one that cannot be used.

use core::fmt;

/// A fixed half-plane in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceDescription<F> {
    /// Points to the free side; any length but 0.
    pub normal: [F; 2],
    /// The free side is normal·p >= offset (m), the normal taken with length 1.
    pub offset: F,
    /// Static friction mu_s >= mu_d.
    pub friction_static: F,
    /// Dynamic friction mu_d >= 0.
    pub friction_dynamic: F,
}

/// A scene in SI units, as it is given to [`Scene::new`](crate::Scene::new).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description<'a, F> {
    /// Vertices (m) in the body frame: one point, a rod of two, or a strictly convex polygon, counter-clockwise.
    pub vertices: &'a [[F; 2]],
    /// Start pose: x, y (m), theta (rad) of the body frame in the world.
    pub start: [F; 3],
    /// Weight W (N) >= 0 at the centroid, along world -y.
    pub weight: F,
    /// The initial holding point g (m), body frame; the rotation's rest offset is then 0. `None`: both are taken from
    /// the hand when it takes hold.
    pub holding_point: Option<[F; 2]>,
    /// How far outside the polygon a hand may be and still take hold (m) >= 0.
    pub reach: F,
    /// Translational stiffness k_h (N/m) > 0.
    pub stiffness_translation: F,
    /// Rotational stiffness k_theta (N·m/rad) >= 0.
    pub stiffness_rotation: F,
    /// The surfaces.
    pub surfaces: &'a [SurfaceDescription<F>],
}

/// The parameter that a [`SceneError`] is about. Indices count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// The number of vertices.
    VertexCount,
    /// A vertex.
    Vertex(usize),
    /// The start pose.
    Start,
    /// The weight.
    Weight,
    /// The initial holding point.
    HoldingPoint,
    /// The reach of the grasp.
    Reach,
    /// k_h
    StiffnessTranslation,
    /// k_theta
    StiffnessRotation,
    /// The number of surfaces.
    SurfaceCount,
    /// The normal of a surface.
    Normal(usize),
    /// The offset of a surface.
    Offset(usize),
    /// mu_s of a surface.
    FrictionStatic(usize),
    /// mu_d of a surface.
    FrictionDynamic(usize),
    /// Surface `surface` at the start: vertex `vertex` is inside it.
    Penetration {
        /// The surface.
        surface: usize,
        /// The deepest vertex.
        vertex: usize,
    },
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::VertexCount => write!(f, "number of vertices"),
            Self::Vertex(i) => write!(f, "vertex {i}"),
            Self::Start => write!(f, "start pose"),
            Self::Weight => write!(f, "weight"),
            Self::HoldingPoint => write!(f, "holding point"),
            Self::Reach => write!(f, "reach"),
            Self::StiffnessTranslation => write!(f, "translational stiffness k_h"),
            Self::StiffnessRotation => write!(f, "rotational stiffness k_theta"),
            Self::SurfaceCount => write!(f, "number of surfaces"),
            Self::Normal(i) => write!(f, "normal of surface {i}"),
            Self::Offset(i) => write!(f, "offset of surface {i}"),
            Self::FrictionStatic(i) => write!(f, "static friction of surface {i}"),
            Self::FrictionDynamic(i) => write!(f, "dynamic friction of surface {i}"),
            Self::Penetration { surface, vertex } => {
                write!(
                    f,
                    "depth of vertex {vertex} in surface {surface} at the start"
                )
            }
        }
    }
}

/// Why a scene cannot be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneError<F> {
    /// Which parameter.
    pub parameter: Parameter,
    /// Its value, SI units (for a vector the component that is at fault, for a count the count).
    pub value: F,
    /// What is allowed.
    pub allowed: &'static str,
}

impl<F: fmt::Debug> fmt::Display for SceneError<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} is {:?}, allowed: {}",
            self.parameter, self.value, self.allowed
        )
    }
}

impl<F: fmt::Debug> core::error::Error for SceneError<F> {}
