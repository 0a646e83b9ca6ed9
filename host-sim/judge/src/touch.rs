//! The line that a contact has with a half-plane, a side of an obstacle or a side of the body, and its friction.

use stiction_core::Touch;

use crate::vector::Vec2;

/// Whether both belong to the same vertex of the body.
pub(crate) fn share_vertex(a: Touch, b: Touch) -> bool {
    a.vertex().is_some() && a.vertex() == b.vertex()
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
