//! Obstacles in the plane: solid, with their free sides hatched, each with its name. World frame, m.

use stiction_scene::{ObstacleInfo, SurfaceInfo};

use super::plane::{Bounds, View, clip, height};
use super::sheet::{Drawn, px};
use super::style::{FAINT, INK, SMALL, SOLID, centred, font, text_width};
use plotters::prelude::*;

/// Depth of the hatches and distance between two [px].
const HATCH: f64 = 7.0;
const SPACING: f64 = 9.0;
/// Height of a name [px].
const NAME: f64 = 14.0;

type Point = (f64, f64);

/// The solid regions: the half-planes and the obstacles.
pub(super) struct Solids<'a> {
    pub(super) surfaces: &'a [SurfaceInfo],
    pub(super) obstacles: &'a [ObstacleInfo],
}

impl View<'_> {
    /// All that is solid: its inside shaded, its free boundary hatched.
    pub(super) fn solids(&self, solids: &Solids<'_>) -> Drawn {
        for obstacle in solids.obstacles {
            self.fill_visible(&corners(obstacle))?;
        }
        self.surfaces(solids.surfaces)?;
        for (k, obstacle) in solids.obstacles.iter().enumerate() {
            match corners(obstacle).as_slice() {
                [pin] if self.bounds.contains(*pin) => self.dot(*pin, 3.5, INK)?,
                [_] => {}
                [a, b] => self.line(&self.visible(&[*a, *b]), INK, 3.0)?,
                polygon => {
                    for side in sides(polygon) {
                        for piece in self.free(solids, k, side) {
                            self.side(polygon, piece)?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// The names of the obstacles, each in the middle of the visible part; if that is too small, next to it, or not at all.
    pub(super) fn names(&self, obstacles: &[ObstacleInfo], beside: bool) -> Drawn {
        for obstacle in obstacles {
            let seen = self.visible(&corners(obstacle));
            let Some(bounds) = Bounds::around(seen.iter().copied()) else {
                continue;
            };
            let width = text_width(&obstacle.name, SMALL) * self.pixel;
            let middle = middle(&seen).unwrap_or(bounds.centre());
            // Within its hatches, or else over them where names are wanted in any case.
            let margin = if beside { 0.0 } else { HATCH * self.pixel };
            let room = Bounds::centred(middle, width, NAME * self.pixel);
            let is_inside = |&place: &Point| sides(&seen).all(|side| above(side, place) <= -margin);
            if seen.len() > 2 && room.corners().iter().all(is_inside) {
                self.name(&obstacle.name, middle, true)?;
            } else if beside {
                let place = self.beside(&bounds, obstacle.vertices.len() == 2, width);
                self.name(&obstacle.name, place, false)?;
            }
        }
        Ok(())
    }

    /// The start of a name of this width next to the visible part of an obstacle: for a wall, above or next to its middle.
    fn beside(&self, seen: &Bounds, is_wall: bool, width: f64) -> Point {
        const GAP: f64 = 9.0;
        let (x, y) = seen.centre();
        let gap = GAP * self.pixel;
        if is_wall && seen.width() > seen.height() {
            return (x - 0.5 * width, y + gap);
        }
        let [right, left] = match is_wall {
            true => [x + gap, x - gap - width],
            false => [seen.x.end + gap, seen.x.start - gap - width],
        };
        let fits = right + width <= self.bounds.x.end;
        (if fits { right } else { left }, y)
    }

    fn name(&self, name: &str, place: Point, middle: bool) -> Drawn {
        let style = font(SMALL).color(&FAINT);
        let style = if middle { centred(&style) } else { style };
        self.plane.draw(&Text::new(name.to_owned(), place, style))
    }

    fn fill_visible(&self, polygon: &[Point]) -> Drawn {
        let seen = self.visible(polygon);
        match seen.len() > 2 {
            true => self.fill(&seen, SOLID),
            false => Ok(()),
        }
    }

    /// The part of a polygon, a wall or a pin in the picture.
    fn visible(&self, points: &[Point]) -> Vec<Point> {
        let Bounds { x, y } = &self.bounds;
        let seen = clip(points, |p| p.0 - x.start);
        let seen = clip(&seen, |p| x.end - p.0);
        let seen = clip(&seen, |p| p.1 - y.start);
        clip(&seen, |p| y.end - p.1)
    }

    /// The pieces of a side of obstacle `k` in the picture that are not behind a half-plane nor in or against another obstacle.
    fn free(&self, solids: &Solids<'_>, k: usize, side: [Point; 2]) -> Vec<[Point; 2]> {
        let (nx, ny) = outward(side);
        let off = 0.3 * self.pixel;
        let at = |part: f64| lerp(side, part);
        // Just outside.
        let beside = |part: f64| {
            let (x, y) = at(part);
            (x + off * nx, y + off * ny)
        };
        let Some((begin, end)) = self.span(side) else {
            return Vec::new();
        };
        let of_surface =
            |surface: &SurfaceInfo| inside(&|part| height(surface, beside(part)), begin, end);
        let of_obstacle = |(j, other): (usize, &ObstacleInfo)| {
            if j == k || other.vertices.len() < 3 {
                return None;
            }
            let polygon = corners(other);
            let mut span = (begin, end);
            for side in sides(&polygon) {
                span = inside(&|part| above(side, beside(part)), span.0, span.1)?;
            }
            Some(span)
        };
        let obstacles = solids.obstacles.iter().enumerate();
        let mut hidden: Vec<(f64, f64)> = (solids.surfaces.iter().filter_map(of_surface))
            .chain(obstacles.filter_map(of_obstacle))
            .collect();
        hidden.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut from, mut pieces) = (begin, Vec::new());
        for (a, b) in hidden {
            if a > from {
                pieces.push([at(from), at(a)]);
            }
            from = from.max(b);
        }
        if from < end {
            pieces.push([at(from), at(end)]);
        }
        pieces
    }

    /// The start and the end of a line's visible part, as fractions of its length.
    fn span(&self, side: [Point; 2]) -> Option<(f64, f64)> {
        let seen = self.visible(&side);
        let [(x, y), (to_x, to_y)] = side;
        let (dx, dy) = (to_x - x, to_y - y);
        let square = dx * dx + dy * dy;
        let part = |&(px, py): &Point| ((px - x) * dx + (py - y) * dy) / square;
        let parts = || seen.iter().map(part);
        let (begin, end) = (
            parts().fold(f64::INFINITY, f64::min),
            parts().fold(f64::NEG_INFINITY, f64::max),
        );
        (begin < end).then_some((begin, end))
    }

    /// A piece of a side, hatched on its solid side as far as the obstacle goes.
    fn side(&self, polygon: &[Point], piece: [Point; 2]) -> Drawn {
        let (nx, ny) = outward(piece);
        let (tx, ty) = (-ny, nx);
        let length = HATCH * self.pixel;
        let [from, to] = piece;
        let total = (to.0 - from.0).hypot(to.1 - from.1);
        let step = SPACING * self.pixel;
        for count in 0..(total / step) as usize {
            let s = (count as f64 + 0.5) * step;
            let (x, y) = (from.0 + s * tx, from.1 + s * ty);
            let foot = (x + length * (tx - nx), y + length * (ty - ny));
            let hatch = sides(polygon).fold(vec![(x, y), foot], |line, side| {
                clip(&line, |place| 1e-9 * total - above(side, place))
            });
            let hatch = self.visible(&hatch);
            if let [first, .., last] = hatch.as_slice() {
                self.line(&[*first, *last], FAINT, 1.0)?;
            }
        }
        self.line(&[from, to], INK, 1.6)
    }

    /// A corner of an obstacle that is touched.
    pub(super) fn touched_corner(&self, place: Point, color: RGBColor) -> Drawn {
        self.dot(place, 3.0, color)?;
        self.plane.draw(&Circle::new(
            place,
            px(6.0),
            super::sheet::stroke(color, 1.6),
        ))
    }
}

/// The corners of an obstacle.
pub(super) fn corners(obstacle: &ObstacleInfo) -> Vec<Point> {
    obstacle.vertices.iter().map(|&[x, y]| (x, y)).collect()
}

/// The sides of a polygon.
fn sides(polygon: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(&from, &to)| [from, to])
}

/// How far a point is outside a side's line.
fn above(side: [Point; 2], (x, y): Point) -> f64 {
    let (nx, ny) = outward(side);
    nx * (x - side[0].0) + ny * (y - side[0].1)
}

/// The centroid of a polygon.
fn middle(polygon: &[Point]) -> Option<Point> {
    let [x, y, area] = sides(polygon).fold([0.0; 3], |[x, y, area], [a, b]| {
        let cross = a.0 * b.1 - b.0 * a.1;
        [
            x + cross * (a.0 + b.0) / 3.0,
            y + cross * (a.1 + b.1) / 3.0,
            area + cross,
        ]
    });
    (area > 0.0).then(|| (x / area, y / area))
}

/// The outward unit normal of a side.
fn outward([from, to]: [Point; 2]) -> Point {
    let (x, y) = (to.0 - from.0, to.1 - from.1);
    let length = x.hypot(y);
    (y / length, -x / length)
}

fn lerp([from, to]: [Point; 2], part: f64) -> Point {
    (
        from.0 + part * (to.0 - from.0),
        from.1 + part * (to.1 - from.1),
    )
}

/// The parts of a line from `begin` to `end` at which an affine height is negative.
fn inside(height: &dyn Fn(f64) -> f64, begin: f64, end: f64) -> Option<(f64, f64)> {
    let (a, b) = (height(begin), height(end));
    let zero = begin + (end - begin) * a / (a - b);
    match (a < 0.0, b < 0.0) {
        (true, true) => Some((begin, end)),
        (true, false) => Some((begin, zero)),
        (false, true) => Some((zero, end)),
        (false, false) => None,
    }
}
