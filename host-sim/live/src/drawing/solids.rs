//! Half-planes and obstacles as they are seen: their insides, and their free borders, hatched on the solid side.

use stiction_scene::{ObstacleInfo, SurfaceInfo};

use super::{Point, Window, clip};

/// Length of a hatch along and across a border (pixels).
pub const HATCH: f64 = 7.0;
/// A border is hidden by a solid that comes this near (pixels).
const NEAR: f64 = 0.3;

/// What a shape shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A polygon: the inside of a half-plane.
    Surface,
    /// A polygon: the inside of an obstacle.
    Obstacle,
    /// A line: a piece of a free border.
    Border,
    /// A line on the solid side of a border.
    Hatch,
    /// A line: an obstacle without an inside.
    Wall,
    /// A point: an obstacle without an extent.
    Pin,
}

impl Role {
    /// Returns its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Surface => "surface",
            Self::Obstacle => "obstacle",
            Self::Border => "border",
            Self::Hatch => "hatch",
            Self::Wall => "wall",
            Self::Pin => "pin",
        }
    }
}

/// A polygon, a line or a point.
#[derive(Clone, Debug)]
pub struct Shape {
    /// What it shows.
    pub role: Role,
    /// Its corners.
    pub points: Vec<Point>,
}

/// All that is solid, as it is seen in a window.
#[derive(Clone, Debug)]
pub struct Solids<'a> {
    /// The half-planes.
    pub surfaces: &'a [SurfaceInfo],
    /// The obstacles.
    pub obstacles: &'a [ObstacleInfo],
    /// What is seen.
    pub window: &'a Window,
    /// A pixel (m).
    pub pixel: f64,
    /// Distance between two hatches (pixels).
    pub spacing: f64,
}

impl Solids<'_> {
    /// Returns all shapes, in the order in which they are drawn.
    pub fn shapes(&self) -> Vec<Shape> {
        let mut shapes = self.insides();
        shapes.extend(self.surface_borders());
        shapes.extend(self.obstacle_borders());
        shapes
    }

    /// Returns the insides.
    pub fn insides(&self) -> Vec<Shape> {
        let obstacles = self.obstacles.iter();
        let obstacles = obstacles.map(|obstacle| Shape {
            role: Role::Obstacle,
            points: self.window.visible(&corners_of(obstacle)),
        });
        let surfaces = self.surfaces.iter().map(|surface| Shape {
            role: Role::Surface,
            points: self.behind(surface),
        });
        let shapes = obstacles.chain(surfaces);
        shapes.filter(|shape| shape.points.len() > 2).collect()
    }

    fn behind(&self, surface: &SurfaceInfo) -> Vec<Point> {
        clip(&self.window.corners(), |point| -height(surface, point))
    }

    /// Returns the borders of the half-planes, as far as they are free, with their hatches.
    pub fn surface_borders(&self) -> Vec<Shape> {
        let tolerance = 1e-9 * (self.window.width() + self.window.height());
        let mut shapes = Vec::new();
        for surface in self.surfaces {
            let boundary: Vec<_> = (self.behind(surface).into_iter())
                .filter(|&point| height(surface, point) >= -tolerance)
                .collect();
            let free = self.surfaces.iter().fold(boundary, |line, other| {
                clip(&line, |point| height(other, point) + tolerance)
            });
            self.surface_border(surface, &free, &mut shapes);
        }
        shapes
    }

    fn surface_border(&self, surface: &SurfaceInfo, points: &[Point], shapes: &mut Vec<Shape>) {
        let [nx, ny] = surface.normal;
        let along = points.iter().map(|(x, y)| (ny * x - nx * y, 0.0));
        let Some(Window { x: ends, .. }) = Window::around(along) else {
            return;
        };
        let at = |s: f64, depth: f64| {
            let height = surface.offset - depth;
            (ny * s + nx * height, -nx * s + ny * height)
        };
        let (spacing, length) = (self.spacing * self.pixel, HATCH * self.pixel);
        for count in 0..((ends.end - ends.start) / spacing) as usize {
            let s = ends.start + (count as f64 + 0.5) * spacing;
            let foot = at(s - length, length);
            if self.window.contains(foot) {
                shapes.push(line(Role::Hatch, at(s, 0.0), foot));
            }
        }
        shapes.push(line(Role::Border, at(ends.start, 0.0), at(ends.end, 0.0)));
    }

    /// Returns the borders of the obstacles, as far as they are free, with their hatches; walls and pins.
    pub fn obstacle_borders(&self) -> Vec<Shape> {
        let mut shapes = Vec::new();
        for (k, obstacle) in self.obstacles.iter().enumerate() {
            match corners_of(obstacle).as_slice() {
                [pin] if self.window.contains(*pin) => shapes.push(Shape {
                    role: Role::Pin,
                    points: vec![*pin],
                }),
                [_] => {}
                [a, b] => shapes.push(Shape {
                    role: Role::Wall,
                    points: self.window.visible(&[*a, *b]),
                }),
                polygon => {
                    for side in sides(polygon) {
                        for piece in self.free(k, side) {
                            self.obstacle_border(polygon, piece, &mut shapes);
                        }
                    }
                }
            }
        }
        shapes
    }

    /// Adds a piece of a side, hatched as far as the obstacle goes.
    fn obstacle_border(&self, polygon: &[Point], piece: [Point; 2], shapes: &mut Vec<Shape>) {
        let (nx, ny) = outward(piece);
        let (tx, ty) = (-ny, nx);
        let length = HATCH * self.pixel;
        let [from, to] = piece;
        let total = (to.0 - from.0).hypot(to.1 - from.1);
        let step = self.spacing * self.pixel;
        for count in 0..(total / step) as usize {
            let s = (count as f64 + 0.5) * step;
            let (x, y) = (from.0 + s * tx, from.1 + s * ty);
            let foot = (x + length * (tx - nx), y + length * (ty - ny));
            let hatch = sides(polygon).fold(vec![(x, y), foot], |line, side| {
                clip(&line, |place| 1e-9 * total - above(side, place))
            });
            if let [first, .., last] = self.window.visible(&hatch).as_slice() {
                shapes.push(line(Role::Hatch, *first, *last));
            }
        }
        shapes.push(line(Role::Border, from, to));
    }

    /// Returns the pieces of a side of obstacle `k` that are seen, and neither behind a half-plane nor in or against another obstacle.
    fn free(&self, k: usize, side: [Point; 2]) -> Vec<[Point; 2]> {
        let (nx, ny) = outward(side);
        let off = NEAR * self.pixel;
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
            let polygon = corners_of(other);
            let mut span = (begin, end);
            for side in sides(&polygon) {
                span = inside(&|part| above(side, beside(part)), span.0, span.1)?;
            }
            Some(span)
        };
        let obstacles = self.obstacles.iter().enumerate();
        let mut hidden: Vec<(f64, f64)> = (self.surfaces.iter().filter_map(of_surface))
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

    /// Returns the start and the end of a line's visible part, as fractions of its length.
    fn span(&self, side: [Point; 2]) -> Option<(f64, f64)> {
        let seen = self.window.visible(&side);
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
}

fn line(role: Role, from: Point, to: Point) -> Shape {
    Shape {
        role,
        points: vec![from, to],
    }
}

/// Returns the corners of an obstacle.
pub fn corners_of(obstacle: &ObstacleInfo) -> Vec<Point> {
    obstacle.vertices.iter().map(|&[x, y]| (x, y)).collect()
}

/// Returns the height of a point above a surface (m); negative inside.
fn height(surface: &SurfaceInfo, (x, y): Point) -> f64 {
    surface.normal[0] * x + surface.normal[1] * y - surface.offset
}

fn sides(polygon: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(&from, &to)| [from, to])
}

/// Returns the outward unit normal of a side.
fn outward([from, to]: [Point; 2]) -> Point {
    let (x, y) = (to.0 - from.0, to.1 - from.1);
    let length = x.hypot(y);
    (y / length, -x / length)
}

/// Returns how far a point is outside a side's line.
fn above(side: [Point; 2], (x, y): Point) -> f64 {
    let (nx, ny) = outward(side);
    nx * (x - side[0].0) + ny * (y - side[0].1)
}

/// Returns how far a point is inside a convex polygon, negative outside (m).
pub fn depth_in(polygon: &[Point], place: Point) -> f64 {
    let depths = sides(polygon).map(|side| -above(side, place));
    depths.fold(f64::INFINITY, f64::min)
}

/// Returns the centroid of a polygon; none without an area.
pub fn centroid(polygon: &[Point]) -> Option<Point> {
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

fn lerp([from, to]: [Point; 2], part: f64) -> Point {
    (
        from.0 + part * (to.0 - from.0),
        from.1 + part * (to.1 - from.1),
    )
}

/// Returns the part of a line from `begin` to `end` in which an affine height is negative.
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
