//! The scene of the reference in plain SI `f64`: the body, its surroundings, and the wrench with which hand and weight load the
//! body. World frame, moments counter-clockwise.

pub(super) use crate::obstacles::shape::{dot, length, sub};

/// A vector in the plane.
pub(super) type Vector = [f64; 2];

/// A wrench (force, moment / body size) or a twist (translation, rotation * body size), so that its three components are comparable.
pub(super) type Screw = [f64; 3];

/// A half-plane that the body cannot enter: the free side is `normal . p >= offset`.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Unit vector into the free side.
    pub normal: [f64; 2],
    /// Position along the normal, m.
    pub offset: f64,
    /// Static friction coefficient, >= `mu_d`.
    pub mu_s: f64,
    /// Dynamic friction coefficient, >= 0.
    pub mu_d: f64,
    /// Memory length of the contact, m: motions with longer slips are stick-slip, those with shorter ones a slide. Below 2^-19
    /// body sizes it counts as that.
    pub memory: f64,
}

/// A fixed convex polygon that the body cannot enter.
#[derive(Clone, Debug)]
pub struct Obstacle {
    /// Corners, counter-clockwise, m. Two: a thin wall. One: a pin.
    pub vertices: Vec<[f64; 2]>,
    /// Static friction coefficient, >= `mu_d`.
    pub mu_s: f64,
    /// Dynamic friction coefficient, >= 0.
    pub mu_d: f64,
    /// Memory length of the contact, m, as for a [`Surface`].
    pub memory: f64,
}

/// The friction of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Friction {
    pub mu_s: f64,
    pub mu_d: f64,
    pub memory: f64,
}

/// A held polygon and its surroundings.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Vertices of the convex body, counter-clockwise, body frame, m.
    pub vertices: Vec<[f64; 2]>,
    /// The point at which the hand holds the body, body frame, m.
    pub holding_point: [f64; 2],
    /// Translational stiffness, N/m, > 0.
    pub k_h: f64,
    /// Rotational stiffness, N m/rad, >= 0.
    pub k_theta: f64,
    /// Weight at the centroid along world -y, N.
    pub weight: f64,
    /// The half-planes.
    pub surfaces: Vec<Surface>,
    /// The convex obstacles; they may touch or overlap.
    pub obstacles: Vec<Obstacle>,
}

/// Position of the body frame, m, and its unwrapped orientation, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub position: Vector,
    pub angle: f64,
}

impl Pose {
    /// World position of a point of the body, m.
    pub(super) fn apply(&self, point: Vector) -> Vector {
        let (sin, cos) = self.angle.sin_cos();
        add(
            self.position,
            [
                cos * point[0] - sin * point[1],
                sin * point[0] + cos * point[1],
            ],
        )
    }

    /// A direction of the body in the world frame.
    pub(super) fn direction(&self, direction: Vector) -> Vector {
        let (sin, cos) = self.angle.sin_cos();
        [
            cos * direction[0] - sin * direction[1],
            sin * direction[0] + cos * direction[1],
        ]
    }

    /// The point of the body at a given point of the world, m.
    pub(super) fn inverse(&self, point: Vector) -> Vector {
        let back = Self {
            position: [0.0, 0.0],
            angle: -self.angle,
        };
        back.direction(sub(point, self.position))
    }

    /// The pose with orientation `angle` that places the body point `held` at `at`.
    pub(super) fn holding(held: Vector, at: Vector, angle: f64) -> Self {
        let turned = Self {
            position: [0.0, 0.0],
            angle,
        }
        .apply(held);
        Self {
            position: sub(at, turned),
            angle,
        }
    }

    /// The pose moved by a twist, whose rotation is in units of `size`.
    pub(super) fn moved(&self, twist: Screw, size: f64) -> Self {
        Self {
            position: add(self.position, [twist[0], twist[1]]),
            angle: self.angle + twist[2] / size,
        }
    }
}

impl Scene {
    /// Largest distance between two vertices or from a vertex to the holding point, m.
    pub(super) fn size(&self) -> f64 {
        let points = || self.vertices.iter().chain([&self.holding_point]);
        let largest = points()
            .flat_map(|&a| points().map(move |&b| length(sub(a, b))))
            .fold(0.0, f64::max);
        if largest > 0.0 { largest } else { 1.0 }
    }

    /// Centroid of the polygon (of the rod, of the point), body frame, m.
    pub(super) fn centroid(&self) -> Vector {
        let v = &self.vertices;
        let first = v[0];
        let (mut area, mut sum) = (0.0, [0.0, 0.0]);
        for pair in v[1..].windows(2) {
            let (a, b) = (sub(pair[0], first), sub(pair[1], first));
            area += cross(a, b);
            sum = add(sum, scale(cross(a, b) / 3.0, add(a, b)));
        }
        if area != 0.0 {
            return add(first, scale(1.0 / area, sum));
        }
        scale(
            1.0 / v.len() as f64,
            v.iter().fold([0.0, 0.0], |sum, &p| add(sum, p)),
        )
    }

    /// Force of hand and weight on the body, N.
    pub(super) fn applied_force(&self, pose: &Pose, hand: [f64; 3]) -> Vector {
        let spring = scale(
            self.k_h,
            sub([hand[0], hand[1]], pose.apply(self.holding_point)),
        );
        sub(spring, [0.0, self.weight])
    }

    /// Moment of hand and weight on the body about the world point `about`, N m.
    pub(super) fn applied_moment(&self, pose: &Pose, hand: [f64; 3], about: Vector) -> f64 {
        let grip = pose.apply(self.holding_point);
        let spring = scale(self.k_h, sub([hand[0], hand[1]], grip));
        let lean = if self.weight == 0.0 {
            0.0
        } else {
            cross(sub(pose.apply(self.centroid()), about), [0.0, -self.weight])
        };
        self.k_theta * (hand[2] - pose.angle) + cross(sub(grip, about), spring) + lean
    }
}

pub(super) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn scale(factor: f64, a: Vector) -> Vector {
    [factor * a[0], factor * a[1]]
}

pub(super) fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
