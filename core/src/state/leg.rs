//! One leg of a motion: its curve, how far it goes, and what ends it. Every verb of every state begins with a leg and
//! shortens it to the first event.

use crate::contact::Pair;
use crate::detect::{Moving, Placed};
use crate::geometry::Vec2;
use crate::grip::{Grip, Way};
use crate::moment::{Bend, Downhill, Moment, Unbent};
use crate::motion::{Course, Margin, Motion};
use crate::pivot::Pivot;
use crate::real::Real;
use crate::verb::{Moved, Trigger};
use crate::world::World;

/// The curve, its course so far, the trigger at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg<R, B = Unbent> {
    motion: Motion<R, B>,
    course: Course<R>,
    trigger: Trigger<R>,
    /// Nothing ends it before the end of its way.
    goes_on: bool,
}

impl<R: Real, B: Bend<R>> Leg<R, B> {
    /// The whole of a turn in proportion to tau.
    pub(super) fn turning(angle: R, trigger: Trigger<R>) -> Self {
        let (motion, course) = Motion::turning(angle);
        Self::of(motion, course, trigger)
    }

    /// A way of tau = x without a turn.
    pub(super) fn straight(x: R, trigger: Trigger<R>) -> Self {
        let motion = Motion::straight();
        let course = motion.course_to(x);
        Self::of(motion, course, trigger)
    }

    /// Of a body that turns about a point in balance of moments, to the end of the way of the hand or to the fold before.
    pub(super) fn balanced(
        moment: &Moment<R, B>,
        (lever, way): (Vec2<R>, &Way<R>),
        trigger: Trigger<R>,
    ) -> Self {
        let motion = Self::motion(moment, lever, way);
        Self::of(motion, motion.course(), trigger)
    }

    /// The same, to where a margin is used up, if that is earlier: what usually ends it, in one search with the others.
    pub(super) fn balanced_until(
        moment: &Moment<R, B>,
        (lever, way): (Vec2<R>, &Way<R>),
        trigger: Trigger<R>,
        (margin, ends): (&Margin<R>, Trigger<R>),
    ) -> Self {
        let motion = Self::motion(moment, lever, way);
        let (course, ended) = motion.course_until(Some(margin));
        let leg = Self::of(motion, course, if ended { ends } else { trigger });
        Self {
            goes_on: leg.goes_on && !ended,
            ..leg
        }
    }

    fn motion(moment: &Moment<R, B>, lever: Vec2<R>, way: &Way<R>) -> Motion<R, B> {
        let drive = lever.conj_mul(way.hand);
        Motion::balanced(moment, drive, way.turn).to_within(moment.tolerance, way.hand.reach())
    }

    fn of(motion: Motion<R, B>, course: Course<R>, trigger: Trigger<R>) -> Self {
        let trigger = if course.folds {
            Trigger::Fold(motion.direction())
        } else {
            trigger
        };
        Self {
            motion,
            course,
            trigger,
            goes_on: !course.folds,
        }
    }

    /// Ends where the margin is used up, if that is earlier.
    pub(super) fn stop_at(&mut self, margin: &Margin<R>, trigger: Trigger<R>) {
        if self.motion.stop_at(margin, &mut self.course) {
            self.trigger = trigger;
            self.goes_on = false;
        }
    }

    /// Ends where a further vertex reaches a surface, if that is earlier. The placed point moves by `shift` at tau = 1.
    pub(super) fn stop_at_touch(
        &mut self,
        scene: &impl World<R>,
        placed: &Placed<R>,
        (shift, keeps): (Vec2<R>, &[Pair]),
    ) {
        let moving = Moving {
            motion: &self.motion,
            shift,
            keeps,
        };
        if let Some(pair) = placed.first_touch(scene, &mut self.course, &moving) {
            self.trigger = Trigger::Touch(pair);
            self.goes_on = false;
        }
    }

    /// Nothing ends it before the end of its way, so far.
    pub(super) fn goes_on(&self) -> bool {
        self.goes_on
    }

    /// tau at the end.
    pub(super) fn part(&self) -> R {
        self.course.part()
    }

    /// ϑ at the end.
    pub(super) fn turn(&self) -> R {
        self.course.end.turn
    }

    pub(super) fn moved(&self) -> Moved<R> {
        Moved {
            part: self.part(),
            unsure: self.course.unsure,
            ..Moved::by(self.trigger)
        }
    }

    /// Turns a pivot to the end of the leg; where it ends in balance with the hand at `to`, without the rounding of the way.
    pub(super) fn turn_with_hand(
        &self,
        scene: &impl World<R>,
        pivot: &mut Pivot<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        *pivot = pivot.moved(R::ZERO, self.turn());
        let moved = self.moved();
        if moved.trigger == Trigger::Balanced && !moved.unsure {
            let moment = pivot.stance(scene, to).pinned::<B>();
            let polished = pivot.moved(R::ZERO, moment.polish());
            // Within a tolerance touches were looked for up to the end of the leg only.
            let is_exact = moment.tolerance == R::ZERO;
            if is_exact || polished.placed(scene).touching(scene, -R::TOUCH).is_empty() {
                *pivot = polished;
            }
        }
        moved
    }

    /// Turns a pivot downhill at a frozen hand, to balance or to the first touch.
    pub(super) fn turn_downhill(
        scene: &impl World<R>,
        pivot: &mut Pivot<R>,
        keeps: &[Pair],
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        let mut leg = Self::turning(downhill.turn, Trigger::Balanced);
        leg.stop_at_touch(scene, &pivot.placed(scene), (Vec2::ZERO, keeps));
        *pivot = pivot.moved(R::ZERO, leg.turn());
        let moved = leg.moved();
        Moved {
            snapped: downhill.snapped,
            unsure: moved.unsure || downhill.unsure,
            ..moved
        }
    }
}
