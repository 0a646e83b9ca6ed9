//! An obstacle that is not in contact, on a window of a search: an axis that keeps it apart, or what touches where that closes (R36).

use super::Obstacle;
use super::apart::Left;
use super::axes::{At, Axis, Normal, speed};
use crate::contact::Feature;
use crate::events::{Ending, Judging};
use crate::found::Found;
use crate::judge::Track;
use crate::motion::Kind;
use crate::real::Real;
use crate::search::Run;
use crate::thresholds::Thresholds;

impl<R: Real, const V: usize, const S: usize, const C: usize> Run<'_, R, V, S, C> {
    /// Whether an axis certainly keeps an obstacle apart on a window; contacts that are held aside.
    fn keeps_apart(&self, on: &Judging<R>, o: &Obstacle<R>, normal: Normal) -> bool {
        let (statics, tol) = (self.watched.statics, R::zero());
        let step = statics.step_behind(o);
        let gap = |at: At<R>| statics.along(o, statics.axis(o, normal, at), at).gap;
        let begin = self.lo.instant.at();
        if gap(begin) <= tol {
            let (axis, body) = (statics.axis(o, normal, begin), self.watched.body);
            // Where a thin wall is closed it is so on both sides.
            let is_behind = statics.are_thin(o) && gap(body.in_front()) < -tol;
            let may_pass = is_behind || statics.is_pinched(o, &axis, begin);
            if may_pass && statics.holds_in_front(o, body, &axis, begin) != Some(true) {
                return false;
            }
        }
        let axis = statics.axis(o, normal, self.hi.instant.at());
        let mut all = statics.compared(o, &axis);
        all.all(|k| {
            if self.is_held(&axis, k) {
                return true;
            }
            let begin = self.value_along(o, normal, k, self.lo);
            let end = self.value_along(o, normal, k, self.hi);
            let half = self.bend(on, &axis, k).halved();
            if end.v > tol.max(half) && begin.v >= -tol {
                return true;
            }
            if begin.v <= tol && end.v < begin.v && begin.d < -tol * speed(&self.lo.rates) {
                return false;
            }
            // What lies a little behind, a step that is none, may not go farther.
            let floor = begin.v.min(R::ZERO);
            if begin.v < -step || end.v < floor - tol {
                return false;
            }
            let (p, q) = ((begin.v - floor).sqrt(), (end.v - floor).sqrt());
            (p + q) * (p + q) >= half || half <= tol
        })
    }
    /// An obstacle that is not in contact: an axis that keeps it apart, or what touches where the widest one closes.
    pub(super) fn judge_other(
        &mut self,
        on: &Judging<R>,
        found: &mut Found<R>,
        o: &Obstacle<R>,
    ) -> Left<R> {
        let (statics, tol) = (self.watched.statics, R::zero());
        let Some(end) = statics.widest(o, self.hi.instant.at()) else {
            // A point and a pin do not meet.
            return Ok(R::HUGE);
        };
        if end.gap > on.bound.way.doubled() + statics.rounding_at(&self.hi.instant) {
            return Ok(end.gap);
        }
        self.know_low();
        if end.gap > tol && self.keeps_apart(on, o, end.axis.normal) {
            return Ok(end.gap);
        }
        if let Some(gap) = self.line_that_keeps_apart(on, o) {
            return Ok(gap);
        }
        let Some(begin) = statics.widest(o, self.lo.instant.at()) else {
            return Ok(R::HUGE);
        };
        if begin.gap > tol {
            return Ok(self.judge_witness(on, found, o, begin.axis.normal));
        }
        self.judge_closed(on, found, o, begin.gap)
    }
    /// The gap along the line of a contact on a side of the body, if that keeps the obstacle apart. A body that slides flat stays on its line.
    fn line_that_keeps_apart(&self, on: &Judging<R>, o: &Obstacle<R>) -> Option<R> {
        let (statics, motion) = (self.watched.statics, self.watched.motion);
        let [first, second] = motion.contacts;
        let is_flat = motion.kind == Kind::Pair && statics.is_in_line(first, second);
        let corners = self.watched.body.contacts.iter().filter(|c| c.is_corner());
        let mut normals = corners.filter_map(|contact| statics.normal_of(contact));
        let begin = self.lo.instant.at();
        let normal = normals.find(|&normal| {
            let is_before =
                || statics.along(o, statics.axis(o, normal, begin), begin).gap >= -R::zero();
            is_flat && is_before() || self.keeps_apart(on, o, normal)
        })?;
        let at = self.hi.instant.at();
        let axis = statics.axis(o, normal, at);
        Some(statics.along(o, axis, at).gap.max(R::ZERO))
    }
    /// An obstacle that is closed where the window begins: the axis that closes most slowly decides.
    fn judge_closed(
        &mut self,
        on: &Judging<R>,
        found: &mut Found<R>,
        o: &Obstacle<R>,
        gap: R,
    ) -> Left<R> {
        let (statics, tol) = (self.watched.statics, R::zero());
        let at = self.lo.instant.at();
        let step = R::MICRO.max(tol - gap);
        let Some(slowest) = statics.slowest(o, self.watched.body, [at, at], &self.lo.rates, step)
        else {
            return Ok(R::ZERO);
        };
        let still = tol * speed(&self.lo.rates);
        let [then, now] = [&*self.lo, &*self.hi].map(|end| {
            let at = end.instant.at();
            let axis = statics.axis(o, slowest.axis.normal, at);
            statics.along(o, axis, at).gap
        });
        let closes = slowest.rate < -still && now < then;
        let is_deep = slowest.rate <= still && then < -R::TOUCH;
        if (closes || is_deep)
            && let Some((feature, _)) = slowest.contact
        {
            return Err(feature);
        }
        if self.keeps_apart(on, o, slowest.axis.normal) {
            return Ok(now.max(R::ZERO));
        }
        let is_behind =
            |axis: &Axis<R>| statics.holds_in_front(o, self.watched.body, axis, at) == Some(false);
        let mut others = statics.axes(o, at).filter(|axis| !is_behind(axis));
        if !statics.are_thin(o) && others.any(|axis| self.keeps_apart(on, o, axis.normal)) {
            return Ok(R::ZERO);
        }
        Ok(self.judge_witness(on, found, o, slowest.axis.normal))
    }
    /// Where the axis that keeps an obstacle apart closes another one may be open, or not close.
    fn judge_witness(
        &mut self,
        on: &Judging<R>,
        found: &mut Found<R>,
        o: &Obstacle<R>,
        normal: Normal,
    ) -> R {
        let (statics, tol) = (self.watched.statics, R::zero());
        let at = self.hi.instant.at();
        let axis = statics.axis(o, normal, at);
        let gap = statics.along(o, axis, at).gap;
        if gap.abs() <= tol {
            let is_apart = self.keeps_apart(on, o, normal);
            if let Some(widest) = statics.widest(o, at)
                && widest.gap > tol
            {
                found.unsure |= !is_apart;
                return widest.gap;
            }
            let both = [self.lo.instant.at(), at];
            if let Some(slowest) =
                statics.slowest(o, self.watched.body, both, &self.hi.rates, R::MICRO)
            {
                found.unsure |= !is_apart && self.bracket.width() > tol;
                let still = tol * speed(&self.hi.rates);
                let level = statics.along(o, slowest.axis, at).gap;
                if slowest.rate > still || slowest.rate >= -still && level >= -tol {
                    return R::ZERO;
                }
                if let Some((feature, _)) = slowest.contact {
                    let touch = Ending::Touch(feature);
                    if found.is_preceded(touch, tol, |dx| level + slowest.rate * dx) {
                        found.hit = Some((touch, R::ZERO));
                    }
                }
            }
            return R::ZERO;
        }
        self.judge_closing(on, found, o, &axis);
        R::ZERO
    }
    /// Along the axis of an obstacle that was apart: what crosses, or may.
    fn judge_closing(
        &mut self,
        on: &Judging<R>,
        found: &mut Found<R>,
        o: &Obstacle<R>,
        axis: &Axis<R>,
    ) {
        let (statics, tol) = (self.watched.statics, R::zero());
        let (step, normal) = (statics.step_behind(o), axis.normal);
        for k in statics.compared(o, axis) {
            let begin = self.value_along(o, normal, k, self.lo);
            let end = self.value_along(o, normal, k, self.hi);
            let half = self.bend(on, axis, k).halved();
            let floor = if begin.v >= -step {
                begin.v.min(R::ZERO)
            } else {
                R::ZERO
            };
            if end.v > tol.max(half) {
                continue;
            }
            if end.v > tol {
                let (p, q) = (begin.v.max(R::ZERO).sqrt(), end.v.sqrt());
                found.unsure |= (p + q) * (p + q) < half;
            } else if end.v >= floor - tol && end.v < -tol {
                found.unsure |= half > tol;
            } else if end.v < -tol {
                let feature = self.first_at_once(o, end.v);
                let touch = feature.or(statics.feature(axis, k)).map(Ending::Touch);
                let ending = touch.unwrap_or(Ending::GoesOn);
                let at = self.crossing(&Track::gap(ending, [begin, end], half));
                found.crosses(ending, at);
            }
        }
    }
    /// On the shortest window all axes that close have done so at once: what touches by the one that closes most slowly, also if they are deep
    /// by more than a touch, since places follow from a hand that is far.
    fn first_at_once(&self, o: &Obstacle<R>, gap: R) -> Option<Feature> {
        if !self.bracket.is_shortest() {
            return None;
        }
        let both = [self.lo.instant.at(), self.hi.instant.at()];
        let step = R::MICRO.max(-gap);
        let slowest =
            (self.watched.statics).slowest(o, self.watched.body, both, &self.hi.rates, step)?;
        slowest.contact.map(|(feature, _)| feature)
    }
}
