//! The plane in which the body moves, drawn to scale: surfaces, body, spring and forces. World frame, m and N.

use stiction_scene::SurfaceInfo;

use super::sheet::{Area, Drawn, Plane, px, size, stroke};
use super::style::{FAINT, INK, SOLID};
use plotters::prelude::*;
use std::ops::Range;
use stiction_live::record::{Frame, Run};

/// A box in the plane.
#[derive(Clone, Debug)]
pub(super) struct Bounds {
    pub(super) x: Range<f64>,
    pub(super) y: Range<f64>,
}

impl Bounds {
    /// The smallest box around points; `None` without a point.
    pub(super) fn around(points: impl IntoIterator<Item = (f64, f64)>) -> Option<Self> {
        points
            .into_iter()
            .fold(None, |bounds: Option<Self>, (x, y)| {
                let Some(Self { x: xs, y: ys }) = bounds else {
                    return Some(Self { x: x..x, y: y..y });
                };
                Some(Self {
                    x: xs.start.min(x)..xs.end.max(x),
                    y: ys.start.min(y)..ys.end.max(y),
                })
            })
    }

    pub(super) fn centre(&self) -> (f64, f64) {
        (
            0.5 * (self.x.start + self.x.end),
            0.5 * (self.y.start + self.y.end),
        )
    }

    pub(super) fn width(&self) -> f64 {
        self.x.end - self.x.start
    }

    pub(super) fn height(&self) -> f64 {
        self.y.end - self.y.start
    }

    /// The box of this width and height around a centre.
    pub(super) fn centred((x, y): (f64, f64), width: f64, height: f64) -> Self {
        Self {
            x: x - 0.5 * width..x + 0.5 * width,
            y: y - 0.5 * height..y + 0.5 * height,
        }
    }

    pub(super) fn contains(&self, (x, y): (f64, f64)) -> bool {
        self.x.contains(&x) && self.y.contains(&y)
    }

    pub(super) fn corners(&self) -> [(f64, f64); 4] {
        let Self { x, y } = self;
        [
            (x.start, y.start),
            (x.end, y.start),
            (x.end, y.end),
            (x.start, y.end),
        ]
    }
}

/// A drawing to scale of a part of the plane.
pub(super) struct View<'a> {
    pub(super) plane: Plane<'a>,
    pub(super) bounds: Bounds,
    /// Metres per pixel.
    pub(super) pixel: f64,
}

impl<'a> View<'a> {
    /// The bounds on the whole of an area, which has their proportions.
    pub(super) fn new(area: &Area<'a>, bounds: Bounds) -> Drawn<Self> {
        let ranges = (bounds.x.clone(), bounds.y.clone());
        let plane = ChartBuilder::on(area)
            .build_cartesian_2d(ranges.0, ranges.1)?
            .plotting_area()
            .clone();
        let pixel = bounds.width() / size(area).0;
        Ok(Self {
            plane,
            bounds,
            pixel,
        })
    }

    /// A line through points, in a color and a width [px].
    pub(super) fn line(
        &self,
        points: &[(f64, f64)],
        color: impl Into<RGBAColor>,
        width: f64,
    ) -> Drawn {
        self.plane
            .draw(&PathElement::new(points.to_vec(), stroke(color, width)))
    }

    /// A filled polygon.
    pub(super) fn fill(&self, corners: &[(f64, f64)], color: impl Into<RGBAColor>) -> Drawn {
        let color: RGBAColor = color.into();
        self.plane
            .draw(&Polygon::new(corners.to_vec(), color.filled()))
    }

    /// A dot of this radius [px].
    pub(super) fn dot(&self, centre: (f64, f64), radius: f64, color: RGBColor) -> Drawn {
        self.plane
            .draw(&Circle::new(centre, px(radius), color.filled()))
    }

    /// A ring of this radius [px].
    pub(super) fn ring(&self, centre: (f64, f64), radius: f64, color: RGBColor) -> Drawn {
        self.plane
            .draw(&Circle::new(centre, px(radius), stroke(color, 1.8)))
    }

    /// The solid sides of surfaces, shaded, and the boundary of the free space, hatched.
    pub(super) fn surfaces(&self, surfaces: &[SurfaceInfo]) -> Drawn {
        for surface in surfaces {
            let solid = clip(&self.bounds.corners(), |point| -height(surface, point));
            if solid.len() > 2 {
                self.fill(&solid, SOLID)?;
            }
        }
        let tolerance = 1e-9 * (self.bounds.width() + self.bounds.height());
        for surface in surfaces {
            let boundary: Vec<_> = clip(&self.bounds.corners(), |point| -height(surface, point))
                .into_iter()
                .filter(|&point| height(surface, point) >= -tolerance)
                .collect();
            let free = surfaces.iter().fold(boundary, |line, other| {
                clip(&line, |point| height(other, point) + tolerance)
            });
            self.boundary(surface, &free)?;
        }
        Ok(())
    }

    /// A piece of a surface's boundary, hatched on its solid side.
    fn boundary(&self, surface: &SurfaceInfo, points: &[(f64, f64)]) -> Drawn {
        let [nx, ny] = surface.normal;
        let along = points.iter().map(|(x, y)| (ny * x - nx * y, 0.0));
        let Some(Bounds { x: ends, .. }) = Bounds::around(along) else {
            return Ok(());
        };
        let at = |s: f64, depth: f64| {
            let height = surface.offset - depth;
            (ny * s + nx * height, -nx * s + ny * height)
        };
        let (spacing, length) = (9.0 * self.pixel, 7.0 * self.pixel);
        for count in 0..((ends.end - ends.start) / spacing) as usize {
            let s = ends.start + (count as f64 + 0.5) * spacing;
            let foot = at(s - length, length);
            if self.bounds.contains(foot) {
                self.line(&[at(s, 0.0), foot], FAINT, 1.0)?;
            }
        }
        self.line(&[at(ends.start, 0.0), at(ends.end, 0.0)], INK, 1.6)
    }

    /// The outline of the body: a polygon, a rod or a point, in a width [px].
    pub(super) fn outline(
        &self,
        corners: &[(f64, f64)],
        color: impl Into<RGBAColor>,
        width: f64,
    ) -> Drawn {
        let color = color.into();
        match corners {
            [] => Ok(()),
            [point] => self
                .plane
                .draw(&Circle::new(*point, px(3.0), color.filled())),
            [first, ..] => {
                let closed: Vec<_> = corners.iter().chain([first]).copied().collect();
                self.line(&closed, color, width)
            }
        }
    }

    /// An arrow from a point along a vector [m], in a width [px]; one shorter than a pixel is left out.
    pub(super) fn arrow(
        &self,
        from: (f64, f64),
        (x, y): (f64, f64),
        color: RGBColor,
        width: f64,
    ) -> Drawn {
        let length = x.hypot(y);
        if length < self.pixel {
            return Ok(());
        }
        let (ex, ey) = (x / length, y / length);
        let head = (3.2 * width * self.pixel).min(length);
        let half = 0.5 * head;
        let tip = (from.0 + x, from.1 + y);
        let neck = (tip.0 - head * ex, tip.1 - head * ey);
        let side = |s: f64| (neck.0 - s * ey, neck.1 + s * ex);
        self.line(&[from, neck], color, width)?;
        self.fill(&[tip, side(half), side(-half)], color)
    }

    /// A coil between two points.
    pub(super) fn spring(&self, from: (f64, f64), to: (f64, f64), color: RGBColor) -> Drawn {
        const TURNS: usize = 7;
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = x.hypot(y);
        if length < 2.0 * self.pixel {
            return Ok(());
        }
        let width = (4.0 * self.pixel).min(0.3 * length) / length;
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
        let coil: Vec<_> = (0..=2 * TURNS).map(point).collect();
        self.line(&coil, color, 1.3)
    }
}

/// Height of a point above a surface [m]; negative inside.
pub(super) fn height(surface: &SurfaceInfo, (x, y): (f64, f64)) -> f64 {
    surface.normal[0] * x + surface.normal[1] * y - surface.offset
}

/// The part of a convex polygon where `depth`, an affine function, is not negative.
pub(super) fn clip(corners: &[(f64, f64)], depth: impl Fn((f64, f64)) -> f64) -> Vec<(f64, f64)> {
    let mut kept = Vec::new();
    for (index, &a) in corners.iter().enumerate() {
        let b = corners[(index + 1) % corners.len()];
        let (da, db) = (depth(a), depth(b));
        if da >= 0.0 {
            kept.push(a);
        }
        if (da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0) {
            let s = da / (da - db);
            kept.push((a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1)));
        }
    }
    kept
}

/// The corners of the body in the world at a pose x, y [m], theta [rad].
pub(super) fn corners(body: &[[f64; 2]], [x, y, theta]: [f64; 3]) -> Vec<(f64, f64)> {
    let (sin, cos) = theta.sin_cos();
    let place = |&[u, v]: &[f64; 2]| (x + cos * u - sin * v, y + sin * u + cos * v);
    body.iter().map(place).collect()
}

/// Angle of the hand [rad]; while it holds the body less its offset in the grip, so that it differs from the body's angle
/// only by what the rotational spring yields.
pub(super) fn hand_angle(run: &Run, frame: &Frame) -> f64 {
    if frame.held && run.stiffness_rotation > 0.0 {
        frame.pose[2] + frame.wrench[2] / run.stiffness_rotation
    } else {
        frame.hand[2]
    }
}

/// A length unit that suits an extent [m]: its name and how many of it make a metre.
pub(super) fn length_unit(extent: f64) -> (&'static str, f64) {
    if extent < 2.0 {
        ("mm", 1e3)
    } else {
        ("m", 1.0)
    }
}
