//! The jamming diagram at a depth: F_x/F_z across, M/(r F_z) up, both without unit.

use crate::plane::Vec2;

/// Whitney's parallelogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagram {
    /// mu, above 0.
    pub friction: f64,
    /// lambda = l/(2 r mu), 0 or more.
    pub lambda: f64,
}

impl Diagram {
    /// Its corners, counter-clockwise, each the load of one point that slides in: the tip on the wall on the side of x, the corner of the
    /// mouth on the other side; the tip on that side, the mouth on the side of x. Sides 0 and 2 are two points, 1 and 3 one wall.
    pub fn corners(&self) -> [Vec2; 4] {
        let across = 1.0 / self.friction;
        let up = 2.0 * self.lambda + 1.0;
        [[across, -1.0], [-across, up], [-across, 1.0], [across, -up]]
    }

    /// The signed distances of a load to the four lines, positive inside, in the order of the sides from [`Self::corners`] on.
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

    /// From its middle to its farthest corner, at most.
    pub(crate) fn size(&self) -> f64 {
        1.0 / self.friction + 2.0 * self.lambda + 1.0
    }
}
