//! The geometry of a scene's picture: what is solid, cut to what is seen, the body, its spring and arrows, as lines and polygons.
//! Plots, small pictures and the Python package draw them, each in its own style. World frame, m; a pixel is a length, too.

mod solids;

use std::ops::Range;

pub use solids::{HATCH, Role, Shape, Solids, centroid, corners_of, depth_in};

/// x, y (m).
pub type Point = (f64, f64);

/// The part of the plane that is seen.
#[derive(Clone, Debug)]
pub struct Window {
    /// From left to right.
    pub x: Range<f64>,
    /// From bottom to top.
    pub y: Range<f64>,
}

impl Window {
    /// Returns the smallest window around points; `None` without a point.
    pub fn around(points: impl IntoIterator<Item = Point>) -> Option<Self> {
        points
            .into_iter()
            .fold(None, |window: Option<Self>, (x, y)| {
                let Some(Self { x: xs, y: ys }) = window else {
                    return Some(Self { x: x..x, y: y..y });
                };
                Some(Self {
                    x: xs.start.min(x)..xs.end.max(x),
                    y: ys.start.min(y)..ys.end.max(y),
                })
            })
    }

    /// Returns the window of this width and height around a centre.
    pub fn centred((x, y): Point, width: f64, height: f64) -> Self {
        Self {
            x: x - 0.5 * width..x + 0.5 * width,
            y: y - 0.5 * height..y + 0.5 * height,
        }
    }

    /// Returns the point in its middle.
    pub fn centre(&self) -> Point {
        (
            0.5 * (self.x.start + self.x.end),
            0.5 * (self.y.start + self.y.end),
        )
    }

    /// Returns its width.
    pub fn width(&self) -> f64 {
        self.x.end - self.x.start
    }

    /// Returns its height.
    pub fn height(&self) -> f64 {
        self.y.end - self.y.start
    }

    /// Returns whether a point is seen.
    pub fn contains(&self, (x, y): Point) -> bool {
        self.x.contains(&x) && self.y.contains(&y)
    }

    /// Returns its corners, counter-clockwise.
    pub fn corners(&self) -> [Point; 4] {
        let Self { x, y } = self;
        [
            (x.start, y.start),
            (x.end, y.start),
            (x.end, y.end),
            (x.start, y.end),
        ]
    }

    /// Returns the part of a convex polygon, a line or a point that is seen.
    pub fn visible(&self, points: &[Point]) -> Vec<Point> {
        let Self { x, y } = self;
        let seen = clip(points, |p| p.0 - x.start);
        let seen = clip(&seen, |p| x.end - p.0);
        let seen = clip(&seen, |p| p.1 - y.start);
        clip(&seen, |p| y.end - p.1)
    }
}

/// Returns the part of a convex polygon where `depth`, an affine function, is not negative.
pub fn clip(corners: &[Point], depth: impl Fn(Point) -> f64) -> Vec<Point> {
    let mut inside = Vec::new();
    for (index, &a) in corners.iter().enumerate() {
        let b = corners[(index + 1) % corners.len()];
        let (da, db) = (depth(a), depth(b));
        if da >= 0.0 {
            inside.push(a);
        }
        if (da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0) {
            let s = da / (da - db);
            inside.push((a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1)));
        }
    }
    inside
}

/// Returns the corners of the body at a pose x, y (m), theta (rad).
pub fn placed(body: &[[f64; 2]], [x, y, theta]: [f64; 3]) -> Vec<Point> {
    let (sin, cos) = theta.sin_cos();
    let place = |&[u, v]: &[f64; 2]| (x + cos * u - sin * v, y + sin * u + cos * v);
    body.iter().map(place).collect()
}

/// An arrow.
#[derive(Clone, Copy, Debug)]
pub struct Arrow {
    /// From its foot to its head.
    pub shaft: [Point; 2],
    /// The head, whose first corner is the tip.
    pub head: [Point; 3],
}

impl Arrow {
    /// Returns the arrow from a point along a vector; none if it is shorter than a pixel. `width`: of its shaft (pixels).
    pub fn new(from: Point, (x, y): Point, width: f64, pixel: f64) -> Option<Self> {
        let length = x.hypot(y);
        if length < pixel {
            return None;
        }
        let (ex, ey) = (x / length, y / length);
        let head = (3.2 * width * pixel).min(length);
        let half = 0.5 * head;
        let tip = (from.0 + x, from.1 + y);
        let neck = (tip.0 - head * ex, tip.1 - head * ey);
        let side = |s: f64| (neck.0 - s * ey, neck.1 + s * ex);
        Some(Self {
            shaft: [from, neck],
            head: [tip, side(half), side(-half)],
        })
    }
}

/// Returns a coil between two points; none if they are closer than two pixels.
pub fn spring(from: Point, to: Point, pixel: f64) -> Option<Vec<Point>> {
    const TURNS: usize = 7;
    let (x, y) = (to.0 - from.0, to.1 - from.1);
    let length = x.hypot(y);
    if length < 2.0 * pixel {
        return None;
    }
    let width = (4.0 * pixel).min(0.3 * length) / length;
    let point = |step: usize| {
        let along = step as f64 / (2 * TURNS) as f64;
        let across = match step {
            0 | 1 => 0.0,
            step if step >= 2 * TURNS - 1 => 0.0,
            step if step % 2 == 0 => width,
            _ => -width,
        };
        (
            from.0 + along * x - across * y,
            from.1 + along * y + across * x,
        )
    };
    Some((0..=2 * TURNS).map(point).collect())
}

/// A moment: an arc around a point with an arrow's head.
#[derive(Clone, Debug)]
pub struct Turn {
    /// The arc.
    pub arc: Vec<Point>,
    /// Its end.
    pub tip: Point,
    /// The vector of the arrow at its end.
    pub along: Point,
}

impl Turn {
    /// Returns the arc of a moment: the share 1 is three quarters of a turn. None if it is shorter than 6 pixels.
    pub fn new((x, y): Point, share: f64, pixel: f64) -> Option<Self> {
        const STEPS: usize = 32;
        let sweep = 1.5 * std::f64::consts::PI * share;
        let radius = 17.0 * pixel;
        if (sweep * radius).abs() < 6.0 * pixel {
            return None;
        }
        let point = |angle: f64| (x + radius * angle.cos(), y + radius * angle.sin());
        let begin = std::f64::consts::FRAC_PI_2;
        let arc = (0..=STEPS)
            .map(|step| point(begin + sweep * step as f64 / STEPS as f64))
            .collect();
        let end = begin + sweep;
        let head = 8.0 * pixel * sweep.signum();
        Some(Self {
            arc,
            tip: point(end),
            along: (-head * end.sin(), head * end.cos()),
        })
    }
}
