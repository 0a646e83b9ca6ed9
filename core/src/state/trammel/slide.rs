//! Two contacts that slide with the hand (STATICS 5): the trammel motion in balance at mu_d. (E6) is linear in the displacement of
//! the hand, so that the part tau of it that is done is explicit, tau(x) = -E(x, 0) / [E(x, 1) - E(x, 0)].

use super::{Run, Trammel};
use crate::balance_curve::Extent;
use crate::bounded::{Bounded, BoundedVec};
use crate::contact::Pair;
use crate::detect::{Moving, PointPath};
use crate::geometry::Vec2;
use crate::grip::Displacement;
use crate::real::Real;
use crate::search::{Found, Samples, first_zero};
use crate::world::World;

/// What ended a slide with the hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SlideEnding<R> {
    /// The end of the displacement, or of the part of it for which the balance is surely stable.
    Arrives,
    /// The end of the range in which the bounds hold.
    Window,
    /// A contact comes to a halt: both stick.
    Halts,
    /// The balance folds: the contacts slip on.
    Folds,
    /// A slip that began here would be as long as the memory: both stick, with stiction.
    Pressed,
    /// The reaction of one contact fell to zero; contact `lasts` slides on along sign·t.
    Opens { lasts: usize, sliding: R },
    /// A further vertex reached a surface.
    Touches(Pair),
}

/// A trammel motion that follows a displacement of the hand.
pub(crate) struct Slides<R> {
    trammel: Trammel<R>,
    /// dp and k dphi, counted as the load is and in units of the displacement.
    force: Vec2<R>,
    couple: R,
    /// The size of the displacement: what is done of it is counted in 1 over this.
    unit: R,
    /// The velocity of a contact, times the stability, below which it rests (rule 7).
    slack: R,
}

/// The slide at a place x.
struct Progress<R> {
    /// E(x, 0) and [E(x, 1) - E(x, 0)] / unit, in the sense in which E falls as the contacts slide.
    rest: Bounded<R>,
    drive: Bounded<R>,
    /// The same of N_1 and N_2, times the size of the resistance.
    normals: [[Bounded<R>; 2]; 2],
    velocities: [Bounded<R>; 2],
    /// How much of E a friction along the slide is worth at each contact, and the size of the resistance.
    frictions: [R; 2],
    resistance: R,
}

/// What a slide is at a place where its part tau is known.
struct Standing<R> {
    /// -dE/dx at the frozen hand.
    stability: R,
    /// N_i times the size of the resistance.
    normals: [R; 2],
    /// |v_i·t_i|
    speeds: [R; 2],
    frictions: [R; 2],
    resistance: R,
}

impl<R: Real> Progress<R> {
    /// tau times the unit.
    fn gone(&self) -> R {
        -self.rest.value / self.drive.value
    }

    fn standing(&self, gone: R) -> Standing<R> {
        Standing {
            stability: -(self.rest.slope + self.drive.slope * gone),
            normals: self
                .normals
                .map(|[rest, drive]| rest.value + drive.value * gone),
            speeds: self.velocities.map(|v| v.value.abs()),
            frictions: self.frictions,
            resistance: self.resistance,
        }
    }
}

impl<R: Real> Slides<R> {
    /// Of a trammel whose load is that at the beginning of a displacement.
    pub(crate) fn new(trammel: Trammel<R>, displacement: &Displacement<R>) -> Self {
        let per_load = trammel.per_load;
        let size = displacement.size();
        let unit = if size > R::ZERO { size.unit() } else { R::ONE };
        let turn = displacement.turn.in_units(unit);
        Self {
            force: displacement.hand.in_units(unit) * per_load,
            couple: trammel.load.stiffness * turn * per_load,
            unit,
            slack: R::rounding(R::from_int(8)) * per_load,
            trammel,
        }
    }

    fn at(&self, x: R) -> Progress<R> {
        let trammel = &self.trammel;
        let p = trammel.sense.curve.at(x);
        let place = trammel.kinematics(&p);
        let before = place.response(trammel.load_at(&p, R::ONE));
        let force = BoundedVec::constant(self.force);
        let lever = trammel.rotated(&p, trammel.load.lever);
        let moment = Bounded::constant(self.couple) + lever.cross(force);
        let change = place.response((force, moment));
        let sense = trammel.sense.resistance.sign();
        let [first, second] = [0, 1].map(|i| {
            let pick = |normals: [Bounded<R>; 2]| if i == 0 { normals[0] } else { normals[1] };
            [before.normals, change.normals].map(|normals| pick(normals).times(sense))
        });
        Progress {
            rest: before.imbalance.times(sense),
            drive: change.imbalance.times(sense),
            normals: [first, second],
            velocities: place.velocities,
            frictions: [
                place.frictions[0].value * sense * trammel.sense.signs[0],
                place.frictions[1].value * sense * trammel.sense.signs[1],
            ],
            resistance: place.resistance.value.abs(),
        }
    }

    /// Positive where a slip that began at a place would be as long as the memory of a contact (rule 10e): of its length per
    /// memory, times the stability.
    fn excess_length(&self, standing: &Standing<R>) -> R {
        let frictions = self.trammel.surfaces.map(|surface| surface.friction);
        let [v1, v2] = standing.speeds;
        let [f1, f2] = frictions;
        // Across the surfaces, not along the edges of the cones.
        let ([a1, a2], [(cos1, _), (cos2, _)]) =
            (standing.normals, frictions.map(|f| f.sliding_edge(R::ZERO)));
        let [n1, n2] = [a1 * cos1, a2 * cos2];
        let [c1, c2] = standing.frictions;
        // What E would be if mu_s bore the load at both contacts, over how fast it falls.
        let jump = f1.drop() * n1 * c1 + f2.drop() * n2 * c2;
        let resists = standing.stability * standing.resistance;
        (v1 * jump - f1.memory() * resists).max(v2 * jump - f2.memory() * resists)
    }

    /// mu_s > mu_d at one of the contacts.
    fn has_stiction(&self) -> bool {
        let [f1, f2] = self.trammel.surfaces.map(|surface| surface.friction);
        f1.threshold() < R::HUGE || f2.threshold() < R::HUGE
    }

    /// The slide would go back as the hand goes on (rule 7).
    fn recedes(&self, start: &Progress<R>, standing: &Standing<R>) -> bool {
        let [v1, v2] = standing.speeds;
        start.drive.value * v1.max(v2) < -self.slack * standing.stability
    }

    /// How the contacts that give way at the edges of their dynamic cones go on (rule 10e): nothing where they do not slide so.
    pub(crate) fn begins(&self) -> Option<SlideEnding<R>> {
        let start = self.at(R::ZERO);
        let standing = start.standing(R::ZERO);
        let rounding = self.trammel.sense.rounding;
        if standing.normals.iter().any(|&normal| normal < -rounding)
            || self.recedes(&start, &standing)
        {
            return None;
        }
        Some(if standing.stability <= R::ZERO {
            SlideEnding::Folds
        } else if self.has_stiction() && self.excess_length(&standing) >= R::ZERO {
            SlideEnding::Pressed
        } else {
            SlideEnding::Arrives
        })
    }

    /// The rates at which the slide advances and N_i grow, in tau, each times a positive number; nothing where it is not stable.
    pub(crate) fn rates(&self) -> Option<(R, [R; 2])> {
        let start = self.at(R::ZERO);
        let stability = -start.rest.slope;
        let normals = start
            .normals
            .map(|[rest, drive]| rest.slope * start.drive.value + drive.value * stability);
        (stability > R::ZERO).then_some((start.drive.value, normals))
    }

    /// Follows the hand to the first ending: how far, and the part of the displacement that is done.
    pub(crate) fn run(
        &self,
        scene: &impl World<R>,
        lasting: &[Pair],
    ) -> (Run<R>, R, SlideEnding<R>) {
        let nowhere = Run {
            slide: R::ZERO,
            turn: R::ZERO,
            unsure: false,
        };
        let start = self.at(R::ZERO);
        let standing = start.standing(R::ZERO);
        let curvature = start.rest.bounds[2] + start.drive.bounds[2] * self.unit;
        let stability = standing.stability;
        if stability <= R::MICRO * curvature {
            return (nowhere, R::ZERO, SlideEnding::Folds);
        }
        if self.recedes(&start, &standing) {
            return (nowhere, R::ZERO, SlideEnding::Halts);
        }
        // As far as the stability surely stays above a quarter.
        let half = stability.halved();
        let change = start.drive.slope * self.unit;
        let most = if change > half { half / change } else { R::ONE };
        let window = if half.halved() < curvature {
            half.halved() / curvature
        } else {
            R::ONE
        };
        let (mut x, mut ending, unsure) = self.first_ending(window, most);
        if let SlideEnding::Arrives = ending {
            x = self.polished(x, most);
        }
        for (opens, lasts) in [(0, 1), (1, 0)] {
            if let Some(zero) = self.first_opening(&start, (x, most), opens) {
                let [s1, s2] = self.trammel.sense.signs;
                let sliding = if lasts == 0 { s1 } else { s2 };
                (x, ending) = (zero, SlideEnding::Opens { lasts, sliding });
            }
        }
        if self.has_stiction()
            && self.excess_length(&standing) < R::ZERO
            && let Some(pressed) = self.first_pressed(x)
        {
            (x, ending) = (pressed, SlideEnding::Pressed);
        }
        let curve = &self.trammel.sense.curve;
        let mut extent = Extent {
            unsure,
            ..curve.extent_to(x)
        };
        let moving = Moving {
            curve,
            path: &PointPath::straight(self.trammel.surfaces[0].tangent),
            lasting,
        };
        if let Some(pair) = (self.trammel.load.placed).first_touch(scene, &mut extent, &moving) {
            ending = SlideEnding::Touches(pair);
            x = extent.end.x;
        }
        let part = if ending == SlideEnding::Arrives {
            most
        } else {
            let gone = self.at(x).gone().max(R::ZERO);
            (gone.min(self.unit) / self.unit).min(most)
        };
        let run = Run {
            slide: extent.part(),
            turn: extent.end.turn,
            unsure: extent.unsure,
        };
        (run, part, ending)
    }

    /// The first ending but a touch, an opening and stiction on [0, window), the hand going the part `most` of its displacement.
    fn first_ending(&self, window: R, most: R) -> (R, SlideEnding<R>, bool) {
        let signs = self.trammel.sense.signs;
        let found = first_zero(window, |x| {
            let at = self.at(x);
            let arrives = (at.rest + at.drive.times(most * self.unit)).as_slope(R::ONE);
            let never = Bounded::constant(R::ONE).as_slope(R::ONE);
            let halts = |velocity: Bounded<R>, sign: R| {
                if sign == R::ZERO {
                    never
                } else {
                    velocity.as_slope(sign)
                }
            };
            let [h1, h2] = [
                halts(at.velocities[0], signs[0]),
                halts(at.velocities[1], signs[1]),
            ];
            Samples::far([arrives, h1, h2])
        });
        match found {
            Found::Nothing { .. } => (window, SlideEnding::Window, false),
            Found::Unsure { x, .. } => (x, SlideEnding::Window, true),
            Found::Zero { x, which } => {
                let ending = if which == 0 {
                    SlideEnding::Arrives
                } else {
                    SlideEnding::Halts
                };
                (x, ending, false)
            }
        }
    }

    /// Where N_i falls to zero before x: none, if it stays positive whatever part is done there, else the first place in quarters of
    /// the way.
    fn first_opening(&self, start: &Progress<R>, (x, most): (R, R), which: usize) -> Option<R> {
        const QUARTERS: u8 = 4;
        let whole = most * self.unit;
        let of = |normals: [[Bounded<R>; 2]; 2]| if which == 0 { normals[0] } else { normals[1] };
        let [rest, drive] = of(start.normals);
        let least = rest.value.min(rest.value + drive.value * whole);
        if least > x * (rest.bounds[1] + drive.bounds[1] * whole) {
            return None;
        }
        let is_pulled = |x: R| {
            let at = self.at(x);
            let [n1, n2] = at.standing(at.gone().max(R::ZERO).min(whole)).normals;
            (if which == 0 { n1 } else { n2 }) < R::ZERO
        };
        let quarter = x.halved().halved();
        let mut presses = R::ZERO;
        for _ in 0..QUARTERS {
            let ahead = presses + quarter;
            if is_pulled(ahead) {
                return Some(Self::first(is_pulled, presses, ahead));
            }
            presses = ahead;
        }
        None
    }

    /// The first place of a property that holds at the second of two places, by bisection: the last one before it.
    fn first(holds: impl Fn(R) -> bool, mut before: R, mut after: R) -> R {
        const BISECTIONS: usize = 60;
        for _ in 0..BISECTIONS {
            let middle = (before + after).halved();
            if middle <= before || middle >= after {
                break;
            }
            if holds(middle) {
                after = middle;
            } else {
                before = middle;
            }
        }
        before
    }

    /// A place at which the part `most` is all but done, without the rounding of the search.
    fn polished(&self, mut x: R, most: R) -> R {
        for _ in 0..2 {
            let at = self.at(x);
            let value = at.rest.value + at.drive.value * (most * self.unit);
            let slope = at.rest.slope + at.drive.slope * (most * self.unit);
            if slope < R::ZERO {
                x = (x - value / slope).max(R::ZERO);
            }
        }
        x
    }

    /// Where the slip that would begin there becomes as long as the memory, if it is so at x: between 0 and there.
    fn first_pressed(&self, x: R) -> Option<R> {
        let is_pressed = |x: R| {
            let at = self.at(x);
            self.excess_length(&at.standing(at.gone())) >= R::ZERO
        };
        is_pressed(x).then(|| Self::first(is_pressed, R::ZERO, x))
    }
}

#[cfg(test)]
mod tests;
