//! The contact that holds the pose: a vertex at a point of its surface and the angle of the body about it.

use crate::contact::{Pair, Regime};
use crate::detect::Placed;
use crate::friction::SlidingEdge;
use crate::geometry::{Orientation, Pose, Vec2};
use crate::grip::Grip;
use crate::load::Load;
use crate::real::Real;
use crate::surface::Surface;
use crate::world::World;

/// A vertex that is held at a point of its surface, and the angle of the body about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pivot<R> {
    pub(crate) contact: Pair,
    /// t·c: the coordinate along the surface. Only slips change it.
    pub(crate) foot: R,
    pub(crate) orientation: Orientation<R>,
}

impl<R: Real> Pivot<R> {
    /// For a body in a pose at which the vertex of `contact` is on the surface.
    pub(crate) fn at(scene: &impl World<R>, pose: &Pose<R>, contact: Pair) -> Self {
        let rotation = pose.orientation.rotation();
        let surface = scene.face(contact, rotation);
        // For a corner it is the body's material that has a coordinate along t.
        let foot = match corner(scene, contact) {
            Some(corner) => surface.tangent.dot(pose.position - corner),
            None => {
                let vertex = scene.vertex(contact.vertex);
                surface.tangent.dot(pose.position + rotation.apply(vertex))
            }
        };
        Self {
            contact,
            foot,
            orientation: pose.orientation,
        }
    }

    pub(crate) fn surface(&self, scene: &impl World<R>) -> Surface<R> {
        scene.face(self.contact, self.orientation.rotation())
    }

    /// c, exactly on the surface.
    pub(crate) fn point<W: World<R>>(&self, scene: &W) -> Vec2<R> {
        if W::CORNERS
            && let Some(corner) = corner(scene, self.contact)
        {
            return corner;
        }
        let surface = scene.surface(self.contact.surface);
        surface.origin + surface.tangent * self.foot
    }

    /// The point of the body at c, body frame.
    fn body_point<W: World<R>>(&self, scene: &W) -> Vec2<R> {
        if !W::CORNERS || !self.contact.is_corner() {
            return scene.vertex(self.contact.vertex);
        }
        let side = self.contact.body_side();
        let outward = scene.body_normal(side);
        // t_b = (-m_y, m_x); the coordinate of the material is -t_b·b.
        outward * outward.dot(scene.vertex(side)) - outward.turned() * self.foot
    }

    pub(crate) fn placed<W: World<R>>(&self, scene: &W) -> Placed<R> {
        let surface = self.contact.surface;
        Placed {
            point: self.point(scene),
            body_point: self.body_point(scene),
            orientation: self.orientation,
            on: (!W::CORNERS || !self.contact.is_corner()).then_some(surface),
        }
    }

    /// Returns whether the contact is on its side, to within a touch.
    pub(crate) fn is_on_side<W: World<R>>(&self, scene: &W) -> bool {
        !W::CORNERS || self.placed(scene).beyond(scene, self.contact) <= R::TOUCH
    }

    /// The load on the body about the pivot. Compiled once per image.
    #[inline(never)]
    pub(crate) fn load(&self, scene: &impl World<R>, grip: &Grip<R>) -> Load<R> {
        Load::new(scene, self.placed(scene), grip)
    }

    /// Returns whether it is pressed so hard that it has stiction of its own (STATICS 7.1, rule 3).
    pub(crate) fn is_pressed(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let surface = self.surface(scene);
        let (normal, _) = surface.reaction(self.load(scene, grip).force);
        surface.friction.is_pressed(normal)
    }

    /// If it is pressed that hard, it sticks with stiction from here on (rule 3).
    pub(crate) fn renew(&self, scene: &impl World<R>, grip: &Grip<R>, regime: &mut Regime<R>) {
        if self.is_pressed(scene, grip) {
            *regime = Regime::Stick { stiction: true };
        }
    }

    /// Moves the foot of a slide to where an edge of the friction cone balances the load, at the same angle (E10).
    pub(crate) fn slide(&mut self, scene: &impl World<R>, grip: &Grip<R>, edge: &SlidingEdge<R>) {
        let arm = grip.holding_point - self.body_point(scene);
        let lever = self.orientation.rotation().apply(arm);
        let force = grip.hand - self.point(scene) - lever + scene.weight();
        self.foot = self.foot + edge.balanced.dot(force) / edge.cos;
    }

    /// Moves the foot as a slide does, as the result of a search: no farther than to the end of its side.
    pub(crate) fn slide_on_side(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        edge: &SlidingEdge<R>,
    ) {
        self.slide(scene, grip, edge);
        self.stay_on_side(scene);
    }

    /// A vertex moves no farther beyond the end of its side than where it leaves it, however far the rounding of the load would move it:
    /// another wall may begin there.
    pub(crate) fn stay_on_side<W: World<R>>(&mut self, scene: &W) {
        if W::CORNERS && !self.contact.is_corner() {
            let [low, high] = scene.reach(self.contact);
            self.foot = self.foot.max(low - R::TOUCH).min(high + R::TOUCH);
        }
    }

    /// Moves a contact that has left its side along sign·t to the exact end of the side, which a search finds only to its rounding.
    pub(crate) fn go_to_end(&mut self, scene: &impl World<R>, sign: R) {
        let [low, high] = scene.reach(self.contact);
        self.foot = if sign > R::ZERO { high } else { low };
    }

    /// This pivot after a slide along t and a turn. Compiled once per image.
    #[inline(never)]
    pub(crate) fn moved(&self, slide: R, turn: R) -> Self {
        Self {
            contact: self.contact,
            foot: self.foot + slide,
            orientation: self.orientation.plus(turn),
        }
    }
}

/// The position of the obstacle's corner of a contact, if the contact is at one.
fn corner<R: Real, W: World<R>>(scene: &W, contact: Pair) -> Option<Vec2<R>> {
    let corner = (W::CORNERS && contact.is_corner()).then(|| scene.corner(contact.surface))??;
    Some(corner.place)
}
