//! The event functions of two contacts that slide together, with their bounds (E14 to E16). A reaction is watched by a numerator whose
//! divisor keeps its sign.

use crate::bounds::Sup;
use crate::couple::Couple;
use crate::events::{Function, Judging, Order, Watch, Watched, Which};
use crate::motion::{Instant, Rates};
use crate::pair_bounds::PairSup;
use crate::real::Real;
use crate::state::gap_slope;
use crate::thresholds::Thresholds;
use crate::values::{Moving, Value, Values};

/// A wrench about the first contact, with its velocity along x.
#[derive(Clone, Copy)]
struct MovingWrench<R> {
    force: Moving<R>,
    moment: Value<R>,
}

/// det(a, b, c) of three wrenches.
fn volume<R: Real>(a: MovingWrench<R>, b: MovingWrench<R>, c: MovingWrench<R>) -> Value<R> {
    a.moment * b.force.cross(c.force)
        + b.moment * c.force.cross(a.force)
        + c.moment * a.force.cross(b.force)
}

/// With the sign of a number.
fn signed<R: Real>(value: Value<R>, sign: R) -> Value<R> {
    if sign < R::ZERO { -value } else { value }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Watched<'_, R, V, S, C> {
    pub(crate) fn pair_values(&self, i: &Instant<R>, rates: &Rates<R>, out: &mut Values<R>) {
        if !self.statics.has_pairs() {
            return out.fill(&[]);
        }
        let m = self.motion;
        let couple = self.statics.couple(m, i);
        let feet = self.feet(rates, &couple);
        let [share1, share2] = if m.pair.pressed {
            self.shares_of(i, rates, &couple)
        } else {
            [Value::NONE; 2]
        };
        let [foot1, foot2] = feet;
        if self.watch == Watch::JointSlip {
            return out.fill(&[self.drive(i, rates), share1, share2, foot1, foot2]);
        }
        // Per unit of the displacement: a slow hand is no halt.
        let size = m.hand_p.size();
        let advance = Value {
            v: (i.e_p + R::of_displacement(size)) / size,
            d: R::ZERO,
        };
        out.fill(&[
            share1,
            share2,
            advance,
            foot1,
            foot2,
            self.memory(i, rates, &couple),
        ]);
    }
    /// Multiples of s v_1, s v_2 of contacts that move: t_2·r12, t_1·r12.
    fn feet(&self, rates: &Rates<R>, couple: &Couple<R>) -> [Value<R>; 2] {
        let r12 = couple.arm(rates.u);
        let [t1, t2] = couple.tangents(rates.theta);
        let along = gap_slope(&couple.frames).dot(self.motion.pair.twist.turned());
        let feet = [t2.dot(r12), t1.dot(r12)];
        let mut out = [Value::NONE; 2];
        for ((slot, foot), contact) in out.iter_mut().zip(feet).zip(self.motion.contacts) {
            if contact.sense.slides() {
                *slot = signed(foot, contact.sense.along(along));
            }
        }
        out
    }
    /// Multiples of N_1, N_2.
    pub(crate) fn shares(&self, i: &Instant<R>, rates: &Rates<R>) -> [Value<R>; 2] {
        let couple = self.statics.couple(self.motion, i);
        self.shares_of(i, rates, &couple)
    }
    fn shares_of(&self, i: &Instant<R>, rates: &Rates<R>, couple: &Couple<R>) -> [Value<R>; 2] {
        let force = Moving {
            at: i.force,
            rate: rates.force,
        };
        let [f1, f2] = couple.directions(rates.u);
        let m = self.motion;
        // In one line a drag has no moment.
        if m.frozen && !m.pair.line {
            return self.drag_shares(i, rates, couple);
        }
        if m.pair.spread && !m.pair.line {
            let sine = f1.at.cross(f2.at);
            return [signed(f2.cross(force), sine), signed(force.cross(f1), sine)];
        }
        let moment = Value {
            v: i.moment,
            d: rates.moment,
        };
        let [r1, r2] = couple.levers(rates.u);
        let [m1, m2] = [r1, r2].map(|r| moment + -r.cross(force));
        let r12 = i.r2 - i.r;
        [signed(m2, r12.cross(f1.at)), signed(m1, -r12.cross(f2.at))]
    }
    /// Out of balance, with a drag against the velocities: det(borne, w_2, drag), det(w_1, borne, drag), of the sign of det(w_1, w_2, drag).
    fn drag_shares(&self, i: &Instant<R>, rates: &Rates<R>, couple: &Couple<R>) -> [Value<R>; 2] {
        let [f1, f2] = couple.directions(rates.u);
        let [r1, _] = couple.levers(rates.u);
        let force = Moving {
            at: i.force,
            rate: rates.force,
        };
        let moment = Value {
            v: i.moment,
            d: rates.moment,
        };
        let borne = MovingWrench {
            force: Moving {
                at: -i.force,
                rate: -rates.force,
            },
            moment: -(moment + -r1.cross(force)),
        };
        let r12 = couple.arm(rates.u);
        let [t1, t2] = couple.tangents(rates.theta);
        let none = Value {
            v: R::ZERO,
            d: R::ZERO,
        };
        let w1 = MovingWrench {
            force: f1,
            moment: none,
        };
        let w2 = MovingWrench {
            force: f2,
            moment: r12.cross(f2),
        };
        let (a1, a2) = (t2.dot(r12), t1.dot(r12));
        let drag = MovingWrench {
            force: t1.times(a1) + t2.times(a2),
            moment: r12.cross(t2) * a2,
        };
        let full = volume(w1, w2, drag).v;
        [
            signed(volume(borne, w2, drag), full),
            signed(volume(w1, borne, drag), full),
        ]
    }
    /// N* - N in one line, D_c less the length of a slip otherwise; the latter by value alone.
    fn memory(&self, i: &Instant<R>, rates: &Rates<R>, couple: &Couple<R>) -> Value<R> {
        let m = self.motion;
        let has_threshold = |c| self.statics.friction(c).threshold < R::HUGE;
        if !m.contacts.into_iter().any(has_threshold) {
            return Value::NONE;
        }
        if self.statics.has_wedges() && !m.pair.even {
            return Value {
                v: self.statics.room_to_stiction(m, i, couple),
                d: R::ZERO,
            };
        }
        let n = self.statics.frame(m.first(), i.rotation, i.g).n;
        Value {
            v: self.statics.friction(m.first()).threshold + n.dot(i.force),
            d: n.dot(rates.force),
        }
    }

    /// What bounds the functions of a pair. A call: compiled into the loop over all functions, it would be computed before it for any motion.
    #[inline(never)]
    pub(crate) fn pair_order(&self, function: Function, on: &Judging<R>) -> Order<R> {
        if !self.statics.has_pairs() {
            return Order::First(R::ZERO);
        }
        let m = self.motion;
        let Some(sup) = &on.pair else {
            return Order::First(R::ZERO);
        };
        let h_p = m.hand_p.at.length_bound();
        let [r1, r2] = sup.r;
        let [f1, f2] = sup.f;
        match function {
            Function::Foot(which) => {
                let tangent = which.other().of(sup.f);
                Order::Second((tangent * sup.r12).along(&on.pace, R::ZERO))
            }
            Function::Share(which) if m.frozen && !m.pair.line => {
                Order::Second(drag_sup(sup, which).along(&on.pace, R::ZERO))
            }
            Function::Share(which) if m.pair.spread && !m.pair.line => {
                let f = which.of([f2, f1]);
                let bend = (f * sup.force).along(&on.pace, f.slope * h_p);
                Order::Second(bend + h_p * on.p_bend)
            }
            Function::Share(which) => {
                let r = which.of([r2, r1]);
                let couple = self.statics.couple_sup(sup.turn);
                let bend = (r * sup.force + couple).along(&on.pace, r.slope * h_p);
                let couple_p = self.statics.world.stiffness.of(m.hand_p.angle.abs());
                let moment_p = couple_p + r.value * h_p;
                Order::Second(bend + moment_p * on.p_bend)
            }
            // N* - N of contacts that bear any couple; otherwise monotonous.
            Function::Memory if m.pair.even => {
                let bend = sup.holding.along(&on.pace, R::ZERO);
                Order::Second(bend + h_p * on.p_bend)
            }
            Function::Memory => Order::First(R::ZERO),
            Function::Margin(_)
            | Function::Low
            | Function::High
            | Function::Normal
            | Function::Stiction
            | Function::Excess
            | Function::Drive
            | Function::Halt
            | Function::Advance
            | Function::Path
            | Function::Lever
            | Function::Presses
            | Function::Stable => Order::First(R::ZERO),
        }
    }
}

/// Of the numerators of the shares with a drag.
fn drag_sup<R: Real>(sup: &PairSup<R>, which: Which) -> Sup<R> {
    let [t1, t2] = sup.f;
    let (a1, a2) = (t2 * sup.r12, t1 * sup.r12);
    let drag = t1 * a1 + t2 * a2;
    let drag_moment = sup.r12 * t2 * a2;
    match which {
        Which::First => {
            let arm = sup.r12 * t2;
            sup.m1 * (t2 * drag) + arm * (drag * sup.force) + drag_moment * (sup.force * t2)
        }
        Which::Second => sup.m1 * (drag * t1) + drag_moment * (t1 * sup.force),
    }
}
