//! Bounds of all that moves in a joint slide, by products of bounds (E14 to E16).

use crate::bounds::{Curvature, Extent, Sup, third};
use crate::motion::{Instant, Motion};
use crate::real::Real;
use crate::world::Statics;

/// The bounds of a pair on a strip of u (E14 to E16).
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairSup<R, const THIRD: bool = false> {
    /// theta
    pub(crate) turn: Sup<R, THIRD>,
    /// xi of the first contact
    pub(crate) foot: Sup<R, THIRD>,
    /// The directions of the reactions.
    pub(crate) f: [Sup<R, THIRD>; 2],
    pub(crate) r: [Sup<R, THIRD>; 2],
    pub(crate) r12: Sup<R, THIRD>,
    pub(crate) force: Sup<R, THIRD>,
    /// M_1
    pub(crate) m1: Sup<R, THIRD>,
    /// f_1×f_2
    pub(crate) spread: Sup<R, THIRD>,
    /// G
    pub(crate) holding: Sup<R, THIRD>,
}

/// |theta_u|, |xi_u|, |z_uu|, |z_uuu|
struct Bends<R> {
    th1: R,
    x1: R,
    z2: R,
    z3: R,
}

/// The bounds of a pair's position up to |u|, a part of its reach (STATICS 4): 4/3 for 1/0.79, 11/8 for 1.37.
fn bends<R: Real, const THIRD: bool>(m: &Motion<R>, apart: R, u: R) -> Bends<R> {
    let (tau, slope) = (m.pair.twist, m.pair.slope);
    let [turns1, turns2] = m.contacts.map(|c| c.is_corner());
    let inverse = R::from_int(4) / R::from_int(3);
    let (th1, z2, z3) = if turns1 == turns2 {
        let th1 = tau.y.abs() * inverse;
        let arm = apart * th1 * inverse / slope;
        let z2 = arm * th1;
        let z3 = third::<R, THIRD>(|| arm * (th1 * th1 + z2.doubled() + z2));
        (th1, z2, z3)
    } else {
        let h = apart + R::ONE + R::HALF.halved();
        // 0 in one line.
        let part = if m.pair.line { R::ZERO } else { h / slope };
        let z2 = part * R::from_int(11) / R::from_int(8);
        let z3 = third::<R, THIRD>(|| part * (R::ONE + R::HALF + z2.doubled().doubled()));
        (tau.y.abs() + z2 * u, z2, z3)
    };
    Bends {
        th1,
        x1: tau.x.abs() + z2 * u,
        z2,
        z3,
    }
}

/// Bounds of the derivatives of G = c_1 - r_1 by those of the foot and of a direction that turns with the body.
fn holding_sup<R: Real, const THIRD: bool>(
    turns: bool,
    r: R,
    foot: [R; 3],
    turned: [R; 3],
) -> [R; 3] {
    let ([x1, x2, x3], [th1, th2, th3]) = (foot, turned);
    let (g1, g2) = (x1 + r * th1, x2 + r * th2);
    let g3 = third::<R, THIRD>(|| x3 + r * th3);
    if !turns {
        return [g1, g2, g3];
    }
    // The foot moves along a tangent that turns.
    let two = x1 * th1;
    let three = third::<R, THIRD>(|| x2 * th1 + x1 * th2);
    [g1, g2 + two.doubled(), g3 + three.doubled() + three]
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The bounds of a pair around an instant.
    #[inline(never)]
    pub(crate) fn pair_sup<const THIRD: bool>(
        &self,
        m: &Motion<R>,
        i: &Instant<R>,
        at: Extent<R>,
    ) -> PairSup<R, THIRD> {
        let turns = m.contacts.map(|c| self.turns(c));
        let [turns1, turns2] = turns;
        let apart = (i.r2 - i.r).length_bound();
        let Bends { th1, x1, z2, z3 } = bends::<R, THIRD>(m, apart, i.u.abs() + at.strip);
        let th2 = th1 * th1 + z2;
        let th3 = third::<R, THIRD>(|| th1 * (th1 * th1 + z2.doubled() + z2) + z3);
        let turned = [th1, th2, th3];
        let [r1, r2] = [i.r, i.r2].map(|r| r.length_bound());
        let way = holding_sup::<R, THIRD>(turns1, r1, [x1, z2, z3], turned);
        let [g1, ..] = way;
        let lever = |turns: bool, r: R| {
            if turns {
                Sup::new(r + g1 * at.strip, way)
            } else {
                Sup::new(r, turned.map(|th| r * th))
            }
        };
        let of_first = lever(turns1, r1);
        let of_second = lever(turns2, r2);
        let r12 = if turns1 && turns2 {
            Sup::constant(apart)
        } else if turns1 == turns2 {
            Sup::new(apart, turned.map(|th| apart * th))
        } else {
            let sum = of_first + of_second;
            Sup {
                value: apart + sum.slope * at.strip,
                ..sum
            }
        };
        let f = turns.map(|turns| {
            if turns {
                Sup::new(R::ONE, turned)
            } else {
                Sup::constant(R::ONE)
            }
        });
        let geometry = PairSup {
            turn: Sup::new(R::ZERO, [th1, z2, z3]),
            foot: Sup::new(R::ZERO, [x1, z2, z3]),
            f,
            r: [of_first, of_second],
            r12,
            force: Sup::constant(R::ZERO),
            m1: Sup::constant(R::ZERO),
            spread: Sup::constant(R::ZERO),
            holding: Sup::new(R::ZERO, way),
        };
        self.loaded(m, i, at, geometry)
    }
    /// K, J and Q of a pair.
    pub(crate) fn pair_curvature(&self, m: &Motion<R>, sup: &PairSup<R>) -> Curvature<R> {
        Curvature {
            k: sup.drive().bend,
            j: self.pair_drive_p(m, sup).slope,
            q: R::ZERO,
        }
    }
    /// With the bounds of F, M_1 and f_1×f_2.
    fn loaded<const THIRD: bool>(
        &self,
        m: &Motion<R>,
        i: &Instant<R>,
        at: Extent<R>,
        s: PairSup<R, THIRD>,
    ) -> PairSup<R, THIRD> {
        let h_p = m.hand_p.at.length_bound();
        let turns1 = self.turns(m.first());
        let [of_first, _] = s.r;
        let force = i.force.length_bound() + h_p * at.way + s.holding.slope * at.strip;
        let couple = self.couple_sup(s.turn);
        // r_1×F = r_1×P, P = F - r_1: P' = -c'
        let pull = (i.force - i.r).length_bound() + h_p * at.way;
        let pull = if turns1 {
            Sup::constant(pull)
        } else {
            Sup {
                value: pull + s.foot.slope * at.strip,
                ..s.foot
            }
        };
        let moment = couple + of_first * pull;
        let m1_p = self.world.stiffness.value * m.hand_p.angle.abs() + i.r.length_bound() * h_p;
        let m1 = (i.moment - i.r.cross(i.force)).abs() + m1_p * at.way + moment.slope * at.strip;
        let spread = if m.contacts.iter().any(|&c| self.turns(c)) {
            let [f1, f2] = s.f;
            f1 * f2
        } else {
            let [f1, f2] = self.reactions_of_pair(m, &self.pair_frames(m, i));
            Sup::constant(f1.cross(f2).abs())
        };
        PairSup {
            force: Sup {
                value: force,
                ..s.holding
            },
            m1: Sup {
                value: m1,
                ..moment
            },
            spread,
            ..s
        }
    }
    /// E_p of a pair: E under the load (h_p, k phi_p). Its slope is J.
    pub(crate) fn pair_drive_p<const THIRD: bool>(
        &self,
        m: &Motion<R>,
        sup: &PairSup<R, THIRD>,
    ) -> Sup<R, THIRD> {
        let h_p = Sup::constant(m.hand_p.at.length_bound());
        let [r1, _] = sup.r;
        let couple = Sup::constant(self.world.stiffness.value * m.hand_p.angle.abs());
        PairSup {
            force: h_p,
            m1: couple + r1 * h_p,
            ..*sup
        }
        .drive()
    }

    /// Of k_theta (phi - theta) and the moment of the weight.
    pub(crate) fn couple_sup<const THIRD: bool>(&self, turn: Sup<R, THIRD>) -> Sup<R, THIRD> {
        let b = self.world.weight * self.grip.centroid.length_bound();
        let held = self.world.stiffness.value + b;
        let (th1, z2) = (turn.slope, turn.bend);
        let third =
            third::<R, THIRD>(|| held * turn.third + b * th1 * (th1 * th1 + z2.doubled() + z2));
        Sup::new(R::ZERO, [held * th1, held * z2 + b * th1 * th1, third])
    }
}

impl<R: Real, const THIRD: bool> PairSup<R, THIRD> {
    /// E = (f_1×f_2) M_1 - (r12×f_2)(f_1×F)
    pub(crate) fn drive(&self) -> Sup<R, THIRD> {
        let [f1, f2] = self.f;
        self.spread * self.m1 + self.r12 * f2 * (f1 * self.force)
    }
}
