//! One search for all motions: to the first event. A window of the motion is certain if every event function stays positive on it: its
//! values at both ends exceed the sagitta that its bound of the second derivative permits (ONE 5, 6).

use crate::bounds::{Begin, Extent, Pace};
use crate::contact::{Contact, Feature};
use crate::events::{Ending, Judging, Order, Value, Values, Watch, Watched, Which};
use crate::geometry::Vec2;
use crate::motion::{Instant, Kind, Motion, Rates, Spot};
use crate::real::Real;
use crate::state::Body;
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// After this many rounds a search returns what is certain.
const ROUNDS: u8 = 40;
/// After this many windows without a branch in p the search goes along u.
const REFUSALS: u8 = 3;

/// How a search ended: at which end of its last window, at which x (or p, if it went along u), how far nothing else is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ended<R> {
    pub(crate) at: Which,
    pub(crate) x: R,
    pub(crate) ending: Ending,
    pub(crate) room: R,
}

/// One end of a window.
#[derive(Clone, Copy, Debug)]
struct WindowEnd<R> {
    instant: Instant<R>,
    rates: Rates<R>,
    values: Values<R>,
}

/// Near a fold the same curve along u: u and p where that begins, the direction of u.
#[derive(Clone, Copy, Debug)]
struct Branch<R> {
    u: R,
    p: R,
    direction: R,
}

/// A search between two evaluations: plain data.
#[derive(Clone, Copy, Debug)]
struct Bracket<R> {
    /// The motion is certain up to here; the next window ends at `hi`, the search at `end`.
    certain: R,
    hi: R,
    end: R,
    /// Which end of the last window is the certain one, and whether it is evaluated.
    low: Which,
    is_known: bool,
    /// The least hi that was too far.
    bad: R,
    room: R,
    round: u8,
    refusals: u8,
    /// The first window is to be that of the tangents' estimate.
    eager: bool,
    shrunk: bool,
    branch: Option<Branch<R>>,
    /// The end of p if the search goes along u.
    stop: R,
}

/// A motion that is searched for its first event.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search<R> {
    pub(crate) motion: Motion<R>,
    pub(crate) watch: Watch,
    u0: R,
    direction: R,
    bracket: Bracket<R>,
    first: WindowEnd<R>,
    second: WindowEnd<R>,
}

impl<R: Real> WindowEnd<R> {
    const NONE: Self = Self {
        instant: Instant::ZERO,
        rates: Rates {
            u: R::ZERO,
            p: R::ZERO,
            g: Vec2::ZERO,
            theta: R::ZERO,
            xi: R::ZERO,
            force: Vec2::ZERO,
            moment: R::ZERO,
        },
        values: Values::NONE,
    };
}

impl<R: Real> Search<R> {
    /// No search yet.
    pub(crate) const fn none(motion: Motion<R>) -> Self {
        Self {
            motion,
            watch: Watch::Way,
            u0: R::ZERO,
            direction: R::ONE,
            bracket: Bracket::new(R::ONE, false, R::ZERO),
            first: WindowEnd::NONE,
            second: WindowEnd::NONE,
        }
    }
    /// A search of x from 0 to `end` along a motion; if it is eager, beginning with the tangents' estimate. No other contact than those of
    /// the body is closer than `room`.
    pub(crate) fn begin(&mut self, motion: Motion<R>, watch: Watch, end: R, eager: bool) {
        self.u0 = match motion.kind {
            Kind::Line | Kind::Pair => R::ZERO,
            Kind::Free | Kind::Pin | Kind::Slide => motion.angle,
        };
        (self.motion, self.watch, self.direction) = (motion, watch, R::ONE);
        self.bracket = Bracket::new(end, eager, R::ZERO);
    }
    /// The search of a frozen motion goes in the direction of this sign of u.
    pub(crate) fn toward(&mut self, direction: R) {
        self.direction = direction;
    }
    pub(crate) fn with_room(&mut self, room: R) {
        self.bracket.room = room;
    }
    /// An end of the last window.
    pub(crate) fn instant(&self, at: Which) -> &Instant<R> {
        match at {
            Which::First => &self.first.instant,
            Which::Second => &self.second.instant,
        }
    }
    /// The last point up to which nothing has happened, if it is beyond the beginning.
    pub(crate) fn certain(&self) -> Option<&Instant<R>> {
        let is_beyond = self.bracket.certain > R::ZERO && self.bracket.is_known;
        is_beyond.then(|| self.instant(self.bracket.low))
    }

    /// One window: what ends the motion, if that is found.
    #[inline(never)]
    pub(crate) fn piece<const V: usize, const S: usize, const C: usize>(
        &mut self,
        statics: &Statics<'_, R, V, S, C>,
        body: &Body<R>,
        evaluations: &mut u32,
    ) -> Option<Ended<R>> {
        let (lo, hi) = match self.bracket.low {
            Which::First => (&mut self.first, &mut self.second),
            Which::Second => (&mut self.second, &mut self.first),
        };
        let mut run = Run {
            watched: Watched {
                statics,
                body,
                motion: &self.motion,
                watch: self.watch,
                direction: self.direction,
            },
            u0: self.u0,
            bracket: &mut self.bracket,
            lo,
            hi,
            evaluations,
        };
        let mut ended = run.round()?;
        if self.bracket.branch.is_some() {
            ended.x = if ended.ending == Ending::End {
                self.bracket.stop
            } else {
                self.instant(ended.at).p
            };
        }
        Some(ended)
    }
}

impl<R: Real> Bracket<R> {
    const fn new(end: R, eager: bool, room: R) -> Self {
        Self {
            certain: R::ZERO,
            hi: end,
            end,
            low: Which::First,
            is_known: false,
            bad: R::HUGE,
            room,
            round: 0,
            refusals: 0,
            eager,
            shrunk: false,
            branch: None,
            stop: end,
        }
    }
    fn width(&self) -> R {
        self.hi - self.certain
    }
}

/// The findings on a window.
struct Found<R> {
    /// Where the first crossing is estimated, and what crosses first in the order of the functions.
    cross: R,
    crossing: Option<Ending>,
    /// What is zero at the end, or at a last Newton step from it.
    hit: Option<(Ending, R)>,
    unsure: bool,
    /// What part of the window would be certain by its bounds.
    part: R,
}

/// An event function at both ends of a window.
struct Track<R> {
    ending: Ending,
    begin: Value<R>,
    end: Value<R>,
    order: Order<R>,
    /// Its second derivative is at least this.
    least: R,
}

struct Run<'a, R, const V: usize, const S: usize, const C: usize> {
    watched: Watched<'a, R, V, S, C>,
    u0: R,
    bracket: &'a mut Bracket<R>,
    lo: &'a mut WindowEnd<R>,
    hi: &'a mut WindowEnd<R>,
    evaluations: &'a mut u32,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Run<'_, R, V, S, C> {
    fn round(&mut self) -> Option<Ended<R>> {
        if self.bracket.eager {
            self.bracket.eager = false;
            self.know_low();
            self.bracket.hi = estimate(self.lo, self.bracket.certain, self.bracket.end);
            return None;
        }
        if self.bracket.round >= ROUNDS {
            return Some(self.ended_low(Ending::GoesOn, R::ZERO));
        }
        let ended = self.window();
        self.bracket.round = self.bracket.round.saturating_add(1);
        ended
    }

    /// The motion ends where it is certain.
    fn ended_low(&mut self, ending: Ending, room: R) -> Ended<R> {
        self.know_low();
        Ended {
            at: self.bracket.low,
            x: self.bracket.certain,
            ending,
            room,
        }
    }
    fn ended_high(&self, ending: Ending, x: R, room: R) -> Ended<R> {
        Ended {
            at: self.bracket.low.other(),
            x,
            ending,
            room,
        }
    }
    /// The beginning of the window, evaluated once.
    #[inline(never)]
    fn know_low(&mut self) {
        if self.bracket.is_known {
            return;
        }
        self.bracket.is_known = true;
        *self.evaluations = self.evaluations.saturating_add(1);
        let spot = match &self.bracket.branch {
            Some(branch) => Spot {
                u: branch.u,
                p: branch.p,
            },
            None => Spot {
                u: self.u0,
                p: R::ZERO,
            },
        };
        let Watched {
            statics, motion, ..
        } = self.watched;
        statics.place(motion, spot, None, &mut self.lo.instant);
        finish(&self.watched, self.bracket, self.lo);
    }

    /// Places the body at x, from where the motion is certain; bounds of the window in between, or the part of it that may be certain.
    fn place(&mut self, x: R) -> Result<Judging<R>, R> {
        *self.evaluations = self.evaluations.saturating_add(1);
        let Watched {
            statics,
            motion,
            body,
            direction,
            ..
        } = self.watched;
        let width = x - self.bracket.certain;
        if let Some(branch) = self.bracket.branch {
            return self.place_along_u(branch, x);
        }
        let (pace, drive) = if motion.frozen {
            let u = self.u0 + direction * x;
            let spot = Spot { u, p: R::ZERO };
            statics.place(motion, spot, None, &mut self.hi.instant);
            let extent = Extent {
                way: R::ZERO,
                strip: width,
            };
            let curvature = statics.curvature(motion, &self.hi.instant, extent);
            let pace = Pace {
                rate: width,
                bent: R::ZERO,
                mixed: curvature.j,
                extent,
            };
            (pace, curvature.k * width * width)
        } else {
            let begin = if self.bracket.is_known {
                Begin::At(&self.lo.instant)
            } else {
                Begin::Spot {
                    spot: Spot {
                        u: self.u0,
                        p: self.bracket.certain,
                    },
                    rotation: body.rotation,
                }
            };
            (
                statics.window(motion, begin, x, &mut self.hi.instant)?,
                R::ZERO,
            )
        };
        let instant = &self.hi.instant;
        Ok(Judging {
            bound: statics.bound(motion, instant, &pace),
            pace,
            p_bend: R::ZERO,
            drive,
            stable: R::ZERO,
            width,
        })
    }
    /// A point of a curve by its u: E is linear in p. Bounds by (U4).
    fn place_along_u(&mut self, branch: Branch<R>, x: R) -> Result<Judging<R>, R> {
        let Watched {
            statics, motion, ..
        } = self.watched;
        let width = x - self.bracket.certain;
        let u = branch.u + branch.direction * x;
        let i = &mut self.hi.instant;
        let mut p = branch.p;
        statics.place(motion, Spot { u, p }, None, i);
        // Once, but for the slide of a C, whose E is quadratic in p.
        for _ in 0..3 {
            let step = -i.e / i.e_p;
            p = p + step;
            let known = (motion.kind != Kind::Pair).then_some(i.rotation);
            statics.place(motion, Spot { u, p }, known, i);
            if motion.kind != Kind::Slide || !motion.first().is_corner() {
                break;
            }
        }
        let extent = Extent {
            way: (p - branch.p).abs(),
            strip: width,
        };
        let curvature = statics.curvature(motion, i, extent);
        let (k, j) = (curvature.k, curvature.j);
        let least = i.e_p.abs() - j * width * (R::TWO + width);
        if least < i.e_p.abs().halved() {
            let part = i.e_p.abs().halved() / (j * width * (R::TWO + width));
            return Err(part.max(R::ONE / R::from_int(8)).min(R::HALF));
        }
        // (U4)
        let inverse = R::ONE / least;
        let rate = (i.e_u.abs() + k * width) * inverse;
        let bend = (k + j * rate * (width + R::TWO)) * inverse;
        let square = width * width;
        let pace = Pace {
            rate: width,
            bent: R::ZERO,
            mixed: j,
            extent: Extent {
                way: rate * width,
                strip: width,
            },
        };
        let p_bend = bend * square;
        let go = motion.drive() * p_bend;
        let mut bound = statics.bound(motion, i, &pace);
        bound.pivot = bound.pivot + go.doubled();
        bound.holding = bound.holding + go.doubled();
        Ok(Judging {
            bound,
            pace,
            p_bend,
            drive: R::ZERO,
            stable: (k.doubled() + (j * rate).doubled() + j * bend) * square,
            width,
        })
    }

    /// One window; what it began with is evaluated only where it is needed.
    fn window(&mut self) -> Option<Ended<R>> {
        let on = match self.place(self.bracket.hi) {
            Ok(on) => on,
            Err(part) => return self.refused(part),
        };
        finish(&self.watched, self.bracket, self.hi);
        let mut found = Found {
            cross: R::HUGE,
            crossing: None,
            hit: None,
            unsure: false,
            part: R::ONE,
        };
        if let Some(ended) = self.judge_functions(&on, &mut found) {
            return Some(ended);
        }
        let mut room = self.bracket.room - on.bound.way;
        if room <= R::ZERO {
            room = R::HUGE;
            if let Some(ended) = self.judge_gaps(&on, &mut room, &mut found) {
                return Some(ended);
            }
        }
        if found.crossing.is_some() || found.unsure {
            return self.shrink(&found);
        }
        self.go_on(&found, &on, room)
    }
    /// There may be no single branch on the window.
    fn refused(&mut self, part: R) -> Option<Ended<R>> {
        let motion = self.watched.motion;
        let width = self.bracket.width();
        self.bracket.refusals = self.bracket.refusals.saturating_add(1);
        if self.bracket.refusals >= REFUSALS && !motion.frozen && self.bracket.branch.is_none() {
            self.know_low();
            let l = &self.lo.instant;
            if l.e_p != R::ZERO && l.e_u < R::ZERO {
                let begin = (width * part * l.e_p / l.e_u).abs().min(R::HALF.halved());
                let reach = if motion.kind == Kind::Pair {
                    motion.pair.reach
                } else {
                    R::from_int(64)
                };
                let branch = Branch {
                    u: l.u,
                    p: l.p,
                    direction: l.e_p.sign(),
                };
                *self.bracket = Bracket {
                    hi: begin.min(reach),
                    end: reach,
                    stop: self.bracket.end,
                    certain: R::ZERO,
                    bad: R::HUGE,
                    branch: Some(branch),
                    is_known: false,
                    ..*self.bracket
                };
                self.know_low();
                return None;
            }
        }
        if width <= R::shortest_window().min(self.bracket.end.halved()) {
            return Some(self.ended_low(Ending::Fold, R::ZERO));
        }
        self.bracket.hi = self.bracket.certain + width * part;
        self.bracket.shrunk = true;
        None
    }
    /// All functions but gaps; what is over at the very beginning ends the motion there.
    fn judge_functions(&mut self, on: &Judging<R>, found: &mut Found<R>) -> Option<Ended<R>> {
        let along_u = self.bracket.branch.is_some();
        for (place, function) in self.watched.functions(along_u) {
            let end = self.hi.values.get(place);
            let order = self.watched.order(function, &self.hi.instant, on);
            if is_clear(end.v, &order) {
                continue;
            }
            self.know_low();
            let begin = self.lo.values.get(place);
            // The slide of a slip that was as long goes on: a crossing, not a level (rule 10f).
            if function == crate::events::Function::Memory && begin.v <= R::ZERO {
                continue;
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
    fn judge_gaps(
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
                if body.contacts.contains(feature) {
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
        None
    }
    /// A lower bound of the second derivative of a gap: if the body turns about a fixed or straight moving point it is -n·R a theta'².
    fn least_bend(&self, on: &Judging<R>, normal: Vec2<R>, arm: Vec2<R>) -> R {
        let motion = self.watched.motion;
        let turn = match motion.kind {
            Kind::Line => motion.line.theta_u.abs() * on.width,
            Kind::Pin if motion.frozen && !motion.first().is_corner() => on.width,
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
        self.bracket.certain == R::ZERO && a.v <= R::zero() && b.v < a.v.max(R::ZERO) && falls
    }
    /// One event function on the window.
    fn judge(&self, found: &mut Found<R>, track: &Track<R>) {
        let tol = R::zero();
        let (x0, w) = (self.bracket.certain, self.bracket.width());
        let (a, b) = (track.begin, track.end);
        let begin = a.v.max(R::ZERO);
        let slope = match track.order {
            Order::Second(_) => b.d,
            Order::First(_) => (b.v - a.v) / w,
        };
        let newton = -b.v / slope;
        if let Order::Second(k) = track.order
            && slope < R::ZERO
            && found.hit.is_none()
            && (a.v > tol || b.v.abs() <= tol)
        {
            // One more step of Newton's iteration leads to the zero.
            let part = newton / w;
            let is_near = part.abs() <= R::ONE / R::from_int(16);
            let is_inside = x0 + w + newton <= self.bracket.end || b.v.abs() <= tol;
            if is_near && k * part * part <= tol.doubled() && is_inside {
                found.hit = Some((track.ending, newton));
                found.unsure |= k > tol.doubled() && a.v > tol && certainty(begin, b.v, k) < R::ONE;
                return;
            }
        }
        if b.v < -tol {
            let chord = x0 + w * (begin / (begin - b.v));
            let is_newton = match track.order {
                Order::Second(_) => slope < R::ZERO && self.bracket.round % 4 != 3,
                Order::First(_) => false,
            };
            let by_newton = x0 + w + newton;
            let at = if is_newton && by_newton > x0 {
                by_newton
            } else {
                chord
            };
            found.cross = found.cross.min(at);
            found.crossing = found.crossing.or(Some(track.ending));
            return;
        }
        // f >= v0 + v0' x + least x²/2, which is least at an end or at both.
        let from_begin = a.v + a.d * w + track.least.min(R::ZERO).halved();
        let is_certain = a.v >= -tol && from_begin >= -tol;
        match track.order {
            Order::First(k) => {
                if b.v <= tol {
                    found.hit = found.hit.or(Some((track.ending, R::ZERO)));
                }
                found.unsure |= begin + b.v.max(R::ZERO) < k;
            }
            Order::Second(k) => {
                if b.v <= tol && slope < -R::standstill() {
                    found.hit = found.hit.or(Some((track.ending, newton)));
                }
                let is_open = a.v > tol || b.v > tol;
                if is_open && k > tol.doubled() && !is_certain {
                    let part = certainty(begin, b.v, k);
                    found.unsure |= part < R::ONE;
                    found.part = found.part.min(part);
                }
            }
        }
    }
    /// The window is too wide, or something crosses zero on it.
    fn shrink(&mut self, found: &Found<R>) -> Option<Ended<R>> {
        let b = &mut *self.bracket;
        let w = b.width();
        if found.crossing.is_some() {
            b.bad = b.bad.min(b.hi);
        }
        if w <= R::standstill() * (R::ONE + b.hi) {
            let hit = found.hit.map(|(ending, _)| ending);
            let ending = found.crossing.or(hit).unwrap_or(Ending::GoesOn);
            let x = b.hi;
            return Some(self.ended_high(ending, x, R::ZERO));
        }
        let part = if found.part < R::ONE {
            let eighth = R::ONE / R::from_int(8);
            (found.part - found.part * eighth).max(eighth)
        } else {
            R::HALF
        };
        let middle = b.certain + w * part;
        b.shrunk = true;
        let mut hi = match (found.crossing.is_some(), found.unsure) {
            (true, true) => found.cross.min(middle),
            (true, false) => found.cross,
            (false, _) => middle,
        };
        if hi <= b.certain {
            hi = b.certain + w * R::EPSILON.sqrt();
        }
        if hi >= b.hi {
            hi = middle;
        }
        b.hi = hi;
        None
    }
    /// The window is certain: the motion ends at its end, or the next window begins there.
    fn go_on(&mut self, found: &Found<R>, on: &Judging<R>, room: R) -> Option<Ended<R>> {
        self.bracket.room = room;
        let (hi, w, end) = (self.bracket.hi, self.bracket.width(), self.bracket.end);
        if let Some((ending, dx)) = found.hit {
            let left = room - R::zero();
            // The last step of Newton's iteration: what remains is rounding.
            let x = hi + dx;
            let is_step = dx != R::ZERO && x > self.bracket.certain && x <= end;
            if is_step && (self.place(x).is_ok() || self.bracket.branch.is_some()) {
                let left = left - dx.abs() * (R::ONE + on.bound.way / w);
                return Some(self.ended_high(ending, x, left));
            }
            return Some(self.ended_high(ending, hi, left));
        }
        if hi >= end {
            // Along u the end is that of the bounds.
            let ending = if self.bracket.branch.is_some() {
                Ending::GoesOn
            } else {
                Ending::End
            };
            return Some(self.ended_high(ending, hi, room));
        }
        if self.is_beyond_reach() {
            return Some(self.ended_high(Ending::GoesOn, hi, room));
        }
        let b = &mut *self.bracket;
        let growth = if b.shrunk {
            w + w.halved().halved()
        } else {
            w.doubled().doubled()
        };
        b.certain = hi;
        b.hi = estimate(self.hi, hi, end).min(end).min(hi + growth);
        b.shrunk = false;
        if b.bad < R::HUGE && b.hi >= b.bad {
            b.hi = if b.bad > hi {
                hi + (b.bad - hi).halved()
            } else {
                (hi + w).min(end)
            };
        }
        b.low = b.low.other();
        b.is_known = true;
        None
    }
    /// The position of a pair on a path is known no farther.
    fn is_beyond_reach(&self) -> bool {
        let motion = self.watched.motion;
        motion.kind == Kind::Pair
            && !motion.frozen
            && self.hi.instant.u.abs() > motion.pair.reach.halved()
    }
}

/// The rest of a window's end from its instant.
fn finish<R: Real, const V: usize, const S: usize, const C: usize>(
    watched: &Watched<'_, R, V, S, C>,
    bracket: &Bracket<R>,
    end: &mut WindowEnd<R>,
) {
    let (statics, motion, i) = (watched.statics, watched.motion, &end.instant);
    let mut stop = None;
    end.rates = match &bracket.branch {
        Some(branch) => {
            stop = Some(bracket.stop);
            let p = -i.e_u / i.e_p * branch.direction;
            statics.rates_of(motion, i, branch.direction, p)
        }
        None if motion.frozen => statics.rates_of(motion, i, watched.direction, R::ZERO),
        None => statics.rates(motion, i),
    };
    watched.values(i, &end.rates, stop, &mut end.values);
}

/// The gap of a contact with its velocity.
fn gap_at<R: Real, const V: usize, const S: usize, const C: usize>(
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

/// Positive on the whole window by its end alone, whatever is at the beginning (ONE 5).
fn is_clear<R: Real>(end: R, order: &Order<R>) -> bool {
    let enough = match *order {
        Order::Second(k) => k.halved(),
        Order::First(k) => k,
    };
    end > R::zero() && end >= enough
}

/// sqrt v0 + sqrt v1 over sqrt(K/2): a function is nowhere less than zero by more than its accuracy if this is 1 or more (ONE 5). A gap that
/// opens from zero without a velocity is certified thereby.
fn certainty<R: Real>(v0: R, v1: R, k: R) -> R {
    let root = |v: R| (v.max(R::ZERO) + R::zero()).sqrt();
    (root(v0) + root(v1)) / k.halved().sqrt()
}

/// Where the first event is by tangents.
fn estimate<R: Real>(from: &WindowEnd<R>, x0: R, end: R) -> R {
    let mut best = end;
    for value in from.values.iter() {
        if value.d < R::ZERO && value.v > R::ZERO && value.v < (best - x0) * -value.d {
            best = best.min(x0 - value.v / value.d);
        }
    }
    best.max(x0 + (end - x0) * R::TOUCH)
}
