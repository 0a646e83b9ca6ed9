//! Two contacts that slide with the hand (STATICS 5): the trammel motion in balance at mu_d. (E6) is linear in the displacement of the
//! hand, so that the fraction tau of it that is done is explicit, tau(x) = -E(x, 0) / [E(x, 1) - E(x, 0)].

use super::kinematics::{Kinematics, Wrench};
use super::{MOST_FOR_TOUCH, MOST_LOOKS, Run, Trammel};
use crate::balance_curve::Extent;
use crate::bounded::{Bounded, Quantity, QuantityVec, Sloped};
use crate::contact::Pair;
use crate::detect::{Moving, PointPath};
use crate::geometry::Vec2;
use crate::grip::Displacement;
use crate::real::Real;
use crate::search::{Found, Looks, Samples, first_zero};
use crate::thresholds::Thresholds;
use crate::world::World;

/// The cost of computing the trammel of a slide with the hand and the bounds of its motion, in units of work.
pub(crate) const SLIDE: u32 = 49;

/// The cost of evaluating two contacts that slide with the hand, in evaluations of the motion of one.
pub(crate) const LOOK: u32 = 13;

/// The maximum number of evaluations of a run in addition to those of its search.
pub(super) const MOST_OF_OTHERS: u32 = 3;

/// The maximum cost of a run without its own evaluations, in units of work.
pub(crate) const MOST_OF_SLIDE: u32 = SLIDE
    + LOOK * (MOST_LOOKS as u32 + MOST_OF_OTHERS)
    + MOST_FOR_TOUCH as u32
    + Looks::MOST_BESIDE as u32;

/// What ended a slide with the hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SlideEnding<R> {
    /// The end of the displacement.
    Arrives,
    /// The end of the range in which the bounds hold.
    Window,
    /// A contact comes to a halt: both stick.
    Halts,
    /// The balance folds: the contacts slip on.
    Folds,
    /// A slip that began here would be as long as the memory length: both stick, with stiction.
    Pressed,
    /// The reaction of one contact fell to zero; contact `lasts` slides on along sign·t.
    Opens { lasts: usize, sliding: R },
    /// A further vertex reached a surface.
    Touches(Pair),
    /// Contact number `contact`, which slides along sign·t, has left its side.
    Off { contact: usize, sign: R },
}

/// The factor by which memory lengths, and what is compared with them, are multiplied: on their own they have few digits.
pub(super) fn per_memory<R: Real>() -> R {
    R::from_int(32)
}

/// A trammel motion that follows a displacement of the hand.
pub(crate) struct Slides<R> {
    pub(super) trammel: Trammel<R>,
    pub(super) displaced: Displaced<R>,
    /// The unit of the fraction of the displacement that is done is 1 over this.
    unit: R,
    /// The velocity of a contact, times the stability, below which it rests (rule 7).
    slack: R,
    /// The slide before any of the displacement is done, with its bounds within the longest window.
    pub(super) start: Progress<Bounded<R>>,
}

/// What the displacement adds to the load.
#[derive(Clone, Copy)]
pub(super) struct Displaced<R> {
    /// dp and k dphi, in the same units as the load and per unit of the displacement.
    pub(super) force: Vec2<R>,
    pub(super) couple: R,
    /// The factor by which its changes of E and N_i are multiplied: products of them with others then lose fewer digits. A power of two.
    pub(super) gain: R,
}

/// The slide at a position x.
#[derive(Clone, Copy)]
pub(super) struct Progress<Q> {
    /// E(x, 0) and [E(x, 1) - E(x, 0)] / unit, in the sense in which E falls as the contacts slide.
    rest: Q,
    pub(super) drive: Q,
    /// Their derivatives with respect to x.
    rest_slope: Q,
    drive_slope: Q,
    /// The same for N_1 and N_2 as for E, times the scale.
    normals: [[Q; 2]; 2],
    pub(super) velocities: [Q; 2],
    /// The contribution to E of a friction along the slide at each contact.
    frictions: [Q; 2],
    /// The size of f_1×f_2 if that is large, so that the force alone determines the N_i; otherwise that of the resistance.
    scale: Q,
}

/// The load at a position, what the displacement adds to it, and the rates of change of (E6) of each along x at the frozen hand.
pub(super) struct Loads<Q> {
    pub(super) load: Wrench<Q>,
    pub(super) added: Wrench<Q>,
    pub(super) slopes: [Q; 2],
}

/// The stability -dE/dx at the frozen hand, and N_i times the scale; both times a common factor.
pub(super) struct Standing<Q> {
    stability: Q,
    normals: [Q; 2],
}

impl<Q> Progress<Q> {
    /// At a position of a motion, with bounds that cover only a window from there. Compiled once per image for each kind.
    #[inline(never)]
    fn at<R: Real>(trammel: &Trammel<R>, displaced: &Displaced<R>, (x, window): (R, R)) -> Self
    where
        Q: Quantity<R>,
    {
        let p = trammel.sense.curve.at(x);
        let place: Kinematics<Q> = trammel.kinematics(&p, window);
        let rate: Q = trammel.sense.curve.rate_as();
        let swing = trammel.swing(&p);
        let load = trammel.load_at(&p, window);
        let before_slope = place.slope(swing, load, trammel.load_slope_at(&p, window));
        let force = QuantityVec::constant(displaced.force);
        let of = |lever: Vec2<R>| trammel.rotated(&p, lever).cross(force);
        let lever = trammel.load.lever;
        let couple = Q::constant(displaced.couple);
        let added = (force, couple + of(lever));
        let added_slope = (QuantityVec::constant(Vec2::ZERO), of(lever.turned()) * rate);
        let change_slope = place.slope(swing, added, added_slope);
        let loads = Loads {
            load,
            added,
            slopes: [before_slope, change_slope],
        };
        Self::of(trammel, &place, &loads, (displaced.gain, window))
    }

    /// From a position and the loads there.
    pub(super) fn of<R: Real>(
        trammel: &Trammel<R>,
        place: &Kinematics<Q>,
        loads: &Loads<Q>,
        (gain, window): (R, R),
    ) -> Self
    where
        Q: Quantity<R>,
    {
        let &Loads {
            load,
            added,
            slopes: [before_slope, change_slope],
        } = loads;
        let (scale, normals) = if place.spread.value().abs() > R::spread() {
            (
                place.spread,
                [load, added].map(|load| place.balanced_normals(load)),
            )
        } else {
            (
                place.resistance,
                [load, added].map(|load| place.normals(load)),
            )
        };
        let presses = scale.value().sign();
        let sense = trammel.sense.resistance.sign();
        let falling = |quantity: Q| quantity.times(sense).within(window);
        let falling_on = |change: Q| change.times(sense * gain).within(window);
        let [rest, on] = [(normals[0], R::ONE), (normals[1], gain)]
            .map(|(n, gain)| n.map(|n| n.times(presses * gain).within(window)));
        let ([f1, f2], [s1, s2]) = (place.frictions, trammel.sense.signs);
        Self {
            rest: falling(place.imbalance(load)),
            drive: falling_on(place.imbalance(added)),
            rest_slope: falling(before_slope),
            drive_slope: falling_on(change_slope),
            normals: [[rest[0], on[0]], [rest[1], on[1]]],
            velocities: place.velocities,
            frictions: [f1.times(sense * s1), f2.times(sense * s2)],
            scale: scale.times(presses).within(window),
        }
    }

    /// Multiplies the changes due to the displacement by a factor.
    fn gain_by<R: Real>(&mut self, gain: R)
    where
        Q: Quantity<R>,
    {
        let [[_, first], [_, second]] = &mut self.normals;
        for change in [&mut self.drive, &mut self.drive_slope, first, second] {
            *change = change.times(gain);
        }
    }

    /// tau times the unit.
    pub(super) fn gone<R: Real>(&self) -> R
    where
        Q: Quantity<R>,
    {
        -self.rest.value() / self.drive.value()
    }

    /// The same in numbers whose bounds are known or not.
    pub(super) fn map<P>(self, of: impl Fn(Q) -> P + Copy) -> Progress<P> {
        Progress {
            rest: of(self.rest),
            drive: of(self.drive),
            rest_slope: of(self.rest_slope),
            drive_slope: of(self.drive_slope),
            normals: self.normals.map(|normal| normal.map(of)),
            velocities: self.velocities.map(of),
            frictions: self.frictions.map(of),
            scale: of(self.scale),
        }
    }

    /// Before any of the displacement is done.
    pub(super) fn begin<R: Real>(&self) -> Standing<Q>
    where
        Q: Quantity<R>,
    {
        Standing {
            stability: -self.rest_slope,
            normals: self.normals.map(|[rest, _]| rest),
        }
    }

    /// In balance, times the drive: quantities that are linear in tau are so without a quotient.
    fn balanced<R: Real>(&self) -> Standing<Q>
    where
        Q: Quantity<R>,
    {
        Standing {
            stability: self.rest * self.drive_slope - self.drive * self.rest_slope,
            normals: (self.normals).map(|[rest, drive]| rest * self.drive - drive * self.rest),
        }
    }
}

impl<R: Real> Progress<Bounded<R>> {
    /// The factor by which the displacement may be multiplied: its changes up to one at first, and their bounds up to eight.
    fn gain(&self) -> R {
        let [[_, first], [_, second]] = self.normals;
        let sizes = [self.drive, self.drive_slope, first, second].map(|change| {
            let bound = change.bounds.suprema.into_iter().fold(R::ZERO, R::max);
            change.value.abs().max(bound / R::from_int(8))
        });
        let most = R::from_int(64);
        let largest = sizes.into_iter().fold(R::ONE / most, R::max);
        R::ONE / largest.min(R::ONE).unit()
    }
}

impl<R: Real> Slides<R> {
    /// For a trammel whose load is that at the beginning of a displacement.
    pub(crate) fn new(trammel: Trammel<R>, displacement: &Displacement<R>) -> Self {
        Self::from_start(trammel, displacement, |trammel, displaced| {
            Progress::at(trammel, displaced, (R::ZERO, Self::longest_window()))
        })
    }

    /// With the known state of the slide before any of the displacement is done.
    pub(super) fn from_start(
        trammel: Trammel<R>,
        displacement: &Displacement<R>,
        start: impl FnOnce(&Trammel<R>, &Displaced<R>) -> Progress<Bounded<R>>,
    ) -> Self {
        let per_load = trammel.per_load;
        let size = displacement.size();
        let unit = if size > R::ZERO { size.unit() } else { R::ONE };
        let turn = displacement.turn.in_units(unit);
        let displaced = Displaced {
            force: displacement.hand.in_units(unit) * per_load,
            couple: trammel.load.stiffness * turn * per_load,
            gain: R::ONE,
        };
        let mut slides = Self {
            displaced,
            unit,
            slack: R::of_displacement(R::ONE) * per_load,
            start: start(&trammel, &displaced),
            trammel,
        };
        let gain = slides.start.gain();
        slides.start.gain_by(gain);
        slides.displaced.gain = gain;
        slides.unit = unit / gain;
        slides.slack = slides.slack * gain;
        slides
    }

    pub(crate) fn trammel(&self) -> &Trammel<R> {
        &self.trammel
    }

    /// The bounds hold up to here, in units of x.
    fn longest_window() -> R {
        R::HALF.halved().halved()
    }

    fn at(&self, x: R) -> Progress<Sloped<R>> {
        Progress::at(&self.trammel, &self.displaced, (x, R::ZERO))
    }

    /// How much a slip that began there falls short of the memory length of each contact (E14), times stability and scale.
    fn lacks<Q: Quantity<R>>(&self, at: &Progress<Q>, standing: &Standing<Q>) -> [Q; 2] {
        self.slip_lengths(at, standing, |length| length)
            .map(|[memory, slip]| memory - slip)
    }

    /// How much a slip that began at a position, after a fraction of the displacement, falls short of the memory length of each contact,
    /// and the memory length itself; both scaled so that few digits suffice.
    pub(super) fn lacks_after(&self, at: &Progress<Sloped<R>>, part: R) -> [(R, R); 2] {
        let after = |[rest, drive]: [Sloped<R>; 2]| Sloped {
            value: rest.value + drive.value * part,
            slope: R::ZERO,
        };
        let falls = after([at.rest_slope, at.drive_slope]);
        let standing = Standing {
            stability: -falls,
            normals: at.normals.map(after),
        };
        self.slip_lengths(at, &standing, |length| length * per_memory())
            .map(|[memory, slip]| (memory.value - slip.value, memory.value.abs()))
    }

    /// The memory length of each contact, and its displacement in a slip that begins there (E14), both times stability and scale. `counted`
    /// scales the lengths.
    fn slip_lengths<Q: Quantity<R>>(
        &self,
        at: &Progress<Q>,
        standing: &Standing<Q>,
        counted: impl Fn(R) -> R,
    ) -> [[Q; 2]; 2] {
        let [first, second] = self.trammel.surfaces.map(|surface| surface.friction);
        let ([f1, f2], [n1, n2]) = (at.frictions, standing.normals);
        // The value of E if mu_s bore the load at both contacts: perpendicular to the surfaces, not along the edges of the cones.
        let [d1, d2] = [first, second].map(|f| counted(f.drop() * f.sliding_edge(R::ZERO).0));
        let jump = n1 * f1.times(d1) + n2 * f2.times(d2);
        let falls = standing.stability * at.scale;
        let ([v1, v2], [s1, s2]) = (at.velocities, self.trammel.sense.signs);
        [(first, v1, s1), (second, v2, s2)].map(|(friction, velocity, sign)| {
            [
                falls.times(counted(friction.memory())),
                velocity.times(sign) * jump,
            ]
        })
    }

    /// Returns whether mu_s > mu_d at one of the contacts.
    pub(super) fn has_stiction(&self) -> bool {
        let [f1, f2] = self.trammel.surfaces.map(|surface| surface.friction);
        f1.threshold() < R::HUGE || f2.threshold() < R::HUGE
    }

    /// Returns whether a slip that began here would be as long as the memory length of a contact.
    pub(super) fn is_pressed(
        &self,
        at: &Progress<Bounded<R>>,
        standing: &Standing<Bounded<R>>,
    ) -> bool {
        let mut lacks = self.lacks(at, standing).into_iter();
        self.has_stiction() && lacks.any(|lacks| lacks.value <= R::ZERO)
    }

    /// Returns whether the slide would move back as the hand goes on (rule 7), or its balance lies behind even where the hand ends, as for
    /// a body that was seated again: contacts that slid stick there.
    fn recedes(&self, start: &Progress<Bounded<R>>, standing: &Standing<Bounded<R>>) -> bool {
        let [v1, v2] = start.velocities.map(|v| v.value.abs());
        let left = start.rest + start.drive.times(self.unit);
        start.drive.value * v1.max(v2) < -self.slack * standing.stability.value
            || left.value < -R::beyond_doubt(left.bounds.error)
    }

    /// How contacts that give way at the edges of their dynamic cones go on (rule 10e): `None` if they do not slide in this manner.
    pub(crate) fn begins(&self) -> Option<SlideEnding<R>> {
        let start = &self.start;
        let standing = start.begin();
        let rounding = self.trammel.sense.rounding;
        let mut normals = standing.normals.iter();
        if normals.any(|normal| normal.value < -rounding) || self.recedes(start, &standing) {
            return None;
        }
        Some(if standing.stability.value <= R::ZERO {
            SlideEnding::Folds
        } else if self.is_pressed(start, &standing) {
            SlideEnding::Pressed
        } else {
            SlideEnding::Arrives
        })
    }

    /// The rates at which the slide advances and those N_i grow that are zero, in tau, each times a positive number; `None` if it is not
    /// stable.
    pub(crate) fn rates(&self) -> Option<(R, [R; 2])> {
        let start = &self.start;
        let is_stable = start.begin().stability.value > R::ZERO;
        let normals = start.balanced().normals.map(|normal| normal.slope);
        is_stable.then_some((start.drive.value, normals))
    }

    /// It is not stable where it begins, or would move back.
    pub(super) fn ends_at_once(&self) -> Option<SlideEnding<R>> {
        let standing = self.start.begin();
        if standing.stability.value <= R::ZERO {
            return Some(SlideEnding::Folds);
        }
        (self.recedes(&self.start, &standing)).then_some(SlideEnding::Halts)
    }

    /// The fraction of the displacement that is done.
    pub(super) fn part_gone(&self, at: &Progress<Sloped<R>>) -> R {
        at.gone().max(R::ZERO).min(self.unit) / self.unit
    }

    /// Follows the hand to the first ending: how far, and the fraction of the displacement that is done.
    #[inline(never)]
    pub(crate) fn run(
        &self,
        scene: &impl World<R>,
        lasting: &[Pair],
    ) -> (Run<R>, R, SlideEnding<R>) {
        let start = &self.start;
        let standing = start.begin();
        if let Some(ending) = self.ends_at_once() {
            let nowhere = Run {
                slide: R::ZERO,
                turn: R::ZERO,
                unsure: false,
                work: SLIDE,
            };
            return (nowhere, R::ZERO, ending);
        }
        let remembers = self.has_stiction() && !self.is_pressed(start, &standing);
        // A drive back by a rounding leaves it where it is.
        let is_driven = start.drive.value > R::ZERO;
        let mut looks = Looks::at_most(MOST_LOOKS);
        let (mut x, mut ending, is_unsure) = if is_driven {
            self.first_ending((self.window(start, &standing), &mut looks), remembers)
        } else {
            (R::ZERO, SlideEnding::Arrives, false)
        };
        let mut arrival = None;
        if let SlideEnding::Arrives = ending {
            let (polished, last) = self.polished(x);
            (x, arrival) = (polished, Some(last));
        }
        let curve = &self.trammel.sense.curve;
        let mut extent = Extent {
            unsure: is_unsure,
            looks: Looks::at_most(MOST_FOR_TOUCH),
            ..curve.extent_to(x)
        };
        let moving = Moving {
            curve,
            path: &PointPath::straight(self.trammel.surfaces[0].tangent),
            lasting,
            left: &[],
        };
        if let Some(pair) = (self.trammel.load.placed).first_touch(scene, &mut extent, &moving) {
            ending = SlideEnding::Touches(pair);
            x = extent.end.x;
        }
        let mut part = R::ONE;
        if ending != SlideEnding::Arrives {
            part = self.part_gone(&self.at(x));
        } else if let Some((opens, at)) = arrival.and_then(|last| self.opens_in_place(&last)) {
            (ending, part) = (opens, at);
        }
        let others = if arrival.is_some() { MOST_OF_OTHERS } else { 1 };
        let run = Run {
            slide: extent.part(),
            turn: extent.end.turn,
            // A slide that reaches the end of its bounds goes on from there.
            unsure: extent.unsure && (ending != SlideEnding::Window || x == R::ZERO),
            work: SLIDE
                .saturating_add((looks.taken().saturating_add(others)).saturating_mul(LOOK))
                .saturating_add(extent.looks.taken()),
        };
        (run, part, ending)
    }

    /// A displacement that hardly drives the slide, as across a slot, may open a contact where the body stands: which, and after which
    /// fraction of it.
    pub(super) fn opens_in_place(&self, at: &Progress<Sloped<R>>) -> Option<(SlideEnding<R>, R)> {
        let [first, second] = at.normals.map(|[rest, drive]| {
            let end = rest.value + drive.value * self.unit;
            (end < -self.trammel.sense.rounding)
                .then(|| (rest.value / (rest.value - end)).max(R::ZERO))
        });
        let [s1, s2] = self.trammel.sense.signs;
        let opens = |lasts, sliding| SlideEnding::Opens { lasts, sliding };
        let of_first = first.map(|part| (opens(1, s2), part));
        let of_second = second.map(|part| (opens(0, s1), part));
        match (of_first, of_second) {
            (Some(first), Some(second)) if second.1 < first.1 => Some(second),
            (first, second) => first.or(second),
        }
    }

    /// Four times the distance at its initial rate, but from 2^-19 to 1/8: over short distances the bounds of products are tight.
    pub(super) fn window(
        &self,
        start: &Progress<Bounded<R>>,
        standing: &Standing<Bounded<R>>,
    ) -> R {
        let longest = Self::longest_window();
        let (goes, stability) = (start.drive.value * self.unit, standing.stability.value);
        let window = if goes.doubled().doubled() < stability * longest {
            (goes / stability).doubled().doubled()
        } else {
            longest
        };
        window.max(R::MICRO)
    }

    /// The functions that are zero where the slide ends: at the end of the displacement, a fold, N_i = 0, a halt of a contact, stiction.
    pub(super) fn ends<Q: Quantity<R>>(&self, at: &Progress<Q>, remembers: bool) -> [Option<Q>; 8] {
        let standing = at.balanced();
        let ([n1, n2], [v1, v2]) = (standing.normals, at.velocities);
        let [s1, s2] = self.trammel.sense.signs.map(|sign| sign != R::ZERO);
        let [l1, l2] = if remembers {
            self.lacks(at, &standing).map(Some)
        } else {
            [None, None]
        };
        [
            Some(at.rest + at.drive.times(self.unit)),
            Some(standing.stability),
            Some(n1),
            Some(n2),
            s1.then_some(v1),
            s2.then_some(v2),
            l1,
            l2,
        ]
    }

    /// The first ending, except a touch, within a window.
    fn first_ending(
        &self,
        (window, looks): (R, &mut Looks),
        remembers: bool,
    ) -> (R, SlideEnding<R>, bool) {
        let [s1, s2] = self.trammel.sense.signs;
        let bounds = self
            .ends(&self.start, remembers)
            .map(|end| end.map(|end| end.bounds));
        let signs = [R::ONE, R::ONE, R::ONE, R::ONE, s1, s2, R::ONE, R::ONE];
        let found = first_zero(window, looks, |x| {
            let mut sides = signs.iter().zip(&bounds);
            let functions = self.ends(&self.at(x), remembers).map(|end| {
                let (&sign, bounds) = sides.next()?;
                Some(end?.as_slope(sign, bounds.as_ref()?))
            });
            Samples {
                functions,
                window: R::HUGE,
            }
        });
        match found {
            Found::Nothing { .. } => (window, SlideEnding::Window, false),
            Found::Unsure { x, .. } => (x, SlideEnding::Window, true),
            Found::Zero { x, which } => (x, self.ending(which), false),
        }
    }

    /// The ending of a slide for the function that became zero, in the order of [`Self::ends`].
    pub(super) fn ending(&self, which: usize) -> SlideEnding<R> {
        let [s1, s2] = self.trammel.sense.signs;
        let opens = |lasts, sliding| SlideEnding::Opens { lasts, sliding };
        match which {
            0 => SlideEnding::Arrives,
            1 => SlideEnding::Folds,
            2 => opens(1, s2),
            3 => opens(0, s1),
            4 | 5 => SlideEnding::Halts,
            8 => SlideEnding::Off {
                contact: 0,
                sign: s1,
            },
            9 => SlideEnding::Off {
                contact: 1,
                sign: s2,
            },
            _ => SlideEnding::Pressed,
        }
    }

    /// A position at which almost the whole displacement is done, without the rounding of the search, and the slide next to it.
    fn polished(&self, x: R) -> (R, Progress<Sloped<R>>) {
        let x = self.nearer(x, &self.at(x));
        let at = self.at(x);
        (self.nearer(x, &at), at)
    }

    /// Closer to where the whole displacement is done.
    pub(super) fn nearer(&self, x: R, at: &Progress<Sloped<R>>) -> R {
        let left = at.rest + at.drive.times(self.unit);
        if left.slope < R::ZERO {
            (x - left.value / left.slope).max(R::ZERO)
        } else {
            x
        }
    }
}

#[cfg(test)]
mod tests;
