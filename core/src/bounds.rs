//! The certificate of a window: one stable branch of balance, and bounds of every second derivative on it (STATICS 4).

use crate::geometry::Vec2;
use crate::motion::{Factor, Instant, Kind, Motion};
use crate::pair_bounds::PairSup;
use crate::real::Real;
use crate::world::Statics;
use core::ops::{Add, Mul};

/// K >= |E_uu|, J >= |E_up|, Q >= |E_pp|, |E_upp| on the strip |u - u_0| <= 2 step of a window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curvature<R> {
    pub(crate) k: R,
    pub(crate) j: R,
    pub(crate) q: R,
}

impl<R: Real> Curvature<R> {
    /// Of a residual that is linear.
    pub(crate) const ZERO: Self = Self {
        k: R::ZERO,
        j: R::ZERO,
        q: R::ZERO,
    };
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
    pub(crate) curvature: Curvature<R>,
    pub(crate) extent: Extent<R>,
}

impl<R: Real> Pace<R> {
    /// Of a u that goes by `rate` in proportion to p, which goes by `way`.
    pub(crate) const fn linear(rate: R, way: R) -> Self {
        Self {
            rate,
            bent: R::ZERO,
            curvature: Curvature::ZERO,
            extent: Extent { way, strip: rate },
        }
    }
}

/// Bounds on a window, along x from 0 to 1 (E11).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bound<R> {
    /// What the pivot adds to the second derivative of a point that turns about it: c2.
    pub(crate) pivot: R,
    /// |theta'|
    pub(crate) theta: R,
    /// theta'² + |theta''|: q
    pub(crate) turn: R,
    /// |G''|: G2
    pub(crate) holding: R,
    /// |xi'|, |xi''| of the first contact: xi1, xi2
    pub(crate) foot: [R; 2],
    /// No point of the body moves farther.
    pub(crate) way: R,
}

impl<R: Real> Bound<R> {
    /// Of a body that stands still.
    pub(crate) const ZERO: Self = Self {
        pivot: R::ZERO,
        theta: R::ZERO,
        turn: R::ZERO,
        holding: R::ZERO,
        foot: [R::ZERO; 2],
        way: R::ZERO,
    };
}

/// Bounds of a function and of its first and second derivative by u, on a strip; of the third only where that is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sup<R, const THIRD: bool = false> {
    pub(crate) value: R,
    pub(crate) slope: R,
    pub(crate) bend: R,
    pub(crate) third: R,
}

/// The bound of a third derivative, where that is asked for.
pub(crate) fn third<R: Real, const THIRD: bool>(bound: impl FnOnce() -> R) -> R {
    if THIRD { bound() } else { R::ZERO }
}

impl<R: Real, const THIRD: bool> Sup<R, THIRD> {
    pub(crate) const fn new(value: R, [slope, bend, third]: [R; 3]) -> Self {
        Self {
            value,
            slope,
            bend,
            third,
        }
    }
    pub(crate) const fn constant(value: R) -> Self {
        Self::new(value, [R::ZERO; 3])
    }
    /// The second derivative along x, with a function of p whose slope by u is at most `mixed`.
    pub(crate) fn along(&self, pace: &Pace<R>, mixed: R) -> R {
        let both = (mixed * pace.extent.way * pace.rate).doubled();
        self.bend * pace.rate * pace.rate + both + self.slope * pace.bent
    }
}
impl<R: Real, const THIRD: bool> Add for Sup<R, THIRD> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::new(
            self.value + b.value,
            [
                self.slope + b.slope,
                self.bend + b.bend,
                third::<R, THIRD>(|| self.third + b.third),
            ],
        )
    }
}
impl<R: Real, const THIRD: bool> Mul for Sup<R, THIRD> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let slope = self.slope * b.value + self.value * b.slope;
        let bend = self.bend * b.value + (self.slope * b.slope).doubled() + self.value * b.bend;
        let third = third::<R, THIRD>(|| {
            let mixed = self.bend * b.slope + self.slope * b.bend;
            self.third * b.value + mixed.doubled() + mixed + self.value * b.third
        });
        Self::new(self.value * b.value, [slope, bend, third])
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// K, J, Q around an instant at either end of a window.
    #[inline(always)]
    pub(crate) fn curvature(&self, m: &Motion<R>, i: &Instant<R>, at: Extent<R>) -> Curvature<R> {
        let b = self.world.weight * self.grip.centroid.length_bound();
        let h_p = m.hand_p.at.length_bound();
        let r = i.r.length_bound();
        let (k, j, q) = match m.kind {
            Kind::Line => (R::ZERO, R::ZERO, R::ZERO),
            Kind::Free => (b, R::ZERO, R::ZERO),
            Kind::Pin => {
                let pull = (i.force - i.r).length_bound();
                if self.turns(m.first()) {
                    let r_p = i.g_p.length_bound();
                    let (r, pull) = (r + r_p * at.way, pull + h_p * at.way);
                    (r * pull + b, r * h_p + r_p * pull, R::ZERO)
                } else {
                    let p_p = (m.hand_p.at - i.g_p).length_bound();
                    (r * (pull + p_p * at.way) + b, r * p_p, R::ZERO)
                }
            }
            Kind::Slide if m.factor != Factor::Both => {
                // A product of two vectors of length 1 or less with r, or with P of a C.
                if self.turns(m.first()) {
                    ((i.force - i.r).length_bound() + h_p * at.way, h_p, R::ZERO)
                } else {
                    (r, R::ZERO, R::ZERO)
                }
            }
            Kind::Slide => {
                let frame = self.frame_inlined(m.first(), i.rotation, i.g);
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
            Kind::Pair if !self.has_pairs() => (b, R::ZERO, R::ZERO),
            Kind::Pair => {
                return self.pair_curvature(m, &self.pair_sup(m, i, at));
            }
        };
        Curvature { k, j, q }
    }

    /// [`Self::curvature`], and in `pair` the bounds of a pair that it is made of.
    #[inline(always)]
    pub(crate) fn curvature_with(
        &self,
        m: &Motion<R>,
        i: &Instant<R>,
        at: Extent<R>,
        pair: &mut Option<PairSup<R>>,
    ) -> Curvature<R> {
        if self.is_pair(m.kind) {
            self.pair_curvature(m, pair.insert(self.pair_sup(m, i, at)))
        } else {
            self.curvature(m, i, at)
        }
    }
    /// |xi_p| at most (E13): |f||h_p| of a slide; a slip moves its foot by p, and what else there is places the foot by u alone.
    pub(crate) fn foot_per_p(&self, m: &Motion<R>) -> R {
        match m.kind {
            Kind::Slide => m.hand_p.at.length_bound() / self.friction(m.first()).sliding.cos,
            Kind::Line | Kind::Free | Kind::Pin | Kind::Pair => m.foot_p.abs(),
        }
    }

    /// The bounds on a window with this pace, and with those of a pair.
    #[inline(never)]
    pub(crate) fn bound(
        &self,
        m: &Motion<R>,
        i: &Instant<R>,
        pace: &Pace<R>,
        pair: Option<&PairSup<R>>,
    ) -> Bound<R> {
        match pair {
            Some(sup) => self.pair_bound(m, sup, pace),
            None => self.bound_inlined(m, i, pace),
        }
    }
    /// [`Self::bound`], compiled into the caller: what it knows of the motion is decided there.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub(crate) fn bound_inlined(&self, m: &Motion<R>, i: &Instant<R>, pace: &Pace<R>) -> Bound<R> {
        let (rate, way) = (pace.rate, pace.extent.way);
        let (h_p, r) = (m.hand_p.at.length_bound() * way, i.r.length_bound());
        let turn = rate * rate + pace.bent;
        let none = Bound {
            theta: rate,
            turn,
            way: rate,
            ..Bound::ZERO
        };
        match m.kind {
            Kind::Line => {
                let line = m.line();
                let theta = line.angle.abs() * rate;
                Bound {
                    theta,
                    turn: theta * theta,
                    way: line.at.length_bound() * rate + self.grip.size * theta,
                    ..none
                }
            }
            Kind::Free => Bound {
                way: h_p + self.grip.size * rate,
                ..none
            },
            Kind::Pin => {
                let xi1 = m.foot_p.abs() * way;
                self.about(m, none, (r, [xi1, R::ZERO]), rate)
            }
            Kind::Slide => {
                let f = R::ONE / self.friction(m.first()).sliding.cos;
                let foot = if self.turns(m.first()) {
                    let pull = (i.force - i.r).length_bound() + h_p;
                    let xi2 = f * (pull * turn + (h_p * rate).doubled());
                    [f * (pull * rate + h_p), xi2]
                } else {
                    [f * (r * rate + h_p), f * r * turn]
                };
                self.about(m, none, (r, foot), rate)
            }
            // [`Self::bound`] has those of a pair.
            Kind::Pair => none,
        }
    }
    /// Those of a pair.
    fn pair_bound(&self, m: &Motion<R>, sup: &PairSup<R>, pace: &Pace<R>) -> Bound<R> {
        let rate = pace.rate;
        let pivot = sup.foot.along(pace, R::ZERO);
        let (theta, xi1) = (sup.turn.slope * rate, sup.foot.slope * rate);
        let turning = theta * theta + sup.turn.along(pace, R::ZERO);
        let turns = self.turns(m.first());
        let more = if turns { theta * xi1 } else { R::ZERO };
        Bound {
            pivot: pivot + more.doubled(),
            theta,
            turn: turning,
            holding: sup.holding.along(pace, R::ZERO),
            foot: [xi1, pivot],
            way: xi1 + theta,
        }
    }
    /// The bounds of a body that turns about a contact whose foot moves.
    #[inline(always)]
    fn about(&self, m: &Motion<R>, b: Bound<R>, (r, foot): (R, [R; 2]), rate: R) -> Bound<R> {
        let [xi1, xi2] = foot;
        let (lever, pivot) = if self.turns(m.first()) {
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
                if self.turns(m.first()) {
                    let [xi1, _] = b.foot;
                    xi1
                } else {
                    R::ZERO
                }
            }
        };
        b.pivot + (arm.length_bound() + more) * b.turn
    }
    /// The bound of the second derivative of the gap between a side of the body and a place of the world that is `arm` from the pivot: from a
    /// vertex, which moves with its foot, or from a corner, along which the body moves.
    pub(crate) fn corner_bound(&self, m: &Motion<R>, b: &Bound<R>, arm: Vec2<R>) -> R {
        let [xi1, xi2] = b.foot;
        let pivot1 = match m.kind {
            Kind::Line | Kind::Free => b.way,
            Kind::Pin | Kind::Slide | Kind::Pair if self.turns(m.first()) => R::ZERO,
            Kind::Pin | Kind::Slide | Kind::Pair => xi1,
        };
        xi2 + (arm.length_bound() + pivot1) * b.turn + (pivot1 * b.theta).doubled()
    }
}
