//! A short motion on which certainly no obstacle is reached. The obstacles next to the body are watched, each along an axis that last
//! separated it from the body: if the gap is open at both ends of the motion, it is open on all of it. The distance to the others is
//! computed once and stays valid for some time.

use super::super::Placed;
use super::axes::{Separation, axes, gap_less, lies_over, room_along};
use super::tally::{Sizes, Tally};
use crate::contact::Pair;
use crate::motion::Instant;
use crate::real::Real;
use crate::work::Work;
use crate::world::World;

/// This many obstacles are watched.
const WATCHED: usize = 3;
/// An obstacle is watched if it is closer than this many times the displacement of a motion.
const NEAR: i32 = 8;

/// The watched axes, as far as they fit into a byte each: they only determine where to look first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Watch([u8; WATCHED]);

impl Watch {
    pub(crate) const NONE: Self = Self([0; WATCHED]);
    /// Marks a side of the body: one of the first 16 obstacles, one of the first 8 sides.
    const BODY_SIDE: u8 = 0x80;

    /// A byte for an axis, not 0; 0 if there is none.
    fn name<R: Real, W: World<R>>(scene: &W, (obstacle, axis): (usize, Separation)) -> u8 {
        match (axis, u8::try_from(obstacle)) {
            (Separation::Side(side), _) => {
                let index = side.saturating_sub(scene.surface_indices().end);
                let named = index.saturating_add(1);
                if named < Self::BODY_SIDE { named } else { 0 }
            }
            (Separation::BodySide(side), Ok(obstacle)) if obstacle < 16 && side < 8 => {
                Self::BODY_SIDE | obstacle << 3 | side
            }
            _ => 0,
        }
    }

    /// The axis of an obstacle.
    pub(super) fn axis_of<R: Real, W: World<R>>(
        self,
        scene: &W,
        obstacle: usize,
    ) -> Option<Separation> {
        let mut named = self
            .0
            .into_iter()
            .filter_map(|name| Self::named(scene, name));
        named.find(|&(of, _)| of == obstacle).map(|(_, axis)| axis)
    }

    fn named<R: Real, W: World<R>>(scene: &W, name: u8) -> Option<(usize, Separation)> {
        if name & Self::BODY_SIDE != 0 {
            let obstacle = usize::from((name & !Self::BODY_SIDE) >> 3);
            return Some((obstacle, Separation::BodySide(name & 7)));
        }
        let side = (scene.surface_indices().end).saturating_add(name.checked_sub(1)?);
        let obstacle = scene.corner(side)?.obstacle;
        Some((usize::from(obstacle), Separation::Side(side)))
    }
}

/// A short motion: the placed point moves along a straight line, or along the body's side, and the body turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Short<'a, R> {
    pub(crate) before: Placed<R>,
    pub(crate) after: Placed<R>,
    /// The contacts that last.
    pub(crate) lasting: &'a [Pair],
    /// No point of the body moves farther than this, including the turn about the placed point.
    pub(crate) way: R,
    /// The turn is no more than this at any time.
    pub(crate) turn: R,
}

impl<R: Real> Short<'_, R> {
    /// Returns whether no obstacle is reached. Obstacles that are not watched are farther away than `room` at the beginning, which shrinks
    /// by the displacement; if that is not enough, the surroundings are examined. If one may be reached the axes are those of before: a
    /// search starts with them.
    pub(crate) fn keeps_off<W: World<R>>(
        &self,
        scene: &W,
        (room, watch): (&mut R, &mut Watch),
        work: &mut Work,
    ) -> bool {
        let tally = Tally::of_frame();
        let flat = self.is_flat(scene);
        let is_open = |&name: &u8| {
            let axis = Watch::named(scene, name);
            axis.is_none_or(|axis| self.is_open(scene, axis, (flat, &tally)))
        };
        let around = if *room > self.way && watch.0.iter().all(is_open) {
            Some((*room - self.way, *watch))
        } else {
            self.looks_around(scene, (flat, &tally))
        };
        work.spend(tally.units());
        (*room, *watch) = around.unwrap_or((R::ZERO, *watch));
        around.is_some()
    }

    /// Returns whether the gap along an axis is open on the whole motion: it exceeds the displacement at the end, or at both ends the most
    /// that the turn may change.
    fn is_open<W: World<R>>(
        &self,
        scene: &W,
        axis: (usize, Separation),
        (flat, tally): (bool, &Tally),
    ) -> bool {
        let sizes = Sizes::of_one(scene, axis.0);
        let gap = |placed: &Placed<R>, by: R| {
            tally.spend(sizes.axis());
            gap_less(scene, placed, axis, ((self.lasting, flat), by))
        };
        let less = self.after.rounding().doubled() + R::TOUCH;
        let turn = self.turn.doubled();
        // Features count as at least a body size away.
        let after = gap(&self.after, self.way + turn);
        after > less || after + self.way > less && gap(&self.before, turn) > R::ZERO
    }

    /// Returns whether two of the contacts that last are collinear.
    fn is_flat<W: World<R>>(&self, scene: &W) -> bool {
        match *self.lasting {
            [one, other] => self.after.lie_in_line(scene, [one, other]),
            _ => self.lasting.len() > 1,
        }
    }

    /// The distance at the end of what is not watched, and what to watch; `None` if an obstacle may be reached.
    #[inline(never)]
    fn looks_around<W: World<R>>(
        &self,
        scene: &W,
        (flat, tally): (bool, &Tally),
    ) -> Option<(R, Watch)> {
        let body = Instant::at_rest(self.after);
        let radius = self.after.radius(scene, None);
        let less = self.after.rounding().doubled() + R::TOUCH;
        let mut room = R::HUGE;
        let mut watched = [(R::HUGE, 0_u8); WATCHED];
        for (obstacle, round) in scene.rounds().iter().enumerate() {
            let apart = self.after.apart(round) - radius;
            if apart > R::ONE {
                room = room.min(apart);
                continue;
            }
            tally.spend(Sizes::of_one(scene, obstacle).axes());
            if lies_over(scene, &self.after, obstacle, self.lasting) {
                continue;
            }
            let along = |axis| {
                (
                    room_along(scene, &body, (obstacle, axis), self.lasting),
                    axis,
                )
            };
            let wider = |a: (R, Separation), b: (R, Separation)| if b.0 > a.0 { b } else { a };
            // A point and a pin have no axis.
            let Some((off, axis)) = axes(scene, obstacle).map(along).reduce(wider) else {
                continue;
            };
            let mut next = (off - less, 0);
            if next.0 <= self.way * R::from_int(NEAR) {
                next.1 = Watch::name(scene, (obstacle, axis));
                if next.1 == 0 || !self.is_open(scene, (obstacle, axis), (flat, tally)) {
                    // The nearest axis may differ from the one that still separates them.
                    next.1 = 0;
                }
            }
            if next.1 != 0 {
                // The nearest ones are watched.
                for place in &mut watched {
                    if next.0 < place.0 {
                        core::mem::swap(place, &mut next);
                    }
                }
            }
            room = room.min(next.0);
            if room <= self.way {
                return None;
            }
        }
        (room > self.way).then(|| (room, Watch(watched.map(|(_, name)| name))))
    }
}
