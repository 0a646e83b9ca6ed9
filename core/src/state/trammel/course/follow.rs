//! Two contacts among obstacles that slide with the hand: along a piece of their motion, in balance (E13), to the first of the end of the
//! displacement, fold, N_i = 0, halt, stiction, a contact that leaves its side, and touch.

use super::super::slide::{Displaced, Loads, MOST_OF_OTHERS, Progress, SLIDE, SlideEnding, Slides};
use super::super::{LOOK, Run, Trammel};
use super::slip::level;
use super::{Course, Spot};
use crate::bounded::{Bounded, Bounds, Quantity, Sloped};
use crate::falls::{Level, MOST_FALLS, first_fall};
use crate::grip::Displacement;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::search::Found;
use crate::thresholds::Thresholds;
use crate::world::World;
use core::cell::Cell;

/// A value with unknown slope: its sign shows on which side of its zero it is.
fn value_of<R: Real>(of: Sloped<R>) -> Sloped<R> {
    Sloped {
        slope: R::ZERO,
        ..of
    }
}

impl<R: Real, W: World<R>> Course<'_, R, W> {
    /// The slide at a point.
    fn progress(
        &self,
        spot: &Spot<R>,
        trammel: &Trammel<R>,
        displaced: &Displaced<R>,
    ) -> Progress<Sloped<R>> {
        let added = (displaced.force, displaced.couple);
        let (place, [load, added]) = self.terms(spot, added);
        let slopes = [load, added].map(|wrench| Sloped {
            value: place.imbalance(wrench).slope,
            slope: R::ZERO,
        });
        let loads = Loads {
            load,
            added,
            slopes,
        };
        Progress::of(trammel, &place, &loads, (displaced.gain, R::ZERO))
    }
}

impl<R: Real> Slides<R> {
    /// Along a course, for a trammel whose load is that at the beginning of a displacement.
    pub(crate) fn along<W: World<R>>(
        course: &Course<'_, R, W>,
        trammel: Trammel<R>,
        displacement: &Displacement<R>,
    ) -> Self {
        let error = trammel.sense.rounding;
        Self::from_start(trammel, displacement, |trammel, displaced| {
            let start = course.progress(&course.spot(R::ZERO), trammel, displaced);
            start.map(|of: Sloped<R>| {
                let bounds = || Bounds {
                    error,
                    suprema: [of.value.abs(), of.slope.abs(), R::ZERO],
                };
                Bounded::known(of.value, || of.slope, bounds)
            })
        })
    }

    /// Follows the hand on a course to the first ending: returns the new pivot, the distance, and the fraction of the displacement that is
    /// done.
    pub(crate) fn follow<W: World<R>>(
        &self,
        course: &Course<'_, R, W>,
    ) -> (Pivot<R>, Run<R>, R, SlideEnding<R>) {
        let standing = self.start.begin();
        let here = |part, ending| {
            let (pivot, run) = course.run_to(R::ZERO, (false, SLIDE));
            (pivot, run, part, ending)
        };
        if let Some(ending) = self.ends_at_once() {
            return here(R::ZERO, ending);
        }
        // A slide that is pressed at its beginning goes on (rule 10).
        let start = self.start.map(|of: Bounded<R>| Sloped {
            value: of.value,
            slope: of.slope,
        });
        let lacks = self.lacks_after(&start, R::ZERO);
        let remembers = self.has_stiction() && lacks.iter().all(|&(lacks, _)| lacks > R::ZERO);
        let looks = Cell::new(0_u32);
        let at = |x: R| {
            looks.set(looks.get().saturating_add(1));
            let spot = course.spot(x);
            (spot, course.progress(&spot, &self.trammel, &self.displaced))
        };
        let is_driven = self.start.drive.value > R::ZERO;
        let window = course.longest().min(self.window(&self.start, &standing));
        let found = if is_driven {
            first_fall((window, window), MOST_FALLS, |x| {
                let (spot, progress) = at(x);
                self.falls(course, &spot, (&progress, remembers))
            })
        } else {
            Found::Zero {
                x: R::ZERO,
                which: 0,
            }
        };
        let (mut x, mut ending, mut unsure) = match found {
            Found::Nothing { .. } => (window, SlideEnding::Window, false),
            Found::Unsure { x, .. } => (x, SlideEnding::Window, true),
            Found::Zero { x, which } => (x, self.ending(which), false),
        };
        let mut arrival = None;
        if let SlideEnding::Arrives = ending {
            x = self.nearer(x, &at(x).1);
            let (_, last) = at(x);
            x = self.nearer(x, &last);
            arrival = Some(last);
        }
        let (reached, searched) = course.reached(x);
        if let Some(reached) = reached {
            (x, unsure) = (reached.x, reached.unsure);
            ending = if unsure {
                SlideEnding::Window
            } else {
                SlideEnding::Touches(reached.contact)
            };
        }
        let mut part = R::ONE;
        if ending != SlideEnding::Arrives {
            part = self.part_gone(&at(x).1);
        } else if let Some((opens, at)) = arrival.and_then(|last| self.opens_in_place(&last)) {
            (ending, part) = (opens, at);
        }
        let others = if arrival.is_some() { MOST_OF_OTHERS } else { 1 };
        let taken = looks.get().saturating_add(others);
        let work = SLIDE
            .saturating_add(taken.saturating_mul(LOOK))
            .saturating_add(searched);
        let is_lost = unsure && (ending != SlideEnding::Window || x == R::ZERO);
        let (pivot, run) = course.run_to(x, (is_lost, work));
        (pivot, run, part, ending)
    }

    /// The functions that fall to zero where the slide ends.
    fn falls<W: World<R>>(
        &self,
        course: &Course<'_, R, W>,
        spot: &Spot<R>,
        (progress, remembers): (&Progress<Sloped<R>>, bool),
    ) -> [Option<Level<R>>; 10] {
        let [left, stability, n1, n2, v1, v2, ..] = self.ends(progress, false);
        let [l1, l2] = self.lacks_after(progress, progress.gone());
        let lacks = |(value, memory): (R, R)| {
            let rounding = R::of_sums(memory);
            remembers.then_some(Level {
                value,
                slope: R::ZERO,
                rounding,
            })
        };
        let [s1, s2] = self.trammel.sense.signs;
        let rounding = self.trammel.sense.rounding.max(R::of_sums(R::ONE));
        let falls = |of| level(of, R::ONE, rounding);
        let by_sign = |of: Option<Sloped<R>>| of.map(|of| falls(value_of(of)));
        let goes = |of: Sloped<R>, sign| level(of, sign, R::standstill());
        [
            left.map(falls),
            by_sign(stability),
            n1.map(falls),
            n2.map(falls),
            v1.map(|v| goes(v, s1)),
            v2.map(|v| goes(v, s2)),
            lacks(l1),
            lacks(l2),
            course.ahead(spot, 0),
            course.ahead(spot, 1),
        ]
    }
}
