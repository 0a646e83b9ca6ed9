//! One vertex on one surface (STATICS 3): pinned it turns in balance of moments about the contact, the angle on its
//! branch; it slips along the surface with the moment balanced at every place.

use super::segment::Segment;
use super::short_slip::ShortSlip;
use crate::balance_curve::Margin;
use crate::certified::CertifiedTurn;
use crate::contact::{Pairs, Reactions};
use crate::friction::Verdict;
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::list::gather;
use crate::load::Load;
use crate::moment::{Downhill, Pinned};
use crate::pivot::Pivot;
use crate::real::Real;
use crate::verb::{Moved, Terms, Trigger};
use crate::world::{Surface, World};

/// The memory: where the vertex is held, and the angle, which is the branch.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SingleVertex<R> {
    pub(crate) pivot: Pivot<R>,
    /// By so much the body can turn about the pivot before another vertex can touch (rad); 0: not known.
    pub(super) room: R,
}

/// Normal reaction and friction on a path of the hand.
struct Reaction<R> {
    normal: Margin<R>,
    friction: Margin<R>,
}

impl<R: Real> SingleVertex<R> {
    pub(crate) fn new(pivot: Pivot<R>) -> Self {
        Self {
            pivot,
            room: R::ZERO,
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        gather([self.pivot.contact])
    }

    fn reaction(
        load: &Load<R>,
        surface: &Surface<R>,
        displacement: &Displacement<R>,
    ) -> Reaction<R> {
        Reaction {
            normal: load.reaction(surface.normal, displacement),
            friction: load.reaction(surface.tangent, displacement),
        }
    }

    /// A certified frame: it sticks and turns. If the hand jumps, its end alone decides.
    pub(crate) fn follow(
        &mut self,
        scene: &impl World<R>,
        (from, to): (&Grip<R>, &Grip<R>),
        terms: Terms<R>,
    ) -> Option<Trigger<R>> {
        let mut load = self.pivot.load(scene, to);
        load.tolerance = terms.tolerance;
        if !load.is_representable() {
            return None;
        }
        let displacement = from.displacement_to(to);
        let certified = CertifiedTurn::pinned::<Pinned>(scene, &load, to, &displacement)?;
        let orientation = certified.orientation;
        // The reaction strays by the turn from the straight line to where the hand alone would take it ...
        let trigger = if self.holds(scene, &load, certified.turn_bound) {
            Trigger::Balanced
        } else {
            // ... and by much less from the one to where it ends.
            let end = load.turned(scene, orientation, to);
            if terms.jumps {
                self.test(scene, &end)
            } else if self.holds(
                scene,
                &end,
                certified.curvature_bound(&load, &displacement).halved(),
            ) {
                Trigger::Balanced
            } else {
                return None;
            }
        };
        self.has_room_to_turn(scene, &certified).then(|| {
            self.pivot.orientation = orientation;
            trigger
        })
    }

    /// True if the reaction stays within the static cone though the lever strays by a part of its length.
    fn holds(&self, scene: &impl World<R>, load: &Load<R>, stray: R) -> bool {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        let slack = load.lever.length_bound() * stray + load.rounding();
        (surface.friction).is_within(normal, friction, slack)
    }

    /// True if no other vertex can reach a surface on the path to `end`, on which no point of the body goes farther than
    /// `travel_bound`, and on which a gap that ends larger than `open` was never closed.
    pub(super) fn has_room(
        &mut self,
        scene: &impl World<R>,
        end: &Pivot<R>,
        (travel_bound, open): (R, R),
    ) -> bool {
        let mut room = self.room - travel_bound;
        if room <= R::ZERO {
            room = end.placed(scene).room(scene, Some(end.contact.vertex));
            if room <= open {
                return false;
            }
        }
        self.room = room;
        true
    }

    /// The same of a certified turn. No point of the body is farther from the pivot than one body size.
    pub(super) fn has_room_to_turn(
        &mut self,
        scene: &impl World<R>,
        certified: &CertifiedTurn<R>,
    ) -> bool {
        let end = Pivot {
            orientation: certified.orientation,
            ..self.pivot
        };
        let open = (certified.turn_bound * certified.turn_bound).halved();
        self.has_room(scene, &end, (certified.turn_bound, open))
    }

    /// Sticks and turns as the hand moves, to the first of fold, touch, friction limit, lift-off.
    pub(crate) fn advance(
        &mut self,
        scene: &impl World<R>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let load = self.pivot.load(scene, from);
        let surface = self.pivot.surface(scene);
        let displacement = from.displacement_to(to);
        let moment = load.pinned::<Pinned>();
        let mut segment =
            Segment::balanced(&moment, (load.lever, &displacement), Trigger::Balanced);
        segment.stop_at_touch(scene, &load.placed, (Vec2::ZERO, &self.contacts()));
        let Reaction { normal, friction } = Self::reaction(&load, &surface, &displacement);
        for sign in [R::ONE, -R::ONE] {
            let holds = surface.friction.holds(normal, friction, sign);
            segment.stop_at(&holds, Trigger::Slide(sign));
        }
        segment.stop_at(&normal, Trigger::Clear);
        segment.turn_with_hand(scene, &mut self.pivot, to)
    }

    /// Turns downhill about the vertex to balance, then tests friction. A vertex that already slides
    /// goes on while it is driven, at once where the turn is blocked.
    pub(crate) fn relax(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        sliding: Option<R>,
    ) -> Moved<R> {
        let begin = self.clone();
        let mut moved = self.turn_down(scene, grip);
        let Some(sign) = sliding else {
            return moved;
        };
        // By a contact that was there at the beginning.
        let blocked = matches!(moved.trigger, Trigger::Touch(pair)
            if begin.pivot.placed(scene).gap(scene, pair) <= R::TOUCH.doubled());
        if blocked {
            *self = begin;
        }
        let at_rest = matches!(moved.trigger, Trigger::Balanced | Trigger::Slide(_));
        if (blocked || at_rest) && self.is_driven(scene, &self.pivot.load(scene, grip), sign) {
            moved.trigger = Trigger::Slide(sign);
        }
        moved
    }

    /// Downhill to balance, or to the first touch: where the balance is near and nothing in the way, without a search.
    fn turn_down(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        let load = self.pivot.load(scene, grip);
        if let Some(certified) =
            CertifiedTurn::pinned::<Pinned>(scene, &load, grip, &Displacement::turn(R::ZERO))
            && self.has_room_to_turn(scene, &certified)
        {
            self.pivot.orientation = certified.orientation;
            return Moved::by(self.test(scene, &self.pivot.load(scene, grip)));
        }
        self.turn_by(scene, grip, &load.pinned::<Pinned>().downhill())
    }

    /// True while the vertex slides on along sign·t, on a stable branch.
    fn is_driven(&self, scene: &impl World<R>, load: &Load<R>, sign: R) -> bool {
        self.is_driven_beyond(scene, load, (sign, load.rounding()))
    }

    /// The same, by more than `off`.
    fn is_driven_beyond(&self, scene: &impl World<R>, load: &Load<R>, (sign, off): (R, R)) -> bool {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        load.stability() > R::ZERO
            && normal > off
            && (surface.friction).is_driven(normal, friction, sign, off)
    }

    /// What the friction at the end of a slip may be off.
    fn found_to(load: &Load<R>) -> R {
        let rounding = load.rounding_with_foot() * R::from_int(64);
        rounding + (load.size() * load.tolerance).doubled().doubled()
    }

    /// The same from a fold of the branch, on in the direction of the sign.
    pub(crate) fn snap(&mut self, scene: &impl World<R>, grip: &Grip<R>, direction: R) -> Moved<R> {
        let moment = self.pivot.load(scene, grip).pinned::<Pinned>();
        self.turn_by(scene, grip, &moment.over_fold(direction))
    }

    fn turn_by(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let lasting = self.contacts();
        let mut moved = Segment::<R>::turn_downhill(scene, &mut self.pivot, &lasting, downhill);
        if moved.trigger == Trigger::Balanced {
            moved.trigger = self.test(scene, &self.pivot.load(scene, grip));
        }
        moved
    }

    /// Friction at rest.
    fn test(&self, scene: &impl World<R>, load: &Load<R>) -> Trigger<R> {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        let rounding = load.rounding();
        match surface.friction.judge(normal, friction, rounding) {
            Verdict::Sticks => Trigger::Balanced,
            Verdict::Slides(sign) => Trigger::Slide(sign),
            Verdict::Opens => Trigger::Clear,
        }
    }

    /// Slides along sign·t, the moment as it is (balanced, but for a contact that opened in mid-slip), to the first of
    /// (E3), touch, lift-off, fold.
    pub(crate) fn slide(&mut self, scene: &impl World<R>, grip: &Grip<R>, sign: R) -> Moved<R> {
        let mut load = self.pivot.load(scene, grip);
        let placed = (&self.pivot, &load);
        let found = ShortSlip::find(scene, placed, grip, sign);
        if let Ok(slip) = found {
            let end = self.pivot.moved(slip.slide, slip.turn);
            if self.has_room(scene, &end, (slip.travel_bound, slip.open)) {
                self.pivot = end;
                return Moved {
                    slip: slip.slide,
                    ..Moved::by(Trigger::Stopped)
                };
            }
        }
        self.room = R::ZERO;
        if self.pivot.surface(scene).friction.is_continuous() {
            // Where it stops it must also stick.
            load.tolerance = R::ZERO;
        }
        // Beyond this distance the hand would pull back; a longer one than this load is covered in several slips.
        let lever = load.lever.length_bound();
        let farthest =
            (load.force.length_bound() + lever.doubled()).min(R::LOAD / lever.max(R::ONE));
        let about = match found {
            Ok(slip) => Some(slip.slide.abs()),
            Err(about) => about,
        };
        // To look no farther than needed is cheap.
        let near = about.map_or(farthest, |about| farthest.min(about.doubled().doubled()));
        let (mut slip, mut segment) = self.slide_segment(scene, &load, sign * near);
        if segment.goes_on() && near < farthest {
            (slip, segment) = self.slide_segment(scene, &load, sign * farthest);
        }
        self.pivot = self.pivot.moved(slip, R::ZERO);
        let moved = segment.turn_with_hand(scene, &mut self.pivot, grip);
        let load = self.pivot.load(scene, grip);
        Moved {
            slip,
            unbalanced: !self.is_balanced(&load)
                || self.is_driven_beyond(scene, &load, (sign, Self::found_to(&load))),
            ..moved
        }
    }

    /// A slide by `shift` along t, or to what ends it before: how far it goes, and its segment. The slide as a function of the turn
    /// is (E2), in the form of (E7).
    fn slide_segment(&self, scene: &impl World<R>, load: &Load<R>, shift: R) -> (R, Segment<R>) {
        let surface = self.pivot.surface(scene);
        let displacement = Displacement::slide(surface.tangent * shift);
        let moment = load.pinned::<Pinned>();
        let Reaction { normal, friction } = Self::reaction(load, &surface, &displacement);
        let drives = surface.friction.drives(normal, friction, shift.sign());
        let ends = (&drives, Trigger::Stopped);
        let lever = load.lever;
        let mut segment =
            Segment::balanced_until(&moment, (lever, &displacement), Trigger::Stopped, ends);
        let lasting = self.contacts();
        segment.stop_at_touch(scene, &load.placed, (surface.tangent * shift, &lasting));
        segment.stop_at(&normal, Trigger::Clear);
        (shift * segment.part(), segment)
    }

    /// True if the moment of the load is rounding, or within the tolerance.
    fn is_balanced(&self, load: &Load<R>) -> bool {
        let within = (load.tolerance * load.stability()).doubled();
        // The angle is rounded, too.
        let angle = R::rounding(load.stability()).doubled().doubled();
        let rounding = (load.rounding_with_foot() + angle).doubled();
        load.moment().abs() <= rounding.max(within)
    }

    pub(crate) fn reactions(&self, scene: &impl World<R>, load: &Load<R>) -> Reactions<R> {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        gather([[normal.max(R::ZERO), friction]])
    }
}

#[cfg(test)]
mod tests;
