//! Which features touch: a vertex of the body on a half-plane or on a side of an obstacle, or a corner of an obstacle on a side
//! of the body.

use crate::vector::Vec2;

/// A pair that is or may come into contact. Side k of a shape runs from its vertex k to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Touch {
    /// A vertex of the body on a half-plane.
    Surface {
        /// Index into [`Scene::vertices`](crate::Scene::vertices).
        vertex: usize,
        /// Index into [`Scene::surfaces`](crate::Scene::surfaces).
        surface: usize,
    },
    /// A vertex of the body on a side of an obstacle.
    Side {
        /// Index into [`Scene::vertices`](crate::Scene::vertices).
        vertex: usize,
        /// Index into [`Scene::obstacles`](crate::Scene::obstacles).
        obstacle: usize,
        /// Index of its side.
        side: usize,
    },
    /// A corner of an obstacle on a side of the body.
    Corner {
        /// Index into [`Scene::obstacles`](crate::Scene::obstacles).
        obstacle: usize,
        /// Index of its corner.
        corner: usize,
        /// Index of the body's side.
        body_side: usize,
    },
}

impl Touch {
    /// The vertex of the body that touches, if any.
    pub const fn vertex(self) -> Option<usize> {
        match self {
            Self::Surface { vertex, .. } | Self::Side { vertex, .. } => Some(vertex),
            Self::Corner { .. } => None,
        }
    }

    /// The touched half-plane, if any.
    pub(crate) const fn surface(self) -> Option<usize> {
        match self {
            Self::Surface { surface, .. } => Some(surface),
            Self::Side { .. } | Self::Corner { .. } => None,
        }
    }

    /// The touched obstacle, if any.
    pub const fn obstacle(self) -> Option<usize> {
        match self {
            Self::Surface { .. } => None,
            Self::Side { obstacle, .. } | Self::Corner { obstacle, .. } => Some(obstacle),
        }
    }

    /// Whether both belong to the same vertex of the body.
    pub(crate) fn shares_vertex(self, other: Self) -> bool {
        self.vertex().is_some() && self.vertex() == other.vertex()
    }
}

/// The line of a contact in a pose, and its friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Face {
    /// Unit normal n towards the body, world frame.
    pub(crate) normal: Vec2,
    pub(crate) friction_static: f64,
    pub(crate) friction_dynamic: f64,
    /// D_c (m), as given.
    pub(crate) memory: Option<f64>,
}

impl Face {
    /// t = (n_y, -n_x)
    pub(crate) fn tangent(&self) -> Vec2 {
        [self.normal[1], -self.normal[0]]
    }

    /// Whether static and dynamic friction differ.
    pub(crate) fn jumps(&self) -> bool {
        self.friction_static > self.friction_dynamic
    }

    /// Whether its coefficients and memory equal those of another face.
    pub(crate) fn rubs_as(&self, other: &Self) -> bool {
        let of = |face: &Self| (face.friction_static, face.friction_dynamic, face.memory);
        of(self) == of(other)
    }
}
