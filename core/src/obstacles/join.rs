//! A touch among obstacles: all that closes together, and what of it bears (R37, R38).

use super::axes::{At, Axis};
use super::flat::Span;
use crate::contact::{Contact, Contacts, Feature};
use crate::real::Real;
use crate::state::Body;
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// A contact that touches a body with others, and what of these lies in one line with it.
struct Joining<'a, R> {
    touched: Contact,
    at: At<R>,
    old: &'a Contacts,
    /// Gaps within this are closed.
    tol: R,
    /// It is on its side, and those on one side of the body, or in one line with it, are more than one, or it is behind them: the body comes to
    /// lie over a step that is none.
    steps: bool,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// What touches an obstacle that the body is not in contact with, within a distance: what is nearest along the axis with the largest gap.
    fn touches_obstacle(&self, body: &Body<R>, index: u8, within: R) -> Option<Feature> {
        let (o, at) = (self.obstacle(index), body.at());
        let is_known = |held: Contact| {
            self.obstacle_of(held) == Some(index)
                || match held.feature {
                    Feature::Vertex { side, .. } => self.is_behind(&o, side),
                    Feature::Corner { .. } => false,
                }
        };
        if self.distance_bound(&o, at.g) > within || body.contacts.iter().any(is_known) {
            return None;
        }
        let widest = self.widest(&o, at)?;
        if widest.gap.abs() > within {
            return None;
        }
        let feature = self.nearest_on_side(body, index, within)?;
        let contact = Contact::at(feature);
        let is_new = |held: Contact| held.feature != feature && !self.is_in_line(held, contact);
        body.contacts.iter().all(is_new).then_some(feature)
    }
    /// Of an obstacle that touches: what is closed and on its side along an axis, the one with the largest gap first.
    fn nearest_on_side(&self, body: &Body<R>, index: u8, within: R) -> Option<Feature> {
        let (o, at) = (self.obstacle(index), body.at());
        let front = body.in_front();
        // Both sides of a wall are as near to a thin body: the one in front of which it was.
        let is_thin = self.are_thin(&o);
        let is_behind_it = |axis: &Axis<R>| {
            let then = self.axis(&o, axis.normal, front);
            is_thin && self.along(&o, then, front).gap < -R::zero()
        };
        let mut best: Option<(R, Feature)> = None;
        for axis in self.axes(&o, at) {
            let gap = self.along(&o, axis, at).gap;
            let is_less = best.is_some_and(|(widest, _)| gap <= widest);
            if gap < -within || is_less || is_behind_it(&axis) {
                continue;
            }
            let mut features = self.compared(&o, &axis).filter_map(|k| {
                let gap = self.gap_along(&axis, self.lever(&axis, k, at), at);
                self.feature(&axis, k).filter(|_| gap <= within)
            });
            if let Some(feature) = features.find(|&f| self.is_on_side(Contact::at(f), at)) {
                best = Some((gap, feature));
            }
        }
        best.map(|(_, feature)| feature)
    }
    /// What is closed of obstacles that the body does not touch, but for what lies in one line with its contacts.
    pub(crate) fn closed_obstacle(&self, body: &Body<R>, within: R) -> Option<Feature> {
        let mut all = self.obstacles();
        all.find_map(|(index, _)| self.touches_obstacle(body, index, within))
    }
    /// A body that has slid flat on others: what lies farther out bears now (R38).
    pub(crate) fn widen(&self, body: &mut Body<R>) {
        let [first, second] = body.contacts.pair();
        if !self.is_edge(&body.contacts) {
            return;
        }
        let [Some(low), Some(high)] = self.flat(first, body.at(), R::TOUCH.doubled()) else {
            return;
        };
        let is_new = |end: Contact| !body.contacts.contains(end.feature);
        let is_even = self.is_even(low, high) && self.is_even(low, first);
        if is_even && (is_new(low) || is_new(high)) {
            let sense = first.sense;
            let is_led = high.feature == first.feature || low.feature == second.feature;
            let [a, b] = if is_led { [high, low] } else { [low, high] };
            body.contacts.keep(&[a.with(sense), b.with(sense)]);
            body.forget();
            self.find_foot(body);
        }
    }
    /// All obstacles that are closed within a distance join the contacts.
    pub(crate) fn join_obstacles(&self, body: &mut Body<R>, within: R) {
        for (index, _) in self.obstacles() {
            if let Some(feature) = self.touches_obstacle(body, index, within) {
                self.join(body, feature, within);
            }
        }
    }
    /// The contacts with one more: of those in one line the two outermost; none if it changes nothing.
    pub(crate) fn joined_by(
        &self,
        body: &Body<R>,
        feature: Feature,
        within: R,
    ) -> Option<Contacts> {
        let (touched, at, old) = (Contact::at(feature), body.at(), &body.contacts);
        if self.world.obstacles.is_empty() {
            let mut contacts = *old;
            contacts.push(touched);
            return Some(contacts);
        }
        let flat = old.iter().filter(|&k| self.is_flat(touched, k, at)).count();
        let depth = -self.gap_here(touched, at);
        let joining = Joining {
            touched,
            at,
            old,
            tol: within.doubled(),
            steps: (flat > 1 || flat == 1 && depth > within) && self.is_on_side(touched, at),
        };
        let ends = self.outermost(&joining, flat);
        // Beside its side nothing is touched but what lies between: the contact there, of another kind than the one that is held.
        let over = match ends {
            [Some(end), None] if !old.is_empty() && !self.is_on_side(touched, at) => {
                let other = || self.between(end, at).unwrap_or(end);
                Some(if old.contains(end.feature) {
                    other()
                } else {
                    end
                })
            }
            [Some(_) | None, _] => None,
        };
        self.with_ends(&joining, ends, over)
    }
    /// The outermost of a contact and of those that are in one line with it, or close with it.
    fn outermost(&self, joining: &Joining<'_, R>, flat: usize) -> [Option<Contact>; 2] {
        let (touched, at, old) = (joining.touched, joining.at, joining.old);
        if joining.steps {
            let mut span = Span::NONE;
            span.take(touched, R::ZERO, R::ZERO);
            for k in old.iter().filter(|&k| self.is_flat(touched, k, at)) {
                span.take(k, self.along_line(joining, k), R::ZERO);
            }
            return span.ends(R::LEAST);
        }
        let mut ends = self.flat(touched, at, joining.tol);
        let [_, high] = ends;
        // What bears already stays; what touches now decides on its side of it.
        if flat == 1
            && high.is_some()
            && let Some(bears) = old.iter().find(|&k| self.is_flat(touched, k, at))
        {
            let x = self.along_line(joining, bears);
            if x.abs() > R::MICRO && self.is_on_side(bears, at) {
                let [low, high] = &mut ends;
                *(if x < R::ZERO { low } else { high }) = Some(bears);
            }
        }
        match ends {
            [Some(a), Some(b)] if a.feature == b.feature => [Some(a), None],
            [a, b] => [a, b],
        }
    }
    /// Where a contact is along the line of the one that touches.
    fn along_line(&self, joining: &Joining<'_, R>, k: Contact) -> R {
        let Joining { touched, at, .. } = *joining;
        let t = self.frame_here(touched, at).t;
        t.dot(self.point(k, at) - self.point(touched, at))
    }
    /// The old contacts that are not replaced, and the ends.
    fn with_ends(
        &self,
        joining: &Joining<'_, R>,
        ends: [Option<Contact>; 2],
        over: Option<Contact>,
    ) -> Option<Contacts> {
        let Joining {
            touched,
            at,
            old,
            tol,
            steps,
        } = *joining;
        let sense = old.first().sense;
        let [_, high] = ends;
        let x = |k: Contact| self.along_line(joining, k);
        let goes = |k: Contact| {
            let is_flat = self.is_flat(touched, k, at);
            let is_here = x(k).abs() <= R::MICRO;
            let is_replaced = if steps {
                is_flat
            } else {
                self.is_level(touched, k, at, tol) && (high.is_some() || is_here)
            };
            // Handed over at its place.
            let is_over = over.is_some_and(|a| is_flat && (x(k) - x(a)).abs() <= R::MICRO);
            is_replaced || is_over
        };
        let is_end = |k: Contact| ends.iter().flatten().any(|end| end.feature == k.feature);
        let mut all = Contacts::NONE;
        for k in old.iter().filter(|&k| !goes(k) && !is_end(k)) {
            all.push(k);
        }
        let same = |k: Contact| old.iter().find(|o| o.feature == k.feature).unwrap_or(k);
        match (ends, over) {
            ([Some(a), Some(b)], _) => {
                all.push(same(a));
                all.push(same(b));
            }
            ([Some(_), None], Some(over)) => all.push(over.with(sense)),
            ([Some(end), None], None) => {
                let one = if old.contains(end.feature) {
                    touched
                } else {
                    end
                };
                all.push(one.with(sense));
            }
            ([None, _], _) if old.is_empty() || self.is_on_side(touched, at) => all.push(touched),
            ([None, _], _) => return None,
        }
        let first = old.first().feature;
        let leads = all.iter().position(|k| k.feature == first);
        all.lead(leads.unwrap_or(0));
        Some(all)
    }
}
