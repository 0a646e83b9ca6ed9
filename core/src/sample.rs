//! The ends of a search's windows: where the body is there, and the bounds in between.

use crate::bounds::{Extent, Pace};
use crate::events::{Ending, Judging, Watched};
use crate::motion::{Instant, Kind, Motion, Spot};
use crate::real::Real;
use crate::search::{Bracket, Branch, Ended, Run, WindowEnd};
use crate::thresholds::Thresholds;
use crate::window::Begin;
use crate::world::Statics;

/// After this many windows without a branch in p the search goes along u.
const REFUSALS: u8 = 3;

impl<R: Real, const V: usize, const S: usize, const C: usize> Run<'_, R, V, S, C> {
    /// The beginning of the window, evaluated once.
    #[inline(never)]
    pub(crate) fn know_low(&mut self) {
        if self.bracket.is_known {
            return;
        }
        self.bracket.is_known = true;
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

    /// The beginning of the window again, to the same bits.
    pub(crate) fn recall_low(&mut self) {
        let Watched {
            statics,
            motion,
            direction,
            ..
        } = self.watched;
        let (x, i) = (self.bracket.certain, &mut self.lo.instant);
        if x == R::ZERO {
            self.bracket.is_known = false;
            return self.know_low();
        }
        match &self.bracket.branch {
            Some(branch) => place_by_u(statics, motion, (branch, x), i),
            None if motion.frozen => {
                let u = self.u0 + direction * x;
                statics.place(motion, Spot { u, p: R::ZERO }, None, i);
            }
            None => {
                let u = self.bracket.placed;
                statics.balance_again(motion, Spot { u, p: x }, i);
            }
        }
        finish(&self.watched, self.bracket, self.lo);
    }

    /// Places the body at x, from where the motion is certain; bounds of the window in between, in place as they are large, or the part of it
    /// that may be certain.
    pub(crate) fn place(&mut self, x: R, on: &mut Judging<R>) -> Result<(), R> {
        let Watched {
            statics,
            motion,
            body,
            ..
        } = self.watched;
        on.width = x - self.bracket.certain;
        if let Some(branch) = self.bracket.branch {
            return self.place_along_u(branch, x, on);
        }
        if motion.frozen {
            return self.place_frozen(x, on);
        }
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
        on.pace = statics.window(motion, begin, x, &mut self.hi.instant, &mut on.pair)?;
        let i = &self.hi.instant;
        on.bound = statics.bound(motion, i, &on.pace, on.pair.as_ref());
        Ok(())
    }
    /// The body a last step of Newton's iteration beyond the end of the window.
    pub(crate) fn step_on(&mut self, dx: R) {
        let Watched {
            statics,
            motion,
            direction,
            ..
        } = self.watched;
        let (x, i) = (self.bracket.hi + dx, &mut self.hi.instant);
        if let Some(branch) = &self.bracket.branch {
            place_by_u(statics, motion, (branch, x), i);
        } else if motion.frozen {
            let u = self.u0 + direction * x;
            statics.place(motion, Spot { u, p: R::ZERO }, None, i);
        } else {
            let from = Spot { u: i.u, p: x };
            statics.balance(motion, from, self.hi.rates.u * dx, i);
        }
    }
    /// At a frozen hand: x is u.
    fn place_frozen(&mut self, x: R, on: &mut Judging<R>) -> Result<(), R> {
        let Watched {
            statics,
            motion,
            direction,
            ..
        } = self.watched;
        let width = on.width;
        let u = self.u0 + direction * x;
        let spot = Spot { u, p: R::ZERO };
        statics.place(motion, spot, None, &mut self.hi.instant);
        let i = &self.hi.instant;
        let extent = Extent {
            way: R::ZERO,
            strip: width,
        };
        let curvature = statics.curvature_with(motion, i, extent, &mut on.pair);
        on.pace = Pace {
            rate: width,
            bent: R::ZERO,
            curvature,
            extent,
        };
        on.drive = curvature.k * width * width;
        on.bound = statics.bound(motion, i, &on.pace, on.pair.as_ref());
        if ![on.drive, on.bound.holding]
            .iter()
            .all(|bound| bound.is_finite())
        {
            // A bound beyond the range of the number type bounds nothing.
            return Err(R::ONE / R::from_int(8));
        }
        Ok(())
    }
    /// Along u: bounds by (E13).
    fn place_along_u(&mut self, branch: Branch<R>, x: R, on: &mut Judging<R>) -> Result<(), R> {
        let Watched {
            statics, motion, ..
        } = self.watched;
        let width = on.width;
        let i = &mut self.hi.instant;
        place_by_u(statics, motion, (&branch, x), i);
        let along = statics.along_u(motion, i, width)?;
        let square = width * width;
        on.p_bend = along.bend * square;
        on.stable = along.stable * square;
        let extent = Extent {
            way: along.rate * width,
            strip: width,
        };
        on.pace = Pace {
            rate: width,
            bent: R::ZERO,
            curvature: along.curvature,
            extent,
        };
        let go = statics.foot_per_p(motion) * on.p_bend;
        if statics.is_pair(motion.kind) {
            on.pair = Some(statics.pair_sup(motion, i, extent));
        }
        on.bound = statics.bound(motion, i, &on.pace, on.pair.as_ref());
        let [_, xi2] = &mut on.bound.foot;
        *xi2 = *xi2 + go;
        on.bound.pivot = on.bound.pivot + go;
        on.bound.holding = on.bound.holding + go;
        Ok(())
    }

    /// There may be no single branch on the window.
    pub(crate) fn refused(&mut self, part: R) -> Option<Ended<R>> {
        let motion = self.watched.motion;
        let width = self.bracket.width();
        self.bracket.refusals = self.bracket.refusals.saturating_add(1);
        if self.bracket.refusals >= REFUSALS && !motion.frozen && self.bracket.branch.is_none() {
            self.know_low();
            let l = &self.lo.instant;
            // u knows p to a touch: where the body hardly turns it does not.
            let slope = l.e_u.abs() * motion.hand_p.size() * (R::ONE + l.u.abs());
            let is_known = slope <= l.e_p.abs() * (R::TOUCH / R::EPSILON);
            if l.e_p != R::ZERO && l.e_u < R::ZERO && is_known {
                let begin = (width * part * l.e_p / l.e_u).abs().min(R::HALF.halved());
                let direction = l.e_p.sign();
                let reach = if motion.kind == Kind::Pair {
                    motion.pair.reach - l.u * direction
                } else {
                    R::from_int(64)
                };
                let branch = Branch {
                    u: l.u,
                    p: l.p,
                    direction,
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
}

/// A point of a curve by its u: E is linear in p.
fn place_by_u<R: Real, const V: usize, const S: usize, const C: usize>(
    statics: &Statics<'_, R, V, S, C>,
    motion: &Motion<R>,
    (branch, x): (&Branch<R>, R),
    i: &mut Instant<R>,
) {
    let u = branch.u + branch.direction * x;
    let mut p = branch.p;
    statics.place(motion, Spot { u, p }, None, i);
    // Once, but for the slide of a C, whose E is quadratic in p.
    for _ in 0..6 {
        let step = -i.e / i.e_p;
        p = p + step;
        let known = (motion.kind != Kind::Pair).then_some(i.rotation);
        statics.place(motion, Spot { u, p }, known, i);
        let is_linear = motion.kind != Kind::Slide || !statics.turns(motion.first());
        if is_linear || R::is_last(step) {
            break;
        }
    }
}

/// The rest of a window's end from its instant.
pub(crate) fn finish<R: Real, const V: usize, const S: usize, const C: usize>(
    watched: &Watched<'_, R, V, S, C>,
    bracket: &Bracket<R>,
    end: &mut WindowEnd<R>,
) {
    let (statics, motion, i) = (watched.statics, watched.motion, &end.instant);
    let [u, p] = match &bracket.branch {
        Some(branch) => [branch.direction, -i.e_u / i.e_p * branch.direction],
        None if motion.frozen => [watched.direction, R::ZERO],
        None => [-i.e_p / i.e_u, R::ONE],
    };
    let stop = bracket.branch.is_some().then_some(bracket.stop);
    end.rates = statics.rates_of(motion, i, u, p);
    watched.values(i, &end.rates, stop, &mut end.values);
}

/// Where the first event is by tangents.
pub(crate) fn estimate<R: Real>(from: &WindowEnd<R>, x0: R, end: R) -> R {
    let mut best = end;
    for value in from.values.iter() {
        if value.d < R::ZERO && value.v > R::ZERO && value.v < (best - x0) * -value.d {
            best = best.min(x0 - value.v / value.d);
        }
    }
    best.max(x0 + (end - x0) * R::TOUCH)
}
