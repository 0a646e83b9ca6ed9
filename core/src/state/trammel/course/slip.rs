//! The slip of two contacts among obstacles: along a piece of their motion, the hand frozen, to the first of (E6), N_i = 0, a contact that
//! turns back or leaves its side, and touch.

use super::super::{Demand, Ending, LOOK, RUN, Run};
use super::{Course, SPOT, Spot, sloped};
use crate::bounded::Sloped;
use crate::detect::{Among, Known, Reached, first_reached};
use crate::falls::{Level, MOST_FALLS, first_fall};
use crate::geometry::Vec2;
use crate::pivot::Pivot;
use crate::real::{Real, along};
use crate::search::Found;
use crate::thresholds::Thresholds;
use crate::world::World;
use core::cell::Cell;

/// The end of the growth of (E6) beyond a fold is searched for by halving a piece at most this many times.
const MAX_HALVINGS: usize = 20;

/// A function that falls, measured in a direction.
pub(super) fn level<R: Real>(of: Sloped<R>, sign: R, rounding: R) -> Level<R> {
    Level {
        value: along(sign, of.value),
        slope: along(sign, of.slope),
        rounding,
    }
}

/// The uncertainty of the moment about a contact, in units of the load, if (E6) is known to a rounding.
fn moment_known_to<R: Real>(rounding: R) -> R {
    rounding.max(R::of_sums(R::ONE))
}

/// For a slip: the sign and the rounding of (E6), and which contacts may turn back.
#[derive(Clone, Copy)]
struct Falls<R> {
    sense: R,
    rounding: R,
    turns: [bool; 2],
    /// Both reactions must press throughout.
    presses: bool,
    /// Which contacts are pressed by the moment about the other one.
    pressed: [bool; 2],
}

impl<R: Real, W: World<R>> Course<'_, R, W> {
    /// Slips to the first ending, where a balance before `clear` does not count; returns the new pivot.
    pub(crate) fn slip(
        &self,
        (sense, rounding): (R, R),
        (clear, demand): (R, Demand),
    ) -> (Pivot<R>, Run<R>, Ending<R>) {
        let window = self.longest();
        let [v1, v2] = self.turning();
        let [s1, s2] = self.signs;
        let falls = Falls {
            sense,
            rounding,
            // A contact that has just turned back does not turn again within a piece.
            turns: [(v1, s1), (v2, s2)]
                .map(|(v, sign)| sign != R::ZERO && v.value.abs() > R::standstill()),
            presses: demand == Demand::Pressed,
            pressed: if demand == Demand::AtTheEnd {
                let pressing = self.pressing(&self.spot(R::ZERO));
                pressing.map(|pressing| pressing.value > moment_known_to(rounding))
            } else {
                [false; 2]
            },
        };
        let looks = Cell::new(0_u32);
        let from = |begin: R, end: R| {
            first_fall((end - begin, end - begin), MOST_FALLS, |x| {
                looks.set(looks.get().saturating_add(1));
                let is_asked = begin >= clear;
                self.falls(&self.spot(begin + x), &falls, is_asked)
            })
        };
        let clear = clear.min(window);
        let mut begin = R::ZERO;
        let mut found = Found::Nothing { x: clear };
        if clear > R::ZERO {
            found = from(R::ZERO, clear);
        }
        if let Found::Nothing { .. } = found
            && clear < window
        {
            begin = clear;
            found = from(clear, window);
        }
        let (mut x, mut ending, mut unsure) = match found {
            Found::Nothing { .. } => (window, Ending::Window, false),
            Found::Zero { x, which } => (begin + x, self.ending(which), false),
            Found::Unsure { x, .. } => (begin + x, Ending::Window, true),
        };
        let (reached, searched) = self.reached(x);
        if let Some(reached) = reached {
            x = reached.x;
            unsure = reached.unsure;
            ending = if unsure {
                Ending::Window
            } else {
                Ending::Touches(reached.contact)
            };
        }
        let work = RUN
            .saturating_add(looks.get().saturating_mul(LOOK))
            .saturating_add(searched);
        let (pivot, run) = self.run_to(
            x,
            (unsure && (ending != Ending::Window || x == R::ZERO), work),
        );
        (pivot, run, ending)
    }

    /// What is touched up to a point, and the cost of finding it, in units of work.
    pub(super) fn reached(&self, x: R) -> (Option<Reached<R>>, u32) {
        if x <= R::ZERO {
            return (None, 0);
        }
        let contacts = self.contacts();
        let known = Known {
            watch: self.watch,
            ..Known::of(&contacts)
        };
        let at = |x: R| self.instant(x);
        first_reached(self.scene, (known, Among::All), x, (&at, SPOT))
    }

    /// The result of a run to `x`.
    pub(super) fn run_to(&self, x: R, (unsure, work): (bool, u32)) -> (Pivot<R>, Run<R>) {
        let pivot = self.spot(x).pivot;
        let run = Run {
            slide: pivot.foot - self.pivot.foot,
            turn: (pivot.orientation.angle()).minus(self.pivot.orientation.angle()),
            unsure,
            work,
        };
        (pivot, run)
    }

    /// How strongly the moment about the other contact presses each of them: where that falls to zero it no longer presses any.
    fn pressing(&self, spot: &Spot<R>) -> [Sloped<R>; 2] {
        let (_, [(force, moment), _]) = self.terms(spot, (Vec2::ZERO, R::ZERO));
        let arm = sloped(spot.arm, self.swing(spot));
        let [first, second] = spot.surfaces;
        let [spin1, spin2] = self.spins(spot);
        let lever = |normal: Vec2<R>, spin| arm.cross(sloped(normal, normal.turned() * spin));
        let about_other = moment - arm.cross(force);
        [
            lever(first.normal, spin1) * about_other,
            -(lever(second.normal, spin2) * moment),
        ]
    }

    /// The functions that are zero where the slip ends: (E6) if requested, N_1, N_2, both velocities, the ends of both sides; if reactions
    /// are examined at balance only, what presses each contact.
    fn falls(&self, spot: &Spot<R>, falls: &Falls<R>, is_asked: bool) -> [Option<Level<R>>; 9] {
        let (place, [load, _]) = self.terms(spot, (Vec2::ZERO, R::ZERO));
        let [n1, n2] = place.normals(load);
        let [v1, v2] = place.velocities;
        let [s1, s2] = self.signs;
        let [turns1, turns2] = falls.turns;
        let presses = falls.presses;
        let pressing = (falls.pressed.contains(&true)).then(|| self.pressing(spot));
        let pressed = |index: usize, is_pressed: bool| {
            let pressing = pressing.filter(|_| is_pressed)?;
            let known_to = moment_known_to(falls.rounding);
            Some(level(*pressing.get(index)?, R::ONE, known_to))
        };
        let [pressed1, pressed2] = falls.pressed;
        let drives = |of| level(of, falls.sense, falls.rounding);
        let goes = |of, sign| level(of, sign, R::standstill());
        [
            is_asked.then(|| drives(place.imbalance(load))),
            presses.then(|| drives(n1)),
            presses.then(|| drives(n2)),
            turns1.then(|| goes(v1, s1)),
            turns2.then(|| goes(v2, s2)),
            self.ahead(spot, 0),
            self.ahead(spot, 1),
            pressed(0, pressed1),
            pressed(1, pressed2),
        ]
    }

    /// The ending of a slip for the function that fell to zero, in the order of [`Self::falls`].
    fn ending(&self, which: usize) -> Ending<R> {
        let [s1, s2] = self.signs;
        match which {
            0 => Ending::Stopped,
            1 | 7 => Ending::Opens {
                lasts: 1,
                sliding: s2,
            },
            2 | 8 => Ending::Opens {
                lasts: 0,
                sliding: s1,
            },
            3 | 4 => Ending::Reverses,
            5 => Ending::Off {
                contact: 0,
                sign: s1,
            },
            _ => Ending::Off {
                contact: 1,
                sign: s2,
            },
        }
    }

    /// At a fold of (E6), where it and its slope are zero: it grows up to here.
    pub(crate) fn clear_of_fold(&self, (sense, rounding): (R, R)) -> R {
        let mut clear = self.longest();
        for _ in 0..MAX_HALVINGS {
            let (place, [load, _]) = self.terms(&self.spot(clear), (Vec2::ZERO, R::ZERO));
            let drive = level(place.imbalance(load), sense, rounding);
            if drive.value > rounding && drive.slope > R::ZERO {
                return clear;
            }
            clear = clear.halved();
        }
        R::ZERO
    }
}
