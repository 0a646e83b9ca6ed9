//! The scene as given by the user, in SI units, and the error for one that cannot be used.

use core::fmt;

/// A fixed half-plane in SI units, world frame. It has no ends and does not move. Of several that coincide, within a touch (STATICS 16)
/// wherever the body can be, only the one of the largest static friction makes contacts, of equal ones the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceDescription<F> {
    /// Its normal n, which points to the free side; finite, of any length but 0: it is normalised.
    pub normal: [F; 2],
    /// Its position b (m): the free side is n·p >= b, with n of length 1. Finite.
    pub offset: F,
    /// Coefficient of static friction mu_s >= mu_d: a contact sticks while |T| <= mu_s N. Finite; 0 in a model without friction.
    pub friction_static: F,
    /// Coefficient of dynamic friction mu_d >= 0: a slip ends where |T| = mu_d N. If it equals mu_s contacts slide steadily, if it is
    /// smaller they stick and slip.
    pub friction_dynamic: F,
    /// Memory length D_c (m) >= 0: the sliding distance over which a contact renews. It sticks and slips if its normal force is at least
    /// k_h D_c / (mu_s - mu_d), and slides at mu_d if it is less (STATICS 10). A small value produces more and shorter slips. Finite;
    /// `None`: L / 4096, L the body's largest vertex distance; 0 and all shorter lengths count as 2^-19 L.
    pub memory: Option<F>,
}

/// A fixed obstacle with corners in SI units, world frame: a closed convex polygon, a thin wall or a pin. It does not move; several may
/// touch or overlap and so form a world that is not convex. Coplanar sides of equal friction that meet are one side: their ends are closer
/// than 1e-9 of the body's size (in `f32` 1e-6, in [`Fixed`](crate::Fixed) 1.9e-6; for coordinates of more than a body size 8 roundings).
///
/// A table of two pieces with a step on it, and a pin above its edge:
///
/// ```
/// use stiction_core::{Description, ObstacleDescription, Parameter, Scene};
///
/// let wood = ObstacleDescription {
///     vertices: &[[-0.5, -0.1], [-0.2, -0.1], [-0.2, 0.0], [-0.5, 0.0]],
///     friction_static: 0.5,
///     friction_dynamic: 0.3,
///     memory: None,
/// };
/// let edge = [[-0.2, -0.1], [0.0, -0.1], [0.0, 0.0], [-0.2, 0.0]];
/// let step = [[-0.3, 0.0], [-0.2, 0.0], [-0.2, 0.02], [-0.3, 0.02]];
/// let of_wood = |vertices| ObstacleDescription { vertices, ..wood };
/// let pin = ObstacleDescription { friction_static: 0.3, ..of_wood(&[[0.0, 0.1]]) };
/// let world = [wood, of_wood(&edge), of_wood(&step), pin];
///
/// // A box over the edge.
/// let description = Description {
///     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
///     start: [-0.02, 0.03, 0.0],
///     weight: 2.0,
///     holding_point: Some([0.0, 0.02]),
///     reach: 0.0,
///     stiffness_translation: 500.0,
///     stiffness_rotation: 0.5,
///     surfaces: &[],
///     obstacles: &world,
/// };
/// assert!(Scene::<f32, 4, 1, 13>::new(&description).is_ok());
/// let full = Scene::<f32, 4, 1, 12>::new(&description);
/// let error = full.expect_err("room for 12 corners");
/// assert_eq!((error.parameter, error.value), (Parameter::CornerCount, 13.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObstacleDescription<'a, F> {
    /// Its corners (m), counter-clockwise: a strictly convex polygon, two for a thin wall with two sides, one for a pin. Each is farther
    /// from every side that does not end at it than the body's vertices are from theirs ([`Description::vertices`]), and no side is shorter
    /// than 2^-16 of the body's size. The corners of all obstacles are at most as many as the scene has room for, and 255 together with the
    /// surfaces.
    pub vertices: &'a [[F; 2]],
    /// Coefficient of static friction mu_s >= mu_d, like [`SurfaceDescription::friction_static`].
    pub friction_static: F,
    /// Coefficient of dynamic friction mu_d >= 0, like [`SurfaceDescription::friction_dynamic`].
    pub friction_dynamic: F,
    /// Memory length D_c (m) >= 0, like [`SurfaceDescription::memory`].
    pub memory: Option<F>,
}

/// A scene in SI units, the input of [`Scene::new`](crate::Scene::new). The world frame is right-handed with y upwards, angles are
/// counter-clockwise; the body frame is that of [`Self::vertices`], wherever its origin is.
///
/// ```
/// use stiction_core::{Description, Parameter, Scene, SurfaceDescription};
///
/// let ice = SurfaceDescription {
///     normal: [0.0, 1.0],
///     offset: 0.0,
///     friction_static: 0.1,
///     friction_dynamic: 0.3,
///     memory: None,
/// };
/// let description = Description {
///     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
///     start: [0.0, 0.03, 0.0],
///     weight: 0.0,
///     holding_point: Some([0.0, 0.02]),
///     reach: 0.0,
///     stiffness_translation: 500.0,
///     stiffness_rotation: 0.5,
///     surfaces: &[ice],
///     obstacles: &[],
/// };
/// let error = Scene::<f32, 4, 1>::new(&description).expect_err("mu_s < mu_d");
/// assert_eq!(error.parameter, Parameter::FrictionStatic(0));
/// assert_eq!(
///     error.to_string(),
///     "static friction of surface 0 is 0.1, allowed: not less than the dynamic friction"
/// );
///
/// let floor = SurfaceDescription { friction_static: 0.5, ..ice };
/// assert!(Scene::<f32, 4, 1>::new(&Description { surfaces: &[floor], ..description }).is_ok());
///
/// let sunk = Description { surfaces: &[floor], start: [0.0, 0.02, 0.0], ..description };
/// let error = Scene::<f32, 4, 1>::new(&sunk).expect_err("10 mm within the floor");
/// assert_eq!(error.parameter, Parameter::Penetration { surface: 0, vertex: 0 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description<'a, F> {
    /// Vertices (m), body frame: one point, a rod of two, or a strictly convex polygon, counter-clockwise, each farther than 3.1e-5
    /// of the body's size (in `f64` 5.8e-6, in [`Fixed`](crate::Fixed) 1.6e-5) from every side that does not end at it. At most as many as the scene has room for,
    /// and 255, among obstacles 128.
    pub vertices: &'a [[F; 2]],
    /// Start pose: x, y (m), theta (rad) of the body frame in the world. No vertex is deeper in a surface, and the body no deeper in an
    /// obstacle, than 1e-5 of its size; those closer than that touch it from the start.
    pub start: [F; 3],
    /// Weight W (N) >= 0 at the centroid, along world -y; 0 in a model without weight.
    pub weight: F,
    /// The first holding point g (m), body frame, taken wherever the hand is, with no offset between its angle and the body's. `None`: the
    /// hand takes hold where it is, within [`Self::reach`], and at its present angle, so that the springs are at rest; it does the same
    /// each time after it has let go.
    pub holding_point: Option<[F; 2]>,
    /// How far outside the body a hand may be and still take hold (m) >= 0. It does not apply to a first hold by [`Self::holding_point`].
    pub reach: F,
    /// Translational stiffness k_h (N/m) > 0: the hand pulls the holding point with k_h (p_h - G).
    pub stiffness_translation: F,
    /// Rotational stiffness k_theta (N·m/rad) >= 0: the hand turns the body with k_theta (phi - theta).
    pub stiffness_rotation: F,
    /// The surfaces, at most as many as the scene has room for, and 255.
    pub surfaces: &'a [SurfaceDescription<F>],
    /// The obstacles; their corners are together at most as many as the scene has room for.
    pub obstacles: &'a [ObstacleDescription<'a, F>],
}

/// The parameter that a [`SceneError`] is about. Indices count from 0, in the lists of the [`Description`] and of
/// the obstacles; the corners of an obstacle count from 0 in it. As text it is the
/// parameter's name: `static friction of surface 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// The number of vertices.
    VertexCount,
    /// A vertex: where it is, or that it makes the polygon not strictly convex or not counter-clockwise.
    Vertex(usize),
    /// The start pose.
    Start,
    /// The weight.
    Weight,
    /// The initial holding point.
    HoldingPoint,
    /// The reach of the grasp.
    Reach,
    /// The translational stiffness k_h.
    StiffnessTranslation,
    /// The rotational stiffness k_theta.
    StiffnessRotation,
    /// The number of surfaces.
    SurfaceCount,
    /// The normal of a surface.
    Normal(usize),
    /// The offset of a surface.
    Offset(usize),
    /// The static friction mu_s of a surface.
    FrictionStatic(usize),
    /// The dynamic friction mu_d of a surface.
    FrictionDynamic(usize),
    /// The memory length of a surface.
    Memory(usize),
    /// At the start a vertex is inside a surface; the value is its depth (m).
    Penetration {
        /// Index of the surface.
        surface: usize,
        /// Index of its deepest vertex.
        vertex: usize,
    },
    /// The number of obstacles.
    ObstacleCount,
    /// The number of corners of all obstacles together.
    CornerCount,
    /// The number of corners of an obstacle.
    Corners(usize),
    /// A corner of an obstacle: where it is, or that it makes the polygon not strictly convex or not counter-clockwise.
    Corner {
        /// Index of the obstacle.
        obstacle: usize,
        /// Index of the corner in it.
        corner: usize,
    },
    /// The length of a side of an obstacle.
    Side {
        /// Index of the obstacle.
        obstacle: usize,
        /// Index of the side in it, that of the corner where it begins.
        side: usize,
    },
    /// The static friction mu_s of an obstacle.
    ObstacleFrictionStatic(usize),
    /// The dynamic friction mu_d of an obstacle.
    ObstacleFrictionDynamic(usize),
    /// The memory length of an obstacle.
    ObstacleMemory(usize),
    /// At the start the body is inside an obstacle; the value is its depth (m).
    Overlap(usize),
}

impl fmt::Display for Parameter {
    /// The name of the parameter, as in an error: `static friction of surface 0`.
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
            Self::Memory(i) => write!(f, "memory of surface {i}"),
            Self::Penetration { surface, vertex } => {
                write!(
                    f,
                    "depth of vertex {vertex} in surface {surface} at the start"
                )
            }
            Self::ObstacleCount => write!(f, "number of obstacles"),
            Self::CornerCount => write!(f, "number of corners of all obstacles"),
            Self::Corners(i) => write!(f, "number of corners of obstacle {i}"),
            Self::Corner { obstacle, corner } => {
                write!(f, "corner {corner} of obstacle {obstacle}")
            }
            Self::Side { obstacle, side } => {
                write!(f, "length of side {side} of obstacle {obstacle}")
            }
            Self::ObstacleFrictionStatic(i) => write!(f, "static friction of obstacle {i}"),
            Self::ObstacleFrictionDynamic(i) => write!(f, "dynamic friction of obstacle {i}"),
            Self::ObstacleMemory(i) => write!(f, "memory of obstacle {i}"),
            Self::Overlap(i) => write!(f, "depth of the body in obstacle {i} at the start"),
        }
    }
}

/// Why a scene cannot be used: `<parameter> is <value>, allowed: <what>` as text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneError<F> {
    /// Which parameter.
    pub parameter: Parameter,
    /// Its value, SI units. For a position or a pose the component that is not finite, or otherwise the one with the larger magnitude, with
    /// its sign (theta if theta is at fault); this also holds for a vertex or corner whose fault is its position relative to the others.
    /// For a normal its length, or the component that is not finite; for a side its length; for a count the count; for a penetration or an
    /// overlap the depth (m).
    pub value: F,
    /// What is allowed, in words.
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
