//! The certificate of a window of a curve: one stable branch of balance (STATICS 4).

use crate::bounds::{Curvature, Extent, Pace};
use crate::geometry::Rotation;
use crate::motion::{Instant, Kind, Motion, Spot};
use crate::pair_bounds::PairSup;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// The residual E at one end of a window with the u of the other, which is in balance; -E_u there at both ends of p.
#[derive(Clone, Copy)]
pub(crate) struct Residual<R> {
    pub(crate) way: R,
    pub(crate) e1: R,
    pub(crate) s0: R,
    pub(crate) s1: R,
}

/// What bounds a curve along u (E13), per u: |p'| <= rate, |p''| <= bend; K, J, Q; and |d²E_u/du²| <= stable.
pub(crate) struct Along<R> {
    pub(crate) rate: R,
    pub(crate) bend: R,
    pub(crate) curvature: Curvature<R>,
    pub(crate) stable: R,
}

/// Where a window begins.
#[derive(Clone, Copy)]
pub(crate) enum Begin<'a, R> {
    /// An instant in balance.
    At(&'a Instant<R>),
    /// u and p in balance, with the rotation there: not placed yet.
    Spot {
        spot: Spot<R>,
        rotation: Rotation<R>,
    },
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The end of a window of a curve, from a beginning in balance to p1, if the window is certainly on one stable branch: the instant in
    /// `out`, and bounds, in `pair` those of a pair. Otherwise the part of the window that may be.
    #[inline(never)]
    pub(crate) fn window(
        &self,
        m: &Motion<R>,
        begin: Begin<'_, R>,
        p1: R,
        out: &mut Instant<R>,
        pair: &mut Option<PairSup<R>>,
    ) -> Result<Pace<R>, R> {
        let (first, residual) = match begin {
            Begin::At(i) => {
                // E and E_u at the same u with the hand at p1: E is linear in p.
                let way = p1 - i.p;
                let s1 = -(i.e_u + self.e_up(m, i) * way);
                let (e1, s0) = (i.e + i.e_p * way, -i.e_u);
                (i, Residual { way, e1, s0, s1 })
            }
            Begin::Spot { spot, rotation } => {
                self.place(m, Spot { p: p1, ..spot }, Some(rotation), out);
                (&*out, self.residual_after(m, out, p1 - spot.p))
            }
        };
        let pace = self.certified(m, first, residual, pair)?;
        let (spot, step) = match begin {
            Begin::At(i) => (Spot { u: i.u, p: p1 }, residual.e1 / residual.s1),
            Begin::Spot { spot, .. } => (Spot { p: p1, ..spot }, self.first_step(m, out)),
        };
        self.balance(m, spot, step, out);
        Ok(pace)
    }
    /// The residual of a window of this width that ends at an instant with the u of its beginning.
    #[inline(always)]
    pub(crate) fn residual_after(&self, m: &Motion<R>, i: &Instant<R>, way: R) -> Residual<R> {
        Residual {
            way,
            e1: i.e,
            s0: self.e_up(m, i) * way - i.e_u,
            s1: -i.e_u,
        }
    }
    /// One stable branch of balance on a window, with the bounds of its rates and those of a pair: (E9), (E10). Otherwise the part of the
    /// window that may be.
    #[inline(never)]
    pub(crate) fn certified(
        &self,
        m: &Motion<R>,
        i: &Instant<R>,
        residual: Residual<R>,
        pair: &mut Option<PairSup<R>>,
    ) -> Result<Pace<R>, R> {
        self.certified_inlined(m, i, residual, pair)
    }
    /// [`Self::certified`], compiled into the caller: what it knows of the motion is decided there.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub(crate) fn certified_inlined(
        &self,
        m: &Motion<R>,
        i: &Instant<R>,
        Residual { way, e1, s0, s1 }: Residual<R>,
        pair: &mut Option<PairSup<R>>,
    ) -> Result<Pace<R>, R> {
        let chord = self.chord(m, i) * way * way;
        let slope = s0.min(s1) - chord / R::from_int(8);
        if slope <= R::ZERO {
            return Err(R::ONE / R::from_int(8));
        }
        // Homogeneous in E: in units of a power of two near its slope.
        let unit = slope.min(R::ONE).unit();
        let (e1, chord) = (e1.abs().scaled(unit), chord.scaled(unit));
        let inverse = R::ONE / slope.scaled(unit);
        // (E9)
        let step = (e1 + chord / R::from_int(8)) * inverse;
        let strip = step.doubled();
        let curvature = self.curvature_with(m, i, Extent { way, strip }, pair);
        let (k, j) = (curvature.k.scaled(unit), curvature.j.scaled(unit));
        let rho = k * step * inverse;
        if rho > R::HALF.halved() {
            let part = R::HALF.halved() / rho;
            return Err(part.max(R::ONE / R::from_int(16)).min(R::HALF));
        }
        within_reach(m, i.u, strip)?;
        // (E10)
        let inverse = inverse / (R::ONE - rho.doubled());
        let rate = (e1 + chord.halved() + (j * way * step).doubled()) * inverse;
        let bent = (k * rate * rate + (j * way * rate).doubled() + chord) * inverse;
        Ok(Pace {
            rate,
            bent,
            curvature,
            extent: Extent { way, strip },
        })
    }
    /// A curve on a length l of u that ends at an instant in balance (E13), or the part of the length that may be certain.
    pub(crate) fn along_u(&self, m: &Motion<R>, i: &Instant<R>, l: R) -> Result<Along<R>, R> {
        let (e_u, e_p) = (i.e_u.abs(), i.e_p.abs());
        let within = |way| self.curvature(m, i, Extent { way, strip: l });
        // |p - p_1| stays below d, which is twice what it is with E_p as at the end.
        let d = ((e_u + within(R::ZERO).k * l) / e_p * l).doubled();
        let curvature = within(d);
        let Curvature { k, j, q } = curvature;
        let lost = j * l + q * d;
        let low = e_p - lost;
        if low < e_p.halved() {
            let part = e_p.halved() / lost;
            return Err(part.max(R::ONE / R::from_int(8)).min(R::HALF));
        }
        let rate = (e_u + k * l + j * d) / low;
        // A rate beyond the range of the number type bounds nothing.
        if rate * l > d || !rate.is_finite() {
            return Err(R::HALF);
        }
        let square = q * rate * rate;
        let bend = (k + (j * rate).doubled() + square) / low;
        // |E_uuu|, |E_uup|
        let (third, mixed) = if self.is_pair(m.kind) {
            let sup = self.pair_sup::<true>(m, i, Extent { way: d, strip: l });
            (sup.drive().third, self.pair_drive_p(m, &sup).bend)
        } else {
            (k.doubled(), j.doubled())
        };
        let stable = third + (mixed * rate).doubled() + square + j * bend;
        Ok(Along {
            rate,
            bend,
            curvature,
            stable,
        })
    }
    /// Q
    #[inline(always)]
    fn chord(&self, m: &Motion<R>, i: &Instant<R>) -> R {
        if m.kind == Kind::Slide && self.turns(m.first()) {
            self.curvature(
                m,
                i,
                Extent {
                    way: R::ZERO,
                    strip: R::ZERO,
                },
            )
            .q
        } else {
            R::ZERO
        }
    }
}

/// The strip of a pair is where its position is bounded; otherwise the part of the window that may be.
fn within_reach<R: Real>(m: &Motion<R>, u: R, strip: R) -> Result<(), R> {
    if m.kind != Kind::Pair || u.abs() + strip <= m.pair.reach {
        return Ok(());
    }
    let left = m.pair.reach - u.abs();
    Err((left / strip).max(R::ONE / R::from_int(16)).min(R::HALF))
}
