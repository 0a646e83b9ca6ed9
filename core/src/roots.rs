//! The first zero of functions that start positive, guaranteed (STATICS 3.2): from the value, the slope and a bound
//! of the curvature follows a step that never passes a zero and converges quadratically at a simple one.

use crate::geometry::Vec2;
use crate::motion::Bend;
use crate::real::Real;

/// Every search ends after this many steps. A simple zero takes 3 to 9; past the place of a double root, which the
/// search may not jump, the steps first halve and then double again.
const MAX_STEPS: usize = 256;

/// A function at one place: its value E, its slope, a bound of |E''| from here on, and the rounding of E.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope<R> {
    pub(crate) value: R,
    pub(crate) slope: R,
    pub(crate) curvature: R,
    pub(crate) rounding: R,
}

impl<R: Real> Slope<R> {
    /// This and less counts as zero: its rounding, or, where it falls, what its zero is away by a tolerance of x.
    fn closed(&self, tolerance: R) -> R {
        self.rounding.max(-(tolerance * self.slope))
    }

    /// The longest step that cannot pass a zero.
    fn safe_step(&self) -> R {
        let (e, d, k) = (self.value, self.slope, self.curvature);
        if e <= R::ZERO || e <= self.rounding && d >= R::ZERO {
            return R::ZERO;
        }
        let root = R::root_of_products(d, d, k.doubled(), e);
        if d < R::ZERO {
            e.doubled() / (root - d)
        } else if k > R::ZERO {
            (d + root) / k
        } else {
            R::HUGE
        }
    }

    /// True if it has no zero within a step, as its lowest course, which is concave, is positive at both ends: cheaper
    /// than to ask how far it has none.
    fn is_clear_of(&self, step: R) -> bool {
        let fall = (self.curvature * step).halved() - self.slope;
        self.value > self.rounding && self.value - fall * step > self.rounding
    }

    /// After a certified step E is at most K step²; true if twice that, or E itself, counts as zero.
    fn is_closed_by(&self, step: R, tolerance: R) -> bool {
        let closed = self.closed(tolerance);
        self.value <= closed || (self.curvature * step * step).doubled() <= closed
    }

    /// The first step. A function that starts at zero and rises is left at the crest of its bound, d/K.
    fn first_step(&self) -> R {
        if self.value > self.rounding {
            self.safe_step()
        } else if self.slope <= R::ZERO {
            R::ZERO
        } else if self.curvature > R::ZERO {
            self.slope / self.curvature
        } else {
            R::HUGE
        }
    }
}

/// The outcome of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Found<R> {
    /// No zero before the limit; `x` is the last place that was looked at.
    Nothing { x: R },
    /// Function number `which` is the first to become zero, at `x`.
    Zero { x: R, which: usize },
    /// The bound of steps was hit at `x`, up to which there is no zero; `which` is the nearest to one.
    Unsure { x: R, which: usize },
}

/// What a search sees at one place.
pub(crate) struct Look<R, const M: usize> {
    /// One that is left out has no zero within the window.
    pub(crate) functions: [Option<Slope<R>>; M],
    /// The farthest that the next step may go: the curvatures need to hold up to there only.
    pub(crate) window: R,
}

impl<R: Real, const M: usize> Look<R, M> {
    /// With curvatures that hold everywhere.
    pub(crate) fn far(functions: [Slope<R>; M]) -> Self {
        Self {
            functions: functions.map(Some),
            window: R::HUGE,
        }
    }
}

/// The first x in [0, limit) at which one of M functions is zero, to within a tolerance of x. Of two zeros at one place the
/// first listed counts.
pub(crate) fn first_zero<R: Real, const M: usize>(
    (limit, tolerance): (R, R),
    mut look: impl FnMut(R) -> Look<R, M>,
) -> Found<R> {
    let mut x = R::ZERO;
    let mut nearest = 0;
    #[cfg(not(test))]
    let steps = 0..MAX_STEPS;
    #[cfg(test)]
    let steps = crate::fixtures::searches::steps(MAX_STEPS);
    for i in steps {
        let Look { functions, window } = look(x);
        let mut step = window;
        let mut closest = None;
        for (which, function) in functions.iter().enumerate() {
            let Some(function) = function else { continue };
            if function.is_clear_of(step) {
                continue;
            }
            let safe = if i == 0 {
                function.first_step()
            } else {
                function.safe_step()
            };
            if safe < step {
                step = safe;
                closest = Some((which, function));
            }
        }
        if x + step >= limit {
            return Found::Nothing { x };
        }
        if let Some((which, function)) = closest {
            nearest = which;
            let leaves = i == 0 && function.value <= function.rounding && step > R::ZERO;
            if !leaves && (step <= R::rounding(x) || function.is_closed_by(step, tolerance)) {
                return Found::Zero { x: x + step, which };
            }
        }
        x = x + step;
    }
    Found::Unsure { x, which: nearest }
}

/// A turn of a pinned body downhill to balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Downhill<R> {
    /// The turn (rad), positive counter-clockwise.
    pub(crate) turn: R,
    /// The way led over a fold: the moment grew before it fell to zero.
    pub(crate) snapped: bool,
    /// The bound of steps was hit before the balance.
    pub(crate) unsure: bool,
}

/// The moment on a body about a point that is pinned: M(ϑ) = couple - k ϑ + Im(e^{-iϑ} z), (E1) relative to the
/// present angle; or about a foot that glides, which adds a second harmonic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment<R, B> {
    pub(crate) couple: R,
    pub(crate) stiffness: R,
    /// z = conj(lever) load: dot and cross.
    pub(crate) hold: Vec2<R>,
    pub(crate) bend: B,
    /// To be found to within this (rad); 0: as far as the digits go.
    pub(crate) tolerance: R,
}

impl<R: Real, B: Bend<R>> Moment<R, B> {
    /// The moment in the present position.
    pub(crate) fn now(&self) -> R {
        self.bend.moment(self.couple + self.hold.y)
    }

    /// -dM/dϑ: positive where the balance is stable.
    pub(crate) fn stability(&self) -> R {
        self.bend.stability(self.stiffness + self.hold.x)
    }

    /// A bound of |d²M/dϑ²|.
    pub(crate) fn bent(&self) -> R {
        self.bend.bound(self.hold.reach(), 2)
    }

    /// By how much the moment of a soft grip must be multiplied for its stability to have a reciprocal in this number type.
    pub(crate) fn softness(&self) -> R {
        const DOUBLINGS: u8 = 24;
        let mut times = R::ONE;
        let mut firm = self.stability() * R::HUGE;
        for _ in 0..DOUBLINGS {
            if firm <= R::ZERO || firm >= R::from_int(16) {
                break;
            }
            (firm, times) = (firm.doubled(), times.doubled());
        }
        times
    }

    /// The moment `k` times as large.
    pub(crate) fn times(self, k: R) -> Self {
        Self {
            couple: self.couple * k,
            stiffness: self.stiffness * k,
            hold: self.hold * k,
            bend: self.bend.times(k),
            tolerance: self.tolerance,
        }
    }

    /// The number type carries the moments of the load.
    pub(crate) fn is_carried(&self) -> bool {
        self.bend.bound(self.hold.reach(), 1) + self.couple.abs() <= R::LOAD
    }

    /// The turn that takes the rounding out of a balance; none next to a fold, where Newton's step is not certain to lead
    /// to this balance (the condition of Kantorovich).
    pub(crate) fn polish(&self) -> R {
        let (moment, stability) = (self.now(), self.stability());
        let bend = (self.bent() * moment.abs()).doubled().doubled();
        if stability <= R::ZERO || bend >= stability * stability {
            return R::ZERO;
        }
        let per_stability = R::ONE / stability;
        if per_stability < R::HUGE {
            self.correction(per_stability)
        } else {
            // Too soft for a reciprocal in this number type.
            moment / stability
        }
    }

    /// The turn to balance, but for the third order in it, from 1 over the stability.
    pub(crate) fn correction(&self, per_stability: R) -> R {
        let turn = self.now() * per_stability;
        turn - (turn * turn).halved() * (self.bend.bow(self.hold.y) * per_stability)
    }

    /// The first stable balance downhill in energy: the first zero of the moment in the direction of its sign.
    pub(crate) fn downhill(&self) -> Downhill<R> {
        let direction = self.now().sign();
        self.search(direction, R::ZERO)
    }

    /// The same from a fold, where moment and slope are zero and the moment grows with the curvature ahead.
    pub(crate) fn over_fold(&self, direction: R) -> Downhill<R> {
        let size = self.bend.bound(self.hold.length(), 3);
        let ahead = -direction * self.bend.bow(self.hold.y);
        let clear = if ahead > R::ZERO {
            (R::ONE + R::HALF) * ahead / size
        } else {
            R::ZERO
        };
        let mut found = self.search(direction, clear);
        found.snapped = true;
        found
    }

    /// In units of about the largest of moment, load and stiffness.
    fn scaled(&self) -> Self {
        let load = self.bend.bound(self.hold.reach(), 1);
        let size = load.max(self.now().abs()).max(self.stiffness);
        if size == R::ZERO {
            return *self;
        }
        let unit = size.unit();
        Self {
            couple: self.couple.in_units(unit),
            stiffness: self.stiffness.in_units(unit),
            hold: self.hold.in_units(unit),
            bend: self.bend.in_units(unit),
            tolerance: self.tolerance,
        }
    }

    fn search(&self, direction: R, start: R) -> Downhill<R> {
        self.scaled().search_from(direction, start)
    }

    fn search_from(&self, direction: R, start: R) -> Downhill<R> {
        let size = self.bend.bound(self.hold.reach(), 1);
        let rounding = R::rounding(size + self.couple.abs());
        let bent = self.bent();
        let moment = self.now().abs();
        // Before this angle the springs' couple alone outweighs the load.
        let certain = if self.stiffness > R::ZERO {
            (moment - size.doubled()) / self.stiffness
        } else {
            R::ZERO
        };
        let start = start.max(certain);
        let mut snapped = false;
        let found = first_zero((R::HUGE, self.tolerance), |y| {
            let turn = direction * (start + y);
            let (half_sin, half_cos) = turn.halved().sin_cos();
            let versine = (half_sin * half_sin).doubled();
            let (sin, cos) = ((half_sin * half_cos).doubled(), R::ONE - versine);
            let first =
                self.now() - self.stiffness * turn - versine * self.hold.y - sin * self.hold.x;
            let value = direction * self.bend.falls(first, sin, (cos, sin));
            let first = self.stiffness + cos * self.hold.x + sin * self.hold.y;
            let slope = -self.bend.slope(first, (cos, sin));
            snapped |= slope > R::ZERO && value > rounding;
            Look::far([Slope {
                value,
                slope,
                curvature: bent,
                rounding,
            }])
        });
        let (x, unsure) = match found {
            Found::Zero { x, .. } => (x, false),
            Found::Unsure { x, .. } | Found::Nothing { x } => (x, true),
        };
        Downhill {
            turn: direction * (start + x),
            snapped,
            unsure,
        }
    }
}

#[cfg(test)]
mod tests;
