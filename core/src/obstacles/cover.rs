//! Corners and sides that nothing can touch, because other obstacles or half-planes are there (R35).

use super::straight::{NEAR, Point, Straight};
use super::union::{Outlines, Raw, is_near};

impl<const S: usize, const C: usize> Outlines<S, C> {
    /// Corners that are in or on another obstacle, behind a half-plane, within a side, or in a hollow; ends of sides from which another one rises.
    pub(super) fn cover(&mut self) {
        for k in 0..self.all.len() {
            let Some(raw) = self.all.get(k).copied() else {
                continue;
            };
            let is_behind = self.planes.iter().any(|plane| plane.height(raw.at) <= NEAR);
            let mut others = self.obstacles().filter(|&o| o != raw.obstacle);
            let is_inside = others.any(|o| self.is_inside(o, raw.at));
            let is_within = self.all.iter().any(|side| {
                let [low, high] = side.ends;
                side.line.is_some_and(|line| {
                    let x = line.tangent().dot(raw.at);
                    line.height(raw.at).abs() <= NEAR && x > low + NEAR && x < high - NEAR
                })
            });
            let covered = is_behind || is_inside || is_within || !self.is_tip(raw.at);
            let hidden = self.is_hidden(&raw);
            let rises = |x| raw.line.is_some_and(|line| self.rises_at(&line, x));
            let hollow = raw.ends.map(rises);
            if let Some(raw) = self.all.get_mut(k) {
                raw.covered |= covered;
                raw.hidden = hidden;
                raw.hollow = hollow;
            }
        }
    }
    /// In front of a line a side rises from its place at x: nothing passes there.
    fn rises_at(&self, line: &Straight, x: f64) -> bool {
        let place = line.normal * line.offset + line.tangent() * x;
        self.all.iter().any(|raw| {
            let Some(own) = raw.line else { return false };
            let [low, high] = [raw.to, raw.at].map(|end| own.tangent().dot(end));
            let along = own.tangent().dot(place);
            let is_there = own.is_near(place) && along >= low - NEAR && along <= high + NEAR;
            let rises = [raw.at, raw.to].iter().any(|&end| line.height(end) > NEAR);
            is_there && rises && line.meeting(&own, place).is_some()
        })
    }
    /// In or on an obstacle, but at no corner of it.
    fn is_inside(&self, obstacle: u8, at: Point) -> bool {
        let mut all = self.around(obstacle);
        let is_at_corner = all.clone().any(|(_, raw, _)| is_near(raw.at, at));
        let is_area = all.clone().count() > 2;
        let behind = |line: Straight| line.height(at) <= NEAR;
        is_area && !is_at_corner && all.all(|(_, raw, _)| raw.line.is_some_and(behind))
    }
    /// All sides that start from a point are on one side of one of them: they leave at least a half-plane free.
    fn is_tip(&self, at: Point) -> bool {
        let leaves = || {
            self.all
                .iter()
                .filter(|raw| raw.line.is_some())
                .flat_map(move |raw| {
                    let way = raw.to - raw.at;
                    let length = way.length();
                    let along = way * (1.0 / length);
                    let begins = is_near(raw.at, at).then_some((along, length));
                    let ends = is_near(raw.to, at).then_some((-along, length));
                    [begins, ends].into_iter().flatten()
                })
        };
        if leaves().next().is_none() {
            return true;
        }
        leaves().any(|(one, length)| {
            let turned = move |(other, of): (Point, f64)| {
                // A direction is as uncertain as the place of its end.
                (one.cross(other), NEAR / length + NEAR / of)
            };
            leaves().map(turned).all(|(sine, off)| sine >= -off)
                || leaves().map(turned).all(|(sine, off)| sine <= off)
        })
    }
    /// A side with another obstacle in front of it, from end to end.
    fn is_hidden(&self, raw: &Raw) -> bool {
        let Some(line) = raw.line else {
            return false;
        };
        // As convex obstacles meet: what both ends are on or in, all of it is.
        let before = (raw.at + raw.to) * 0.5 + line.normal * (4.0 * NEAR);
        let mut others = self.obstacles().filter(|&o| o != raw.obstacle);
        others.any(|o| {
            let all = self.around(o);
            let is_in = |at: Point| {
                let behind = |line: Straight| line.height(at) <= NEAR;
                all.clone()
                    .all(|(_, side, _)| side.line.is_some_and(behind))
            };
            all.clone().count() > 2 && is_in(raw.at) && is_in(raw.to) && is_in(before)
        })
    }
}
