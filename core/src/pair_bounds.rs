//! Bounds of all that moves in a joint slide, by products of bounds (E14 to E16).

use crate::bounds::{Extent, Sup};
use crate::motion::{Instant, Motion};
use crate::real::Real;
use crate::world::Statics;

/// The bounds of a pair on a strip of u (E14 to E16).
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairSup<R> {
    /// theta
    pub(crate) turn: Sup<R>,
    /// xi of the first contact
    pub(crate) foot: Sup<R>,
    /// The directions of the reactions.
    pub(crate) f: [Sup<R>; 2],
    pub(crate) r: [Sup<R>; 2],
    pub(crate) r12: Sup<R>,
    pub(crate) force: Sup<R>,
    /// M_1
    pub(crate) m1: Sup<R>,
    /// f_1×f_2
    pub(crate) spread: Sup<R>,
    /// G
    pub(crate) holding: Sup<R>,
}

/// |theta_u|, |xi_u|, |z_uu|
struct Bends<R> {
    th1: R,
    x1: R,
    z2: R,
}

/// The bounds of a pair's position up to |u|, a part of its reach (STATICS 4): 4/3 for 1/D, 11/8 for 1.37.
fn bends<R: Real>(m: &Motion<R>, apart: R, u: R) -> Bends<R> {
    let (tau, slope) = (m.pair.twist, m.pair.slope);
    let [turns1, turns2] = m.contacts.map(|c| c.is_corner());
    let inverse = R::from_int(4) / R::from_int(3);
    let (th1, z2) = if turns1 == turns2 {
        let th1 = tau.y.abs() * inverse;
        (th1, apart * th1 * th1 * inverse / slope)
    } else {
        let h = apart + R::ONE + R::HALF.halved();
        let z2 = if m.pair.reach < R::HUGE {
            h * R::from_int(11) / (slope * R::from_int(8))
        } else {
            // In one line.
            R::ZERO
        };
        (tau.y.abs() + z2 * u, z2)
    };
    Bends {
        th1,
        x1: tau.x.abs() + z2 * u,
        z2,
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The bounds of a pair around an instant.
    #[inline(never)]
    pub(crate) fn pair_sup(&self, m: &Motion<R>, i: &Instant<R>, at: Extent<R>) -> PairSup<R> {
        let turns = m.contacts.map(|c| self.turns(c));
        let [turns1, turns2] = turns;
        let apart = (i.r2 - i.r).length_bound();
        let Bends { th1, x1, z2 } = bends(m, apart, i.u.abs() + at.strip);
        let th2 = th1 * th1 + z2;
        let more = if turns1 { th1 * x1 } else { R::ZERO };
        let [r1, r2] = [i.r, i.r2].map(|r| r.length_bound());
        let (g1, g2) = (x1 + r1 * th1, z2 + r1 * th2 + more.doubled());
        let lever = |turns: bool, r: R| {
            if turns {
                Sup::new(r + g1 * at.strip, g1, g2)
            } else {
                Sup::new(r, r * th1, r * th2)
            }
        };
        let of_first = lever(turns1, r1);
        let of_second = lever(turns2, r2);
        let r12 = if turns1 && turns2 {
            Sup::constant(apart)
        } else if turns1 == turns2 {
            Sup::new(apart, apart * th1, apart * th2)
        } else {
            let sum = of_first + of_second;
            Sup::new(apart + sum.slope * at.strip, sum.slope, sum.bend)
        };
        let f = turns.map(|turns| {
            if turns {
                Sup::new(R::ONE, th1, th2)
            } else {
                Sup::constant(R::ONE)
            }
        });
        let geometry = PairSup {
            turn: Sup::new(R::ZERO, th1, z2),
            foot: Sup::new(R::ZERO, x1, z2),
            f,
            r: [of_first, of_second],
            r12,
            force: Sup::constant(R::ZERO),
            m1: Sup::constant(R::ZERO),
            spread: Sup::constant(R::ZERO),
            holding: Sup::new(R::ZERO, g1, g2),
        };
        self.loaded(m, i, at, geometry)
    }
    /// With the bounds of F, M_1 and f_1×f_2.
    fn loaded(&self, m: &Motion<R>, i: &Instant<R>, at: Extent<R>, s: PairSup<R>) -> PairSup<R> {
        let h_p = m.hand_p.at.length_bound();
        let turns1 = self.turns(m.first());
        let (g1, g2) = (s.holding.slope, s.holding.bend);
        let [of_first, _] = s.r;
        let force = i.force.length_bound() + h_p * at.way + g1 * at.strip;
        let couple = self.couple_sup(s.turn);
        // r_1×F = r_1×P, P = F - r_1: P' = -c'
        let pull = (i.force - i.r).length_bound() + h_p * at.way;
        let pull = if turns1 {
            Sup::constant(pull)
        } else {
            Sup::new(pull + s.foot.slope * at.strip, s.foot.slope, s.foot.bend)
        };
        let lever_part = of_first * pull;
        let slope = couple.slope + lever_part.slope;
        let m1_p = self.stiffness.value * m.hand_p.angle.abs() + i.r.length_bound() * h_p;
        let m1 = (i.moment - i.r.cross(i.force)).abs() + m1_p * at.way + slope * at.strip;
        let spread = if m.contacts.iter().any(|&c| self.turns(c)) {
            let [f1, f2] = s.f;
            f1 * f2
        } else {
            let [f1, f2] = self.couple(m, i).f;
            Sup::constant(f1.cross(f2).abs())
        };
        PairSup {
            force: Sup::new(force, g1, g2),
            m1: Sup::new(m1, slope, couple.bend + lever_part.bend),
            spread,
            ..s
        }
    }
    /// J of a pair: the slope of E under the load (h_p, k phi_p).
    pub(crate) fn pair_mixed(&self, m: &Motion<R>, sup: &PairSup<R>) -> R {
        let h_p = Sup::constant(m.hand_p.at.length_bound());
        let [r1, _] = sup.r;
        let couple = Sup::constant(self.stiffness.value * m.hand_p.angle.abs());
        PairSup {
            force: h_p,
            m1: couple + r1 * h_p,
            ..*sup
        }
        .drive()
        .slope
    }

    /// Of k_theta (phi - theta) and the moment of the weight.
    pub(crate) fn couple_sup(&self, turn: Sup<R>) -> Sup<R> {
        let b = self.weight * self.centroid.length_bound();
        let held = self.stiffness.value + b;
        Sup::new(
            R::ZERO,
            held * turn.slope,
            held * turn.bend + b * turn.slope * turn.slope,
        )
    }
}

impl<R: Real> PairSup<R> {
    /// E = (f_1×f_2) M_1 - (r12×f_2)(f_1×F)
    pub(crate) fn drive(&self) -> Sup<R> {
        let [f1, f2] = self.f;
        self.spread * self.m1 + self.r12 * f2 * (f1 * self.force)
    }
}
