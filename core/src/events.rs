//! Whatever can end a motion, as a function with a value, a slope along x and a bound: the search looks for the first zero of all.

use crate::contact::Sense;
pub(crate) use crate::ending::{Ending, Which};
use crate::geometry::Vec2;
pub(crate) use crate::judging::Judging;
use crate::motion::{Instant, Motion, Rates};
use crate::real::Real;
use crate::state::Body;
use crate::thresholds::Thresholds;
use crate::values::{Moving, Value, Values};
use crate::world::{Friction, Statics};

/// What a motion is watched for, besides gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Watch {
    /// Nothing else.
    Way,
    /// A stick of one contact.
    Stick,
    /// A stick of several contacts of one vertex.
    Corner,
    /// A slip of one contact.
    Slip(Sense),
    /// A turn to balance at a frozen hand.
    Turn,
    /// A turn to balance of a body whose contact slides.
    Topple,
    /// A slide of one contact.
    Slide,
    /// A slide of one contact that bears nothing.
    Trail,
    /// A slide of two.
    Joint,
    /// A slip of two.
    JointSlip,
}

/// An event function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    /// N sin(lambda) - s T' cos(lambda): how far the reaction is inside the edge of the cone at which a slide of sign s begins.
    Margin(Sense),
    /// How far the force is inside the extreme edges of several contacts of one vertex.
    Low,
    High,
    /// N
    Normal,
    /// N* - N
    Stiction,
    /// s T' cos(lambda) - N sin(lambda)
    Excess,
    /// E in the direction of the motion.
    Drive,
    /// s xi'
    Halt,
    /// e·r, with its sign: a contact that bears nothing bears from where the lever is on the edge of the cone.
    Lever,
    /// -n·h_p: the hand presses a contact that bears nothing.
    Presses,
    /// A multiple of N_k of a pair.
    Share(Which),
    /// E_p of a pair: the hand drives it on.
    Advance,
    /// A multiple of s v_k of a pair.
    Foot(Which),
    /// D_c less the slip's length of a pair (E21).
    Memory,
    /// Along u: what is left of p, and -E_u.
    Path,
    Stable,
}

impl Watch {
    /// In the order of [`Values`].
    fn functions(self) -> &'static [Function] {
        use Function as F;
        match self {
            Self::Way => &[],
            Self::Stick => &[
                F::Margin(Sense::Plus),
                F::Margin(Sense::Minus),
                F::Normal,
                F::Stiction,
            ],
            Self::Corner => &[F::Low, F::High],
            Self::Slip(_) => &[F::Excess, F::Normal],
            Self::Turn => &[F::Drive],
            Self::Topple => &[F::Drive, F::Normal],
            Self::Slide => &[F::Normal, F::Halt, F::Stiction],
            Self::Trail => &[F::Lever, F::Halt, F::Presses],
            Self::Joint => &[
                F::Share(Which::First),
                F::Share(Which::Second),
                F::Advance,
                F::Foot(Which::First),
                F::Foot(Which::Second),
                F::Memory,
            ],
            Self::JointSlip => &[
                F::Drive,
                F::Share(Which::First),
                F::Share(Which::Second),
                F::Foot(Which::First),
                F::Foot(Which::Second),
            ],
        }
    }
}

/// What bounds an event function on a window.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Order<R> {
    /// Its second derivative.
    Second(R),
    /// Its slope: its own is not known.
    First(R),
}

/// A motion that is watched.
#[derive(Clone, Copy)]
pub(crate) struct Watched<'a, R, const V: usize, const S: usize, const C: usize> {
    pub(crate) statics: &'a Statics<'a, R, V, S, C>,
    pub(crate) body: &'a Body<R>,
    pub(crate) motion: &'a Motion<R>,
    pub(crate) watch: Watch,
    /// The direction of u of a frozen motion: 1 or -1.
    pub(crate) direction: R,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Watched<'_, R, V, S, C> {
    /// All functions, with their places in [`Values`].
    pub(crate) fn functions(
        &self,
        along_u: bool,
    ) -> impl Iterator<Item = (usize, Function)> + use<R, V, S, C> {
        let more: &[(usize, Function)] = if along_u {
            const {
                &[
                    (Values::<f64>::PATH, Function::Path),
                    (Values::<f64>::STABLE, Function::Stable),
                ]
            }
        } else {
            &[]
        };
        let own = (0_usize..).zip(self.watch.functions().iter().copied());
        own.chain(more.iter().copied())
    }

    /// What has happened where a function is zero.
    pub(crate) fn ending(&self, function: Function) -> Ending {
        match function {
            Function::Margin(sense) => Ending::Yields(sense),
            Function::Low | Function::High => Ending::GivesWay,
            Function::Normal | Function::Presses => Ending::Clear,
            // As another slide.
            Function::Lever => Ending::GoesOn,
            Function::Stiction | Function::Memory => Ending::Pressed,
            Function::Excess | Function::Drive => Ending::Stopped,
            Function::Halt | Function::Advance | Function::Foot(_) => Ending::Halt,
            Function::Share(which) => Ending::Opens(which),
            Function::Path => Ending::End,
            Function::Stable => Ending::Fold,
        }
    }

    /// The values at an instant; those along u in addition if p ends at `stop`.
    #[inline(never)]
    pub(crate) fn values(
        &self,
        i: &Instant<R>,
        rates: &Rates<R>,
        stop: Option<R>,
        out: &mut Values<R>,
    ) {
        match self.watch {
            Watch::Way => out.fill(&[]),
            Watch::Turn => out.fill(&[self.drive(i, rates)]),
            Watch::Corner => out.fill(&self.corner_values(i, rates)),
            Watch::Stick | Watch::Slip(_) | Watch::Slide | Watch::Trail | Watch::Topple => {
                self.single_values(i, rates, out);
            }
            Watch::Joint | Watch::JointSlip => self.pair_values(i, rates, out),
        }
        if let Some(stop) = stop {
            // p is known to the rounding of E over E_p (R10).
            let known = R::EPSILON / i.e_p.abs().max(R::divisor());
            let left = stop - i.p;
            let path = Value {
                v: if left.abs() <= known { R::ZERO } else { left },
                d: -rates.p,
            };
            let stable = Value {
                v: -i.e_u,
                d: -R::EPSILON,
            };
            out.put(Values::<R>::PATH, path);
            out.put(Values::<R>::STABLE, stable);
        }
    }

    pub(crate) fn drive(&self, i: &Instant<R>, rates: &Rates<R>) -> Value<R> {
        Value {
            v: i.e * self.direction,
            d: i.e_u * rates.u * self.direction,
        }
    }

    /// lo×(-F), (-F)×hi
    fn corner_values(&self, i: &Instant<R>, rates: &Rates<R>) -> [Value<R>; 2] {
        let force = Moving {
            at: i.force,
            rate: rates.force,
        };
        let fixed = |at| Moving {
            at,
            rate: Vec2::ZERO,
        };
        match self.statics.extreme_edges(self.body) {
            Some([low, high]) => [-fixed(low).cross(force), fixed(high).cross(force)],
            None => [Value::NONE; 2],
        }
    }

    fn single_values(&self, i: &Instant<R>, rates: &Rates<R>, out: &mut Values<R>) {
        let m = self.motion;
        let frame = self.statics.frame(m.first(), i.rotation, i.g);
        let friction = self.statics.friction(m.first());
        let direction = |at: Vec2<R>| Moving {
            at,
            rate: if frame.turns {
                at.turned() * rates.theta
            } else {
                Vec2::ZERO
            },
        };
        let force = Moving {
            at: i.force,
            rate: rates.force,
        };
        let normal = -direction(frame.n).dot(force);
        let pull = direction(frame.t).dot(force);
        match self.watch {
            Watch::Stick => {
                let cone = friction.cone(self.body.stiction);
                let (n, t) = (normal.times(cone.sin), pull.times(cone.cos));
                out.fill(&[n + -t, n + t, normal, self.stiction(friction, normal)]);
            }
            Watch::Slip(sense) => {
                let t = pull.times(sense.along(friction.sliding.cos));
                out.fill(&[t + -normal.times(friction.sliding.sin), normal]);
            }
            Watch::Slide => {
                let stiction = self.stiction(friction, normal);
                out.fill(&[normal, self.halt(i, rates), stiction]);
            }
            Watch::Trail => out.fill(&self.trail_values(i, rates, &frame)),
            Watch::Topple => out.fill(&[self.drive(i, rates), normal]),
            Watch::Way | Watch::Corner | Watch::Turn | Watch::Joint | Watch::JointSlip => {}
        }
    }
    /// N* - N, while there is no stiction.
    fn stiction(&self, friction: &Friction<R>, normal: Value<R>) -> Value<R> {
        if self.body.stiction || friction.threshold >= R::HUGE {
            return Value::NONE;
        }
        Value {
            v: friction.threshold - normal.v,
            d: -normal.d,
        }
    }

    /// What bounds a function on a window.
    pub(crate) fn order(&self, function: Function, i: &Instant<R>, on: &Judging<R>) -> Order<R> {
        let turns = self.statics.turns(self.motion.first());
        let h_p = self.motion.hand_p.at.length_bound();
        let size = self.motion.hand_p.size();
        // Of the force in a direction that turns with the body, or not.
        let force = if turns {
            let way = h_p * on.pace.extent.way;
            let [xi1, _] = on.bound.foot;
            let g1 = xi1 + i.r.length_bound() * on.pace.rate;
            (i.force.length_bound() + way + g1) * on.bound.turn
                + (on.pace.rate * (way + g1)).doubled()
                + on.bound.holding
        } else {
            on.bound.holding
        };
        let force = force + h_p * on.p_bend;
        match function {
            Function::Normal | Function::Stiction
                if matches!(self.watch, Watch::Slide | Watch::Topple) && !turns =>
            {
                Order::Second(i.r.length_bound() * on.bound.turn + h_p * on.p_bend)
            }
            Function::Margin(_)
            | Function::Low
            | Function::High
            | Function::Normal
            | Function::Stiction
            | Function::Excess => Order::Second(force),
            Function::Drive => Order::Second(on.drive),
            Function::Halt => self.halt_order(i, on),
            Function::Lever => {
                let [_, xi2] = on.bound.foot;
                Order::Second(xi2)
            }
            Function::Advance | Function::Presses => {
                Order::First(on.pace.curvature.j * on.pace.rate / size)
            }
            Function::Share(_) | Function::Foot(_) | Function::Memory => {
                self.pair_order(function, on)
            }
            Function::Path => Order::Second(on.p_bend),
            Function::Stable => Order::Second(on.stable),
        }
    }
}
