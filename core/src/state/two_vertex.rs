//! Two vertices on two surfaces (STATICS 5): the pose is locked while an internal force between the contacts keeps both reactions within
//! their cones (E5); beyond that the body moves with one degree of freedom, like a trammel.

mod slip;

use super::fixed_pose::FixedPose;
use super::trammel::{
    CertifiedSlide, Course, Demand, SLIDE, SlideEnding, Slides, Trammel, certified_slide,
    certified_slide_among, sliding_reactions,
};
use crate::contact::{Pair, Pairs, Reactions, Regime};
use crate::detect::{Short, Watch};
use crate::grip::Grip;
use crate::list::gather;
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::verb::{Moved, Relax, Trigger, seat_sliding};
use crate::work::{CERTIFIED_AMONG, DRIVEN, Work};
use crate::world::World;

pub(crate) use slip::Slip;
use slip::keep;

/// The memory: where the first contact is held, the fixed angle, the other contact, and whether they stick.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TwoVertex<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) other: Pair,
    pub(crate) regime: Regime<R>,
    /// Edges of the friction cones that bore the load last.
    pub(crate) bearers: [u8; 3],
    /// The distance that the body can move before another vertex can touch a surface (L); 0: not known.
    pub(super) room: R,
    pub(super) watch: Watch,
}

impl<R: Real> TwoVertex<R> {
    pub(crate) fn new(pivot: Pivot<R>, other: Pair) -> Self {
        Self {
            pivot,
            other,
            regime: Regime::LOOSE,
            bearers: [0, 1, 2],
            room: R::ZERO,
            watch: Watch::NONE,
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        gather([self.pivot.contact, self.other])
    }

    fn fixed_pose(&self, scene: &impl World<R>) -> FixedPose<R> {
        let stiction = self.regime.has_stiction();
        FixedPose::new(scene, &self.pivot, (&self.contacts(), stiction))
    }

    /// A certified frame: it stays, as the set of loads that are borne is convex and the end of the path decides; or it slides on.
    pub(crate) fn follow<W: World<R>>(
        &mut self,
        scene: &W,
        path: (&Grip<R>, &Grip<R>),
        work: &mut Work,
    ) -> bool {
        if let Some(sense) = self.regime.slide() {
            let contacts = (&self.pivot, self.other);
            let slide = if W::CORNERS && self.contacts().iter().any(|pair| pair.is_corner()) {
                work.spend(CERTIFIED_AMONG);
                certified_slide_among(scene, contacts, path, sense)
            } else {
                certified_slide(scene, contacts, path, sense)
            };
            let slide = slide
                .filter(|slide| !W::CORNERS || self.are_on_sides(scene, &slide.pivot))
                .filter(|slide| self.has_room(scene, slide, work));
            self.pivot = slide.as_ref().map_or(self.pivot, |slide| slide.pivot);
            return slide.is_some();
        }
        let fixed_pose = self.fixed_pose(scene);
        let bears = fixed_pose.bears(scene, path.1, &mut self.bearers);
        work.spend(fixed_pose.work());
        bears
    }

    /// Returns whether both contacts are on their sides at a position of the pivot.
    fn are_on_sides(&self, scene: &impl World<R>, pivot: &Pivot<R>) -> bool {
        let placed = pivot.placed(scene);
        let contacts = self.contacts();
        contacts
            .iter()
            .all(|&pair| placed.beyond(scene, pair) <= R::ZERO)
    }

    /// True if nothing else can be reached on a displacement that begins here.
    #[inline(always)]
    fn has_room<W: World<R>>(
        &mut self,
        scene: &W,
        slide: &CertifiedSlide<R>,
        work: &mut Work,
    ) -> bool {
        if W::CORNERS {
            return self.has_room_among(scene, slide, work);
        }
        let way = slide.travel_bound;
        if self.room <= way {
            self.room = self.room_beside(scene);
        }
        let has_room = self.room > way;
        self.room = self.room - way;
        has_room
    }

    /// The room to half-planes, except by its contacts.
    fn room_beside(&self, scene: &impl World<R>) -> R {
        let contacts = self.contacts();
        let placed = self.pivot.placed(scene);
        placed.room_of(scene, |pair| !contacts.contains(pair))
    }

    /// The same with obstacles.
    #[inline(never)]
    fn has_room_among<W: World<R>>(
        &mut self,
        scene: &W,
        slide: &CertifiedSlide<R>,
        work: &mut Work,
    ) -> bool {
        let contacts = self.contacts();
        let way = slide.travel_bound;
        let short = Short {
            before: self.pivot.placed(scene),
            after: slide.pivot.placed(scene),
            lasting: &contacts,
            way,
            turn: slide.turn_bound,
        };
        let mut least = self.room - way;
        if least <= R::ZERO {
            self.room = R::ZERO;
            least = self.room_beside(scene) - way;
        }
        let keeps_off = short.keeps_off(scene, (&mut self.room, &mut self.watch), work);
        self.room = self.room.min(least);
        keeps_off && self.room > R::ZERO
    }

    /// Slides with the hand, or stays as it moves.
    pub(crate) fn advance(
        &mut self,
        scene: &impl World<R>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        match self.regime.slide() {
            Some(sense) => self.advance_sliding(scene, (from, to), sense),
            None => self.advance_sticking(scene, (from, to)),
        }
    }

    /// Stays as the hand moves, as long as the interval of (E5) is not empty.
    #[inline(never)]
    fn advance_sticking(
        &self,
        scene: &impl World<R>,
        (from, to): (&Grip<R>, &Grip<R>),
    ) -> Moved<R> {
        let moved = self.fixed_pose(scene).advance(scene, from, to);
        Moved {
            trigger: slides(moved.trigger),
            ..moved
        }
    }

    /// The slide in a sense of the twist that follows a displacement of the hand.
    fn sliding<W: World<R>>(
        &self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        sense: R,
    ) -> Slides<R> {
        let trammel = Trammel::in_sense(scene, (&self.pivot, self.other), from, sense);
        self.follows(scene, trammel, (from, to))
    }

    /// The same for a trammel whose load is that at the beginning.
    fn follows<W: World<R>>(
        &self,
        scene: &W,
        trammel: Trammel<R>,
        (from, to): (&Grip<R>, &Grip<R>),
    ) -> Slides<R> {
        let displacement = from.displacement_to(to);
        if W::CORNERS {
            let course = Course::of(scene, (&self.pivot, self.other), from, &trammel);
            return Slides::along(&course, trammel, &displacement);
        }
        Slides::new(trammel, &displacement)
    }

    /// Slides on both surfaces as the hand moves, to the first of halt, fold, touch, N_i = 0, stiction, or as far as the bounds hold.
    #[inline(never)]
    fn advance_sliding<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        sense: R,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let slides = self.sliding(scene, (from, to), sense);
        let (run, part, ending) = if W::CORNERS {
            let contacts = (&self.pivot, self.other);
            let course = Course::of(scene, contacts, from, slides.trammel()).watching(self.watch);
            let (pivot, run, part, ending) = slides.follow(&course);
            self.pivot = pivot;
            (run, part, ending)
        } else {
            let (run, part, ending) = slides.run(scene, &self.contacts());
            self.pivot = seat_sliding(scene, self.pivot.moved(run.slide, run.turn), self.other);
            (run, part, ending)
        };
        let trigger = match ending {
            SlideEnding::Window if !run.unsure => Trigger::GoesOn,
            SlideEnding::Window | SlideEnding::Arrives => Trigger::Balanced,
            SlideEnding::Halts => Trigger::Halts,
            SlideEnding::Folds => Trigger::Fold(sense),
            SlideEnding::Pressed => Trigger::Pressed,
            SlideEnding::Touches(pair) => Trigger::Touch(pair),
            SlideEnding::Opens { lasts, sliding } => keep(lasts, sliding),
            SlideEnding::Off { contact, sign } => Trigger::Off { contact, sign },
        };
        Moved {
            part,
            unsure: run.unsure,
            work: run.work,
            ..Moved::by(trigger)
        }
    }

    /// Without stiction the contacts give way at the edges of their dynamic cones: they slide, or stick on with stiction. `None` if no
    /// slide has the signs of these edges, or none follows the hand in balance (rule 10e).
    pub(crate) fn begin_slide(
        &self,
        scene: &impl World<R>,
        path: (&Grip<R>, &Grip<R>),
        work: &mut Work,
    ) -> Option<Regime<R>> {
        let signs = self.sliding_signs(scene, path.0, work)?;
        let mut senses = [R::ONE, -R::ONE].into_iter();
        senses.find_map(|sense| {
            let trammel = Trammel::in_sense(scene, (&self.pivot, self.other), path.0, sense);
            let mut velocities = trammel.signs().into_iter().zip(signs);
            if !velocities.all(|(velocity, sign)| velocity * sign >= R::ZERO) {
                return None;
            }
            work.spend(SLIDE);
            let slides = self.follows(scene, trammel, path);
            match slides.begins() {
                Some(SlideEnding::Arrives) => Some(Regime::Slide(sense)),
                Some(SlideEnding::Pressed) => Some(Regime::Stick { stiction: true }),
                _ => None,
            }
        })
    }

    /// The directions along t in which the contacts would begin to slide. A call of its own: the cone is off the stack when it returns.
    #[inline(never)]
    fn sliding_signs(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        work: &mut Work,
    ) -> Option<[R; 2]> {
        let fixed_pose = self.fixed_pose(scene);
        let signs = fixed_pose.sliding_signs(scene, grip);
        work.spend(fixed_pose.work());
        signs
    }

    /// The other contact has just closed while the first one slid along a sign: both slide if the motion that continues this slide follows
    /// the hand and presses the new contact on, otherwise both stick (rule 10g).
    pub(crate) fn slide_on(
        &mut self,
        scene: &impl World<R>,
        path: (&Grip<R>, &Grip<R>),
        (sign, work): (R, &mut Work),
    ) {
        self.regime = Regime::LOOSE;
        for sense in [R::ONE, -R::ONE] {
            let trammel = Trammel::in_sense(scene, (&self.pivot, self.other), path.0, sense);
            let [first, _] = trammel.signs();
            if first != sign {
                continue;
            }
            work.spend(SLIDE);
            let slides = self.follows(scene, trammel, path);
            if let Some((advances, [_, pressing])) = slides.rates()
                && advances > R::ZERO
                && pressing > R::ZERO
            {
                self.regime = Regime::Slide(sense);
            }
        }
    }

    /// Tests the contacts in the present pose; a motion in progress goes on while it is driven.
    #[inline(never)]
    pub(crate) fn relax(&self, scene: &impl World<R>, grip: &Grip<R>, how: Relax<R>) -> Moved<R> {
        let driven =
            || Trammel::driven(scene, (&self.pivot, self.other), grip, Demand::Pressed).is_some();
        let moved = match how.sliding {
            Some(sign) if driven() => Moved::by(Trigger::Slide(sign)),
            _ => self.fixed_pose(scene).test(scene, grip, how.tried),
        };
        let asked = if how.sliding.is_some() { DRIVEN } else { 0 };
        Moved {
            trigger: slides(moved.trigger),
            work: moved.work.saturating_add(asked),
            ..moved
        }
    }

    pub(crate) fn is_jammed(&self, scene: &impl World<R>, grip: &Grip<R>, work: &mut Work) -> bool {
        if self.regime.slide().is_some() {
            return false;
        }
        let fixed_pose = self.fixed_pose(scene);
        let is_jammed = fixed_pose.is_jammed(scene, grip);
        work.spend(fixed_pose.work());
        is_jammed
    }

    pub(crate) fn release(&self, scene: &impl World<R>, grip: &Grip<R>, work: &mut Work) -> R {
        let fixed_pose = self.fixed_pose(scene);
        let release = fixed_pose.release(scene, grip);
        work.spend(fixed_pose.work());
        release
    }

    /// The reactions, and the directions along t in which the contacts slide: 0 if they stick.
    pub(crate) fn reactions(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        load: &Load<R>,
    ) -> (Reactions<R>, [R; 2]) {
        if let Some(sense) = self.regime.slide() {
            let contacts = (&self.pivot, self.other);
            let (reactions, signs) = sliding_reactions(scene, contacts, (grip, load), sense);
            return (gather(reactions), signs);
        }
        (self.fixed_pose(scene).reactions(scene, load), [R::ZERO; 2])
    }
}

/// If both contacts last, they slide.
fn slides<R: Real>(trigger: Trigger<R>) -> Trigger<R> {
    match trigger {
        Trigger::Keep {
            contacts: [a, b],
            sliding: Some(sign),
        } if a != b => Trigger::Slide(sign),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// If a single contact slides on, the other one opens.
    #[test]
    fn both_contacts_slide_where_both_last() {
        let keep = |contacts, sliding: Option<f64>| Trigger::Keep { contacts, sliding };
        for sign in [1.0, -1.0] {
            for [a, b] in [[0, 1], [1, 0]] {
                assert_eq!(slides(keep([a, b], Some(sign))), Trigger::Slide(sign));
                assert_eq!(slides(keep([a, b], None)), keep([a, b], None));
                assert_eq!(slides(keep([a, a], Some(sign))), keep([a, a], Some(sign)));
            }
        }
        assert_eq!(slides(Trigger::Clear::<f64>), Trigger::Clear);
    }
}
