//! The contact that holds the pose: a vertex at a place of its surface and the angle of the body about it.

use crate::contact::{Pair, Regime};
use crate::detect::Placed;
use crate::friction::SlidingEdge;
use crate::geometry::{Orientation, Pose, Vec2};
use crate::grip::Grip;
use crate::load::Load;
use crate::real::Real;
use crate::world::{Surface, World};

/// A vertex that is held at a place of its surface, and the angle of the body about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pivot<R> {
    pub(crate) contact: Pair,
    /// t·c: where along the surface. It changes by slips alone.
    pub(crate) foot: R,
    pub(crate) orientation: Orientation<R>,
}

impl<R: Real> Pivot<R> {
    /// Of a body in a pose at which the vertex of `contact` is on the surface.
    pub(crate) fn at(scene: &impl World<R>, pose: &Pose<R>, contact: Pair) -> Self {
        let vertex = scene.vertex(contact.vertex);
        let point = pose.position + pose.orientation.rotation().apply(vertex);
        Self {
            contact,
            foot: scene.surface(contact.surface).tangent.dot(point),
            orientation: pose.orientation,
        }
    }

    pub(crate) fn surface(&self, scene: &impl World<R>) -> Surface<R> {
        scene.surface(self.contact.surface)
    }

    /// c, exactly on the surface.
    pub(crate) fn point(&self, scene: &impl World<R>) -> Vec2<R> {
        let surface = self.surface(scene);
        surface.origin + surface.tangent * self.foot
    }

    pub(crate) fn placed(&self, scene: &impl World<R>) -> Placed<R> {
        Placed {
            point: self.point(scene),
            body_point: scene.vertex(self.contact.vertex),
            orientation: self.orientation,
            on: Some(self.contact.surface),
        }
    }

    /// The load on the body about the pivot. Once in an image.
    #[inline(never)]
    pub(crate) fn load(&self, scene: &impl World<R>, grip: &Grip<R>) -> Load<R> {
        Load::new(scene, self.placed(scene), grip)
    }

    /// It is pressed so hard that it has stiction of its own (STATICS 7.1, rule 3).
    pub(crate) fn is_pressed(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let surface = self.surface(scene);
        let (normal, _) = surface.reaction(self.load(scene, grip).force);
        surface.friction.is_pressed(normal)
    }

    /// What is pressed so hard sticks with stiction from here on (rule 3).
    pub(crate) fn renew(&self, scene: &impl World<R>, grip: &Grip<R>, regime: &mut Regime<R>) {
        if self.is_pressed(scene, grip) {
            *regime = Regime::Stick { stiction: true };
        }
    }

    /// The foot of a slide goes to where an edge of the friction cone balances the load, the angle as it is (E10).
    pub(crate) fn slide(&mut self, scene: &impl World<R>, grip: &Grip<R>, edge: &SlidingEdge<R>) {
        let arm = grip.holding_point - scene.vertex(self.contact.vertex);
        let lever = self.orientation.rotation().apply(arm);
        let force = grip.hand - self.point(scene) - lever + scene.weight();
        self.foot = self.foot + edge.balanced.dot(force) / edge.cos;
    }

    /// The same pivot after a slide along t and a turn. Once in an image.
    #[inline(never)]
    pub(crate) fn moved(&self, slide: R, turn: R) -> Self {
        Self {
            contact: self.contact,
            foot: self.foot + slide,
            orientation: self.orientation.plus(turn),
        }
    }
}
