//! One world of several obstacles, which need not be convex: sides that form one line, sides that are one, corners that nothing can touch
//! (R35). Decided in double precision, for all number types alike; lengths / L.

use super::straight::{NEAR, Point, Straight};
use super::{Corner, Obstacle};
use crate::geometry::{Vec2, normalized};
use crate::list::gather;
use crate::real::Real;
use crate::scene::{ObstacleDescription, SurfaceDescription};
use crate::si::SiFloat;
use crate::thresholds::Thresholds;
use crate::units::Units;
use crate::world::{Friction, Side};
use heapless::Vec;

/// A corner, and the side from it to the next one.
#[derive(Clone, Copy)]
pub(super) struct Raw {
    pub(super) obstacle: u8,
    pub(super) at: Point,
    pub(super) to: Point,
    /// None for a pin.
    pub(super) line: Option<Straight>,
    /// The line is that of a longer side, if it is in one.
    is_level: bool,
    pub(super) ends: [f64; 2],
    friction: [f64; 3],
    one: u8,
    first: u8,
    pub(super) covered: bool,
    /// The side lies in or on another obstacle.
    pub(super) hidden: bool,
    /// From its ends another side rises.
    pub(super) hollow: [bool; 2],
}

/// All corners, and the half-planes before them.
pub(super) struct Outlines<const S: usize, const C: usize> {
    pub(super) planes: Vec<Straight, S>,
    pub(super) all: Vec<Raw, C>,
}

fn wide<F: SiFloat>(x: F) -> f64 {
    x.widen()
}

impl<const S: usize, const C: usize> Outlines<S, C> {
    fn index(&self, corner: usize) -> u8 {
        u8::try_from(self.planes.len().saturating_add(corner)).unwrap_or(u8::MAX)
    }
    /// Adds the corners of an obstacle, every side on a line of its own.
    fn add(&mut self, obstacle: u8, corners: &[Point], friction: [f64; 3]) {
        for (k, &at) in corners.iter().enumerate() {
            let next = corners.get(k.saturating_add(1)).or(corners.first());
            let to = next.copied().unwrap_or(at);
            let index = self.index(self.all.len());
            // There is room for it.
            let _ = self.all.push(Raw {
                obstacle,
                at,
                to,
                line: (corners.len() > 1).then(|| Straight::through(at, to, index)),
                is_level: false,
                ends: [0.0; 2],
                friction,
                one: index,
                first: u8::try_from(self.all.len()).unwrap_or(u8::MAX),
                covered: false,
                hidden: false,
                hollow: [false; 2],
            });
        }
    }
    /// The first of the half-planes and level lines that is accepted.
    #[inline(never)]
    fn find(&self, accepts: &dyn Fn(&Straight) -> bool) -> Option<Straight> {
        let levels = self.all.iter().filter(|raw| raw.is_level);
        let mut lines = (self.planes.iter()).chain(levels.filter_map(|raw| raw.line.as_ref()));
        lines.find(|line| accepts(line)).copied()
    }
    /// Sides take the line of a longer one of their direction if both ends are on it: over its length a line is known best.
    fn level(&mut self) {
        while let Some(k) = self.longest() {
            let line = self.all.get(k).and_then(|raw| {
                let own = raw.line?;
                let is_same = |line: &Straight| {
                    line.normal.dot(own.normal) > 0.0
                        && line.is_near(raw.at)
                        && line.is_near(raw.to)
                };
                self.find(&is_same).or(Some(own))
            });
            if let Some(raw) = self.all.get_mut(k) {
                (raw.line, raw.is_level) = (line, true);
            }
        }
        for k in 0..self.all.len() {
            self.level_wall(k);
        }
        for raw in &mut self.all {
            if let Some(line) = raw.line {
                raw.ends = [raw.to, raw.at].map(|end| line.tangent().dot(end));
            }
        }
    }
    /// The longest side that is not level yet.
    fn longest(&self) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        for (k, raw) in self.all.iter().enumerate() {
            let way = raw.to - raw.at;
            let square = way.dot(way);
            let is_open = raw.line.is_some() && !raw.is_level;
            if is_open && best.is_none_or(|(longest, _)| square > longest) {
                best = Some((square, k));
            }
        }
        best.map(|(_, k)| k)
    }
    /// A thin wall has one line, whichever of its sides shares it.
    fn level_wall(&mut self, k: usize) {
        let next = k.saturating_add(1);
        let (Some(front), Some(back)) = (self.all.get(k), self.all.get(next)) else {
            return;
        };
        let is_wall = front.obstacle == back.obstacle && back.to == front.at;
        let (true, Some(a), Some(b)) = (is_wall, front.line, back.line) else {
            return;
        };
        let level = match (a.index == self.index(k), b.index == self.index(next)) {
            (false, true) => a.turned(b.index),
            (true, false) => b.turned(a.index),
            (true, true) | (false, false) => return,
        };
        let mut lines = self.all.iter_mut().filter_map(|raw| raw.line.as_mut());
        while let Some(line) = lines.find(|line| line.index == level.index) {
            *line = level;
        }
    }
    /// Sides in one line of equal friction that meet are one side.
    fn join(&mut self) {
        let mut is_done = false;
        while !is_done {
            is_done = true;
            for i in 0..self.all.len() {
                for k in 0..i {
                    let (Some(&a), Some(&b)) = (self.all.get(k), self.all.get(i)) else {
                        continue;
                    };
                    let (Some(line), Some(other)) = (a.line, b.line) else {
                        continue;
                    };
                    let ([low, high], [begin, end]) = (a.ends, b.ends);
                    let meet = low <= end + NEAR && begin <= high + NEAR;
                    let ends = [low.min(begin), high.max(end)];
                    let one = a.one.min(b.one);
                    let is_one = a.ends == ends && b.ends == ends && a.one == b.one;
                    if line.index != other.index || a.friction != b.friction || !meet || is_one {
                        continue;
                    }
                    for place in [k, i] {
                        if let Some(raw) = self.all.get_mut(place) {
                            (raw.ends, raw.one) = (ends, one);
                        }
                    }
                    is_done = false;
                }
            }
        }
    }
    /// The corners of an obstacle, with the side that ends at each.
    pub(super) fn around(&self, obstacle: u8) -> impl Iterator<Item = (usize, Raw, Raw)> + Clone {
        let own = |raw: &&Raw| raw.obstacle == obstacle;
        let members = self.all.iter().filter(own);
        let last = members.clone().next_back().copied();
        let from = self
            .all
            .iter()
            .position(|raw| raw.obstacle == obstacle)
            .unwrap_or(0);
        let count = members.count();
        (from..from.saturating_add(count)).filter_map(move |k| {
            let raw = *self.all.get(k)?;
            let before = if k == from {
                last
            } else {
                self.all.get(k.checked_sub(1)?).copied()
            };
            Some((k, raw, before?))
        })
    }
    /// Each corner onto the lines of the sides that end there, a pin or an end of a wall onto two that cross near it, and corners at one
    /// place together.
    fn place(&mut self) {
        for obstacle in self.obstacles() {
            let around = self.around(obstacle);
            let moved: Vec<(usize, Point), C> =
                gather(around.map(|(k, raw, before)| (k, self.placed(&raw, &before))));
            for (k, at) in moved {
                let same = self.all.iter().take(k).find(|other| is_near(other.at, at));
                let (at, first) = same.map_or((at, None), |other| (other.at, Some(other.first)));
                if let Some(raw) = self.all.get_mut(k) {
                    raw.at = at;
                    raw.first = first.unwrap_or(raw.first);
                    raw.covered |= first.is_some();
                }
            }
        }
    }
    fn placed(&self, raw: &Raw, before: &Raw) -> Point {
        let at = raw.at;
        let Some(own) = raw.line.or_else(|| self.find(&|line| line.is_near(at))) else {
            return at;
        };
        let of_sides = before.line.and_then(|line| own.meeting(&line, at));
        let crosses = |line: &Straight| line.is_near(at) && own.meeting(line, at).is_some();
        let across = || own.meeting(&self.find(&crosses)?, at);
        let onto = || at - own.normal * own.height(at);
        of_sides.or_else(across).unwrap_or_else(onto)
    }
    pub(super) fn obstacles(&self) -> core::ops::Range<u8> {
        let last = self.all.last().map(|raw| raw.obstacle);
        0..last.map_or(0, |last| last.saturating_add(1))
    }
}

pub(super) fn is_near(a: Point, b: Point) -> bool {
    (a - b).length() <= NEAR
}

/// The corners and obstacles of a world, in the numbers of the solver.
pub(crate) type United<R, const C: usize> = (Vec<Corner<R>, C>, Vec<Obstacle<R>, C>);

/// Unites obstacles and half-planes to one world.
pub(crate) fn unite<R: Real, const S: usize, const C: usize>(
    surfaces: &[SurfaceDescription<R::Si>],
    given: &[ObstacleDescription<'_, R::Si>],
    units: &Units<R::Si>,
) -> United<R, C> {
    let length = wide(units.length);
    let [from_x, from_y] = units.origin.map(wide);
    let plane = |(index, s): (u8, &SurfaceDescription<R::Si>)| {
        let [x, y] = s.normal.map(wide);
        let (x, y) = normalized(x, y);
        Straight {
            normal: Vec2::new(x, y),
            offset: (wide(s.offset) - (x * from_x + y * from_y)) / length,
            index,
        }
    };
    let mut world = Outlines::<S, C> {
        planes: gather((0_u8..).zip(surfaces).map(plane)),
        all: Vec::new(),
    };
    for (index, obstacle) in (0_u8..).zip(given) {
        let corners = obstacle.vertices.iter();
        let corners: Vec<Point, C> =
            gather(corners.map(|&[x, y]| {
                Vec2::new((wide(x) - from_x) / length, (wide(y) - from_y) / length)
            }));
        let memory = obstacle.memory.map_or(-1.0, wide);
        let friction = [
            wide(obstacle.friction_static),
            wide(obstacle.friction_dynamic),
            memory,
        ];
        world.add(index, &corners, friction);
    }
    world.level();
    world.join();
    world.place();
    world.cover();
    let frictions = given
        .iter()
        .map(|o| Friction::described([o.friction_static, o.friction_dynamic], o.memory, units));
    let frictions: Vec<Friction<R>, C> = gather(frictions);
    let corners = world.all.iter().map(|raw| corner(raw, &frictions));
    let all = world.obstacles().map(|index| obstacle(&world, index));
    (gather(corners), gather(all))
}

fn number<R: Real>(x: f64) -> R {
    R::from_si(R::Si::narrow(x), R::Si::ONE)
}
fn point<R: Real>(at: Point) -> Vec2<R> {
    Vec2::new(number(at.x), number(at.y))
}

fn corner<R: Real>(raw: &Raw, frictions: &[Friction<R>]) -> Corner<R> {
    let friction = frictions.get(usize::from(raw.obstacle));
    let ([low, high], [before, after]) = (raw.ends.map(number::<R>), raw.hollow);
    let more = |is_hollow: bool| if is_hollow { R::in_front() } else { R::ZERO };
    let friction = friction.copied().unwrap_or(Friction::NONE);
    let side = raw.line.map_or(Side::NOWHERE, |line| Side {
        normal: point(line.normal),
        tangent: point(line.tangent()),
        offset: number(line.offset),
        friction,
    });
    Corner {
        place: point(raw.at),
        side: Side { friction, ..side },
        ends: [low - more(before), high + more(after)],
        line: raw.line.map_or(u8::MAX, |line| line.index),
        one: raw.one,
        first: raw.first,
        obstacle: raw.obstacle,
        covered: raw.covered,
        hidden: raw.hidden,
    }
}

/// An obstacle with a circle about the middle of its ranges, larger by what places round to.
fn obstacle<R: Real, const S: usize, const C: usize>(
    world: &Outlines<S, C>,
    index: u8,
) -> Obstacle<R> {
    let places = world.around(index).map(|(_, raw, _)| raw.at);
    let range = |along: fn(Point) -> f64| {
        let all = places.clone().map(along);
        let (low, high) = all.fold((f64::HUGE, f64::LEAST), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        low + (high - low) * 0.5
    };
    let middle = Vec2::new(range(|at| at.x), range(|at| at.y));
    let radius = places
        .clone()
        .fold(0.0, |most: f64, at| most.max((at - middle).length()));
    let from = world.around(index).next().map_or(0, |(k, ..)| k);
    Obstacle {
        from: u8::try_from(from).unwrap_or(u8::MAX),
        count: u8::try_from(places.count()).unwrap_or(u8::MAX),
        middle: point(middle),
        radius: number(radius * 1.001 + NEAR),
    }
}
