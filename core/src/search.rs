//! The first zero of functions that start positive, guaranteed (STATICS 3.2): the value, the slope and a bound of the curvature give a step
//! that never passes a zero and converges quadratically to a simple one.

use crate::real::Real;

/// The remaining evaluations of a motion for the searches for its end, which share them. A simple zero takes 3 to 9; past the point of a
/// double root, which a search may not jump over, the steps first halve and then double again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Looks {
    most: u8,
    left: u8,
    /// Other work for the searches, in units of work.
    beside: u16,
}

impl Looks {
    /// The maximum number of evaluations for the motion of a single contact, or of none.
    pub(crate) const MOST: u8 = 64;
    /// Every search has this many of its own, so that all of them get away from where they begin.
    const OWN: u8 = 4;
    /// Other work is counted up to this much.
    pub(crate) const MOST_BESIDE: u16 = 32;
    /// For a motion of that kind that has not been evaluated yet.
    pub(crate) const ALL: Self = Self::at_most(Self::MOST);

    pub(crate) const fn at_most(most: u8) -> Self {
        Self {
            most,
            left: most,
            beside: 0,
        }
    }

    /// Takes one more for a search that has already taken `own`, if there is one.
    fn take(&mut self, own: u8) -> bool {
        if self.left > 0 {
            self.left = self.left.saturating_sub(1);
        } else if own < Self::OWN {
            self.most = self.most.saturating_add(1);
        } else {
            return false;
        }
        true
    }

    /// Counts other work that takes as long as this many evaluations.
    pub(crate) fn add(&mut self, units: u16) {
        self.beside = self.beside.saturating_add(units).min(Self::MOST_BESIDE);
    }

    /// Counts the work of examining obstacles, in units of work, however many.
    pub(crate) fn add_among(&mut self, units: u32) {
        let units = u16::try_from(units).unwrap_or(u16::MAX);
        self.beside = self.beside.saturating_add(units);
    }

    /// The number of evaluations taken, including other work.
    pub(crate) fn taken(self) -> u32 {
        u32::from(self.most.saturating_sub(self.left)).saturating_add(u32::from(self.beside))
    }
}

/// A function at one point: its value E, its slope, a bound of |E''| from here on, and the rounding of E.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope<R> {
    pub(crate) value: R,
    pub(crate) slope: R,
    pub(crate) curvature: R,
    pub(crate) rounding: R,
}

impl<R: Real> Slope<R> {
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

    /// True if it has no zero within a step, because its lowest possible curve, a parabola, which is concave, is positive at both ends:
    /// cheaper than computing the distance without a zero.
    fn is_clear_of(&self, step: R) -> bool {
        let fall = (self.curvature * step).halved() - self.slope;
        self.value > self.rounding && self.value - fall * step > self.rounding
    }

    /// After a certified step E is at most K step²; true if twice that, or E itself, counts as zero.
    fn is_closed_by(&self, step: R) -> bool {
        self.value <= self.rounding || (self.curvature * step * step).doubled() <= self.rounding
    }

    /// The first step. A function that starts at zero and rises is stepped to the crest of its bound, d/K.
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
    /// No zero before the limit; `x` is the last point that was evaluated.
    Nothing { x: R },
    /// Function number `which` is the first to become zero, at `x`.
    Zero { x: R, which: usize },
    /// No evaluation was left at `x`, up to which there is no zero; `which` is the closest to one.
    Unsure { x: R, which: usize },
}

/// The functions of a search at one point.
pub(crate) struct Samples<R, const M: usize> {
    /// A function that is `None` has no zero within the window.
    pub(crate) functions: [Option<Slope<R>>; M],
    /// The farthest that the next step may go: the curvatures need only hold up to there.
    pub(crate) window: R,
}

impl<R: Real, const M: usize> Samples<R, M> {
    /// With curvatures that hold everywhere.
    pub(crate) fn far(functions: [Slope<R>; M]) -> Self {
        Self {
            functions: functions.map(Some),
            window: R::HUGE,
        }
    }
}

/// The first x in [0, limit) at which one of M functions is zero. Of two zeros at one point the first in the list counts.
pub(crate) fn first_zero<R: Real, const M: usize>(
    limit: R,
    looks: &mut Looks,
    mut sample: impl FnMut(R) -> Samples<R, M>,
) -> Found<R> {
    let mut x = R::ZERO;
    let mut nearest = 0;
    #[cfg(test)]
    let mut search = crate::fixtures::searches::begin();
    let mut own = 0;
    while looks.take(own) {
        #[cfg(test)]
        if !search.goes_on() {
            break;
        }
        let Samples { functions, window } = sample(x);
        let mut step = window;
        let mut closest = None;
        for (which, function) in functions.iter().enumerate() {
            let Some(function) = function else { continue };
            if function.is_clear_of(step) {
                continue;
            }
            let safe = if own == 0 {
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
            let leaves = own == 0 && function.value <= function.rounding && step > R::ZERO;
            if !leaves && (step <= R::rounding(x) || function.is_closed_by(step)) {
                return Found::Zero { x: x + step, which };
            }
        }
        x = x + step;
        own = own.saturating_add(1);
    }
    #[cfg(test)]
    search.gives_up();
    Found::Unsure { x, which: nearest }
}

#[cfg(test)]
mod tests;
