//! One search for all motions: to the first event. A window of the motion is certain if every event function stays positive on it: its
//! values at both ends exceed the sagitta that its bound of the second derivative permits (STATICS 5, 6).

pub(crate) use crate::bracket::{Bracket, Branch, WindowEnd, Windows};
use crate::events::{Ending, Judging, Watch, Watched, Which};
use crate::found::Found;
use crate::judge::gap_at;
use crate::motion::{Instant, Kind, Motion, Spot};
use crate::real::Real;
use crate::sample::{estimate, finish};
use crate::state::Body;
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// After this many rounds a search returns what is certain.
const ROUNDS: u8 = 40;
/// In the last of them a window on which something crosses zero is followed by one of at most half its length.
const LAST_ROUNDS: u8 = 8;

/// How a search ended: at which end of its last window, at which x (or p, if it went along u), how far nothing else is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ended<R> {
    pub(crate) at: Which,
    pub(crate) x: R,
    pub(crate) ending: Ending,
    pub(crate) room: R,
}

/// A motion that is searched for its first event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Search<R> {
    pub(crate) motion: Motion<R>,
    pub(crate) watch: Watch,
    /// A frozen motion goes against u.
    backwards: bool,
    bracket: Bracket<R>,
}

impl<R: Real> Search<R> {
    /// No search yet.
    pub(crate) const fn none(motion: Motion<R>) -> Self {
        Self {
            motion,
            watch: Watch::Way,
            backwards: false,
            bracket: Bracket::new(R::ONE, false, R::ZERO),
        }
    }
    /// A search of x from 0 to `end` along a motion; if it is eager, beginning with the tangents' estimate. No other contact than those of
    /// the body is closer than `room`.
    pub(crate) fn begin(&mut self, motion: Motion<R>, watch: Watch, end: R, eager: bool) {
        (self.motion, self.watch, self.backwards) = (motion, watch, false);
        self.bracket = Bracket::new(end, eager, R::ZERO);
    }
    /// The search of a frozen motion goes in the direction of this sign of u.
    pub(crate) fn toward(&mut self, direction: R) {
        self.backwards = direction < R::ZERO;
    }
    pub(crate) fn with_room(&mut self, room: R) {
        self.bracket.room = room;
    }
    /// The last point up to which nothing has happened, if it is beyond the beginning.
    pub(crate) fn certain<'a, const V: usize, const S: usize, const C: usize>(
        &mut self,
        statics: &Statics<'_, R, V, S, C>,
        body: &Body<R>,
        windows: &'a mut Windows<R>,
    ) -> Option<&'a Instant<R>> {
        let is_beyond = self.bracket.certain > R::ZERO && self.bracket.is_known;
        is_beyond.then(|| {
            self.recall(statics, body, windows);
            windows.instant(self.bracket.low)
        })
    }
    /// What was known between two steps is evaluated again.
    pub(crate) fn recall<const V: usize, const S: usize, const C: usize>(
        &mut self,
        statics: &Statics<'_, R, V, S, C>,
        body: &Body<R>,
        windows: &mut Windows<R>,
    ) {
        if self.bracket.is_known {
            self.run(statics, body, windows).recall_low();
        }
    }
    fn run<'a, const V: usize, const S: usize, const C: usize>(
        &'a mut self,
        statics: &'a Statics<'a, R, V, S, C>,
        body: &'a Body<R>,
        windows: &'a mut Windows<R>,
    ) -> Run<'a, R, V, S, C> {
        let (lo, hi) = match self.bracket.low {
            Which::First => (&mut windows.first, &mut windows.second),
            Which::Second => (&mut windows.second, &mut windows.first),
        };
        Run {
            watched: Watched {
                statics,
                body,
                motion: &self.motion,
                watch: self.watch,
                direction: if self.backwards { -R::ONE } else { R::ONE },
            },
            u0: match self.motion.kind {
                Kind::Line | Kind::Pair => R::ZERO,
                Kind::Free | Kind::Pin | Kind::Slide => self.motion.angle,
            },
            bracket: &mut self.bracket,
            lo,
            hi,
        }
    }
    /// One window: what ends the motion, if that is found.
    #[inline(never)]
    pub(crate) fn piece<const V: usize, const S: usize, const C: usize>(
        &mut self,
        statics: &Statics<'_, R, V, S, C>,
        body: &Body<R>,
        windows: &mut Windows<R>,
    ) -> Option<Ended<R>> {
        let mut ended = self.run(statics, body, windows).round()?;
        if self.bracket.branch.is_some() {
            let (instant, stop) = (windows.instant_mut(ended.at), self.bracket.stop);
            if (instant.p - stop) * self.motion.hand_p.size() > R::TOUCH {
                // By more than u knows p: it has not happened (R10).
                (ended.ending, ended.room) = (Ending::End, R::ZERO);
            }
            if ended.ending == Ending::End {
                // Where E hardly depends on p, u tells p no better than rounding, or than what a search before left of E: the hand is where
                // its path ends.
                let (u, p) = (instant.u, stop);
                statics.place(&self.motion, Spot { u, p }, None, instant);
            }
            ended.x = instant.p;
        }
        Some(ended)
    }
}

pub(crate) struct Run<'a, R, const V: usize, const S: usize, const C: usize> {
    pub(crate) watched: Watched<'a, R, V, S, C>,
    pub(crate) u0: R,
    pub(crate) bracket: &'a mut Bracket<R>,
    pub(crate) lo: &'a mut WindowEnd<R>,
    pub(crate) hi: &'a mut WindowEnd<R>,
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
    pub(crate) fn ended_low(&mut self, ending: Ending, room: R) -> Ended<R> {
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
    /// One window; what it began with is evaluated only where it is needed.
    fn window(&mut self) -> Option<Ended<R>> {
        let mut on = Judging::new();
        if let Err(part) = self.place(self.bracket.hi, &mut on) {
            return self.refused(part);
        }
        finish(&self.watched, self.bracket, self.hi);
        let mut found = Found::NONE;
        if let Some(ended) = self.judge_functions(&on, &mut found) {
            return Some(ended);
        }
        if C > 0
            && let Some(ended) = self.judge_ends(&on, &mut found)
        {
            return Some(ended);
        }
        let mut room = self.bracket.room - on.bound.way;
        if room <= self.watched.statics.rounding_at(&self.hi.instant) {
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
    /// The window is too wide, or something crosses zero on it.
    fn shrink(&mut self, found: &Found<R>) -> Option<Ended<R>> {
        let b = &mut *self.bracket;
        let w = b.width();
        if found.crossing.is_some() {
            b.bad = b.bad.min(b.hi);
        }
        if b.is_shortest() {
            let ending = found.ending();
            if self.watched.statics.world.has_obstacles() && ending.is_touch() {
                // Before it: behind it the foot may be beyond the end of its side.
                return Some(self.ended_low(ending, R::ZERO));
            }
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
        // Where a function only just crosses zero, its crossing may be estimated a little closer each time: the last rounds find a window that
        // is certain.
        let is_late = b.round >= ROUNDS - LAST_ROUNDS;
        b.shrunk = true;
        let mut hi = match (found.crossing.is_some(), found.unsure || is_late) {
            (true, true) => found.cross.min(middle),
            (true, false) => found.cross,
            (false, _) => middle,
        };
        if hi <= b.certain {
            hi = b.certain + w * R::EPSILON.sqrt();
            if hi <= b.certain {
                // No number is in between: it happens at the beginning.
                return Some(self.ended_low(found.crossing.unwrap_or(Ending::GoesOn), R::ZERO));
            }
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
            let left = left - dx.abs() * (R::ONE + on.bound.way / w);
            if is_step && dx > R::ZERO && (left < -R::TOUCH || self.leads_beyond(dx)) {
                if self.is_closed(ending) {
                    // A longer window only tells how its gap rounds.
                    return Some(self.ended_high(ending, hi, left));
                }
                let next = x.min(hi + (self.bracket.bad - hi).halved());
                if next > hi && next < self.bracket.bad {
                    self.bracket.hi = next;
                    return None;
                }
                // No number is in between.
                return Some(self.ended_high(ending, hi, left));
            }
            if is_step {
                self.step_on(dx);
            }
            return Some(self.ended_high(ending, if is_step { x } else { hi }, left));
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
            let middle = hi + (b.bad - hi).halved();
            b.hi = if middle > hi {
                middle
            } else {
                (hi + w).min(end)
            };
        }
        (b.low, b.placed) = (b.low.other(), self.hi.instant.placed);
        b.is_known = true;
        None
    }
    /// What touches has no gap at the end of the window, within its accuracy.
    fn is_closed(&self, ending: Ending) -> bool {
        matches!(ending, Ending::Touch(feature) if gap_at(self.watched.statics, feature, self.hi).v <= R::zero())
    }
    /// A step beyond the window leads to where something else is over, by the tangents: a window up to there tells which is first.
    fn leads_beyond(&self, dx: R) -> bool {
        let below = -R::zero();
        (self.hi.values.iter()).any(|f| f.d < R::ZERO && f.v >= below && f.v + f.d * dx < below)
            || C > 0 && self.leads_off(dx)
    }
    /// The position of a pair on a path is known no farther.
    fn is_beyond_reach(&self) -> bool {
        let motion = self.watched.motion;
        motion.kind == Kind::Pair
            && !motion.frozen
            && self.hi.instant.u.abs() > motion.pair.reach.halved()
    }
}
