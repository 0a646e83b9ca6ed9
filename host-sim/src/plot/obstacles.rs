//! The names of obstacles in the plane, and their corners that are touched. World frame, m.

use plotters::prelude::*;
use stiction_live::drawing::{HATCH, Point, Window, centroid, corners_of, depth_in};
use stiction_scene::ObstacleInfo;

use super::plane::View;
use super::sheet::{Drawn, px, stroke};
use super::style::{FAINT, SMALL, centred, font, text_width};

/// Height of a name [px].
const NAME: f64 = 14.0;

impl View<'_> {
    /// The names of the obstacles, each in the middle of the visible part; if that is too small, next to it, or not at all.
    pub(super) fn names(&self, obstacles: &[ObstacleInfo], beside: bool) -> Drawn {
        for obstacle in obstacles {
            let seen = self.window.visible(&corners_of(obstacle));
            let Some(extent) = Window::around(seen.iter().copied()) else {
                continue;
            };
            let width = text_width(&obstacle.name, SMALL) * self.pixel;
            let middle = centroid(&seen).unwrap_or(extent.centre());
            // Within its hatches, or else over them where names are wanted in any case.
            let margin = if beside { 0.0 } else { HATCH * self.pixel };
            let room = Window::centred(middle, width, NAME * self.pixel);
            let is_inside = |&place: &Point| depth_in(&seen, place) >= margin;
            if seen.len() > 2 && room.corners().iter().all(is_inside) {
                self.name(&obstacle.name, middle, true)?;
            } else if beside {
                let place = self.beside(&extent, obstacle.vertices.len() == 2, width);
                self.name(&obstacle.name, place, false)?;
            }
        }
        Ok(())
    }

    /// The start of a name of this width next to the visible part of an obstacle: for a wall, above or next to its middle.
    fn beside(&self, seen: &Window, is_wall: bool, width: f64) -> Point {
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
        let fits = right + width <= self.window.x.end;
        (if fits { right } else { left }, y)
    }

    fn name(&self, name: &str, place: Point, middle: bool) -> Drawn {
        let style = font(SMALL).color(&FAINT);
        let style = if middle { centred(&style) } else { style };
        self.plane.draw(&Text::new(name.to_owned(), place, style))
    }

    /// A corner of an obstacle that is touched.
    pub(super) fn touched_corner(&self, place: Point, color: RGBColor) -> Drawn {
        self.dot(place, 3.0, color)?;
        self.plane
            .draw(&Circle::new(place, px(6.0), stroke(color, 1.6)))
    }
}
