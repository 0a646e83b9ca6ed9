//! Level tops: sides of the world that lie in one line within 2^-19 L are one floor (STATICS 12, R35). Decided once for a scene: every law is
//! about the obstacles with their corners on the lines that their sides share, and at one place where they meet. World frame (m).

use std::cmp::Ordering;

use crate::body::size;
use crate::obstacles::OVERLAP;
use crate::scene::{Obstacle, Scene};
use crate::shape::{ends, outward, sides};
use crate::vector::{Vec2, add, cross, distance, dot, scaled, sub};

/// Levels at a smaller angle (its sine) have no place in common that is known well enough.
const PARALLEL: f64 = 1.0 / 16.0;

/// n·x = offset
#[derive(Clone, Copy)]
struct Line {
    normal: Vec2,
    offset: f64,
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

/// The lines of a scene, and for every obstacle and side which it is.
struct Levels {
    all: Vec<Line>,
    of_sides: Vec<Vec<usize>>,
}

impl Levels {
    /// Every side takes the line of a half-plane or of a longer side of its direction that both of its ends are near.
    fn of(scene: &Scene, near: f64) -> Self {
        let planes = scene.surfaces.iter().map(|surface| Line {
            normal: surface.normal,
            offset: surface.offset,
        });
        let mut all: Vec<Line> = planes.collect();
        let shape = |obstacle: usize| scene.obstacles[obstacle].vertices.as_slice();
        let of = |obstacle: usize| (0..sides(shape(obstacle))).map(move |side| (obstacle, side));
        let mut order: Vec<(usize, usize)> = (0..scene.obstacles.len()).flat_map(of).collect();
        let length = |&(obstacle, side): &(usize, usize)| {
            let [from, to] = ends(shape(obstacle), side);
            distance(from, to)
        };
        order.sort_by(|a, b| length(b).total_cmp(&length(a)));
        let none = |obstacle: &Obstacle| vec![0; sides(&obstacle.vertices)];
        let mut of_sides: Vec<Vec<usize>> = scene.obstacles.iter().map(none).collect();
        let mut shared = of_sides.clone();
        for (obstacle, side) in order {
            let (line, ends) = (Line::of(shape(obstacle), side), ends(shape(obstacle), side));
            let is_same = |other: &Line| {
                dot(other.normal, line.normal) > 0.0
                    && ends.iter().all(|&end| other.is_near(end, near))
            };
            let found = all.iter().position(is_same);
            of_sides[obstacle][side] = found.unwrap_or(all.len());
            shared[obstacle][side] = usize::from(found.is_some());
            if found.is_none() {
                all.push(line);
            }
        }
        // A thin wall has one line, whichever of its sides shares it.
        for (own, shared) in of_sides.iter().zip(&shared) {
            if let (&[front, back], &[of_front, of_back]) = (own.as_slice(), shared.as_slice()) {
                match of_front.cmp(&of_back) {
                    Ordering::Greater => all[back] = all[front].turned(),
                    Ordering::Less => all[front] = all[back].turned(),
                    Ordering::Equal => {}
                }
            }
        }
        Self { all, of_sides }
    }

    /// A corner where the lines of its sides meet, a pin and an end of a thin wall where two lines cross.
    fn placed(&self, at: Vec2, own: Option<[Line; 2]>, near: f64) -> Vec2 {
        let mut shared = self.all.iter().filter(|line| line.is_near(at, near));
        let first = own.map(|[side, _]| side);
        let Some(line) = first.or_else(|| shared.next().copied()) else {
            return at;
        };
        let of_sides = own.and_then(|both| meeting(at, both));
        let across = || shared.find_map(|other| meeting(at, [line, *other]));
        of_sides.or_else(across).unwrap_or_else(|| line.onto(at))
    }
}

/// The obstacles of a scene, level.
pub(crate) fn level(scene: &Scene) -> Vec<Obstacle> {
    let near = OVERLAP * size(&scene.vertices);
    let lines = Levels::of(scene, near);
    let mut places: Vec<Vec2> = Vec::new();
    let mut levelled = scene.obstacles.clone();
    for (obstacle, own) in levelled.iter_mut().zip(&lines.of_sides) {
        let count = own.len();
        for (k, at) in obstacle.vertices.iter_mut().enumerate() {
            let both = (count > 0).then(|| [own[k], own[(k + count - 1) % count]]);
            let placed = lines.placed(*at, both.map(|both| both.map(|line| lines.all[line])), near);
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
