//! The names of obstacles in the plane, and their corners that are touched. World frame, m.

use std::ops::Range;

use plotters::prelude::*;
use stiction_live::drawing::{HATCH, Point, Window, centroid, corners_of, depth_in};
use stiction_scene::{ObstacleInfo, SurfaceInfo, WrittenScene};

use super::plane::View;
use super::sheet::{Drawn, px, stroke};
use super::style::{FAINT, SMALL, SOLID, centred, font, text_width};

/// Height of a name, its distance from lines and solids, and the spacing of the places that are tried [px].
const NAME: f64 = 14.0;
const CLEAR: f64 = 4.0;
const STEP: f64 = 4.0;

impl View<'_> {
    /// The names of the obstacles, each in the middle of its visible part and within its hatches, or not at all.
    pub(super) fn names_inside(&self, obstacles: &[ObstacleInfo]) -> Drawn {
        for obstacle in obstacles {
            let seen = self.window.visible(&corners_of(obstacle));
            let Some(middle) = centroid(&seen) else {
                continue;
            };
            let (width, height) = self.size(&obstacle.name);
            let room = Window::centred(middle, width, height);
            if is_inside(&room, &seen, HATCH * self.pixel) {
                self.name(&obstacle.name, &room)?;
            }
        }
        Ok(())
    }

    /// The names of the obstacles, each in its visible part, or else next to it, clear of convex shapes that are drawn and of one another.
    /// A name without such a place is left out.
    pub(super) fn names(&self, scene: &WrittenScene, mut drawn: Vec<Vec<Point>>) -> Drawn {
        let solids: Vec<_> = scene.obstacles.iter().map(corners_of).collect();
        let clear = CLEAR * self.pixel;
        for (obstacle, corners) in scene.obstacles.iter().zip(&solids) {
            let seen = self.window.visible(corners);
            let mut rooms = self.rooms(&seen, self.size(&obstacle.name));
            rooms.retain(|room| drawn.iter().all(|shape| is_apart(room, shape, clear)));
            let inside = |margin: f64| rooms.iter().find(|room| is_inside(room, &seen, margin));
            let is_outside = |room: &&Window| {
                let mut surfaces = scene.surfaces.iter();
                solids.iter().all(|solid| is_apart(room, solid, clear))
                    && surfaces.all(|surface| is_above(room, surface))
            };
            let within = inside(HATCH * self.pixel).or_else(|| inside(0.0));
            if let Some(room) = within {
                // Over the hatches.
                self.fill(&room.corners(), SOLID)?;
            }
            if let Some(room) = within.or_else(|| rooms.iter().find(is_outside)) {
                self.name(&obstacle.name, room)?;
                drawn.push(room.corners().to_vec());
            }
        }
        Ok(())
    }

    /// The width and the height of a name [m].
    fn size(&self, name: &str) -> (f64, f64) {
        (text_width(name, SMALL) * self.pixel, NAME * self.pixel)
    }

    /// The rooms of this size in the window on and around the visible part of an obstacle, the nearest to its middle first.
    fn rooms(&self, seen: &[Point], (width, height): (f64, f64)) -> Vec<Window> {
        let Some(extent) = Window::around(seen.iter().copied()) else {
            return Vec::new();
        };
        let (x, y) = centroid(seen).unwrap_or(extent.centre());
        let (step, around) = (STEP * self.pixel, 2.0 * CLEAR * self.pixel);
        let places = |middle: f64, range: &Range<f64>, half: f64| {
            let steps = |length: f64| ((length + half + around) / step) as i32;
            let all = -steps(middle - range.start)..=steps(range.end - middle);
            all.map(move |k| middle + f64::from(k) * step)
        };
        let rows = places(y, &extent.y, 0.5 * height);
        let centres = rows.flat_map(|y| places(x, &extent.x, 0.5 * width).map(move |x| (x, y)));
        let mut rooms: Vec<_> = centres
            .map(|centre| Window::centred(centre, width, height))
            .filter(|room| {
                room.corners()
                    .iter()
                    .all(|&corner| self.window.contains(corner))
            })
            .collect();
        let far = |room: &Window| {
            let centre = room.centre();
            (centre.0 - x).hypot(centre.1 - y)
        };
        rooms.sort_by(|a, b| far(a).total_cmp(&far(b)));
        rooms
    }

    fn name(&self, name: &str, room: &Window) -> Drawn {
        let style = centred(&font(SMALL).color(&FAINT));
        self.plane
            .draw(&Text::new(name.to_owned(), room.centre(), style))
    }

    /// A corner of an obstacle that is touched.
    pub(super) fn touched_corner(&self, place: Point, color: RGBColor) -> Drawn {
        self.dot(place, 3.0, color)?;
        self.plane
            .draw(&Circle::new(place, px(6.0), stroke(color, 1.6)))
    }
}

/// Whether a room is in a polygon, this far from its sides [m].
fn is_inside(room: &Window, polygon: &[Point], margin: f64) -> bool {
    let mut corners = room.corners().into_iter();
    polygon.len() > 2 && corners.all(|corner| depth_in(polygon, corner) >= margin)
}

/// Whether a room is this far from a convex shape: a polygon, a line or a point [m].
fn is_apart(room: &Window, shape: &[Point], clear: f64) -> bool {
    let (width, height) = (room.width() + 2.0 * clear, room.height() + 2.0 * clear);
    let wide = Window::centred(room.centre(), width, height);
    let is_beside = |axis: fn(&Point) -> f64, range: &Range<f64>| {
        shape.iter().all(|point| axis(point) < range.start)
            || shape.iter().all(|point| axis(point) > range.end)
    };
    is_beside(|point| point.0, &wide.x)
        || is_beside(|point| point.1, &wide.y)
        || wide.visible(shape).is_empty()
}

/// Whether a room is outside a surface.
fn is_above(room: &Window, surface: &SurfaceInfo) -> bool {
    let [nx, ny] = surface.normal;
    let mut corners = room.corners().into_iter();
    corners.all(|(x, y)| nx * x + ny * y > surface.offset)
}
