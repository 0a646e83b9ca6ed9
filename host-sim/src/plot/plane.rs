//! The plane in which the body moves, drawn to scale: surfaces, body, spring and forces. World frame, m and N.

use plotters::prelude::*;
use stiction_live::drawing::{Arrow, Point, Role, Solids, Window, spring};

use super::sheet::{Area, Drawn, Plane, px, size, stroke};
use super::style::{FAINT, INK, SOLID};
use stiction_live::record::{Frame, Run};

/// Distance between two hatches (px).
const SPACING: f64 = 9.0;
/// Distance along a path between two heads that show its direction, and their length (px). Turns within `TURNS`, as of stick-slip, do not
/// count: a head shows where they lead.
const HEADS: f64 = 90.0;
const HEAD: f64 = 9.0;
const TURNS: f64 = 14.0;

/// A drawing to scale of a part of the plane.
pub(super) struct View<'a> {
    pub(super) plane: Plane<'a>,
    pub(super) window: Window,
    /// Metres per pixel.
    pub(super) pixel: f64,
}

impl<'a> View<'a> {
    /// A window on the whole of an area, which has its proportions.
    pub(super) fn new(area: &Area<'a>, window: Window) -> Drawn<Self> {
        let ranges = (window.x.clone(), window.y.clone());
        let plane = ChartBuilder::on(area)
            .build_cartesian_2d(ranges.0, ranges.1)?
            .plotting_area()
            .clone();
        let pixel = window.width() / size(area).0;
        Ok(Self {
            plane,
            window,
            pixel,
        })
    }

    /// A line through points, in a color and a width [px].
    pub(super) fn line(&self, points: &[Point], color: impl Into<RGBAColor>, width: f64) -> Drawn {
        self.plane
            .draw(&PathElement::new(points.to_vec(), stroke(color, width)))
    }

    pub(super) fn fill(&self, corners: &[Point], color: impl Into<RGBAColor>) -> Drawn {
        let color: RGBAColor = color.into();
        self.plane
            .draw(&Polygon::new(corners.to_vec(), color.filled()))
    }

    /// A dot of this radius [px].
    pub(super) fn dot(&self, centre: Point, radius: f64, color: RGBColor) -> Drawn {
        self.plane
            .draw(&Circle::new(centre, px(radius), color.filled()))
    }

    /// A ring of this radius [px].
    pub(super) fn ring(&self, centre: Point, radius: f64, color: RGBColor) -> Drawn {
        self.plane
            .draw(&Circle::new(centre, px(radius), stroke(color, 1.8)))
    }

    /// All that is solid: its inside shaded, its free border hatched.
    pub(super) fn solids(&self, run: &Run) -> Drawn {
        let solids = Solids {
            surfaces: &run.scene.surfaces,
            obstacles: &run.scene.obstacles,
            window: &self.window,
            pixel: self.pixel,
            spacing: SPACING,
        };
        for shape in solids.shapes() {
            let points = &shape.points;
            match shape.role {
                Role::Surface | Role::Obstacle => self.fill(points, SOLID)?,
                Role::Border => self.line(points, INK, 1.6)?,
                Role::Hatch => self.line(points, FAINT, 1.0)?,
                Role::Wall => self.line(points, INK, 3.0)?,
                Role::Pin => self.dot(points[0], 3.5, INK)?,
            }
        }
        Ok(())
    }

    /// The outline of the body: a polygon, a rod or a point, in a width [px].
    pub(super) fn outline(
        &self,
        corners: &[Point],
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
    pub(super) fn arrow(&self, from: Point, along: Point, color: RGBColor, width: f64) -> Drawn {
        let Some(arrow) = Arrow::new(from, along, width, self.pixel) else {
            return Ok(());
        };
        self.line(&arrow.shaft, color, width)?;
        self.fill(&arrow.head, color)
    }

    /// The direction of a path: heads of arrows on it, [`HEADS`] apart, the first after half of that or in the middle of a short path.
    pub(super) fn direction(&self, points: &[Point], color: RGBColor) -> Drawn {
        let Some(&end) = points.last() else {
            return Ok(());
        };
        let distance = |a: Point, b: Point| (b.0 - a.0).hypot(b.1 - a.1) / self.pixel;
        let mut steps: Vec<Point> = Vec::new();
        for &point in points {
            if steps
                .last()
                .is_none_or(|last| distance(*last, point) >= TURNS)
            {
                steps.push(point);
            }
        }
        let pairs = || steps.windows(2).map(|ends| (ends[0], ends[1]));
        let length: f64 = pairs().map(|(from, to)| distance(from, to)).sum();
        let mut left = 0.5 * HEADS.min(length);
        for (from, to) in pairs() {
            left -= distance(from, to);
            // The nearest step; a mark at the end would cover it.
            if left <= 0.5 * TURNS && distance(to, end) > 2.0 * HEAD {
                self.head(from, to, color)?;
                left = HEADS;
            }
        }
        Ok(())
    }

    /// The head of an arrow from one point to another.
    fn head(&self, from: Point, to: Point, color: RGBColor) -> Drawn {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = x.hypot(y);
        let (ex, ey) = (x / length, y / length);
        let (long, half) = (HEAD * self.pixel, 0.4 * HEAD * self.pixel);
        let back = (to.0 - long * ex, to.1 - long * ey);
        let side = |s: f64| (back.0 - s * ey, back.1 + s * ex);
        self.fill(&[to, side(half), side(-half)], color)
    }

    pub(super) fn spring(&self, from: Point, to: Point, color: RGBColor) -> Drawn {
        match spring(from, to, self.pixel) {
            Some(coil) => self.line(&coil, color, 1.3),
            None => Ok(()),
        }
    }
}

/// Angle of the hand [rad]; while it holds the body less its offset in the grip, so that it differs from the body's angle
/// only by what the rotational spring yields.
pub(super) fn hand_angle(run: &Run, frame: &Frame) -> f64 {
    if frame.held && run.scene.stiffness_rotation > 0.0 {
        frame.pose[2] + frame.wrench[2] / run.scene.stiffness_rotation
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
