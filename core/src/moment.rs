//! The moment on a body about a contact as a function of its turn, with the second harmonic of a gliding foot (STATICS 3.1, 3.6): its
//! stability, the correction of a balance, the first stable balance downhill.

use crate::geometry::Vec2;
use crate::real::Real;
use crate::search::{Found, Looks, Samples, Slope, first_zero};

mod second_harmonic;

pub(crate) use second_harmonic::{Pinned, SecondHarmonic, Sliding};

/// A turn of a pinned body downhill to balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Downhill<R> {
    /// The turn (rad), positive counter-clockwise.
    pub(crate) turn: R,
    /// The turn passed over a fold: the moment grew before it fell to zero.
    pub(crate) snapped: bool,
    /// No evaluation was left before the balance was reached.
    pub(crate) unsure: bool,
    /// The evaluations that its search did not use.
    pub(crate) looks: Looks,
}

/// The moment on a body about a pinned point: M(ϑ) = couple - k ϑ + Im(e^{-iϑ} z), (E1) relative to the present angle; or about a gliding
/// foot, which adds a second harmonic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment<R, H> {
    pub(crate) couple: R,
    pub(crate) stiffness: R,
    /// z = conj(lever) load: dot and cross.
    pub(crate) hold: Vec2<R>,
    pub(crate) harmonic: H,
}

/// The change of a moment over a whole displacement of the hand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drive<R> {
    /// k dphi
    pub(crate) couple: R,
    /// zp = Yp + iXp as (Yp, Xp).
    pub(crate) hold: Vec2<R>,
}

impl<R: Real> Drive<R> {
    /// Its value in the present position, D(0).
    pub(crate) fn now(&self) -> R {
        self.couple + self.hold.y
    }

    /// The drive multiplied by `k`.
    pub(crate) fn times(&self, k: R) -> Self {
        Self {
            couple: self.couple * k,
            hold: self.hold * k,
        }
    }
}

impl<R: Real, H: SecondHarmonic<R>> Moment<R, H> {
    /// The moment in the present position.
    pub(crate) fn now(&self) -> R {
        self.harmonic.moment(self.couple + self.hold.y)
    }

    /// -dM/dϑ: positive where the balance is stable.
    pub(crate) fn stability(&self) -> R {
        self.harmonic.stability(self.stiffness + self.hold.x)
    }

    /// A bound of |d²M/dϑ²|.
    pub(crate) fn curvature_bound(&self) -> R {
        self.harmonic.bound(self.hold.length_bound(), 2)
    }

    /// The factor by which the moment of a soft grip must be multiplied for its stability to have a reciprocal in this number type.
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

    /// The moment multiplied by `k`.
    pub(crate) fn times(self, k: R) -> Self {
        Self {
            couple: self.couple * k,
            stiffness: self.stiffness * k,
            hold: self.hold * k,
            harmonic: self.harmonic.times(k),
        }
    }

    /// The turn that removes the rounding from a balance; zero near a fold, where Newton's step is not certain to lead to this balance (the
    /// condition of Kantorovich).
    pub(crate) fn polish(&self) -> R {
        let (moment, stability) = (self.now(), self.stability());
        let kantorovich = (self.curvature_bound() * moment.abs()).doubled().doubled();
        if stability <= R::ZERO || kantorovich >= stability * stability {
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

    /// The turn to balance up to its third order, from 1 over the stability.
    pub(crate) fn correction(&self, per_stability: R) -> R {
        let turn = self.now() * per_stability;
        turn - (turn * turn).halved() * (self.harmonic.stiffening(self.hold.y) * per_stability)
    }

    /// The first stable balance downhill in energy: the first zero of the moment in the direction of its sign.
    pub(crate) fn downhill(&self) -> Downhill<R> {
        let direction = self.now().sign();
        self.search(direction, R::ZERO)
    }

    /// The same from a fold, where moment and slope are zero and the moment grows with the curvature ahead.
    pub(crate) fn over_fold(&self, direction: R) -> Downhill<R> {
        let size = self.harmonic.bound(self.hold.length(), 3);
        let ahead = -direction * self.harmonic.stiffening(self.hold.y);
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
        let pull = self.harmonic.bound(self.hold.length_bound(), 1);
        let size = pull.max(self.now().abs()).max(self.stiffness);
        if size == R::ZERO {
            return *self;
        }
        let unit = size.unit();
        Self {
            couple: self.couple.in_units(unit),
            stiffness: self.stiffness.in_units(unit),
            hold: self.hold.in_units(unit),
            harmonic: self.harmonic.in_units(unit),
        }
    }

    fn search(&self, direction: R, start: R) -> Downhill<R> {
        self.scaled().search_from(direction, start)
    }

    /// The first zero of the moment beyond a turn of `start` (rad) in the direction of its sign, by certified steps (STATICS 3.1);
    /// `snapped` if the moment grew on the way there.
    fn search_from(&self, direction: R, start: R) -> Downhill<R> {
        let size = self.harmonic.bound(self.hold.length_bound(), 1);
        let rounding = R::rounding(size + self.couple.abs());
        let curvature = self.curvature_bound();
        let moment = self.now().abs();
        // Before this angle the springs' couple alone outweighs the load.
        let certain = if self.stiffness > R::ZERO {
            (moment - size.doubled()) / self.stiffness
        } else {
            R::ZERO
        };
        let start = start.max(certain);
        let mut snapped = false;
        let mut looks = Looks::ALL;
        let found = first_zero(R::HUGE, &mut looks, |y| {
            let turn = direction * (start + y);
            let (half_sin, half_cos) = turn.halved().sin_cos();
            let versine = (half_sin * half_sin).doubled();
            let (sin, cos) = ((half_sin * half_cos).doubled(), R::ONE - versine);
            let first =
                self.now() - self.stiffness * turn - versine * self.hold.y - sin * self.hold.x;
            let value = direction * self.harmonic.falls(first, sin, (cos, sin));
            let first = self.stiffness + cos * self.hold.x + sin * self.hold.y;
            let slope = -self.harmonic.slope(first, (cos, sin));
            snapped |= slope > R::ZERO && value > rounding;
            Samples::far([Slope {
                value,
                slope,
                curvature,
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
            looks,
        }
    }
}

#[cfg(test)]
mod tests;
