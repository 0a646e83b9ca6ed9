//! Two vertices on two surfaces (STATICS 5): the pose is locked while an internal force between the contacts keeps both
//! reactions within their cones (E5); beyond that the body moves with one degree of freedom, like a trammel.

use super::fixed_pose::FixedPose;
use super::trammel::{
    Demand, Ending, Run, SLIDE, SlideEnding, Slides, Trammel, certified_slide, sliding_reactions,
};
use crate::contact::{Pair, Pairs, Reactions, Regime};
use crate::geometry::{Angle, Orientation};
use crate::grip::Grip;
use crate::list::gather;
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::sign::Sign;
use crate::verb::{Moved, Relax, Trigger, seat_sliding};
use crate::work::{DRIVEN, Work};
use crate::world::{Surface, World};

/// The memory: where the first contact is held, the fixed angle, the other contact, and whether they stick.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TwoVertex<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) other: Pair,
    pub(crate) regime: Regime<R>,
    /// Edges of the friction cones that bore the load last.
    pub(crate) bearers: [u8; 3],
    /// By so much the body can move before a further vertex can touch a surface (L); 0: not known.
    pub(super) room: R,
}

/// A slip of one or two vertices that is under way, piece by piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slip<R> {
    /// Where it began: the first contact and the angle.
    pub(super) foot: R,
    angle: Angle<R>,
    /// The sign of the twist: it goes one way.
    sense: Sign,
    demand: Demand,
    /// Where nothing drives it on a contact opens: whether the first one lasts, and the direction in which the one that lasts slides.
    opens: Option<(bool, Sign)>,
}

/// A stretch of a slip: as far as the bounds of its motion hold, and what ends it there.
struct Stretch<R> {
    slip: Slip<R>,
    run: Run<R>,
    ending: Ending<R>,
}

impl<R: Real> Slip<R> {
    pub(super) fn from(pivot: &Pivot<R>, sense: R) -> Self {
        Self {
            foot: pivot.foot,
            angle: pivot.orientation.angle(),
            sense: Sign::of(sense),
            demand: Demand::Pressed,
            opens: None,
        }
    }
}

impl<R: Real> TwoVertex<R> {
    pub(crate) fn new(pivot: Pivot<R>, other: Pair) -> Self {
        Self {
            pivot,
            other,
            regime: Regime::LOOSE,
            bearers: [0, 1, 2],
            room: R::ZERO,
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        gather([self.pivot.contact, self.other])
    }

    fn fixed_pose(&self, scene: &impl World<R>) -> FixedPose<R> {
        let stiction = self.regime.has_stiction();
        FixedPose::new(scene, &self.pivot, (&self.contacts(), stiction))
    }

    /// A certified frame: it stays, as the loads that are borne are convex and the end of the way decides; or it slides on.
    pub(crate) fn follow(
        &mut self,
        scene: &impl World<R>,
        path: (&Grip<R>, &Grip<R>),
        work: &mut Work,
    ) -> bool {
        if let Some(sense) = self.regime.slide() {
            let slide = certified_slide(scene, (&self.pivot, self.other), path, sense);
            let slide = slide.filter(|slide| self.has_room(scene, slide.travel_bound));
            self.pivot = slide.as_ref().map_or(self.pivot, |slide| slide.pivot);
            return slide.is_some();
        }
        let fixed_pose = self.fixed_pose(scene);
        let bears = fixed_pose.bears(scene, path.1, &mut self.bearers);
        work.spend(fixed_pose.work());
        bears
    }

    /// True if no further vertex can reach a surface on a way that begins here.
    fn has_room(&mut self, scene: &impl World<R>, way: R) -> bool {
        if self.room <= way {
            let contacts = self.contacts();
            let placed = self.pivot.placed(scene);
            self.room = placed.room_of(scene, |pair| !contacts.contains(pair));
        }
        let has_room = self.room > way;
        self.room = self.room - way;
        has_room
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
    fn sliding(
        &self,
        scene: &impl World<R>,
        (from, to): (&Grip<R>, &Grip<R>),
        sense: R,
    ) -> Slides<R> {
        let trammel = Trammel::in_sense(scene, (&self.pivot, self.other), from, sense);
        Slides::new(trammel, &from.displacement_to(to))
    }

    /// Slides on both surfaces as the hand moves, to the first of halt, fold, touch, N_i = 0, stiction, or as far as the bounds hold.
    #[inline(never)]
    fn advance_sliding(
        &mut self,
        scene: &impl World<R>,
        (from, to): (&Grip<R>, &Grip<R>),
        sense: R,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let slides = self.sliding(scene, (from, to), sense);
        let (run, part, ending) = slides.run(scene, &self.contacts());
        self.pivot = seat_sliding(scene, self.pivot.moved(run.slide, run.turn), self.other);
        let trigger = match ending {
            SlideEnding::Window if !run.unsure => Trigger::GoesOn,
            SlideEnding::Window | SlideEnding::Arrives => Trigger::Balanced,
            SlideEnding::Halts => Trigger::Halts,
            SlideEnding::Folds => Trigger::Fold(sense),
            SlideEnding::Pressed => Trigger::Pressed,
            SlideEnding::Touches(pair) => Trigger::Touch(pair),
            SlideEnding::Opens { lasts, sliding } => keep(lasts, sliding),
        };
        Moved {
            part,
            unsure: run.unsure,
            work: run.work,
            ..Moved::by(trigger)
        }
    }

    /// Without stiction the contacts give way at the edges of their dynamic cones: they slide, or stick on with stiction. Nothing
    /// where no slide has the signs of these edges, or none follows the hand in balance (rule 10e).
    pub(crate) fn begin_slide(
        &self,
        scene: &impl World<R>,
        path: (&Grip<R>, &Grip<R>),
        work: &mut Work,
    ) -> Option<Regime<R>> {
        let fixed_pose = self.fixed_pose(scene);
        let signs = fixed_pose.sliding_signs(scene, path.0);
        work.spend(fixed_pose.work());
        let signs = signs?;
        let mut senses = [R::ONE, -R::ONE].into_iter();
        senses.find_map(|sense| {
            let trammel = Trammel::in_sense(scene, (&self.pivot, self.other), path.0, sense);
            let mut velocities = trammel.signs().into_iter().zip(signs);
            if !velocities.all(|(velocity, sign)| velocity * sign >= R::ZERO) {
                return None;
            }
            work.spend(SLIDE);
            let slides = Slides::new(trammel, &path.0.displacement_to(path.1));
            match slides.begins() {
                Some(SlideEnding::Arrives) => Some(Regime::Slide(sense)),
                Some(SlideEnding::Pressed) => Some(Regime::Stick { stiction: true }),
                _ => None,
            }
        })
    }

    /// The other contact has just closed while the first one slid along a sign: both slide if the motion that goes on with that
    /// follows the hand and presses the new contact on, else both stick (rule 10g).
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
            let slides = Slides::new(trammel, &path.0.displacement_to(path.1));
            if let Some((advances, [_, pressing])) = slides.rates()
                && advances > R::ZERO
                && pressing > R::ZERO
            {
                self.regime = Regime::Slide(sense);
            }
        }
    }

    /// Puts the contacts to the test as they are; a motion under way goes on while it is driven.
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

    /// Slips on both surfaces to the first of (E6), N_i = 0, touch. Where it ends in balance both stick if one of them went as far as
    /// its memory, else they slide on with the hand (rule 10d). It goes as far as the bounds hold; what is under way then goes on.
    #[inline(never)]
    pub(crate) fn slip(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        under_way: &mut Option<Slip<R>>,
    ) -> Moved<R> {
        if let Some(stretch) = self.slip_driven(scene, grip, under_way) {
            return self.slip_on(scene, grip, stretch, under_way);
        }
        match under_way.take() {
            // Nothing drives it beyond what was looked at.
            Some(slip) => {
                let opens = slip.opens.map(|(first_lasts, sliding)| {
                    keep(usize::from(!first_lasts), sliding.number())
                });
                let trigger = opens.unwrap_or(Trigger::Stopped);
                self.end_slip(scene, grip, &slip, (trigger, true))
            }
            // In both senses, with either demand.
            None => Moved {
                work: DRIVEN + DRIVEN,
                ..Moved::by(Trigger::Undriven)
            },
        }
    }

    /// From a fold of a slide, on in the same sense.
    #[inline(never)]
    pub(crate) fn snap(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        sense: R,
        under_way: &mut Option<Slip<R>>,
    ) -> Moved<R> {
        if under_way.is_some() {
            return self.slip(scene, grip, under_way);
        }
        let stretch = self.slip_over_fold(scene, grip, sense);
        self.slip_on(scene, grip, stretch, under_way)
    }

    /// Along a motion that is driven, as far as the bounds hold. A call of its own: the motion is off the stack when it is done.
    #[inline(never)]
    fn slip_driven(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        under_way: &mut Option<Slip<R>>,
    ) -> Option<Stretch<R>> {
        let contacts = (&self.pivot, self.other);
        // It goes one way.
        let (senses, demand) = match under_way {
            Some(slip) => ([slip.sense.number(); 2], slip.demand),
            None => ([R::ONE, -R::ONE], Demand::Pressed),
        };
        let any = |demand| Trammel::driven_in(scene, contacts, grip, (&senses, demand));
        let trammel = any(demand).or_else(|| any(Demand::AtTheEnd))?;
        Some(self.slip_along(scene, (&trammel, R::ZERO), under_way.take()))
    }

    /// From a fold, where no balance ends it, likewise.
    #[inline(never)]
    fn slip_over_fold(&mut self, scene: &impl World<R>, grip: &Grip<R>, sense: R) -> Stretch<R> {
        let trammel = Trammel::in_sense(scene, (&self.pivot, self.other), grip, sense);
        let clear = trammel.clear_of_fold();
        self.slip_along(scene, (&trammel, clear), None)
    }

    /// Along a motion as far as the bounds hold; balance does not end it before `clear`.
    fn slip_along(
        &mut self,
        scene: &impl World<R>,
        (trammel, clear): (&Trammel<R>, R),
        under_way: Option<Slip<R>>,
    ) -> Stretch<R> {
        self.room = R::ZERO;
        let slip = under_way.unwrap_or_else(|| Slip::from(&self.pivot, trammel.direction()));
        let (run, ending) = trammel.run(scene, &self.contacts(), (clear, slip.demand));
        self.pivot = seat_sliding(scene, self.pivot.moved(run.slide, run.turn), self.other);
        Stretch { slip, run, ending }
    }

    /// What has come of a slip: its end, or it is under way.
    fn slip_on(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        Stretch {
            mut slip,
            run,
            ending,
        }: Stretch<R>,
        under_way: &mut Option<Slip<R>>,
    ) -> Moved<R> {
        slip.opens = None;
        let mut work = run.work;
        let ends = match ending {
            Ending::Stopped => Some(Trigger::Stopped),
            Ending::Touches(pair) => Some(Trigger::Touch(pair)),
            Ending::Window | Ending::Reverses => None,
            Ending::Opens { lasts, sliding } => {
                slip.opens = Some((lasts == 0, Sign::of(sliding)));
                let (opens, units) = self.can_open(scene, grip, lasts, sliding);
                work = work.saturating_add(units);
                opens.then(|| keep(lasts, sliding))
            }
        };
        let unbalanced = ending != Ending::Stopped || slip.demand == Demand::AtTheEnd;
        if slip.opens.is_some() {
            slip.demand = Demand::AtTheEnd;
        }
        let goes_on = ends.is_none() && !run.unsure;
        let moved = if goes_on {
            *under_way = Some(slip);
            Moved::by(Trigger::GoesOn)
        } else {
            // What has no end here does not get away from where it is.
            let trigger = ends.unwrap_or(Trigger::Stopped);
            self.end_slip(scene, grip, &slip, (trigger, unbalanced))
        };
        Moved {
            unsure: run.unsure,
            work: work.saturating_add(moved.work),
            ..moved
        }
    }

    /// What a slip leaves behind that goes no farther.
    fn end_slip(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        slip: &Slip<R>,
        (trigger, unbalanced): (Trigger<R>, bool),
    ) -> Moved<R> {
        let begin = Pivot {
            foot: slip.foot,
            orientation: Orientation::new(slip.angle),
            ..self.pivot
        };
        let slide = self.pivot.foot - begin.foot;
        let mut moved = Moved {
            slip: slide,
            unbalanced,
            ..Moved::by(trigger)
        };
        if moved.trigger != Trigger::Stopped {
            return moved;
        }
        // Where opposite surfaces clamp the body, what ends a slip is not always a balance.
        let fixed_pose = self.fixed_pose(scene);
        let is_at_rest = fixed_pose.is_at_rest(scene, grip);
        moved.work = fixed_pose.work();
        if !is_at_rest {
            moved.unbalanced = true;
            let turn = (self.pivot.orientation.angle()).minus(slip.angle);
            if slide.abs() + turn.abs() <= R::MICRO {
                self.pivot = begin;
                moved.trigger = Trigger::Undriven;
            }
        }
        if !moved.unbalanced {
            self.regime = Regime::after_slip(self.has_renewed(scene, &begin), slip.sense.number());
        }
        moved
    }

    /// A contact has gone as far as its memory since a place, and regains stiction.
    fn has_renewed(&self, scene: &impl World<R>, begin: &Pivot<R>) -> bool {
        let pairs = self.contacts();
        let surfaces = || pairs.iter().map(|pair| scene.surface(pair.surface));
        let has_stiction = surfaces().any(|surface| surface.friction.threshold() < R::HUGE);
        let foot = |pivot: &Pivot<R>, pair: &Pair| {
            let placed = pivot.placed(scene);
            let point = placed.point + placed.arm(scene, pair.vertex);
            scene.surface(pair.surface).tangent.dot(point)
        };
        let renews = |(pair, surface): (&Pair, Surface<R>)| {
            (foot(&self.pivot, pair) - foot(begin, pair)).abs() >= surface.friction.memory()
        };
        has_stiction && pairs.iter().zip(surfaces()).any(renews)
    }

    /// True if the contact that does not last can leave its surface, by a turn about the one that lasts or by its slide; and what
    /// that took, in units of work.
    fn can_open(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        lasts: usize,
        sliding: R,
    ) -> (bool, u32) {
        let fixed_pose = self.fixed_pose(scene);
        let opens = [None, Some(sliding)]
            .into_iter()
            .any(|sliding| fixed_pose.opens(scene, grip, &([lasts, lasts], sliding)));
        (opens, fixed_pose.work())
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

    /// The reactions, and the directions along t in which the contacts slide: 0 where they stick.
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

/// Only one of the contacts lasts, and slides.
fn keep<R: Real>(lasts: usize, sliding: R) -> Trigger<R> {
    Trigger::Keep {
        contacts: [lasts, lasts],
        sliding: Some(sliding),
    }
}

/// Where both contacts last, they slide.
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
impl<R: Real> TwoVertex<R> {
    /// A slip to its end, in as many goes as it takes.
    pub(super) fn slip_to_the_end(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        let mut under_way = None;
        for _ in 0..1000 {
            let moved = self.slip(scene, grip, &mut under_way);
            if moved.trigger != Trigger::GoesOn {
                return moved;
            }
        }
        panic!("a slip without end");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a single contact that slides on, the other one opens.
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
