//! Two vertices on one surface (STATICS 4): the angle is locked to the surface. Everything is linear in the hand's way
//! and in the slip, so every event is closed form.

use super::leg::Leg;
use crate::contact::{Pair, Pairs, Reactions};
use crate::friction::Verdict;
use crate::geometry::Vec2;
use crate::grip::{Grip, Way};
use crate::list::gather;
use crate::load::Stance;
use crate::moment::Gliding;
use crate::motion::Margin;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::verb::{Moved, Trigger};
use crate::world::{Surface, World};

/// The memory: where the first vertex is held, the locked angle, and the other vertex.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Edge<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) vertex: u8,
}

/// Reactions on a way of the hand: (E4) and its change.
struct Reaction<R> {
    /// N_1, N_2
    parts: [Margin<R>; 2],
    /// N_1 + N_2
    normal: Margin<R>,
    /// T
    friction: Margin<R>,
}

impl<R: Real> Reaction<R> {
    /// A vertex is, or both are, pulled off.
    fn opens(&self, sliding: Option<R>) -> Option<Trigger<R>> {
        let [first, second] = self.parts;
        match (
            first.start < -first.rounding,
            second.start < -second.rounding,
        ) {
            (true, true) => Some(Trigger::Clear),
            (true, false) => Some(keep(1, sliding)),
            (false, true) => Some(keep(0, sliding)),
            (false, false) => None,
        }
    }
}

impl<R: Real> Edge<R> {
    pub(crate) fn contacts(&self) -> Pairs {
        let first = self.pivot.contact;
        let second = Pair {
            vertex: self.vertex,
            surface: first.surface,
        };
        gather([first, second])
    }

    fn reaction(&self, scene: &impl World<R>, stance: &Stance<R>, way: &Way<R>) -> Reaction<R> {
        let surface = self.pivot.surface(scene);
        // The edge does not turn.
        let normal = stance.reaction(surface.normal, way);
        // x_2 - x_1
        let span = surface.tangent.dot(stance.placed.arm(scene, self.vertex));
        let turn = scene.stiffness() * way.turn + stance.lever.cross(way.hand);
        let second = Margin {
            start: -stance.moment() / span,
            along: -turn / span,
            turning: Vec2::ZERO,
            rounding: stance.rounding() / span.abs(),
        };
        Reaction {
            parts: [normal.combine(R::ONE, second, -R::ONE), second],
            normal,
            friction: stance.reaction(surface.tangent, way),
        }
    }

    /// A calm frame: it stays, or without friction glides. All is linear on the way, so that its end decides.
    pub(crate) fn follow<W: World<R>>(&mut self, scene: &W, to: &Grip<R>) -> bool {
        let mut pivot = self.pivot;
        if W::GLIDES {
            pivot.glide(scene, to);
        }
        let stance = pivot.stance(scene, to);
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(stance.force);
        let span = surface.tangent.dot(stance.placed.arm(scene, self.vertex));
        let second = -stance.moment() / span;
        let slack = stance.rounding() / span.abs();
        let follows = stance.is_carried()
            && second > slack
            && normal - second > slack
            && (W::GLIDES || (surface.friction).is_within(normal, friction, slack));
        if follows {
            self.pivot = pivot;
        }
        follows
    }

    /// Stays as the hand moves, to the first of friction limit and N_i = 0.
    pub(crate) fn advance<W: World<R>>(
        &mut self,
        scene: &W,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        if W::GLIDES {
            return self.glide_along(scene, from, to);
        }
        let stance = self.pivot.stance(scene, from);
        let reaction = self.reaction(scene, &stance, &from.way_to(to));
        let mut leg: Leg<R> = Leg::straight(R::ONE, Trigger::Balanced);
        let friction = self.pivot.surface(scene).friction;
        for sign in [R::ONE, -R::ONE] {
            let holds = friction.holds(reaction.normal, reaction.friction, sign);
            leg.stop_at(&holds, Trigger::Slide(sign));
        }
        for (part, other) in reaction.parts.iter().zip([1, 0]) {
            leg.stop_at(part, keep(other, None));
        }
        leg.moved()
    }

    /// Without friction it glides as the hand moves, to the first N_i = 0.
    fn glide_along(&mut self, scene: &impl World<R>, from: &Grip<R>, to: &Grip<R>) -> Moved<R> {
        let stance = self.pivot.stance(scene, from);
        let way = from.way_to(to).pressing(&self.pivot.surface(scene));
        let reaction = self.reaction(scene, &stance, &way);
        let mut leg = Leg::<R, Gliding<R>>::straight(R::ONE, Trigger::Balanced);
        for (part, other) in reaction.parts.iter().zip([1, 0]) {
            leg.stop_at(part, keep(other, None));
        }
        self.pivot.glide(scene, &from.lerp(to, leg.part()));
        leg.moved()
    }

    /// Without friction it glides to balance, the energy falling by itself; then N_i are put to the test.
    fn glide_down(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        self.pivot.glide(scene, grip);
        let stance = self.pivot.stance(scene, grip);
        let reaction = self.reaction(scene, &stance, &Way::slide(Vec2::ZERO));
        Moved::by(reaction.opens(None).unwrap_or(Trigger::Balanced))
    }

    /// Puts the edge to the test as it lies.
    pub(crate) fn relax<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        sliding: Option<R>,
    ) -> Moved<R> {
        if W::GLIDES {
            return self.glide_down(scene, grip);
        }
        Moved::by(self.test(scene, grip, sliding))
    }

    fn test(&self, scene: &impl World<R>, grip: &Grip<R>, sliding: Option<R>) -> Trigger<R> {
        let stance = self.pivot.stance(scene, grip);
        let reaction = self.reaction(scene, &stance, &Way::slide(Vec2::ZERO));
        if let Some(opens) = reaction.opens(sliding) {
            return opens;
        }
        let (normal, friction) = (reaction.normal.start, reaction.friction.start);
        let rounding = stance.rounding();
        let coulomb = self.pivot.surface(scene).friction;
        if let Some(sign) = sliding
            && coulomb.is_driven(normal, friction, sign, rounding)
        {
            return Trigger::Slide(sign);
        }
        match coulomb.judge(normal, friction, rounding) {
            Verdict::Sticks => Trigger::Balanced,
            Verdict::Slides(sign) => Trigger::Slide(sign),
            Verdict::Opens => Trigger::Clear,
        }
    }

    /// Slides along sign·t to the first of |T| = mu_d N, touch, N_i = 0.
    pub(crate) fn slide(&mut self, scene: &impl World<R>, grip: &Grip<R>, sign: R) -> Moved<R> {
        let stance = self.pivot.stance(scene, grip);
        let surface: Surface<R> = self.pivot.surface(scene);
        let farthest = stance.force.reach() + stance.lever.reach().doubled();
        let shift = surface.tangent * sign;
        let reaction = self.reaction(scene, &stance, &Way::slide(shift));
        let mut leg: Leg<R> = Leg::straight(farthest, Trigger::Stopped);
        let drives = surface
            .friction
            .drives(reaction.normal, reaction.friction, sign);
        leg.stop_at(&drives, Trigger::Stopped);
        leg.stop_at_touch(scene, &stance.placed, (shift, &self.contacts()));
        for (part, other) in reaction.parts.iter().zip([1, 0]) {
            leg.stop_at(part, keep(other, Some(sign)));
        }
        let slip = sign * leg.part();
        self.pivot = self.pivot.moved(slip, R::ZERO);
        Moved {
            slip,
            ..leg.moved()
        }
    }

    /// The friction is collinear; it is reported in proportion to N_i.
    pub(crate) fn reactions(&self, scene: &impl World<R>, stance: &Stance<R>) -> Reactions<R> {
        let reaction = self.reaction(scene, stance, &Way::slide(Vec2::ZERO));
        let parts = reaction.parts.map(|part| part.start.max(R::ZERO));
        let normal = parts[0] + parts[1];
        let friction = reaction.friction.start;
        let share = |part: R| {
            if normal > R::ZERO {
                friction * (part / normal)
            } else {
                R::ZERO
            }
        };
        gather(parts.map(|n| [n, share(n)]))
    }
}

/// Contact number `contact` lasts alone.
fn keep<R: Real>(contact: usize, sliding: Option<R>) -> Trigger<R> {
    Trigger::Keep {
        contacts: [contact, contact],
        sliding,
    }
}

#[cfg(test)]
mod tests;
