//! The springs between hand and body: force F = k_h (p_h - G), couple M = k_theta (phi - theta); and the displacement of the hand, which is
//! the other end of both. Lengths / L, forces / (k_h L): k_h is 1.

use crate::friction::SlidingEdge;
use crate::geometry::{Angle, Pose, Vec2};
use crate::real::Real;
use crate::surface::Surface;
use crate::world::World;

/// The hand's hold on the body: the boundary condition of every equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Grip<R> {
    /// g, body frame.
    pub(crate) holding_point: Vec2<R>,
    /// p_h, world frame.
    pub(crate) hand: Vec2<R>,
    /// phi less its rest offset.
    pub(crate) angle: Angle<R>,
}

impl<R: Real> Grip<R> {
    /// F and k_theta (phi - theta) on a body in a pose.
    pub(crate) fn springs(&self, scene: &impl World<R>, pose: &Pose<R>) -> (Vec2<R>, R) {
        let held = pose.position + pose.orientation.rotation().apply(self.holding_point);
        let turn = self.angle.minus(pose.orientation.angle());
        (self.hand - held, scene.stiffness() * turn)
    }

    /// Returns whether the body swings freely about the holding point (STATICS 3.7).
    pub(crate) fn swings(&self, scene: &impl World<R>) -> bool {
        scene.swings(self.holding_point - scene.centroid())
    }

    /// The straight path of the hand: `self` at 0, `to` at 1.
    pub(crate) fn lerp(&self, to: &Self, part: R) -> Self {
        Self {
            holding_point: to.holding_point,
            hand: self.hand.lerp(to.hand, part),
            angle: self.angle.plus(to.angle.minus(self.angle) * part),
        }
    }

    /// Continued in the direction of another grip, possibly beyond it, until the load on a body that stays has changed by `change`.
    pub(crate) fn ahead(&self, scene: &impl World<R>, to: &Self, change: R) -> Self {
        let displacement = self.displacement_to(to);
        let changes = displacement.changes(scene);
        if changes == R::ZERO {
            return *self;
        }
        let unit = changes.unit();
        Self {
            holding_point: self.holding_point,
            hand: self.hand + displacement.hand.in_units(unit) * change,
            angle: self.angle.plus(displacement.turn.in_units(unit) * change),
        }
    }

    /// This grip moved toward another one, but not beyond it, by a given change.
    pub(crate) fn toward(&self, scene: &impl World<R>, to: &Self, change: R) -> Self {
        let changes = self.displacement_to(to).changes(scene);
        let part = if changes > change {
            change / changes
        } else {
            R::ONE
        };
        self.lerp(to, part)
    }

    /// The displacement of the hand to another grip, including its turn.
    pub(crate) fn displacement_to(&self, to: &Self) -> Displacement<R> {
        Displacement {
            hand: to.hand - self.hand,
            turn: to.angle.minus(self.angle),
        }
    }
}

/// A displacement of the hand and its turn, relative to the contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Displacement<R> {
    pub(crate) hand: Vec2<R>,
    pub(crate) turn: R,
}

impl<R: Real> Displacement<R> {
    /// The contact slides by `shift` while the hand is frozen: relative to the contact the hand moves back.
    pub(crate) fn slide(shift: Vec2<R>) -> Self {
        Self {
            hand: -shift,
            turn: R::ZERO,
        }
    }

    /// The hand turns only.
    pub(crate) fn turn(turn: R) -> Self {
        Self {
            hand: Vec2::ZERO,
            turn,
        }
    }

    /// The component that drives the turn of a body whose foot slides along a surface: the foot follows the rest.
    pub(crate) fn pressing(&self, surface: &Surface<R>, edge: &SlidingEdge<R>) -> Self {
        Self {
            hand: edge.reaction * surface.normal.dot(self.hand),
            turn: self.turn,
        }
    }

    /// The change that it causes in the load on a body that stays.
    fn changes(&self, scene: &impl World<R>) -> R {
        self.hand.length_bound() + scene.stiffness() * self.turn.abs()
    }

    /// The most by which it can move the body: displacement and turn at a lever of one body size.
    pub(crate) fn size(&self) -> R {
        self.hand.length_bound() + self.turn.abs()
    }
}
