//! Joint angles to the pose of the hand, and a wrench on the hand to joint torques by the transposed Jacobian: the power of
//! the torques is that of the wrench, tau·dq = F·dP + M dphi.

use super::geometry::{Geometry, GeometryError, HandleMount};
use core::f32::consts::FRAC_PI_2;
use stiction_core::{Angle, Real, Wrench};

/// Why a configuration of the mechanism cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fault {
    /// The encoders have not been read, or cannot be.
    NotRead,
    /// The elbows are farther apart, or closer, than the distal links reach: counts were lost.
    Unreachable,
    /// The distal links are collinear, or nearly so (or on top of each other): no force across them can be output.
    Singular,
    /// A number is not finite.
    NotFinite,
}

impl Fault {
    /// Its name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NotRead => "not-read",
            Self::Unreachable => "unreachable",
            Self::Singular => "singular",
            Self::NotFinite => "not-finite",
        }
    }
}

type Vector = [f32; 2];

/// The position of the mechanism, and how the hand moves with its joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Configuration {
    /// P: position of the hand in the world (m).
    pub position: [f32; 2],
    /// phi: angle of the handle in the world, unwrapped.
    pub handle: Angle<f32>,
    /// dP/dq1 and dP/dq2 (m/rad). The handle's joint does not move P.
    pub position_by_joint: [[f32; 2]; 2],
    /// dphi/dq of the three joints.
    pub handle_by_joint: [f32; 3],
}

impl Configuration {
    /// The torques (N·m) of the three joints that produce a wrench on the hand.
    ///
    /// # Errors
    /// [`Fault::NotFinite`] if the wrench, or a torque for it, is not finite.
    pub fn torques(&self, wrench: &Wrench<f32>) -> Result<[f32; 3], Fault> {
        let [by_left, by_right] = self.position_by_joint;
        let [left, right, handle] = self.handle_by_joint.map(|turn| turn * wrench.moment);
        let torques = [
            dot(by_left, wrench.force) + left,
            dot(by_right, wrench.force) + right,
            handle,
        ];
        if torques.into_iter().all(Real::is_finite) {
            Ok(torques)
        } else {
            Err(Fault::NotFinite)
        }
    }
}

/// The kinematics of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    geometry: Geometry,
}

/// The proximal link of an arm.
#[derive(Clone, Copy)]
struct Arm {
    /// Its far end, in the world (m).
    elbow: Vector,
    /// The link as a vector rotated by a quarter turn, counter-clockwise (m): the displacement of the elbow per radian of the joint's
    /// angle.
    turned: Vector,
}

impl Kinematics {
    /// # Errors
    /// [`GeometryError`] names the first parameter that is not finite or out of its range.
    pub fn new(geometry: &Geometry) -> Result<Self, GeometryError> {
        geometry.check()?;
        Ok(Self {
            geometry: *geometry,
        })
    }

    fn arm(&self, at: f32, length: f32, angle: Angle<f32>) -> Arm {
        let [x, y] = self.geometry.origin;
        let (sin, cos) = Real::sin_cos(angle.rest);
        Arm {
            elbow: [x + at + length * cos, y + length * sin],
            turned: [-length * sin, length * cos],
        }
    }

    /// P where the distal links meet, to the left of the line from B1 to B2.
    fn hand(&self, left: &Arm, right: &Arm) -> Result<Vector, Fault> {
        let [r1, r2] = self.geometry.distal;
        let [dx, dy] = minus(right.elbow, left.elbow);
        let apart = Real::hypot(dx, dy);
        // Elbows on top of each other: the hand may be anywhere around them.
        if apart <= 1e-6 * r1 {
            return Err(Fault::Singular);
        }
        let along = ((r1 - r2) * (r1 + r2) / apart + apart) * 0.5;
        let square = (r1 - along) * (r1 + along);
        if square < 0.0 {
            return Err(Fault::Unreachable);
        }
        let across = Real::sqrt(square);
        let (ux, uy) = (dx / apart, dy / apart);
        let [x, y] = left.elbow;
        Ok([x + along * ux - across * uy, y + along * uy + across * ux])
    }

    /// The configuration at joint angles: left, right, handle.
    ///
    /// # Errors
    /// [`Fault`]: the mechanism cannot be there, or can output no force there.
    pub fn solve(&self, joints: &[Angle<f32>; 3]) -> Result<Configuration, Fault> {
        let [q1, q2, q3] = *joints;
        if ![q1, q2, q3].into_iter().all(Angle::is_finite) {
            return Err(Fault::NotFinite);
        }
        let geometry = &self.geometry;
        let ([l1, l2], [r1, r2]) = (geometry.proximal, geometry.distal);
        let left = self.arm(-0.5 * geometry.base, l1, q1);
        let right = self.arm(0.5 * geometry.base, l2, q2);
        let position = self.hand(&left, &right)?;

        let u1 = minus(position, left.elbow);
        let u2 = minus(position, right.elbow);
        let area = cross(u1, u2);
        // Also false for NaN.
        let is_stiff = Real::abs(area) >= geometry.least_sine * r1 * r2;
        if !is_stiff {
            return Err(Fault::Singular);
        }
        // u_i·dP = u_i·t_i dq_i, for both arms: the distal links keep their lengths.
        let by_left = scaled(turned_back(u2), dot(u1, left.turned) / area);
        let by_right = scaled(turned_back(u1), -dot(u2, right.turned) / area);

        let (link, by) = match geometry.handle {
            HandleMount::Base => (0.0, [0.0, 0.0]),
            HandleMount::LeftLink => {
                let by = [minus(by_left, left.turned), by_right];
                (angle(u1), by.map(|v| cross(u1, v) / (r1 * r1)))
            }
            HandleMount::RightLink => {
                let by = [by_left, minus(by_right, right.turned)];
                (angle(u2), by.map(|v| cross(u2, v) / (r2 * r2)))
            }
        };
        let [a, b] = by;
        let configuration = Configuration {
            position,
            handle: q3.plus(link),
            position_by_joint: [by_left, by_right],
            handle_by_joint: [a, b, 1.0],
        };
        if configuration.is_finite() {
            Ok(configuration)
        } else {
            Err(Fault::NotFinite)
        }
    }
}

impl Configuration {
    fn is_finite(&self) -> bool {
        let [[a, b], [c, d]] = self.position_by_joint;
        let [x, y] = self.position;
        self.handle.is_finite()
            && [a, b, c, d, x, y].into_iter().all(Real::is_finite)
            && self.handle_by_joint.into_iter().all(Real::is_finite)
    }
}

fn dot([ax, ay]: Vector, [bx, by]: Vector) -> f32 {
    ax * bx + ay * by
}

fn cross([ax, ay]: Vector, [bx, by]: Vector) -> f32 {
    ax * by - ay * bx
}

fn minus([ax, ay]: Vector, [bx, by]: Vector) -> Vector {
    [ax - bx, ay - by]
}

fn scaled([x, y]: Vector, k: f32) -> Vector {
    [x * k, y * k]
}

/// Rotated by a quarter turn, clockwise.
fn turned_back([x, y]: Vector) -> Vector {
    [y, -x]
}

/// From +x (rad), in [-pi/2, 3 pi/2]: a distal link points straight down only with crossed elbows, so the angle is continuous over the
/// workspace.
fn angle([x, y]: Vector) -> f32 {
    FRAC_PI_2 + Real::atan2(-x, y)
}
