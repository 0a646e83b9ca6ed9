//! Two vertices on one surface, or two collinear contacts (STATICS 4, 12.5): the angle is locked to the surface. Everything is linear in
//! the hand's path and in the slip, so every event has a closed form.

use super::SingleVertex;
use super::segment::Segment;
use crate::balance_curve::Margin;
use crate::contact::{Pair, Pairs, Reactions, Regime};
use crate::detect::{Placed, PointPath, Short, Watch};
use crate::friction::{SlidingEdge, Verdict};
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::list::gather;
use crate::load::Load;
use crate::moment::Sliding;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::verb::{Moved, Trigger};
use crate::work::Work;
use crate::world::{Surface, World};

mod ends;
mod reaction;

use reaction::Reaction;

/// The memory: where the first contact is held, the locked angle, the other contact, and whether they stick.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Edge<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) other: Pair,
    pub(crate) regime: Regime<R>,
    /// The distance that it can slide before a vertex can touch another surface; 0: not known.
    room: R,
    watch: Watch,
}

impl<R: Real> Edge<R> {
    pub(crate) fn new(pivot: Pivot<R>, other: Pair) -> Self {
        Self {
            pivot,
            other,
            regime: Regime::LOOSE,
            room: R::ZERO,
            watch: Watch::NONE,
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        gather([self.pivot.contact, self.other])
    }

    /// x_2 - x_1
    fn span(&self, scene: &impl World<R>, placed: &Placed<R>) -> R {
        let arm = placed.arm_to(scene, self.other);
        self.pivot.surface(scene).tangent.dot(arm)
    }

    /// N_2 that balances a moment about contact 1, (E4).
    fn second(moment: R, span: R) -> R {
        -moment / span
    }

    /// N_1, N_2, N and T on a displacement of the hand, linear in tau since the edge does not turn (E4).
    fn reaction(
        &self,
        scene: &impl World<R>,
        load: &Load<R>,
        displacement: &Displacement<R>,
    ) -> Reaction<R> {
        let surface = self.pivot.surface(scene);
        // The edge does not turn.
        let normal = load.reaction(surface.normal, displacement);
        let span = self.span(scene, &load.placed);
        let turn = scene.stiffness() * displacement.turn + load.lever.cross(displacement.hand);
        let second = Margin {
            start: Self::second(load.moment(), span),
            along: Self::second(turn, span),
            turning: Vec2::ZERO,
            rounding: load.rounding() / span.abs(),
        };
        Reaction {
            parts: [normal.combine(R::ONE, second, -R::ONE), second],
            normal,
            friction: load.reaction(surface.tangent, displacement),
        }
    }

    /// The edge of the friction cone in a slide along sign·t.
    fn sliding(&self, scene: &impl World<R>, sign: R) -> SlidingEdge<R> {
        self.pivot.surface(scene).sliding(sign)
    }

    /// A certified frame: it stays, or slides with the hand. Everything is linear on the path, so that its end decides.
    pub(crate) fn follow<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        work: &mut Work,
    ) -> bool {
        let mut after = self.clone();
        let surface = self.pivot.surface(scene);
        let slide = if W::GLIDES {
            Some(R::ONE)
        } else {
            self.regime.slide()
        };
        if let Some(sign) = slide {
            let edge = self.sliding(scene, sign);
            after.pivot.slide(scene, to, &edge);
            let displacement = from.displacement_to(to);
            let advance = edge.balanced.dot(displacement.hand) * sign;
            let way = (after.pivot.foot - self.pivot.foot).abs();
            if !W::GLIDES && advance < -SingleVertex::<R>::slack(&displacement)
                || W::SURFACES && !after.has_room(scene, &self.pivot, (way, work))
            {
                return false;
            }
        }
        let load = after.pivot.load(scene, to);
        let (normal, friction) = surface.reaction(load.force);
        let span = self.span(scene, &load.placed);
        let second = Self::second(load.moment(), span);
        let mut slack = load.rounding() / span.abs();
        if W::CORNERS && slide.is_some() {
            let Some(bend) = after.bend_of_ends(scene, &self.pivot, from.displacement_to(to))
            else {
                return false;
            };
            slack = slack + bend / span.abs();
        }
        let stiction = self.regime.has_stiction();
        let coulomb = surface.friction;
        let holds = slide.is_some() || coulomb.is_within((normal, friction), stiction, slack);
        let follows = load.is_representable() && second > slack && normal - second > slack && holds;
        if coulomb.is_pressed(normal) && !stiction {
            if slide.is_some() {
                return false;
            }
            after.regime = Regime::Stick { stiction: true };
        }
        if follows {
            *self = after;
        }
        follows
    }

    /// True if nothing else can be reached on a displacement of the edge that has ended here.
    #[inline(always)]
    fn has_room<W: World<R>>(
        &mut self,
        scene: &W,
        begin: &Pivot<R>,
        (way, work): (R, &mut Work),
    ) -> bool {
        if W::CORNERS {
            return self.has_room_among(scene, begin, (way, work));
        }
        self.room = self.room - way;
        if self.room <= R::ZERO {
            self.room = self.room_beside(scene, &self.pivot.placed(scene)) - way;
        }
        self.room > R::ZERO
    }

    /// The room to half-planes other than the one on which it lies.
    fn room_beside<W: World<R>>(&self, scene: &W, placed: &Placed<R>) -> R {
        let counts = |pair: &Pair| {
            pair.surface != self.pivot.contact.surface && (!W::CORNERS || *pair != self.other)
        };
        placed.room_of(scene, counts)
    }

    /// The same with obstacles.
    #[inline(never)]
    fn has_room_among<W: World<R>>(
        &mut self,
        scene: &W,
        begin: &Pivot<R>,
        (way, work): (R, &mut Work),
    ) -> bool {
        let contacts = self.contacts();
        let short = Short {
            before: begin.placed(scene),
            after: self.pivot.placed(scene),
            lasting: &contacts,
            way,
            turn: R::ZERO,
        };
        let mut least = self.room - way;
        if least <= R::ZERO {
            self.room = R::ZERO;
            least = self.room_beside(scene, &short.after) - way;
        }
        let keeps_off = short.keeps_off(scene, (&mut self.room, &mut self.watch), work);
        self.room = self.room.min(least);
        keeps_off && self.room > R::ZERO
    }

    /// Stays or slides as the hand moves, to the first of friction limit, N = N*, halt, touch and N_i = 0.
    #[inline(never)]
    pub(crate) fn advance<W: World<R>>(
        &mut self,
        scene: &W,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        if W::GLIDES {
            return self.advance_sliding(scene, (from, to), R::ONE);
        }
        if let Some(sign) = self.regime.slide() {
            return self.advance_sliding(scene, (from, to), sign);
        }
        let load = self.pivot.load(scene, from);
        let reaction = self.reaction(scene, &load, &from.displacement_to(to));
        let mut segment: Segment<R> = Segment::straight(R::ONE, Trigger::Balanced);
        let friction = self.pivot.surface(scene).friction;
        let stiction = self.regime.has_stiction();
        for sign in [R::ONE, -R::ONE] {
            let margins = (reaction.normal, reaction.friction);
            let holds = friction.holds(margins, stiction, sign);
            segment.stop_at(&holds, Trigger::Slide(sign));
        }
        if let Some(loosens) = friction.loosens(reaction.normal)
            && !stiction
        {
            segment.stop_at(&loosens, Trigger::Pressed);
        }
        for (part, other) in reaction.parts.iter().zip([1, 0]) {
            segment.stop_at(part, keep(other, None));
        }
        segment.moved()
    }

    /// Slides along sign·t as the hand moves, to the first of halt, N = N*, touch and N_i = 0.
    fn advance_sliding<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        sign: R,
    ) -> Moved<R> {
        let edge = self.sliding(scene, sign);
        let displacement = from.displacement_to(to);
        let load = self.pivot.load(scene, from);
        let foot = load.foot(&edge, &displacement);
        if !W::GLIDES && foot.along * sign < -SingleVertex::<R>::slack(&displacement) {
            return Moved {
                part: R::ZERO,
                ..Moved::by(Trigger::Halts)
            };
        }
        let surface = self.pivot.surface(scene);
        let shift = surface.tangent * (foot.along / edge.cos);
        let relative = Displacement {
            hand: displacement.hand - shift,
            ..displacement
        };
        let reaction = self.reaction(scene, &load, &relative);
        let mut segment = Segment::<R, Sliding<R>>::straight(R::ONE, Trigger::Balanced);
        if W::SURFACES {
            let path = PointPath::straight(shift);
            segment.stop_at_touch(scene, &load.placed, (&path, &self.contacts()));
        }
        if let Some(loosens) = surface.friction.loosens(reaction.normal) {
            segment.stop_at(&loosens, Trigger::Pressed);
        }
        if W::CORNERS {
            let along = (foot.along / edge.cos, sign);
            self.stop_at_ends(scene, &mut segment, (&load, &relative), along);
        } else {
            for (part, other) in reaction.parts.iter().zip([1, 0]) {
                segment.stop_at(part, keep(other, Some(sign)));
            }
        }
        self.pivot
            .slide_on_side(scene, &from.lerp(to, segment.part()), &edge);
        segment.moved()
    }

    /// Without friction it glides to balance, the energy falling by itself; then the N_i are tested.
    fn glide_down(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        let edge = self.sliding(scene, R::ONE);
        self.pivot.slide(scene, grip, &edge);
        let load = self.pivot.load(scene, grip);
        let reaction = self.reaction(scene, &load, &Displacement::slide(Vec2::ZERO));
        Moved::by(reaction.opens(None).unwrap_or(Trigger::Balanced))
    }

    /// Tests the edge in its present pose.
    #[inline(never)]
    pub(crate) fn relax<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        sliding: Option<R>,
    ) -> Moved<R> {
        if W::GLIDES {
            return self.glide_down(scene, grip);
        }
        self.pivot.renew(scene, grip, &mut self.regime);
        Moved::by(self.test(scene, grip, sliding))
    }

    /// Tests the reactions at the frozen hand: a contact opens, a slide goes on, or the total reaction is judged by its cone (STATICS 4).
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
        let stiction = self.regime.has_stiction();
        match coulomb.judge((normal, friction), stiction, rounding) {
            Verdict::Sticks => Trigger::Balanced,
            Verdict::Slides(sign) => Trigger::Slide(sign),
            Verdict::Opens => Trigger::Clear,
        }
    }

    /// Slips along sign·t to the first of |T| = mu_d N, touch, N_i = 0. If |T| = mu_d N ends it, it sticks if it is pressed hard enough,
    /// otherwise it slides on with the hand (rule 4).
    #[inline(never)]
    pub(crate) fn slip<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>, sign: R) -> Moved<R> {
        let load = self.pivot.load(scene, grip);
        let surface: Surface<R> = self.pivot.surface(scene);
        let farthest = load.force.length_bound() + load.lever.length_bound().doubled();
        let shift = surface.tangent * sign;
        let relative = Displacement::slide(shift);
        let reaction = self.reaction(scene, &load, &relative);
        let mut segment: Segment<R> = Segment::straight(farthest, Trigger::Stopped);
        let drives = surface
            .friction
            .drives(reaction.normal, reaction.friction, sign);
        segment.stop_at(&drives, Trigger::Stopped);
        segment.stop_at_touch(
            scene,
            &load.placed,
            (&PointPath::straight(shift), &self.contacts()),
        );
        if W::CORNERS {
            self.stop_at_ends(scene, &mut segment, (&load, &relative), (sign, sign));
        } else {
            for (part, other) in reaction.parts.iter().zip([1, 0]) {
                segment.stop_at(part, keep(other, Some(sign)));
            }
        }
        let slip = sign * segment.part();
        self.pivot = self.pivot.moved(slip, R::ZERO);
        self.room = R::ZERO;
        let moved = segment.moved();
        if moved.trigger == Trigger::Stopped {
            self.regime = Regime::after_slip(self.pivot.is_pressed(scene, grip), sign);
        }
        Moved { slip, ..moved }
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

/// Only contact number `contact` lasts.
fn keep<R: Real>(contact: usize, sliding: Option<R>) -> Trigger<R> {
    Trigger::Keep {
        contacts: [contact, contact],
        sliding,
    }
}

#[cfg(test)]
mod tests;
