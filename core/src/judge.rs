//! Event functions on a window: whether it is certain, where something crosses zero (STATICS 5).

use crate::contact::{Contact, Feature};
use crate::events::{Ending, Function, Judging, Order, Watched};
use crate::found::Found;
use crate::geometry::Vec2;
use crate::motion::Kind;
use crate::real::Real;
use crate::search::{Ended, Run, WindowEnd};
use crate::thresholds::Thresholds;
use crate::values::{Value, Values};
use crate::world::Statics;

/// An event function at both ends of a window.
pub(crate) struct Track<R> {
    ending: Ending,
    begin: Value<R>,
    end: Value<R>,
    order: Order<R>,
    /// Its second derivative is at least this.
    least: R,
}

impl<R: Real> Track<R> {
    /// With its bound of the second derivative.
    pub(crate) fn gap(ending: Ending, [begin, end]: [Value<R>; 2], bend: R) -> Self {
        Self {
            ending,
            begin,
            end,
            order: Order::Second(bend),
            least: -bend,
        }
    }
    /// By its values alone.
    pub(crate) fn monotonous(ending: Ending, [begin, end]: [Value<R>; 2]) -> Self {
        Self {
            ending,
            begin,
            end,
            order: Order::First(R::ZERO),
            least: R::LEAST,
        }
    }
    /// How far from zero it is zero. At a fold p is known to its rounding, as the root is a double one.
    fn accuracy(&self) -> R {
        if self.ending == Ending::End {
            R::of_products()
        } else {
            R::zero()
        }
    }
    /// Where it counts as zero without a step to its zero: a gap that is closed within its accuracy is closed, others at `exact`.
    fn level(&self, exact: R) -> R {
        if matches!(self.ending, Ending::Touch(_)) {
            R::zero()
        } else {
            exact
        }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Run<'_, R, V, S, C> {
    /// All functions but gaps; what is over at the very beginning ends the motion there.
    pub(crate) fn judge_functions(
        &mut self,
        on: &Judging<R>,
        found: &mut Found<R>,
    ) -> Option<Ended<R>> {
        let along_u = self.bracket.branch.is_some();
        for (place, function) in self.watched.functions(along_u) {
            let end = self.hi.values.get(place);
            let order = self.watched.order(function, &self.hi.instant, on);
            // (R3) holds for what is not negative at the beginning. A hand that turns back there stops a slide whose foot it moves by a touch.
            let may_begin_below = function == Function::Halt && self.bracket.certain == R::ZERO;
            if is_clear(end.v, &order) && !may_begin_below {
                continue;
            }
            self.know_low();
            let begin = self.lo.values.get(place);
            if may_begin_below && begin.v < R::ZERO {
                let way = self.lo.rates.xi.abs() * self.bracket.end;
                if way > R::TOUCH {
                    return Some(self.ended_low(Ending::Halt, self.watched.body.room));
                }
            }
            let least = match order {
                Order::Second(k) => -k,
                Order::First(_) => R::LEAST,
            };
            let track = Track {
                ending: self.watched.ending(function),
                begin,
                end,
                order,
                least,
            };
            if self.is_over(&track) {
                let room = self.watched.body.room;
                return Some(self.ended_low(track.ending, room));
            }
            self.judge(found, &track);
        }
        None
    }
    /// All gaps of vertices that are no contacts; the least one of those that are open.
    pub(crate) fn judge_gaps(
        &mut self,
        on: &Judging<R>,
        room: &mut R,
        found: &mut Found<R>,
    ) -> Option<Ended<R>> {
        let Watched {
            statics,
            motion,
            body,
            ..
        } = self.watched;
        for (vertex, a) in statics.vertices() {
            let i = &self.hi.instant;
            let arm = i.rotation.apply(a);
            let (at, bend) = (i.g + arm, statics.gap_bound(motion, &on.bound, arm - i.r));
            let clear = bend.halved().max(R::zero());
            for (side, surface) in statics.sides() {
                let gap = surface.normal.dot(at) - surface.offset;
                if gap > clear {
                    *room = room.min(gap);
                    continue;
                }
                let feature = Feature::Vertex { vertex, side };
                if statics.holds(&body.contacts, feature) {
                    continue;
                }
                *room = room.min(gap);
                self.know_low();
                let track = Track {
                    ending: Ending::Touch(feature),
                    begin: gap_at(statics, feature, self.lo),
                    end: gap_at(statics, feature, self.hi),
                    order: Order::Second(bend),
                    least: self.least_bend(on, surface.normal, arm).max(-bend),
                };
                if self.is_over(&track) {
                    return Some(self.ended_low(track.ending, R::ZERO));
                }
                self.judge(found, &track);
            }
        }
        if C == 0 {
            return None;
        }
        self.judge_obstacles(on, room, found)
    }
    /// A lower bound of the second derivative of a gap: if the body turns about a fixed or straight moving point it is -n·R a theta'².
    fn least_bend(&self, on: &Judging<R>, normal: Vec2<R>, arm: Vec2<R>) -> R {
        let motion = self.watched.motion;
        let turn = match motion.kind {
            Kind::Line => motion.line().angle.abs() * on.width,
            Kind::Pin if motion.frozen && !self.watched.statics.turns(motion.first()) => on.width,
            Kind::Free | Kind::Pin | Kind::Slide | Kind::Pair => return R::LEAST,
        };
        let arm = arm - self.hi.instant.r;
        (-normal.dot(arm) - arm.length_bound() * turn) * turn * turn
    }
    /// Zero at the beginning of the motion, and falling: the event is there.
    fn is_over(&self, track: &Track<R>) -> bool {
        let (a, b) = (track.begin, track.end);
        let falls = match track.order {
            Order::Second(_) if self.bracket.round >= 2 => a.d < -R::in_plane(),
            Order::Second(_) => a.d < R::ZERO,
            Order::First(_) if self.bracket.round >= 2 => false,
            Order::First(_) => a.v <= R::ZERO && b.v <= R::ZERO,
        };
        // It has to fall by more than rounding up to the end.
        let least = match track.order {
            Order::Second(_) => -R::of_products(),
            Order::First(_) => a.v.max(R::ZERO),
        };
        let is_zero = a.v <= track.level(R::of_products());
        self.bracket.certain == R::ZERO && is_zero && b.v < least && falls
    }
    /// A zero beyond the end of the search is none (R10); gaps that are closed within their accuracy are closed.
    fn is_reached(&self, track: &Track<R>, newton: R) -> bool {
        let is_closed = track.end.v <= track.level(R::ZERO);
        if self.bracket.branch.is_none() {
            return is_closed || self.bracket.hi + newton <= self.bracket.end;
        }
        // Along u the search ends where p does.
        let path = self.hi.values.get(Values::<R>::PATH);
        path.d >= R::ZERO || newton <= path.v / -path.d || is_closed && path.v >= R::ZERO
    }
    /// One more step of Newton's iteration from the end of the window leads to the zero.
    fn is_hit(&self, found: &mut Found<R>, track: &Track<R>, newton: R) -> bool {
        let tol = track.accuracy();
        let (a, b) = (track.begin, track.end);
        let is_earlier = found.is_preceded(track.ending, tol, |dx| b.v + self.slope(track) * dx);
        let Order::Second(k) = track.order else {
            return false;
        };
        let is_inside = self.is_reached(track, newton);
        let is_first = is_earlier && (a.v > tol || b.v.abs() <= tol);
        if !is_first || !is_inside || !self.is_last(track, k, newton) {
            return false;
        }
        found.hit = Some((track.ending, newton));
        let begin = a.v.max(R::ZERO);
        found.unsure |= k > tol.doubled() && a.v > tol && certainty(begin, b.v, k) < R::ONE;
        true
    }
    /// The second order of a step of Newton's iteration from the end of the window is less than the accuracy of the function.
    fn is_last(&self, track: &Track<R>, bend: R, newton: R) -> bool {
        let part = newton / self.bracket.width();
        let is_near = part.abs() <= R::ONE / R::from_int(16);
        is_near && bend * part * part <= track.accuracy().doubled()
    }
    /// How fast it changes at the end of the window, or on it; that of -E_u is its chord's.
    fn slope(&self, track: &Track<R>) -> R {
        match track.order {
            Order::Second(_) if track.ending != Ending::Fold => track.end.d,
            Order::Second(_) | Order::First(_) => {
                (track.end.v - track.begin.v) / self.bracket.width()
            }
        }
    }
    /// Where what is below zero at the end crosses zero, by Newton's step or the chord.
    pub(crate) fn crossing(&self, track: &Track<R>) -> R {
        let (x0, w) = (self.bracket.certain, self.bracket.width());
        let (slope, end) = (self.slope(track), track.end.v);
        let is_newton = match track.order {
            Order::Second(_) => slope < R::ZERO && self.bracket.round % 4 != 3,
            Order::First(_) => false,
        };
        let by_newton = x0 + w - end / slope;
        if is_newton && by_newton > x0 {
            return by_newton;
        }
        let begin = track.begin.v.max(R::ZERO);
        x0 + w * (begin / (begin - end))
    }
    /// One event function on the window.
    pub(crate) fn judge(&self, found: &mut Found<R>, track: &Track<R>) {
        let tol = track.accuracy();
        let w = self.bracket.width();
        let (a, b) = (track.begin, track.end);
        let begin = a.v.max(R::ZERO);
        let slope = self.slope(track);
        let newton = -b.v / slope;
        if slope < R::ZERO && self.is_hit(found, track, newton) {
            return;
        }
        if b.v < -tol {
            found.crosses(track.ending, self.crossing(track));
            return;
        }
        // f >= v0 + v0' x + least x²/2, which is least at an end or at both.
        let from_begin = a.v + a.d * w + track.least.min(R::ZERO).halved();
        let is_certain = a.v >= -tol && from_begin >= -tol;
        match track.order {
            Order::First(k) => {
                // The last step is that of the chord.
                let is_near = newton <= w / R::from_int(16);
                let is_earlier = found.is_preceded(track.ending, tol, |dx| b.v + slope * dx);
                let is_here = b.v <= tol && slope < R::ZERO && is_near;
                if is_earlier && is_here && self.is_reached(track, newton) {
                    found.hit = Some((track.ending, newton));
                }
                let sum = begin + b.v.max(R::ZERO);
                if sum < k {
                    found.unsure = true;
                    found.part = found.part.min(sum / k);
                }
            }
            Order::Second(k) => {
                if b.v <= tol && slope < -R::standstill() && self.is_reached(track, newton) {
                    let step = if self.is_last(track, k, newton) {
                        newton
                    } else {
                        R::ZERO
                    };
                    found.hit = found.hit.or(Some((track.ending, step)));
                }
                let is_open = a.v > tol || b.v > tol;
                if is_open && k > tol.doubled() && !is_certain {
                    let part = certainty(begin, b.v, k);
                    found.unsure |= part < R::ONE;
                    let part = if a.v > tol && self.bracket.round % 4 != 3 {
                        part
                    } else {
                        part.min(by_begin(a, k, w))
                    };
                    found.part = found.part.min(part);
                }
            }
        }
    }
}

/// The gap of a contact with its velocity.
pub(crate) fn gap_at<R: Real, const V: usize, const S: usize, const C: usize>(
    statics: &Statics<'_, R, V, S, C>,
    feature: Feature,
    end: &WindowEnd<R>,
) -> Value<R> {
    let i = &end.instant;
    let contact = Contact::at(feature);
    let frame = statics.frame(contact, i.rotation, i.g);
    Value {
        v: statics.gap_of(contact, &frame, i.rotation, i.g),
        d: frame.opening(end.rates.g, end.rates.theta),
    }
}

/// Positive on the whole window by its end alone, whatever is at the beginning (R3).
fn is_clear<R: Real>(end: R, order: &Order<R>) -> bool {
    let enough = match *order {
        Order::Second(k) => k.halved(),
        Order::First(k) => k,
    };
    end > R::zero() && end >= enough
}

/// The part x of a window of this width up to which v0 + v0' x - K x²/2 is not negative by more than its accuracy. What opens from zero, or
/// from next to it, with a velocity of zero is no more certain on a shorter window by (R2), until its second order is as small.
fn by_begin<R: Real>(begin: Value<R>, k: R, width: R) -> R {
    let slope = begin.d * width;
    let above = begin.v.max(R::ZERO) + R::zero();
    (slope + R::sum_of_products(slope, slope, k.doubled(), above).sqrt()) / k
}

/// sqrt v0 + sqrt v1 over sqrt(K/2): a function is nowhere less than zero by more than its accuracy if this is 1 or more (R2). A gap that
/// opens from zero without a velocity is certified thereby.
fn certainty<R: Real>(v0: R, v1: R, k: R) -> R {
    let root = |v: R| (v.max(R::ZERO) + R::zero()).sqrt();
    (root(v0) + root(v1)) / k.halved().sqrt()
}
