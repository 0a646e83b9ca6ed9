//! The jamming diagram at a depth: F_x/F_z horizontally, M/(r F_z) vertically, both dimensionless.

use super::plane::Vec2;

/// Whitney's parallelogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagram {
    /// mu, above 0.
    pub friction: f64,
    /// lambda = l/(2 r mu), at least 0.
    pub lambda: f64,
}

impl Diagram {
    /// Its corners, counter-clockwise, each the load of a single contact that slides in: the tip on the wall on the side of x, then the
    /// corner of the mouth on the other side; the tip on that side, then the mouth on the side of x. Sides 0 and 2 represent two-point
    /// contact, sides 1 and 3 one wall.
    pub fn corners(&self) -> [Vec2; 4] {
        let across = 1.0 / self.friction;
        let up = 2.0 * self.lambda + 1.0;
        [[across, -1.0], [-across, up], [-across, 1.0], [across, -up]]
    }

    /// The signed distances of a load to the four lines, positive inside, in the order of the sides of [`Self::corners`].
    pub fn distances(&self, [across, up]: Vec2) -> [f64; 4] {
        let Self { friction, lambda } = *self;
        let slope = friction * (1.0 + lambda);
        let (on_line, scale) = (up + slope * across, libm::hypot(1.0, slope));
        [
            (lambda - on_line) / scale,
            1.0 / friction + across,
            (lambda + on_line) / scale,
            1.0 / friction - across,
        ]
    }

    /// The signed distance to the nearest of the four lines, positive inside.
    pub fn margin(&self, load: Vec2) -> f64 {
        self.distances(load)
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }

    /// An upper bound of the distance from its centre to its farthest corner.
    pub(crate) fn size(&self) -> f64 {
        1.0 / self.friction + 2.0 * self.lambda + 1.0
    }
}
