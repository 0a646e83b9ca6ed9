//! Where a contact that slides would run back (STATICS 4): a function without a division, so that its second derivative is bounded.

use crate::bounds::{Curvature, Sup};
use crate::events::{Judging, Order, Watched};
use crate::motion::{Factor, Instant, Rates};
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::values::Value;

/// Second derivatives of a slide by u and p; E_up = E_pu.
struct Second<R> {
    xi_uu: R,
    xi_up: R,
    e_uu: R,
    e_up: R,
    e_pp: R,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Watched<'_, R, V, S, C> {
    /// s (xi_u E_p - xi_p E_u) per unit of the displacement, a slow hand being no halt: -E_u s xi', as u' = -E_p/E_u.
    pub(crate) fn halt(&self, i: &Instant<R>, rates: &Rates<R>) -> Value<R> {
        let second = self.second(i);
        let size = self.motion.hand_p.size();
        let along = |u: R, p: R| {
            let part = |v, v_u, v_p| Value {
                v,
                d: v_u * u + v_p * p,
            };
            let xi_u = part(i.xi_u, second.xi_uu, second.xi_up);
            let xi_p = part(i.xi_p, second.xi_up, R::ZERO);
            let e_u = part(i.e_u, second.e_uu, second.e_up);
            let e_p = part(i.e_p, second.e_up, second.e_pp);
            xi_u * e_p + -(xi_p * e_u)
        };
        let Value { v, d } = along(rates.u, rates.p);
        // What is known of the last step of Newton's iteration is its first order.
        let last = along(R::ONE, R::ZERO).d * (i.u - i.placed);
        let sense = self.motion.first().sense;
        Value {
            v: sense.along(v + last) / size + R::of_balance(i.e_u.abs()),
            d: sense.along(d) / size,
        }
    }
    fn second(&self, i: &Instant<R>) -> Second<R> {
        let (m, statics) = (self.motion, self.statics);
        let frame = statics.frame(m.first(), i.rotation, i.g);
        let edge = statics.edge(m.first(), &frame);
        let (n, e) = (frame.n, edge.e * (R::ONE / edge.cos));
        let h_p = m.hand_p.at;
        let m_tt = statics.world.weight * i.rotation.apply(statics.grip.centroid).x;
        let (arm, rest) = if frame.turns {
            let pull = i.force - i.r;
            (pull, -(n.dot(i.r) * e.dot(pull)))
        } else {
            (i.r, n.dot(i.force) * e.dot(i.r))
        };
        let (straight, across) = (
            n.dot(arm) * e.dot(arm),
            n.dot(arm.turned()) * e.dot(arm.turned()),
        );
        let (xi_up, e_pp, twice) = if frame.turns {
            let e_pp = (n.dot(h_p) * e.dot(h_p)).doubled();
            (e.turned().dot(h_p), e_pp, (across - straight).doubled())
        } else {
            (R::ZERO, R::ZERO, straight - across.doubled())
        };
        let (e_uu, e_pp) = match m.factor {
            Factor::Both => (m_tt + rest + twice, e_pp),
            Factor::Lever | Factor::Normal(_) => (statics.e_uu_factor(m, i), R::ZERO),
        };
        Second {
            xi_uu: -e.dot(arm),
            xi_up,
            e_uu,
            e_up: statics.e_up(m, i),
            e_pp,
        }
    }

    /// Its bound: products of the bounds of each factor and of its derivatives along x.
    pub(crate) fn halt_order(&self, i: &Instant<R>, on: &Judging<R>) -> Order<R> {
        let (m, pace) = (self.motion, &on.pace);
        let Curvature { k, j, q } = pace.curvature;
        let (rate, way, bent) = (pace.rate, pace.extent.way, pace.bent);
        let (turn, mixed) = (rate * rate + bent, (way * rate).doubled());
        let f = R::ONE / self.statics.friction(m.first()).sliding.cos;
        let h_p = m.hand_p.at.length_bound();
        let (arm, turns) = if self.statics.turns(m.first()) {
            ((i.force - i.r).length_bound() + h_p * way, R::ONE)
        } else {
            (i.r.length_bound(), R::ZERO)
        };
        let (x, y) = (f * arm, f * h_p);
        let xi_u = Sup::<R>::new(
            x,
            [
                x * rate + turns * y * way,
                x * turn + turns * y * (mixed + on.p_bend),
                R::ZERO,
            ],
        );
        let xi_p = Sup::new(y, [turns * y * rate, turns * y * turn, R::ZERO]);
        let e_p = Sup::new(
            i.e_p.abs() + j * pace.extent.strip + q * way,
            [
                j * rate + q * way,
                j * (rate * rate + turn) + q * (mixed + on.p_bend),
                R::ZERO,
            ],
        );
        let e_u = Sup::new(
            i.e_u.abs() + k * pace.extent.strip + j * way,
            [
                k * rate + j * way,
                k * (rate * rate + turn) + j * (mixed.doubled() + on.p_bend) + q * way * way,
                R::ZERO,
            ],
        );
        Order::Second((xi_u * e_p + xi_p * e_u).bend / m.hand_p.size())
    }
}
