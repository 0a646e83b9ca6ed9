//! Two vertices on one surface (STATICS 4): the angle is locked to the surface. Everything is linear in the hand's path
//! and in the slip, so every event is closed form.

use super::segment::Segment;
use crate::balance_curve::Margin;
use crate::contact::{Pair, Pairs, Reactions};
use crate::friction::Verdict;
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::list::gather;
use crate::load::Load;
use crate::moment::Gliding;
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

/// Reactions on a path of the hand: (E4) and its change.
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

    fn reaction(
        &self,
        scene: &impl World<R>,
        load: &Load<R>,
        displacement: &Displacement<R>,
    ) -> Reaction<R> {
        let surface = self.pivot.surface(scene);
        // The edge does not turn.
        let normal = load.reaction(surface.normal, displacement);
        // x_2 - x_1
        let span = surface.tangent.dot(load.placed.arm(scene, self.vertex));
        let turn = scene.stiffness() * displacement.turn + load.lever.cross(displacement.hand);
        let second = Margin {
            start: -load.moment() / span,
            along: -turn / span,
            turning: Vec2::ZERO,
            rounding: load.rounding() / span.abs(),
        };
        Reaction {
            parts: [normal.combine(R::ONE, second, -R::ONE), second],
            normal,
            friction: load.reaction(surface.tangent, displacement),
        }
    }

    /// A certified frame: it stays, or without friction glides. All is linear on the path, so that its end decides.
    pub(crate) fn follow<W: World<R>>(&mut self, scene: &W, to: &Grip<R>) -> bool {
        let mut pivot = self.pivot;
        if W::GLIDES {
            pivot.glide(scene, to);
        }
        let load = pivot.load(scene, to);
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        let span = surface.tangent.dot(load.placed.arm(scene, self.vertex));
        let second = -load.moment() / span;
        let slack = load.rounding() / span.abs();
        let is_certified = load.is_representable()
            && second > slack
            && normal - second > slack
            && (W::GLIDES || (surface.friction).is_within(normal, friction, slack));
        if is_certified {
            self.pivot = pivot;
        }
        is_certified
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
        let load = self.pivot.load(scene, from);
        let reaction = self.reaction(scene, &load, &from.displacement_to(to));
        let mut segment: Segment<R> = Segment::straight(R::ONE, Trigger::Balanced);
        let friction = self.pivot.surface(scene).friction;
        for sign in [R::ONE, -R::ONE] {
            let holds = friction.holds(reaction.normal, reaction.friction, sign);
            segment.stop_at(&holds, Trigger::Slide(sign));
        }
        for (part, other) in reaction.parts.iter().zip([1, 0]) {
            segment.stop_at(part, keep(other, None));
        }
        segment.moved()
    }

    /// Without friction it glides as the hand moves, to the first N_i = 0.
    fn glide_along(&mut self, scene: &impl World<R>, from: &Grip<R>, to: &Grip<R>) -> Moved<R> {
        let load = self.pivot.load(scene, from);
        let displacement = from
            .displacement_to(to)
            .pressing(&self.pivot.surface(scene));
        let reaction = self.reaction(scene, &load, &displacement);
        let mut segment = Segment::<R, Gliding<R>>::straight(R::ONE, Trigger::Balanced);
        for (part, other) in reaction.parts.iter().zip([1, 0]) {
            segment.stop_at(part, keep(other, None));
        }
        self.pivot.glide(scene, &from.lerp(to, segment.part()));
        segment.moved()
    }

    /// Without friction it glides to balance, the energy falling by itself; then N_i are put to the test.
    fn glide_down(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        self.pivot.glide(scene, grip);
        let load = self.pivot.load(scene, grip);
        let reaction = self.reaction(scene, &load, &Displacement::slide(Vec2::ZERO));
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
        let load = self.pivot.load(scene, grip);
        let reaction = self.reaction(scene, &load, &Displacement::slide(Vec2::ZERO));
        if let Some(opens) = reaction.opens(sliding) {
            return opens;
        }
        let (normal, friction) = (reaction.normal.start, reaction.friction.start);
        let rounding = load.rounding();
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
        let load = self.pivot.load(scene, grip);
        let surface: Surface<R> = self.pivot.surface(scene);
        let farthest = load.force.length_bound() + load.lever.length_bound().doubled();
        let shift = surface.tangent * sign;
        let reaction = self.reaction(scene, &load, &Displacement::slide(shift));
        let mut segment: Segment<R> = Segment::straight(farthest, Trigger::Stopped);
        let drives = surface
            .friction
            .drives(reaction.normal, reaction.friction, sign);
        segment.stop_at(&drives, Trigger::Stopped);
        segment.stop_at_touch(scene, &load.placed, (shift, &self.contacts()));
        for (part, other) in reaction.parts.iter().zip([1, 0]) {
            segment.stop_at(part, keep(other, Some(sign)));
        }
        let slip = sign * segment.part();
        self.pivot = self.pivot.moved(slip, R::ZERO);
        Moved {
            slip,
            ..segment.moved()
        }
    }

    /// The friction is collinear; it is reported in proportion to N_i.
    pub(crate) fn reactions(&self, scene: &impl World<R>, load: &Load<R>) -> Reactions<R> {
        let reaction = self.reaction(scene, load, &Displacement::slide(Vec2::ZERO));
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
