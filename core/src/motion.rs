//! A point on any motion of the body, to first order: its pose and the velocity of each of its points. Among obstacles a normal may turn
//! with the body, so the end of a motion is found from values and slopes at points of it (STATICS 12.3).

use crate::bounded::Sloped;
use crate::contact::Pair;
use crate::detect::Placed;
use crate::geometry::Vec2;
use crate::real::Real;
use crate::surface::Surface;
use crate::world::World;

/// The body at a point of a motion, and its velocity per unit of the motion's parameter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instant<R> {
    pub(crate) placed: Placed<R>,
    /// The velocity of the body's material at the placed point.
    pub(crate) velocity: Vec2<R>,
    /// dϑ/dx
    pub(crate) turn: R,
}

/// Normal and friction reaction of a contact, and their rates of change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bears<R> {
    pub(crate) normal: Sloped<R>,
    pub(crate) friction: Sloped<R>,
}

impl<R: Real> Bears<R> {
    /// A linear combination of N and T.
    pub(crate) fn combine(&self, (normal, friction): (R, R)) -> Sloped<R> {
        Sloped {
            value: self.normal.value * normal + self.friction.value * friction,
            slope: self.normal.slope * normal + self.friction.slope * friction,
        }
    }
}

impl<R: Real> Instant<R> {
    /// At rest.
    pub(crate) fn at_rest(placed: Placed<R>) -> Self {
        Self {
            placed,
            velocity: Vec2::ZERO,
            turn: R::ZERO,
        }
    }

    /// The velocity of the body's material at an arm from the placed point.
    pub(crate) fn velocity_at(&self, arm: Vec2<R>) -> Vec2<R> {
        self.velocity + arm.turned() * self.turn
    }

    /// The gap of a contact.
    pub(crate) fn gap(&self, scene: &impl World<R>, contact: Pair) -> Sloped<R> {
        let surface = self.surface(scene, contact);
        let arm = self.placed.arm_to(scene, contact);
        Sloped {
            value: self.placed.gap(scene, contact),
            slope: surface.normal.dot(self.velocity_at(arm)),
        }
    }

    /// The coordinate along t of the body's material at a contact.
    pub(crate) fn foot(&self, scene: &impl World<R>, contact: Pair) -> Sloped<R> {
        let surface = self.surface(scene, contact);
        let arm = self.placed.arm_to(scene, contact);
        Sloped {
            value: self.placed.foot(scene, contact),
            slope: surface.tangent.dot(self.velocity_at(arm)),
        }
    }

    /// The surface of a contact at the present orientation of the body.
    pub(crate) fn surface(&self, scene: &impl World<R>, contact: Pair) -> Surface<R> {
        scene.face(contact, self.placed.orientation.rotation())
    }

    /// The force of the load and its rate of change, for a hand at a position with a velocity.
    pub(crate) fn force(
        &self,
        scene: &impl World<R>,
        holding_point: Vec2<R>,
        (hand, rate): (Vec2<R>, Vec2<R>),
    ) -> (Vec2<R>, Vec2<R>) {
        let rotation = self.placed.orientation.rotation();
        let lever = rotation.apply(holding_point - self.placed.body_point);
        let force = hand - self.placed.point - lever + scene.weight();
        (force, rate - self.velocity_at(lever))
    }

    /// The reaction of a contact that alone bears a force with a rate of change.
    pub(crate) fn bears(
        &self,
        scene: &impl World<R>,
        contact: Pair,
        (force, rate): (Vec2<R>, Vec2<R>),
    ) -> Bears<R> {
        let surface = self.surface(scene, contact);
        // The normal of a corner turns with the body.
        let turn = if contact.is_corner() {
            self.turn
        } else {
            R::ZERO
        };
        let along = |direction: Vec2<R>| Sloped {
            value: -direction.dot(force),
            slope: -direction.dot(rate) - direction.turned().dot(force) * turn,
        };
        Bears {
            normal: along(surface.normal),
            friction: along(surface.tangent),
        }
    }
}
