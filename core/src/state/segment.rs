//! One segment of a motion: its curve, its extent, and what ends it. Every verb of every state begins with a segment and shortens it to the
//! first event.

use crate::balance_curve::{BalanceCurve, Extent, Margin, Place};
use crate::contact::Pair;
use crate::detect::{Among, Known, Moving, Placed, PointPath, Reached, Tip, first_reached};
use crate::falls::{Level, MOST_FALLS, first_fall};
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::moment::{Downhill, Drive, Moment, Pinned, SecondHarmonic};
use crate::motion::Instant;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::search::{Found, Looks};
use crate::thresholds::Thresholds;
use crate::verb::{Moved, Trigger};
use crate::work::{LOOK_AT_FALL, PLACE};
use crate::world::World;

/// The curve, its extent so far, the trigger at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment<R, H = Pinned> {
    curve: BalanceCurve<R, H>,
    extent: Extent<R>,
    trigger: Trigger<R>,
    /// Nothing ends it before the end of its path.
    goes_on: bool,
}

impl<R: Real, H: SecondHarmonic<R>> Segment<R, H> {
    /// The whole of a turn in proportion to tau.
    pub(super) fn turning(angle: R, trigger: Trigger<R>) -> Self {
        let (curve, extent) = BalanceCurve::turning(angle);
        Self::of(curve, extent, trigger)
    }

    /// A path of tau = x without a turn.
    pub(super) fn straight(x: R, trigger: Trigger<R>) -> Self {
        let curve = BalanceCurve::straight();
        let extent = curve.extent_to(x);
        Self::of(curve, extent, trigger)
    }

    /// For a body that turns about a point in balance of moments, to the end of the path of the hand or to an earlier fold.
    pub(super) fn balanced(moment: &Moment<R, H>, drive: &Drive<R>, trigger: Trigger<R>) -> Self {
        let curve = BalanceCurve::balanced(moment, drive);
        Self::of(curve, curve.extent(), trigger)
    }

    /// The same, to where a margin is used up, if that is earlier: the usual end, in one search with the others.
    pub(super) fn balanced_until(
        moment: &Moment<R, H>,
        drive: &Drive<R>,
        trigger: Trigger<R>,
        (margin, ends): (&Margin<R>, Trigger<R>),
    ) -> Self {
        let curve = BalanceCurve::balanced(moment, drive);
        let (extent, ended) = curve.extent_until(Some(margin));
        let segment = Self::of(curve, extent, if ended { ends } else { trigger });
        Self {
            goes_on: segment.goes_on && !ended,
            ..segment
        }
    }

    /// A segment of a curve up to an extent; it ends with `trigger`, or in a fold if the extent does.
    fn of(curve: BalanceCurve<R, H>, extent: Extent<R>, trigger: Trigger<R>) -> Self {
        let trigger = if extent.folds {
            Trigger::Fold(curve.direction())
        } else {
            trigger
        };
        Self {
            curve,
            extent,
            trigger,
            goes_on: !extent.folds,
        }
    }

    /// Ends where the margin is used up, if that is earlier.
    pub(super) fn stop_at(&mut self, margin: &Margin<R>, trigger: Trigger<R>) {
        if self.curve.stop_at(margin, &mut self.extent) {
            self.trigger = trigger;
            self.goes_on = false;
        }
    }

    /// Ends at a point, if that is earlier.
    pub(super) fn stop_at_place(&mut self, x: R, trigger: Trigger<R>) {
        if x < self.extent.end.x {
            self.extent.end = self.curve.at(x);
            (self.extent.folds, self.extent.unsure) = (false, false);
            self.trigger = trigger;
            self.goes_on = false;
        }
    }

    /// Ends where a foot turns back whose displacement is a margin, if that is earlier.
    pub(super) fn stop_at_reversal(&mut self, foot: &Margin<R>, slack: R, trigger: Trigger<R>) {
        if self.curve.stop_at_reversal(foot, slack, &mut self.extent) {
            self.trigger = trigger;
            self.goes_on = false;
        }
    }

    /// Ends where another vertex reaches a surface, if that is earlier, with the placed point moving along a path.
    pub(super) fn stop_at_touch(
        &mut self,
        scene: &impl World<R>,
        placed: &Placed<R>,
        (path, lasting): (&PointPath<R>, &[Pair]),
    ) {
        self.stop_at_touch_of(scene, placed, (path, Known::of(lasting)));
    }

    /// The same if contacts have just opened.
    pub(super) fn stop_at_touch_of(
        &mut self,
        scene: &impl World<R>,
        placed: &Placed<R>,
        (path, known): (&PointPath<R>, Known<'_>),
    ) {
        let moving = Moving {
            curve: &self.curve,
            path,
            lasting: known.lasting,
            left: known.left,
        };
        if let Some(pair) = placed.first_touch(scene, &mut self.extent, &moving) {
            self.trigger = Trigger::Touch(pair);
            self.goes_on = false;
        }
    }

    /// Ends at the first point at which one of some functions of the motion falls to zero, if that is earlier.
    pub(super) fn stop_at_first<const M: usize>(
        &mut self,
        sample: impl Fn(&BalanceCurve<R, H>, &Place<R>) -> [Option<Level<R>>; M],
        triggers: [Trigger<R>; M],
    ) {
        let limit = self.extent.end;
        // A turn of an eighth: on such a piece no reaction turns back twice.
        let rate = self.curve.rate().abs().doubled().doubled().doubled();
        let longest = if rate * limit.x > R::ONE {
            R::ONE / rate
        } else {
            limit.x
        };
        let mut looks = 0_u32;
        let found = first_fall((limit.x, longest), MOST_FALLS, |x| {
            looks = looks.saturating_add(LOOK_AT_FALL);
            let place = if x == limit.x {
                limit
            } else {
                self.curve.at(x)
            };
            sample(&self.curve, &place)
        });
        self.extent.looks.add_among(looks);
        let (x, which, unsure) = match found {
            Found::Nothing { .. } => return,
            Found::Zero { x, which } => (x, which, false),
            Found::Unsure { x, which } => (x, which, true),
        };
        let end = if x == limit.x {
            limit
        } else {
            self.curve.at(x)
        };
        self.extent = Extent {
            end,
            folds: false,
            unsure,
            ..self.extent
        };
        self.trigger = triggers.get(which).copied().unwrap_or(self.trigger);
        self.goes_on = false;
    }

    /// Ends where a motion whose placed point is not one of the body's reaches an obstacle or a half-plane.
    pub(super) fn stop_at_reached(
        &mut self,
        scene: &impl World<R>,
        lasting: &[Pair],
        at: impl Fn(&BalanceCurve<R, H>, &Place<R>) -> Instant<R>,
    ) {
        let limit = self.extent.end;
        let at = |x: R| {
            let place = if x == limit.x {
                limit
            } else {
                self.curve.at(x)
            };
            at(&self.curve, &place)
        };
        let known = (Known::of(lasting), Among::All);
        let (reached, work) = first_reached(scene, known, limit.x, (&at, PLACE));
        self.extent.looks.add_among(work);
        if let Some(Reached { x, contact, unsure }) = reached {
            self.extent = Extent {
                end: self.curve.at(x),
                folds: false,
                unsure,
                ..self.extent
            };
            self.trigger = Trigger::Touch(contact);
            self.goes_on = false;
        }
    }

    /// Nothing ends it before the end of its path, so far.
    pub(super) fn goes_on(&self) -> bool {
        self.goes_on
    }

    /// tau at the end, (E7).
    pub(super) fn part(&self) -> R {
        self.extent.part()
    }

    /// ϑ at the end.
    pub(super) fn turn(&self) -> R {
        self.extent.end.turn
    }

    /// The searches use the evaluations that others have left.
    pub(super) fn with(mut self, looks: Looks) -> Self {
        self.extent.looks = looks;
        self
    }

    /// The remaining evaluations.
    pub(super) fn looks(&self) -> Looks {
        self.extent.looks
    }

    /// The evaluations and other work for them, in units of work.
    pub(super) fn work(&self) -> u32 {
        self.extent.looks.taken()
    }

    pub(super) fn moved(&self) -> Moved<R> {
        Moved {
            part: self.part(),
            unsure: self.extent.unsure,
            work: self.work(),
            ..Moved::by(self.trigger)
        }
    }

    /// Turns a pivot to the end of the segment; if it ends in balance with the hand at `to`, without the rounding of the path.
    pub(super) fn turn_with_hand(
        &self,
        scene: &impl World<R>,
        pivot: &mut Pivot<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        *pivot = pivot.moved(R::ZERO, self.turn());
        let moved = self.moved();
        if moved.trigger == Trigger::Balanced && !moved.unsure {
            let moment = pivot.load(scene, to).pinned::<H>();
            *pivot = pivot.moved(R::ZERO, moment.polish());
        }
        moved
    }

    /// Ends where the body has turned to the end of what supports a contact at the end of a side.
    fn stop_at_tip<W: World<R>>(&mut self, scene: &W, placed: &Placed<R>, contact: Pair) {
        let (towards, tips) = placed.tips(scene, contact);
        if towards * self.turn() <= R::ZERO || tips.iter().all(Option::is_none) {
            return;
        }
        let path = PointPath::straight(Vec2::ZERO);
        let gap = |body: &Instant<R>, tip: &Tip<R>| {
            let gap = body.gap(scene, tip.neighbour);
            Level::new(gap, R::of_coordinates())
        };
        self.stop_at_first(
            |curve, place| {
                let body = curve.instant(place, placed, &path);
                let [first, second] = &tips;
                [first, second].map(|tip| tip.as_ref().map(|tip| gap(&body, tip)))
            },
            [Trigger::Off {
                contact: 0,
                sign: R::ZERO,
            }; 2],
        );
    }

    /// Turns a pivot downhill at a frozen hand, to balance or to the first touch.
    pub(super) fn turn_downhill<W: World<R>>(
        scene: &W,
        pivot: &mut Pivot<R>,
        lasting: &[Pair],
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        let mut segment = Self::turning(downhill.turn, Trigger::Balanced).with(downhill.looks);
        segment.stop_at_touch(
            scene,
            &pivot.placed(scene),
            (&PointPath::straight(Vec2::ZERO), lasting),
        );
        if W::CORNERS {
            segment.stop_at_tip(scene, &pivot.placed(scene), pivot.contact);
        }
        *pivot = pivot.moved(R::ZERO, segment.turn());
        let moved = segment.moved();
        Moved {
            snapped: downhill.snapped,
            unsure: moved.unsure || downhill.unsure,
            ..moved
        }
    }
}

impl<R: Real> Segment<R> {
    /// For a body that turns about a pinned vertex as the hand moves, to the first of fold and touch.
    pub(super) fn pinned<W: World<R>>(
        scene: &W,
        load: &Load<R>,
        displacement: &Displacement<R>,
        lasting: &[Pair],
    ) -> Self {
        let (moment, drive) = (load.pinned(), load.drive(displacement));
        let mut segment = Self::balanced(&moment, &drive, Trigger::Balanced);
        let path = PointPath::straight(Vec2::ZERO);
        segment.stop_at_touch(scene, &load.placed, (&path, lasting));
        if W::CORNERS
            && let Some(&contact) = lasting.first()
        {
            segment.stop_at_tip(scene, &load.placed, contact);
        }
        segment
    }
}
