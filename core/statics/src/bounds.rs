//! The certificate of a window: one stable branch of balance, and bounds of every second derivative on it (ONE 4).

use crate::geometry::{Rotation, Vec2};
use crate::motion::{Instant, Kind, Motion, Spot};
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::world::Statics;
use core::ops::{Add, Mul};

/// K >= |E_uu|, J >= |E_up|, Q >= |E_pp|, |E_upp| on the strip |u - u_0| <= 2 step of a window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curvature<R> {
    pub(crate) k: R,
    pub(crate) j: R,
    pub(crate) q: R,
}

/// The extent of a window: how far p goes, and u at most from where it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent<R> {
    pub(crate) way: R,
    pub(crate) strip: R,
}

/// |u'| <= rate, |u''| <= bent along x from 0 to 1 on a window, with its extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace<R> {
    pub(crate) rate: R,
    pub(crate) bent: R,
    /// J
    pub(crate) mixed: R,
    pub(crate) extent: Extent<R>,
}

/// Bounds on a window, along x from 0 to 1 (U3).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bound<R> {
    /// What the pivot adds to the second derivative of a point that turns about it: c2.
    pub(crate) pivot: R,
    /// theta'² + |theta''|: q
    pub(crate) turn: R,
    /// |G''|: G2
    pub(crate) holding: R,
    /// |xi'|, |xi''| of the first contact: xi1, xi2
    pub(crate) foot: [R; 2],
    /// No point of the body moves farther.
    pub(crate) way: R,
}

/// Bounds of a function and of its first and second derivative by u, on a strip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sup<R> {
    pub(crate) value: R,
    pub(crate) slope: R,
    pub(crate) bend: R,
}

impl<R: Real> Sup<R> {
    pub(crate) const fn new(value: R, slope: R, bend: R) -> Self {
        Self { value, slope, bend }
    }
    pub(crate) const fn constant(value: R) -> Self {
        Self::new(value, R::ZERO, R::ZERO)
    }
    /// The second derivative along x, with a function of p whose slope by u is at most `mixed`.
    pub(crate) fn along(&self, pace: &Pace<R>, mixed: R) -> R {
        let both = (mixed * pace.extent.way * pace.rate).doubled();
        self.bend * pace.rate * pace.rate + both + self.slope * pace.bent
    }
}
impl<R: Real> Add for Sup<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::new(
            self.value + b.value,
            self.slope + b.slope,
            self.bend + b.bend,
        )
    }
}
impl<R: Real> Mul for Sup<R> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::new(
            self.value * b.value,
            self.slope * b.value + self.value * b.slope,
            self.bend * b.value + (self.slope * b.slope).doubled() + self.value * b.bend,
        )
    }
}

/// The bounds of a pair on a strip of u (ONE 4, pairs).
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairSup<R> {
    /// theta
    pub(crate) turn: Sup<R>,
    /// xi of the first contact
    foot: Sup<R>,
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
    holding: Sup<R>,
}

/// Where a window begins.
#[derive(Clone, Copy)]
pub(crate) enum Begin<'a, R> {
    /// An instant in balance.
    At(&'a Instant<R>),
    /// u and p in balance, with R(u) if u is an angle: not placed yet.
    Spot {
        spot: Spot<R>,
        rotation: Rotation<R>,
    },
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The end of a window of a curve, from a beginning in balance to p1, if the window is certainly on one stable branch: the instant in
    /// `out`, and bounds. Otherwise the part of the window that may be.
    pub(crate) fn window(
        &self,
        m: &Motion<R>,
        begin: Begin<'_, R>,
        p1: R,
        out: &mut Instant<R>,
    ) -> Result<Pace<R>, R> {
        // E and E_u at the same u with the hand at p1: E is linear in p.
        let (first, way, e1, s0, s1) = match begin {
            Begin::At(i) => {
                let way = p1 - i.p;
                let s1 = -(i.e_u + self.e_up(m, i) * way);
                (i, way, i.e + i.e_p * way, -i.e_u, s1)
            }
            Begin::Spot { spot, rotation } => {
                let known = (m.kind != Kind::Pair).then_some(rotation);
                self.place(m, Spot { p: p1, ..spot }, known, out);
                let way = p1 - spot.p;
                let s0 = self.e_up(m, out) * way - out.e_u;
                (&*out, way, out.e, s0, -out.e_u)
            }
        };
        let chord = self.chord(m, first) * way * way;
        let slope = s0.min(s1) - chord / R::from_int(8);
        if slope <= R::ZERO {
            return Err(R::ONE / R::from_int(8));
        }
        // Homogeneous in E: in units of a power of two near its slope.
        let unit = slope.min(R::ONE).unit();
        let (e1, chord) = (e1.abs().scaled(unit), chord.scaled(unit));
        let inverse = R::ONE / slope.scaled(unit);
        // (U1)
        let step = (e1 + chord / R::from_int(8)) * inverse;
        let strip = step.doubled();
        let curvature = self.curvature(m, first, Extent { way, strip });
        let (k, j) = (curvature.k.scaled(unit), curvature.j.scaled(unit));
        let rho = k * step * inverse;
        if rho > R::HALF.halved() {
            let part = R::HALF.halved() / rho;
            return Err(part.max(R::ONE / R::from_int(16)).min(R::HALF));
        }
        if m.kind == Kind::Pair && first.u.abs() + strip > m.pair.reach {
            let left = m.pair.reach - first.u.abs();
            return Err((left / strip).max(R::ONE / R::from_int(16)).min(R::HALF));
        }
        // (U2)
        let inverse = inverse / (R::ONE - rho.doubled());
        let rate = (e1 + chord.halved() + (j * way * step).doubled()) * inverse;
        let bent = (k * rate * rate + (j * way * rate).doubled() + chord) * inverse;
        let pace = Pace {
            rate,
            bent,
            mixed: curvature.j,
            extent: Extent { way, strip },
        };
        let (spot, step) = match begin {
            Begin::At(i) => {
                let e_u1 = i.e_u + self.e_up(m, i) * way;
                (Spot { u: i.u, p: p1 }, -(i.e + i.e_p * way) / e_u1)
            }
            Begin::Spot { spot, .. } => (Spot { p: p1, ..spot }, self.first_step(m, out)),
        };
        self.balance(m, spot, step, out);
        Ok(pace)
    }
    /// Q
    fn chord(&self, m: &Motion<R>, i: &Instant<R>) -> R {
        if m.kind == Kind::Slide && m.first().is_corner() {
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

    /// K, J, Q around an instant at either end of a window.
    pub(crate) fn curvature(&self, m: &Motion<R>, i: &Instant<R>, at: Extent<R>) -> Curvature<R> {
        let b = self.weight * self.centroid.length_bound();
        let h_p = m.hand_p.at.length_bound();
        let r = i.r.length_bound();
        let (k, j, q) = match m.kind {
            Kind::Line => (R::ZERO, R::ZERO, R::ZERO),
            Kind::Free => (b, R::ZERO, R::ZERO),
            Kind::Pin => {
                let turns = m.first().is_corner();
                let (r_p, p_p) = if turns {
                    (i.g_p.length_bound(), h_p)
                } else {
                    (R::ZERO, (m.hand_p.at - i.g_p).length_bound())
                };
                let pull = (i.force - i.r).length_bound();
                let (r, pull) = (r + r_p * at.way, pull + p_p * at.way);
                (r * pull + b, r * p_p + r_p * pull, R::ZERO)
            }
            Kind::Slide => {
                let frame = self.frame(m.first(), i.rotation, i.g);
                let f = R::ONE / self.friction(m.first()).sliding.cos;
                if frame.turns {
                    let pull = (i.force - i.r).length_bound() + h_p * at.way;
                    let eta = frame.n.dot(i.r).abs();
                    let arm = pull.doubled() + eta;
                    (b + f * pull * arm, f * h_p * arm, (f * h_p * h_p).doubled())
                } else {
                    let n_p = frame.n.dot(m.hand_p.at).abs();
                    let nu = frame.n.dot(i.force).abs() + n_p * at.way;
                    let turn = R::TWO + at.strip.min(R::TWO);
                    (b + f * r * (nu + turn * r), f * r * n_p, R::ZERO)
                }
            }
            Kind::Pair => {
                let sup = self.pair_sup(m, i, at);
                let mixed = self.pair_mixed(m, &sup);
                (sup.drive().bend, mixed, R::ZERO)
            }
        };
        Curvature { k, j, q }
    }

    /// The bounds of a pair around an instant.
    pub(crate) fn pair_sup(&self, m: &Motion<R>, i: &Instant<R>, at: Extent<R>) -> PairSup<R> {
        let turns = m.contacts.map(|c| c.is_corner());
        let [turns1, turns2] = turns;
        let h_p = m.hand_p.at.length_bound();
        let apart = (i.r2 - i.r).length_bound();
        let tau = m.pair.twist;
        // D >= 3/4 |g|, below 0.79
        let (th1, z2) = if turns1 == turns2 {
            let th1 = tau.y.abs() * R::from_int(4) / R::from_int(3);
            let z2 = apart * th1 * th1 * R::from_int(4) / (m.pair.slope * R::from_int(3));
            (th1, z2)
        } else {
            // 1.37 H/|g|
            let h = apart + R::ONE + R::HALF.halved();
            let z2 = h * (R::ONE + R::HALF.halved() + R::ONE / R::from_int(8)) / m.pair.slope;
            (tau.y.abs() + z2 * (i.u.abs() + at.strip), z2)
        };
        let x1 = tau.x.abs() + z2 * (i.u.abs() + at.strip);
        let th2 = th1 * th1 + z2;
        let turn = Sup::new(R::ZERO, th1, z2);
        let foot = Sup::new(R::ZERO, x1, z2);
        let (r1, r2) = (i.r.length_bound(), i.r2.length_bound());
        let more = if turns1 {
            (th1 * x1).doubled()
        } else {
            R::ZERO
        };
        let (g1, g2) = (x1 + r1 * th1, z2 + r1 * th2 + more);
        let holding = Sup::new(R::ZERO, g1, g2);
        let lever = |turns: bool, r: R| {
            if turns {
                Sup::new(r + g1 * at.strip, g1, g2)
            } else {
                Sup::new(r, r * th1, r * th2)
            }
        };
        let f = turns.map(|turns| {
            if turns {
                Sup::new(R::ONE, th1, th2)
            } else {
                Sup::constant(R::ONE)
            }
        });
        let r = [lever(turns1, r1), lever(turns2, r2)];
        let [of_first, of_second] = r;
        let r12 = if turns1 && turns2 {
            Sup::constant(apart)
        } else if turns1 == turns2 {
            Sup::new(apart, apart * th1, apart * th2)
        } else {
            let sum = of_first + of_second;
            Sup::new(apart + sum.slope * at.strip, sum.slope, sum.bend)
        };
        let force = Sup::new(
            i.force.length_bound() + h_p * at.way + g1 * at.strip,
            g1,
            g2,
        );
        let couple = self.couple_sup(turn);
        // r_1×F = r_1×P, P = F - r_1: P' = -c'
        let pull = if turns1 {
            Sup::constant((i.force - i.r).length_bound() + h_p * at.way)
        } else {
            Sup::new(
                (i.force - i.r).length_bound() + h_p * at.way + x1 * at.strip,
                x1,
                z2,
            )
        };
        let lever_part = of_first * pull;
        let slope = couple.slope + lever_part.slope;
        let m1_p = self.stiffness.value * m.hand_p.angle.abs() + r1 * h_p;
        let m1 = Sup::new(
            (i.moment - i.r.cross(i.force)).abs() + m1_p * at.way + slope * at.strip,
            slope,
            couple.bend + lever_part.bend,
        );
        let [f1, f2] = f;
        let spread = if turns1 || turns2 {
            f1 * f2
        } else {
            let [f1, f2] = self.couple(m, i).f;
            Sup::constant(f1.cross(f2).abs())
        };
        PairSup {
            turn,
            foot,
            f,
            r,
            r12,
            force,
            m1,
            spread,
            holding,
        }
    }
    /// J of a pair: the slope of E under the load (h_p, k phi_p).
    fn pair_mixed(&self, m: &Motion<R>, sup: &PairSup<R>) -> R {
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

    /// The bounds on a window with this pace.
    pub(crate) fn bound(&self, m: &Motion<R>, i: &Instant<R>, pace: &Pace<R>) -> Bound<R> {
        let (rate, way) = (pace.rate, pace.extent.way);
        let h_p = m.hand_p.at.length_bound() * way;
        let turn = rate * rate + pace.bent;
        let r = i.r.length_bound();
        let none = Bound {
            pivot: R::ZERO,
            turn,
            holding: R::ZERO,
            foot: [R::ZERO; 2],
            way: rate,
        };
        match m.kind {
            Kind::Line => {
                let theta = m.line.theta_u.abs() * rate;
                Bound {
                    turn: theta * theta,
                    way: m.line.g_u.length_bound() * rate + self.size() * theta,
                    ..none
                }
            }
            Kind::Free => Bound {
                way: h_p + self.size() * rate,
                ..none
            },
            Kind::Pin => {
                let xi1 = m.foot_p.abs() * way;
                self.about(m, none, (r, [xi1, R::ZERO]), rate)
            }
            Kind::Slide => {
                let f = R::ONE / self.friction(m.first()).sliding.cos;
                let foot = if m.first().is_corner() {
                    let pull = (i.force - i.r).length_bound() + h_p;
                    let xi2 = f * (pull * turn + (h_p * rate).doubled());
                    [f * (pull * rate + h_p), xi2]
                } else {
                    [f * (r * rate + h_p), f * r * turn]
                };
                self.about(m, none, (r, foot), rate)
            }
            Kind::Pair => {
                let sup = self.pair_sup(m, i, pace.extent);
                let pivot = sup.foot.along(pace, R::ZERO);
                let theta = sup.turn.slope * rate;
                let turning = theta * theta + sup.turn.along(pace, R::ZERO);
                let xi1 = sup.foot.slope * rate;
                let more = if m.first().is_corner() {
                    (theta * xi1).doubled()
                } else {
                    R::ZERO
                };
                Bound {
                    pivot: pivot + more,
                    turn: turning,
                    holding: sup.holding.along(pace, R::ZERO),
                    foot: [xi1, pivot],
                    way: xi1 + theta,
                }
            }
        }
    }
    /// The bounds of a body that turns about a contact whose foot moves.
    fn about(&self, m: &Motion<R>, b: Bound<R>, (r, foot): (R, [R; 2]), rate: R) -> Bound<R> {
        let [xi1, xi2] = foot;
        let (lever, pivot) = if m.first().is_corner() {
            (r + xi1, xi2 + (rate * xi1).doubled())
        } else {
            (r, xi2)
        };
        Bound {
            pivot,
            holding: pivot + lever * b.turn,
            foot,
            way: xi1 + rate,
            ..b
        }
    }
    /// The bound of the second derivative of the gap of a vertex that is `arm` from the pivot.
    pub(crate) fn gap_bound(&self, m: &Motion<R>, b: &Bound<R>, arm: Vec2<R>) -> R {
        let more = match m.kind {
            Kind::Line | Kind::Free => R::ZERO,
            Kind::Pin | Kind::Slide | Kind::Pair => {
                if m.first().is_corner() {
                    let [xi1, _] = b.foot;
                    xi1
                } else {
                    R::ZERO
                }
            }
        };
        b.pivot + (arm.length_bound() + more) * b.turn
    }
}

impl<R: Real> PairSup<R> {
    /// E = (f_1×f_2) M_1 - (r12×f_2)(f_1×F)
    pub(crate) fn drive(&self) -> Sup<R> {
        let [f1, f2] = self.f;
        self.spread * self.m1 + self.r12 * f2 * (f1 * self.force)
    }
}
