//! The second harmonic of a moment: the contribution of a sliding foot to the balance of a pinned one (STATICS 3.6). A sticking foot does
//! not move while the body turns, so it has none: the type makes sure that nothing of it is compiled.

use crate::geometry::Vec2;
use crate::real::Real;
use core::fmt::Debug;

/// The second harmonic of a moment, -(1 - cos 2ϑ) P - sin 2ϑ Q in addition to the first one: what (E11) adds to H. Every verb adds its
/// share to that of the first harmonic; `turn` is (cos ϑ, sin ϑ).
pub(crate) trait SecondHarmonic<R: Real>: Copy + Debug + PartialEq {
    /// The harmonic of a foot that stays.
    const NONE: Self;

    /// The harmonic of a sliding foot, with the lever (along, off) the surface and the reaction on an edge of the friction cone at (cos lambda, sign sin
    /// lambda) from the normal.
    fn sliding(lever: (R, R), edge: (R, R)) -> Self;
    /// The moment at ϑ = 0.
    fn moment(self, first: R) -> R;
    /// -dM/dϑ at ϑ = 0.
    fn stability(self, first: R) -> R;
    /// -d²M/dϑ² at ϑ = 0.
    fn stiffening(self, first: R) -> R;
    /// `first` less the decrease of the moment up to ϑ, with `times` in place of one of its two factors sin ϑ.
    fn falls(self, first: R, times: R, turn: (R, R)) -> R;
    /// `first` plus that decrease.
    fn rises(self, first: R, times: R, turn: (R, R)) -> R;
    /// Its derivative with respect to ϑ.
    fn slope(self, first: R, turn: (R, R)) -> R;
    /// Its second derivative.
    fn second(self, first: R, turn: (R, R)) -> R;
    /// A bound of its derivative of an order, from that of the first harmonic; for order 0, half of its decrease.
    fn bound(self, first: R, order: u8) -> R;
    /// In other units of moment.
    fn in_units(self, unit: R) -> Self;
    /// The same multiplied by `k`.
    fn times(self, k: R) -> Self;
}

/// The point stays: there is no second harmonic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pinned;

impl<R: Real> SecondHarmonic<R> for Pinned {
    const NONE: Self = Self;

    fn sliding(_: (R, R), _: (R, R)) -> Self {
        Self
    }
    fn moment(self, first: R) -> R {
        first
    }
    fn stability(self, first: R) -> R {
        first
    }
    fn stiffening(self, first: R) -> R {
        first
    }
    fn falls(self, first: R, _: R, _: (R, R)) -> R {
        first
    }
    fn rises(self, first: R, _: R, _: (R, R)) -> R {
        first
    }
    fn slope(self, first: R, _: (R, R)) -> R {
        first
    }
    fn second(self, first: R, _: (R, R)) -> R {
        first
    }
    fn bound(self, first: R, _: u8) -> R {
        first
    }
    fn in_units(self, _: R) -> Self {
        Self
    }
    fn times(self, _: R) -> Self {
        Self
    }
}

/// The foot slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sliding<R> {
    /// (Q, P)
    second: Vec2<R>,
}

impl<R: Real> Sliding<R> {
    /// (1 - cos 2ϑ) P + sin 2ϑ Q over 2 sin ϑ.
    fn rise(self, (cosine, sine): (R, R)) -> R {
        R::sum_of_products(sine, self.second.y, cosine, self.second.x)
    }
}

impl<R: Real> SecondHarmonic<R> for Sliding<R> {
    const NONE: Self = Self { second: Vec2::ZERO };

    fn sliding((along, off): (R, R), (cos, sin): (R, R)) -> Self {
        let smooth = Vec2::new(
            R::difference_of_products(along, along, off, off).halved(),
            -(along * off),
        );
        Self {
            second: smooth * cos + smooth.turned() * sin,
        }
    }
    fn moment(self, first: R) -> R {
        first + self.second.y
    }
    fn stability(self, first: R) -> R {
        first + self.second.x.doubled()
    }
    fn stiffening(self, first: R) -> R {
        first + self.second.y.doubled().doubled()
    }
    fn falls(self, first: R, times: R, turn: (R, R)) -> R {
        first - (times * self.rise(turn)).doubled()
    }
    fn rises(self, first: R, times: R, turn: (R, R)) -> R {
        first + (times * self.rise(turn)).doubled()
    }
    fn slope(self, first: R, (cosine, sine): (R, R)) -> R {
        let across = R::difference_of_products(cosine, self.second.y, sine, self.second.x);
        first + (self.second.x + (sine * across).doubled()).doubled()
    }
    fn second(self, first: R, turn: (R, R)) -> R {
        let (_, sine) = turn;
        let level = self.second.y - (sine * self.rise(turn)).doubled();
        first + level.doubled().doubled()
    }
    fn bound(self, first: R, order: u8) -> R {
        first + (0..order).fold(self.second.length_bound(), |bound, _| bound.doubled())
    }
    fn in_units(self, unit: R) -> Self {
        Self {
            second: self.second.in_units(unit),
        }
    }
    fn times(self, k: R) -> Self {
        Self {
            second: self.second * k,
        }
    }
}
