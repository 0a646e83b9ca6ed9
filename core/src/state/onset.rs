//! What begins where a reaction is zero: there friction is not decided by the reaction, but by the rates at which it grows along the
//! displacement of the hand (STATICS 7, rule 6).

use super::on_corner::slide_rates;
use super::swing::Swing;
use super::{Edge, SingleVertex};
use crate::contact::{Pair, Regime};
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::moment::{Pinned, Sliding};
use crate::real::{Real, along};
use crate::world::{Surface, World};

/// The initial rates of a body that turns about its pivot with the hand: per unit of the displacement.
struct Rates<R> {
    /// The rate of the foot along t.
    foot: R,
    turn: R,
}

impl<R: Real> SingleVertex<R> {
    /// Pinned; `None` if that is not stable.
    fn pinned_rates(load: &Load<R>, displacement: &Displacement<R>) -> Option<Rates<R>> {
        let moment = load.pinned::<Pinned>();
        (moment.stability() > R::ZERO).then(|| Rates {
            foot: R::ZERO,
            turn: load.drive(displacement).now() / moment.stability(),
        })
    }

    /// Sliding along sign·t; `None` if that is not stable.
    fn sliding_rates<W: World<R>>(
        &self,
        scene: &W,
        (load, surface): (&Load<R>, &Surface<R>),
        displacement: &Displacement<R>,
        sign: R,
    ) -> Option<Rates<R>> {
        if self.is_corner(scene) {
            let edge = surface.sliding(sign);
            let rates = slide_rates(scene, (load, &self.pivot), &edge, displacement);
            return rates.rates().map(|(foot, turn)| Rates { foot, turn });
        }
        if load.swings(scene) {
            let rates = Swing::new(load, surface, sign).rates(displacement);
            return rates.map(|(foot, turn)| Rates { foot, turn });
        }
        let edge = surface.sliding(sign);
        let moment = load.sliding::<Sliding<R>>(scene, surface, &edge);
        let drive = load.sliding_drive((surface, &edge), displacement);
        let foot = load.foot(&edge, displacement);
        (moment.stability() > R::ZERO).then(|| {
            let turn = drive.now() / moment.stability();
            Rates {
                foot: (foot.along + foot.turning.y * turn) / edge.cos,
                turn,
            }
        })
    }

    /// The growth rate of the load.
    fn load_rate(load: &Load<R>, displacement: &Displacement<R>, rates: &Rates<R>) -> Vec2<R> {
        displacement.hand - load.lever.turned() * rates.turn
    }

    /// For a vertex that has just touched, or whose reaction has fallen to zero: it sticks if the friction grows more slowly than mu_d
    /// times the normal reaction, otherwise it slides with the load.
    pub(crate) fn begin(&mut self, scene: &impl World<R>, (at, to): (&Grip<R>, &Grip<R>)) {
        if self.swings(scene, at) {
            return self.begin_swinging(scene, (at, to));
        }
        self.regime = Regime::LOOSE;
        let load = self.pivot.load(scene, at);
        let surface = self.pivot.surface(scene);
        let displacement = at.displacement_to(to);
        let Some(pinned) = Self::pinned_rates(&load, &displacement) else {
            return;
        };
        let force = Self::load_rate(&load, &displacement, &pinned);
        let (normal, friction) = surface.reaction(force);
        if (surface.friction).is_within((normal, friction), false, R::ZERO) {
            return;
        }
        let sign = -friction.sign();
        let slides = self.sliding_rates(scene, (&load, &surface), &displacement, sign);
        if slides.is_some_and(|rates| along(sign, rates.foot) > R::ZERO) {
            self.regime = Regime::Slide(sign);
        }
    }

    /// True if a slide along sign·t would move back as the hand goes on.
    pub(crate) fn recedes(
        &self,
        scene: &impl World<R>,
        (at, to): (&Grip<R>, &Grip<R>),
        sign: R,
    ) -> bool {
        let load = self.pivot.load(scene, at);
        let surface = self.pivot.surface(scene);
        let displacement = at.displacement_to(to);
        let rates = self.sliding_rates(scene, (&load, &surface), &displacement, sign);
        rates.is_some_and(|rates| along(sign, rates.foot) < -Self::slack(&displacement))
    }

    /// True if the vertex leaves its surface as the body goes on with the hand alone.
    pub(crate) fn leaves(&self, scene: &impl World<R>, (at, to): (&Grip<R>, &Grip<R>)) -> bool {
        let load = self.pivot.load(scene, at);
        let displacement = at.displacement_to(to);
        let weight = scene.weight();
        // About the holding point.
        let stability = load.stiffness + (load.centroid - load.lever).dot(weight);
        let turn = if at.swings(scene) {
            R::ZERO
        } else if weight == Vec2::ZERO {
            displacement.turn
        } else if stability > R::ZERO {
            load.stiffness * displacement.turn / stability
        } else {
            return true;
        };
        let opening = displacement.hand - load.lever.turned() * turn;
        self.pivot.surface(scene).normal.dot(opening) >= R::ZERO
    }

    /// The direction in which the body turns about the hand as the vertex leaves its surface, if its balance in the air is not stable.
    pub(crate) fn topples_free(&self, scene: &impl World<R>, grip: &Grip<R>) -> Option<R> {
        let load = self.pivot.load(scene, grip);
        let weight = scene.weight();
        let stability = load.stiffness + (load.centroid - load.lever).dot(weight);
        let opening = -self.pivot.surface(scene).normal.dot(load.lever.turned());
        let hangs = weight != Vec2::ZERO && !grip.swings(scene);
        (hangs && stability <= R::ZERO).then_some(opening.sign())
    }

    /// True if the gap of another contact opens as this vertex slides on with the hand along sign·t.
    pub(crate) fn opens(
        &self,
        scene: &impl World<R>,
        (at, to): (&Grip<R>, &Grip<R>),
        (other, sign): (Pair, R),
    ) -> bool {
        let load = self.pivot.load(scene, at);
        let surface = self.pivot.surface(scene);
        let displacement = at.displacement_to(to);
        let rates = self.sliding_rates(scene, (&load, &surface), &displacement, sign);
        rates.is_some_and(|rates| {
            let arm = load.placed.arm_to(scene, other);
            let velocity = surface.tangent * rates.foot + arm.turned() * rates.turn;
            let other = scene.face(other, load.placed.orientation.rotation());
            other.normal.dot(velocity) >= R::ZERO
        })
    }

    /// True if friction does not hold a slip along sign·t, to the accuracy with which its beginning is known, and the gap of another
    /// contact opens in it.
    pub(crate) fn slips_off(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        (other, sign): (Pair, R),
    ) -> bool {
        let load = self.pivot.load(scene, grip);
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        let tangent = surface.tangent * sign;
        let mut pull = load.lever;
        if self.is_corner(scene) {
            // The normal of a corner turns with the body (E16).
            pull = pull + load.force;
        }
        let turn = tangent.cross(pull) / load.stability();
        let velocity = tangent + load.placed.arm_to(scene, other).turned() * turn;
        let gap = scene.face(other, load.placed.orientation.rotation());
        let off = -Self::found_to(&load);
        load.stability() > R::ZERO
            && (surface.friction).is_driven(normal, friction, sign, off)
            && gap.normal.dot(velocity) > R::ZERO
    }
}

impl<R: Real> Edge<R> {
    /// True if a slide along sign·t would move back as the hand goes on.
    pub(crate) fn recedes(
        &self,
        scene: &impl World<R>,
        (at, to): (&Grip<R>, &Grip<R>),
        sign: R,
    ) -> bool {
        let edge = self.pivot.surface(scene).sliding(sign);
        let displacement = at.displacement_to(to);
        let foot = edge.balanced.dot(displacement.hand);
        along(sign, foot) < -SingleVertex::<R>::slack(&displacement)
    }

    /// For an edge that has just landed: as for a vertex, without a turn.
    pub(crate) fn begin(&mut self, scene: &impl World<R>, (at, to): (&Grip<R>, &Grip<R>)) {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(at.displacement_to(to).hand);
        self.regime = if (surface.friction).is_within((normal, friction), false, R::ZERO) {
            Regime::LOOSE
        } else {
            Regime::Slide(-friction.sign())
        };
    }
}

#[cfg(test)]
mod tests;
