//! Level tops: sides of the world that lie in one line within 2^-19 L are one floor (STATICS 12, R35). Decided once for a scene: every law is
//! about the obstacles with their corners on the lines that their sides share, and at one place where they meet. World frame (m).

use std::cmp::Ordering;

use crate::body::size;
use crate::obstacles::OVERLAP;
use crate::scene::{Obstacle, Scene};
use crate::shape::{ends, outward, sides};
use crate::vector::{Vec2, add, cross, distance, dot, scaled, sub};

/// Lines at a smaller angle (its sine) have no place in common that is known well enough.
const PARALLEL: f64 = 1.0 / 16.0;

/// n·x = offset
#[derive(Clone, Copy)]
struct Line {
    normal: Vec2,
    offset: f64,
}

/// A side of an obstacle.
struct Side {
    obstacle: usize,
    side: usize,
    ends: [Vec2; 2],
}

impl Side {
    fn length(&self) -> f64 {
        distance(self.ends[0], self.ends[1])
    }
}

impl Line {
    /// The line of a side.
    fn of(shape: &[Vec2], side: usize) -> Self {
        let normal = outward(shape, side);
        Self {
            normal,
            offset: dot(normal, ends(shape, side)[0]),
        }
    }

    fn height(&self, at: Vec2) -> f64 {
        dot(self.normal, at) - self.offset
    }

    fn is_near(&self, at: Vec2, near: f64) -> bool {
        self.height(at).abs() <= near
    }

    fn turned(&self) -> Self {
        Self {
            normal: scaled(self.normal, -1.0),
            offset: -self.offset,
        }
    }

    fn onto(&self, at: Vec2) -> Vec2 {
        sub(at, scaled(self.normal, self.height(at)))
    }
}

/// The obstacles of a scene, level.
pub(crate) fn level(scene: &Scene) -> Vec<Obstacle> {
    let near = OVERLAP * size(&scene.vertices);
    let planes = scene.surfaces.iter().map(|surface| Line {
        normal: surface.normal,
        offset: surface.offset,
    });
    let mut lines: Vec<Line> = planes.collect();
    let mut all: Vec<Side> = Vec::new();
    for (obstacle, shape) in scene.obstacles.iter().map(|o| &o.vertices).enumerate() {
        all.extend((0..sides(shape)).map(|side| Side {
            obstacle,
            side,
            ends: ends(shape, side),
        }));
    }
    all.sort_by(|a, b| b.length().total_cmp(&a.length()));
    // Of every side, with where in the lines it is.
    let mut own: Vec<Vec<usize>> = scene
        .obstacles
        .iter()
        .map(|o| vec![0; sides(&o.vertices)])
        .collect();
    let mut shared = own.clone();
    for side in &all {
        let line = Line::of(&scene.obstacles[side.obstacle].vertices, side.side);
        let is_same = |other: &Line| {
            dot(other.normal, line.normal) > 0.0
                && side.ends.iter().all(|&end| other.is_near(end, near))
        };
        let found = lines.iter().position(is_same);
        own[side.obstacle][side.side] = found.unwrap_or(lines.len());
        shared[side.obstacle][side.side] = usize::from(found.is_some());
        if found.is_none() {
            lines.push(line);
        }
    }
    // A thin wall has one line, whichever of its sides shares it.
    for (own, shared) in own.iter().zip(&shared) {
        if let (&[front, back], &[of_front, of_back]) = (own.as_slice(), shared.as_slice()) {
            match of_front.cmp(&of_back) {
                Ordering::Greater => lines[back] = lines[front].turned(),
                Ordering::Less => lines[front] = lines[back].turned(),
                Ordering::Equal => {}
            }
        }
    }
    let mut places: Vec<Vec2> = Vec::new();
    let mut levelled = scene.obstacles.clone();
    for (obstacle, own) in levelled.iter_mut().zip(own) {
        let own: Vec<Line> = own.iter().map(|&line| lines[line]).collect();
        let count = own.len();
        for (k, at) in obstacle.vertices.iter_mut().enumerate() {
            let mut shared = lines.iter().filter(|line| line.is_near(*at, near));
            let sides = (count > 0).then(|| [own[k], own[(k + count - 1) % count]]);
            // A pin and an end of a thin wall are where two lines cross.
            let first = sides
                .map(|[side, _]| side)
                .or_else(|| shared.next().copied());
            let placed = first.map_or(*at, |line| {
                sides
                    .and_then(|both| meeting(*at, both))
                    .or_else(|| shared.find_map(|other| meeting(*at, [line, *other])))
                    .unwrap_or_else(|| line.onto(*at))
            });
            let same = places
                .iter()
                .find(|other| distance(**other, placed) <= near);
            *at = same.copied().unwrap_or(placed);
            places.push(*at);
        }
    }
    levelled
}

/// The corner near a point between two lines; none if they are almost parallel.
fn meeting(at: Vec2, [a, b]: [Line; 2]) -> Option<Vec2> {
    let sine = cross(a.normal, b.normal);
    let turned = |[x, y]: Vec2| [-y, x];
    let along = |line: &Line, part: f64| scaled(turned(line.normal), part / sine);
    let place = || add(at, sub(along(&b, a.height(at)), along(&a, b.height(at))));
    (sine.abs() >= PARALLEL).then(place)
}

#[cfg(test)]
mod tests {
    use super::level;
    use crate::scene::{Obstacle, Scene};
    use crate::sides::Sides;

    /// Two tiles of 1 m side by side, the second of them lower by this (m), and a body of 1 m.
    fn floor(lower: f64) -> Scene {
        let tile = |x: f64, top: f64| Obstacle {
            name: String::new(),
            vertices: vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, top], [x, top]],
            friction_static: 0.5,
            friction_dynamic: 0.3,
            memory: None,
        };
        Scene {
            vertices: vec![[0.0, 0.0], [1.0, 0.0]],
            start: [0.0, 2.0, 0.0],
            weight: 0.0,
            holding_point: None,
            stiffness_translation: 1.0,
            stiffness_rotation: 1.0,
            surfaces: Vec::new(),
            obstacles: vec![tile(0.0, 1.0), tile(1.0, 1.0 - lower)],
        }
    }

    #[test]
    fn tops_within_two_to_the_minus_19_are_one_floor() {
        let mut scene = floor(1e-6);
        scene.obstacles = level(&scene);
        let [_, second] = scene.obstacles.as_slice() else {
            panic!("two tiles");
        };
        assert!((second.vertices[2][1] - 1.0).abs() < 1e-15);
        let [low, high] = Sides::new(&scene).run(1, 2);
        assert!((high - low - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_higher_step_is_a_step() {
        let scene = floor(4e-6);
        assert_eq!(level(&scene), scene.obstacles);
    }
}
