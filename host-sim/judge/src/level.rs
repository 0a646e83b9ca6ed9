//! Level tops: sides of the world that lie in one line within 2^-19 L are one floor (STATICS 12, R35). Decided once for a scene: every law is
//! about the obstacles with their corners on the lines that their sides share, and at one place where they meet. World frame (m).

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

impl Line {
    fn height(&self, at: Vec2) -> f64 {
        dot(self.normal, at) - self.offset
    }

    fn is_near(&self, at: Vec2, near: f64) -> bool {
        self.height(at).abs() <= near
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
    let mut own = Vec::new();
    for obstacle in &scene.obstacles {
        let shape = &obstacle.vertices;
        let first = lines.len();
        for side in 0..sides(shape) {
            let line = line_of(shape, side, (&lines, near));
            lines.push(line);
        }
        own.push(first..lines.len());
    }
    let mut places: Vec<Vec2> = Vec::new();
    let mut levelled = scene.obstacles.clone();
    for (obstacle, own) in levelled.iter_mut().zip(own) {
        let own = &lines[own];
        let count = own.len();
        for (k, at) in obstacle.vertices.iter_mut().enumerate() {
            let placed = if count == 0 {
                let line = lines.iter().find(|line| line.is_near(*at, near));
                line.map_or(*at, |line| line.onto(*at))
            } else {
                meeting(*at, [own[k], own[(k + count - 1) % count]])
            };
            let same = places
                .iter()
                .find(|other| distance(**other, placed) <= near);
            *at = same.copied().unwrap_or(placed);
            places.push(*at);
        }
    }
    levelled
}

/// The line of a side: that of an earlier one of its direction if both ends are on it.
fn line_of(shape: &[Vec2], side: usize, (earlier, near): (&[Line], f64)) -> Line {
    let (normal, ends) = (outward(shape, side), ends(shape, side));
    let is_same = |line: &&Line| {
        dot(line.normal, normal) > 0.0 && ends.iter().all(|&end| line.is_near(end, near))
    };
    let own = Line {
        normal,
        offset: dot(normal, ends[0]),
    };
    earlier.iter().find(is_same).copied().unwrap_or(own)
}

/// The corner near a point between two lines.
fn meeting(at: Vec2, [a, b]: [Line; 2]) -> Vec2 {
    let sine = cross(a.normal, b.normal);
    if sine.abs() < PARALLEL {
        return a.onto(at);
    }
    let turned = |[x, y]: Vec2| [-y, x];
    let along = |line: &Line, part: f64| scaled(turned(line.normal), part / sine);
    add(at, sub(along(&b, a.height(at)), along(&a, b.height(at))))
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
