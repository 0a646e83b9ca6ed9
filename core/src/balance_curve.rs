//! How the body moves while a contact state lasts, as one curve (STATICS 3.3). While the hand covers the fraction tau of its path (or, hand
//! frozen, while the contact slides by the fraction tau), the body turns by ϑ so that the moment about the contact stays zero. That balance
//! is linear in tau (E7), with the second harmonic of a gliding foot as in (E11),
//!
//! ```text
//! H(ϑ) = tau D(ϑ)      H = kϑ + (1 - cos ϑ) X0 + sin ϑ Y0      D = k dphi + cos ϑ Xp - sin ϑ Yp
//! ```
//!
//! with z0 = Y0 + iX0 = conj(lever) load and zp = Yp + iXp = conj(lever) dp, so that tau is explicit in ϑ (STATICS 3.1, 3.2). Both are
//! divided by D(0) and by the rate ϑ = rate·x, which keeps them regular even if the body does not turn: a straight motion, a free one, and
//! a slip of a stiff or centred grip are the same curve. Everything that can end the motion is a [`Margin`].

use crate::detect::{Placed, PointPath};
use crate::geometry::Vec2;
use crate::moment::{Drive, Moment, Pinned, SecondHarmonic};
use crate::motion::Instant;
use crate::real::Real;
use crate::search::{Found, Looks, Samples, Slope, first_zero};

mod bounded;
mod margin;
mod reversal;

pub(crate) use margin::Margin;

/// The curve x -> (tau, ϑ), x >= 0, in units of D(0) / rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BalanceCurve<R, H = Pinned> {
    /// ϑ = rate x
    rate: R,
    /// k
    stiffness: R,
    /// z0 = (Y0, X0)
    hold: Vec2<R>,
    /// zp = (Yp, Xp)
    drive: Vec2<R>,
    /// The second harmonic of H(ϑ).
    harmonic: H,
}

/// A point of the curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<R> {
    /// The parameter.
    pub(crate) x: R,
    /// ϑ (rad)
    pub(crate) turn: R,
    /// 1 - cos ϑ
    versine: R,
    /// sin ϑ
    sine: R,
    /// H / rate and its slope
    h: R,
    h_slope: R,
    /// D / rate and its slope
    d: R,
    d_slope: R,
}

impl<R: Real> Place<R> {
    /// tau = H / D, (E7).
    pub(crate) fn part(&self) -> R {
        self.h / self.d
    }
}

/// The extent of a motion: the point that ends it and the cause.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent<R> {
    pub(crate) end: Place<R>,
    /// |tau| stays below this.
    pub(crate) part_bound: R,
    /// tau only grows.
    pub(crate) rises: bool,
    pub(crate) folds: bool,
    pub(crate) unsure: bool,
    /// The evaluations left to the searches for an end.
    pub(crate) looks: Looks,
}

impl<R: Real> Extent<R> {
    /// tau at the end; however small H and D are there, no more than it can be.
    pub(crate) fn part(&self) -> R {
        let part = self.part_bound.min(self.end.part());
        if self.rises { part.max(R::ZERO) } else { part }
    }
}

impl<R: Real, H: SecondHarmonic<R>> BalanceCurve<R, H> {
    /// Balanced about the contact: the moment with k and z0 of the module's text, and its drive, k dphi and zp.
    pub(crate) fn balanced(moment: &Moment<R, H>, drive: &Drive<R>) -> Self {
        let Moment {
            stiffness,
            hold,
            harmonic,
            ..
        } = *moment;
        let start = drive.now();
        // With a quarter of the largest component neither the distance to the end nor the bounds of the curvatures become large.
        let largest = harmonic
            .bound(stiffness + hold.length_bound(), 1)
            .max(drive.hold.length_bound());
        let size = start.abs().max(largest.halved().halved());
        if size == R::ZERO {
            return Self::straight();
        }
        let unit = size.unit();
        Self {
            rate: start.in_units(unit),
            stiffness: stiffness.in_units(unit),
            hold: hold.in_units(unit),
            drive: drive.hold.in_units(unit),
            harmonic: harmonic.in_units(unit),
        }
    }

    /// No turn: tau = x.
    pub(crate) fn straight() -> Self {
        Self {
            stiffness: R::ONE,
            ..Self::kinematic(R::ZERO, Vec2::ZERO)
        }
    }

    /// A turn by `angle` in proportion to tau, and its extent to tau = 1. Its units of x are few radians, because curvatures grow with the
    /// square of the unit.
    pub(crate) fn turning(angle: R) -> (Self, Extent<R>) {
        let unit = angle.abs().halved().max(R::ONE).unit();
        let curve = Self {
            stiffness: R::ONE.in_units(unit),
            ..Self::kinematic(angle.in_units(unit), Vec2::ZERO)
        };
        let extent = curve.extent_to(unit);
        let end = Place {
            turn: angle,
            ..extent.end
        };
        (curve, Extent { end, ..extent })
    }

    /// ϑ = rate x, tau = [sin ϑ hold.x + (1 - cos ϑ) hold.y] / rate.
    pub(crate) fn kinematic(rate: R, hold: Vec2<R>) -> Self {
        Self {
            rate,
            stiffness: R::ZERO,
            hold,
            drive: Vec2::ZERO,
            harmonic: H::NONE,
        }
    }

    /// A bound of H' / D(0).
    fn whole(&self) -> R {
        self.harmonic
            .bound(self.stiffness + self.hold.length_bound(), 1)
    }

    /// The sign of the turn.
    pub(crate) fn direction(&self) -> R {
        self.rate.sign()
    }

    /// The point at parameter 0.
    fn begin(&self) -> Place<R> {
        Place {
            x: R::ZERO,
            turn: R::ZERO,
            versine: R::ZERO,
            sine: R::ZERO,
            h: R::ZERO,
            h_slope: (self.harmonic).slope(self.stiffness + self.hold.x, (R::ONE, R::ZERO)),
            d: R::ONE,
            d_slope: -self.drive.x,
        }
    }

    /// The point at parameter x.
    pub(crate) fn at(&self, x: R) -> Place<R> {
        if x == R::ZERO {
            return self.begin();
        }
        let turn = self.rate * x;
        let half = turn.halved();
        let (sinc, c) = half.sinc_cos();
        let s = sinc * half;
        let versine = (s * s).doubled();
        let sine = (s * c).doubled();
        let cosine = R::ONE - versine;
        // sin(ϑ)/ϑ and (1 - cos ϑ)/ϑ. Near a fold the components of H are large, but those of H/ϑ are not.
        let (sine_part, versine_part) = (sinc * c, sinc * s);
        let with = |z: Vec2<R>| R::sum_of_products(sine_part, z.x, versine_part, z.y);
        let per_turn = self.stiffness + with(self.hold);
        // H and D of (E7); for a gliding foot H is that of (E11).
        Place {
            x,
            turn,
            versine,
            sine,
            h: x * self.harmonic.rises(per_turn, sine_part, (cosine, sine)),
            h_slope: self.harmonic.slope(
                self.stiffness + cosine * self.hold.x + sine * self.hold.y,
                (cosine, sine),
            ),
            d: R::ONE - x * with(self.drive),
            d_slope: -(cosine * self.drive.x + sine * self.drive.y),
        }
    }

    /// Second derivatives of H/rate and D/rate.
    fn second(&self, p: &Place<R>) -> (R, R) {
        let cosine = R::ONE - p.versine;
        let first = cosine * self.hold.y - p.sine * self.hold.x;
        (
            self.rate * self.harmonic.second(first, (cosine, p.sine)),
            self.rate * (p.sine * self.drive.x - cosine * self.drive.y),
        )
    }

    /// To tau = 1, or to the fold before it, where ϑ would have to jump.
    pub(crate) fn extent(&self) -> Extent<R> {
        self.extent_until(None).0
    }

    /// The same, or to where a margin is used up, if that is earlier; returns true if it is.
    pub(crate) fn extent_until(&self, margin: Option<&Margin<R>>) -> (Extent<R>, bool) {
        let (z0, zp) = (self.hold.length_bound(), self.drive.length_bound());
        let margin = margin.map(|margin| {
            let margin = margin.scaled();
            (margin, self.curvature_bound(&margin))
        });
        let rate = self.rate.abs();
        let curvature = self.harmonic.bound(z0, 2);
        // The most by which H' and H' - D' change.
        let (change, changes) = (rate * curvature, rate * (curvature + zp));
        let per = |change: R| {
            if change > R::ZERO {
                R::ONE / change
            } else {
                R::HUGE
            }
        };
        let (per_change, per_changes) = (per(change), per(changes));
        let mut looks = Looks::ALL;
        let found = first_zero(R::HUGE, &mut looks, |x| {
            let p = self.at(x);
            let mut window = R::ONE + x.doubled();
            // Before the end H < D, so that dtau/dx D = H' - tau D' > 0 as long as neither H' nor H' - D' falls to zero.
            let rises = p.h_slope - p.d_slope;
            let clear = (p.h_slope * per_change).min(rises * per_changes);
            let fold = if clear > window.halved().halved().halved().halved() {
                window = clear;
                None
            } else {
                Some(self.fold(&p, window))
            };
            let end = Slope {
                value: p.d - p.h,
                slope: -rises,
                curvature: changes,
                rounding: R::EPSILON,
            };
            let margin = (margin.as_ref())
                .map(|(margin, curvature_bound)| self.slope(margin, &p, (curvature_bound, window)));
            Samples {
                functions: [fold, margin, Some(end)],
                window,
            }
        });
        let (x, which, unsure) = match found {
            Found::Zero { x, which } => (x, which, false),
            Found::Unsure { x, .. } | Found::Nothing { x } => (x, 2, true),
        };
        let mut end = self.at(x);
        if which == 2 && !unsure {
            // tau = 1, however small H and D are.
            end.d = end.d.max(R::EPSILON);
            end.h = end.d;
        }
        let extent = Extent {
            end,
            part_bound: R::ONE,
            rises: true,
            folds: which == 0,
            unsure,
            looks,
        };
        let margin = margin.as_ref().map(|(margin, _)| margin);
        let ends = which == 1 || margin.is_some_and(|m| !extent.folds && m.is_used_up(&extent));
        (extent, ends)
    }

    /// dtau/dx D²: zero at a fold.
    fn fold(&self, p: &Place<R>, window: R) -> Slope<R> {
        let (z0, zp) = (self.hold.length_bound(), self.drive.length_bound());
        let rate = self.rate.abs();
        let whole = self.whole();
        let (h2, d2) = self.second(p);
        let d_most = p.d.abs() + window * zp;
        let curvature = self.harmonic.bound(z0, 3);
        let curved = curvature * (rate * d_most + zp) + zp * (whole + rate * d_most);
        Slope {
            value: p.h_slope * p.d - p.h * p.d_slope,
            slope: h2 * p.d - p.h * d2,
            curvature: rate * curved,
            rounding: R::rounding(whole),
        }
    }

    /// The body on this curve, among obstacles, while its placed point moves along a path.
    pub(crate) fn instant(
        &self,
        p: &Place<R>,
        placed: &Placed<R>,
        path: &PointPath<R>,
    ) -> Instant<R> {
        let PointPath {
            shift,
            tangent,
            turning,
        } = *path;
        let (part, rate) = self.part_and_rate(p);
        let cosine = R::ONE - p.versine;
        let along = turning.y * p.sine - turning.x * p.versine;
        let speed = (turning.y * cosine - turning.x * p.sine) * self.rate;
        Instant {
            placed: Placed {
                point: placed.point + shift * part + tangent * along,
                orientation: placed.orientation.plus(p.turn),
                ..*placed
            },
            velocity: shift * rate + tangent * speed,
            turn: self.rate,
        }
    }

    /// tau and dtau/dx.
    pub(crate) fn part_and_rate(&self, p: &Place<R>) -> (R, R) {
        let per = R::ONE / p.d.max(R::EPSILON);
        let part = p.h * per;
        (part, (p.h_slope - part * p.d_slope) * per)
    }

    /// dϑ/dx
    pub(crate) fn rate(&self) -> R {
        self.rate
    }

    /// The extent of a motion whose end is known: x from 0 to `x`.
    pub(crate) fn extent_to(&self, x: R) -> Extent<R> {
        Extent {
            end: self.at(x),
            part_bound: x * self.whole(),
            rises: false,
            folds: false,
            unsure: false,
            looks: Looks::ALL,
        }
    }
}

#[cfg(test)]
mod tests;
