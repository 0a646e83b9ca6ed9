//! Where a contact is: the line of its side, its ends, and whatever is behind it. World frame, m.

use super::super::shape::{Point, dot, ends, length, neighbours, outward, sides, sub};
use super::Laws;
use crate::reference::Touch;

/// Line and ends of a contact in a pose.
pub(super) struct Line {
    pub(super) point: Point,
    pub(super) normal: Point,
    /// Distance of the contact's point from the contact's line, along the normal (m).
    pub(super) gap: f64,
    /// How far the point is past the nearer end of its side (m).
    pub(super) beyond: f64,
    /// The deepest neighbour behind the line (m).
    pub(super) behind: f64,
}

impl Laws {
    /// `None` if there is no such contact.
    pub(super) fn line(&self, body: &[Point], touch: Touch) -> Option<Line> {
        let behind = |normal: Point, point: Point, others: &[Point], sign: f64| {
            let depth = others.iter().map(|&p| -sign * dot(normal, sub(p, point)));
            depth.fold(f64::NEG_INFINITY, f64::max)
        };
        match touch {
            Touch::Surface { vertex, surface } => {
                let surface = self.among.setup.surfaces.get(surface)?;
                let point = *body.get(vertex)?;
                let long = length(surface.normal);
                let normal = surface.normal.map(|n| n / long);
                Some(Line {
                    point,
                    normal,
                    gap: dot(normal, point) - surface.offset / long,
                    beyond: f64::NEG_INFINITY,
                    behind: behind(normal, point, &neighbours(body, vertex), 1.0),
                })
            }
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => {
                let shape = &self.among.obstacles.get(obstacle)?.vertices;
                let point = *body.get(vertex)?;
                let (normal, gap, _) = side_of(shape, side, point)?;
                Some(Line {
                    point,
                    normal,
                    gap,
                    beyond: self.past(obstacle, side, point),
                    behind: behind(normal, point, &neighbours(body, vertex), 1.0),
                })
            }
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => {
                let shape = &self.among.obstacles.get(obstacle)?.vertices;
                let point = *shape.get(corner)?;
                let (normal, gap, beyond) = side_of(body, body_side, point)?;
                let normal = normal.map(|x| -x);
                Some(Line {
                    point,
                    normal,
                    gap,
                    beyond,
                    behind: behind(normal, point, &neighbours(shape, corner), -1.0),
                })
            }
        }
    }

    /// How far a point is past the end of a side, or of the line that several coplanar sides form: if they meet and have the same
    /// friction, the solver reports the first of them for all.
    fn past(&self, obstacle: usize, side: usize, point: Point) -> f64 {
        let all = &self.among.obstacles;
        let normal = outward(&all[obstacle].vertices, side);
        let seam = 1e-6 * self.size;
        let is_coplanar = |[from, to]: &[Point; 2]| {
            let [a, b] = ends(&all[obstacle].vertices, side);
            let off = [from, to].map(|p| dot(normal, sub(*p, a)).abs());
            let along = dot(sub(*to, *from), sub(b, a));
            off[0].max(off[1]) <= seam && along > 0.0
        };
        let others = all.iter().filter(|o| o.friction == all[obstacle].friction);
        let sides = others.flat_map(|o| {
            let count = sides(&o.vertices);
            (0..count).map(|side| ends(&o.vertices, side))
        });
        let coplanar = sides.filter(is_coplanar);
        let past = coplanar.map(|side| beyond(side, point));
        past.fold(f64::INFINITY, f64::min)
    }
}

/// Normal of a side of a shape, gap of a point above it, and how far the point is past the side's ends; `None` if there is no such side.
fn side_of(shape: &[Point], side: usize, point: Point) -> Option<(Point, f64, f64)> {
    if side >= sides(shape) {
        return None;
    }
    let normal = outward(shape, side);
    let both = ends(shape, side);
    Some((
        normal,
        dot(normal, sub(point, both[0])),
        beyond(both, point),
    ))
}

/// How far a point is past the ends of a side, along it; negative between them.
fn beyond([from, to]: [Point; 2], point: Point) -> f64 {
    let along = sub(to, from);
    let long = length(along);
    let place = dot(along, sub(point, from)) / long;
    (-place).max(place - long)
}
