//! The slip of two vertices on two surfaces (STATICS 5): a motion of one degree of freedom at a frozen hand, piece by piece as far as its
//! bounds hold, to the first of (E6), N_i = 0 and touch.

use super::TwoVertex;
use crate::contact::{Pair, Regime};
use crate::geometry::{Angle, Orientation};
use crate::grip::Grip;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::sign::Sign;
use crate::state::trammel::{Course, Demand, Ending, Run, Trammel, certified_slip};
use crate::verb::{Moved, Trigger, seat_sliding};
use crate::work::{CERTIFIED_SLIP, DRIVEN, Work};
use crate::world::{Surface, World};

/// A slip of one or two vertices in progress, piece by piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slip<R> {
    /// Where it began: the first contact and the angle.
    pub(in crate::state) foot: R,
    angle: Angle<R>,
    /// The sign of the twist: it moves in one direction.
    sense: Sign,
    demand: Demand,
    /// If nothing drives it on a contact opens: whether the first one lasts, and the direction in which the one that lasts slides.
    opens: Option<(bool, Sign)>,
}

/// A stretch of a slip: as far as the bounds of its motion hold, and what ends it there.
struct Stretch<R> {
    slip: Slip<R>,
    run: Run<R>,
    ending: Ending<R>,
}

impl<R: Real> Slip<R> {
    pub(in crate::state) fn from(pivot: &Pivot<R>, sense: R) -> Self {
        Self {
            foot: pivot.foot,
            angle: pivot.orientation.angle(),
            sense: Sign::of(sense),
            demand: Demand::Pressed,
            opens: None,
        }
    }

    /// The pivot where it began.
    fn begin(&self, pivot: &Pivot<R>) -> Pivot<R> {
        Pivot {
            foot: self.foot,
            orientation: Orientation::new(self.angle),
            ..*pivot
        }
    }
}

impl<R: Real> TwoVertex<R> {
    /// Slips on both surfaces to the first of (E6), N_i = 0, touch. If it ends in balance both stick if one of them moved as far as its
    /// memory length, otherwise they slide on with the hand (rule 10d). It moves as far as the bounds hold; a slip in progress then goes
    /// on.
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
            // Nothing drives it beyond what was examined.
            Some(slip) => {
                let opens = slip.opens.map(|(first_lasts, sliding)| {
                    keep(usize::from(!first_lasts), sliding.number())
                });
                let trigger = opens.unwrap_or(Trigger::Stopped);
                self.end_slip(scene, grip, &slip, (trigger, true))
            }
            // In both directions, with either demand.
            None => Moved {
                work: DRIVEN + DRIVEN,
                ..Moved::by(Trigger::Undriven)
            },
        }
    }

    /// From a fold of a slide, on in the same direction.
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

    /// Along a motion that is driven, as far as the bounds hold. A call of its own: the motion is off the stack when it returns.
    #[inline(never)]
    fn slip_driven(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        under_way: &mut Option<Slip<R>>,
    ) -> Option<Stretch<R>> {
        let contacts = (&self.pivot, self.other);
        // It moves in one direction.
        let (senses, demand) = match under_way {
            Some(slip) => ([slip.sense.number(); 2], slip.demand),
            None => ([R::ONE, -R::ONE], Demand::Pressed),
        };
        let any = |demand| Trammel::driven_in(scene, contacts, grip, (&senses, demand));
        let trammel = any(demand).or_else(|| any(Demand::AtTheEnd))?;
        Some(self.slip_along(scene, grip, (&trammel, false), under_way.take()))
    }

    /// From a fold, where no balance ends it, in the same manner.
    #[inline(never)]
    fn slip_over_fold(&mut self, scene: &impl World<R>, grip: &Grip<R>, sense: R) -> Stretch<R> {
        let trammel = Trammel::in_sense(scene, (&self.pivot, self.other), grip, sense);
        self.slip_along(scene, grip, (&trammel, true), None)
    }

    /// Along a motion as far as the bounds hold; from a fold, where it is in balance, to the next balance.
    fn slip_along<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        (trammel, over_fold): (&Trammel<R>, bool),
        under_way: Option<Slip<R>>,
    ) -> Stretch<R> {
        let slip = under_way.unwrap_or_else(|| Slip::from(&self.pivot, trammel.direction()));
        if W::CORNERS {
            let mut work = Work::none();
            if under_way.is_none() && !over_fold {
                let sense = trammel.direction();
                if let Some(run) = self.slip_shortly(scene, grip, (sense, &mut work)) {
                    let ending = Ending::Rests;
                    return Stretch { slip, run, ending };
                }
            }
            self.room = R::ZERO;
            let course =
                Course::of(scene, (&self.pivot, self.other), grip, trammel).watching(self.watch);
            let falls = trammel.falls();
            let clear = if over_fold {
                course.clear_of_fold(falls)
            } else {
                R::ZERO
            };
            let (pivot, mut run, ending) = course.slip(falls, (clear, slip.demand));
            self.pivot = pivot;
            run.work = run.work.saturating_add(work.done());
            return Stretch { slip, run, ending };
        }
        self.room = R::ZERO;
        let clear = if over_fold {
            trammel.clear_of_fold()
        } else {
            R::ZERO
        };
        let (run, ending) = trammel.run(scene, &self.contacts(), (clear, slip.demand));
        self.pivot = seat_sliding(scene, self.pivot.moved(run.slide, run.turn), self.other);
        Stretch { slip, run, ending }
    }

    /// A slip in a direction of the twist that certainly ends in balance (STATICS 12.8), if nothing is reached on it.
    #[inline(never)]
    fn slip_shortly<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        (sense, work): (R, &mut Work),
    ) -> Option<Run<R>> {
        work.spend(CERTIFIED_SLIP);
        let begin = self.pivot;
        let slip = certified_slip(scene, (&begin, self.other), grip, sense)
            .filter(|slip| self.are_on_sides(scene, &slip.pivot))
            .filter(|slip| self.has_room_among(scene, slip, work))?;
        self.pivot = slip.pivot;
        Some(Run {
            slide: self.pivot.foot - begin.foot,
            turn: (self.pivot.orientation.angle()).minus(begin.orientation.angle()),
            unsure: false,
            work: work.done(),
        })
    }

    /// The result of a stretch of a slip: its end, or that it is in progress.
    fn slip_on<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        Stretch {
            mut slip,
            run,
            ending,
        }: Stretch<R>,
        under_way: &mut Option<Slip<R>>,
    ) -> Moved<R> {
        slip.opens = None;
        if W::CORNERS && ending == Ending::Rests {
            let begin = slip.begin(&self.pivot);
            self.rests(scene, (&slip, &begin));
            return Moved {
                slip: self.pivot.foot - begin.foot,
                work: run.work,
                ..Moved::by(Trigger::Stopped)
            };
        }
        let mut work = run.work;
        let ends = match ending {
            Ending::Stopped | Ending::Rests => Some(Trigger::Stopped),
            Ending::Touches(pair) => Some(Trigger::Touch(pair)),
            Ending::Window | Ending::Reverses => None,
            Ending::Off { contact, sign } => Some(Trigger::Off { contact, sign }),
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
            // If it has no end here it makes no progress.
            let trigger = ends.unwrap_or(Trigger::Stopped);
            self.end_slip(scene, grip, &slip, (trigger, unbalanced))
        };
        Moved {
            unsure: run.unsure,
            work: work.saturating_add(moved.work),
            ..moved
        }
    }

    /// What a slip that goes no farther leaves behind.
    fn end_slip<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        slip: &Slip<R>,
        (trigger, unbalanced): (Trigger<R>, bool),
    ) -> Moved<R> {
        let begin = slip.begin(&self.pivot);
        let slide = self.pivot.foot - begin.foot;
        let mut moved = Moved {
            slip: slide,
            unbalanced,
            ..Moved::by(trigger)
        };
        if moved.trigger != Trigger::Stopped {
            return moved;
        }
        // If opposite surfaces clamp the body, a slip does not always end in balance.
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
        if W::CORNERS && !moved.unbalanced {
            // A slip that began with a contact that did not press may come to (E6) with one that does not.
            let contacts = (&self.pivot, self.other);
            let slid = Trammel::in_sense(scene, contacts, grip, slip.sense.number());
            moved.unbalanced = !slid.presses_both();
            moved.work = moved.work.saturating_add(DRIVEN);
        }
        if !moved.unbalanced {
            self.rests(scene, (slip, &begin));
        }
        moved
    }

    /// In balance at the end of a slip from a position both stick or slide on.
    fn rests(&mut self, scene: &impl World<R>, (slip, begin): (&Slip<R>, &Pivot<R>)) {
        self.regime = Regime::after_slip(self.has_renewed(scene, begin), slip.sense.number());
    }

    /// Returns whether a contact has moved as far as its memory length since a position, and so regains stiction.
    fn has_renewed(&self, scene: &impl World<R>, begin: &Pivot<R>) -> bool {
        let pairs = self.contacts();
        let surfaces = || pairs.iter().map(|pair| scene.surface(pair.surface));
        let has_stiction = surfaces().any(|surface| surface.friction.threshold() < R::HUGE);
        let foot = |pivot: &Pivot<R>, pair: &Pair| pivot.placed(scene).foot(scene, *pair);
        let renews = |(pair, surface): (&Pair, Surface<R>)| {
            (foot(&self.pivot, pair) - foot(begin, pair)).abs() >= surface.friction.memory()
        };
        has_stiction && pairs.iter().zip(surfaces()).any(renews)
    }

    /// True if the contact that does not last can leave its surface, by a turn about the one that lasts or by a slide of that one; and the
    /// cost of the test, in units of work.
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
}

/// Only one of the contacts lasts, and slides.
pub(super) fn keep<R: Real>(lasts: usize, sliding: R) -> Trigger<R> {
    Trigger::Keep {
        contacts: [lasts, lasts],
        sliding: Some(sliding),
    }
}

#[cfg(test)]
impl<R: Real> TwoVertex<R> {
    /// A slip to its end, in as many calls as it takes.
    pub(in crate::state) fn slip_to_the_end(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
    ) -> Moved<R> {
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
