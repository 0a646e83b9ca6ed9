//! Random scenes of a body among obstacles of all shapes, with hand paths of ordinary use: the hand approaches from outside,
//! presses, drags, turns and withdraws. They are the same on every machine: only IEEE 754 arithmetic is used.

use super::scene::{Among, Obstacle};
use super::shape::{Point, placed, separation};
use crate::draw::Draw;
use crate::run::between;
use crate::setup::Setup;

pub(crate) mod pieces;

/// Frames of a path, including the first.
pub const FRAMES: usize = 401;
/// Frames per second, for scene files.
pub const RATE: f64 = 1000.0;
/// The body is at least this far from everything at the start, in body sizes.
const CLEAR: f64 = 0.05;
/// The number of obstacles of a scene.
const OBSTACLES: usize = 4;
/// The hand stays this close to the start, in body sizes: fixed point represents up to 8.
const FAR: f64 = 3.5;

/// A scene and a hand's path through it.
#[derive(Clone, Debug)]
pub struct World {
    /// The scene.
    pub among: Among,
    /// Frame, and x, y (m), phi (rad) of the hand in it; straight lines in between.
    pub keyframes: Vec<(usize, [f64; 3])>,
    /// The convex cell that the body cannot leave, if it is in one (m).
    pub room: Option<Vec<Point>>,
}

impl World {
    /// The hand, frame by frame.
    pub fn hands(&self) -> Vec<[f64; 3]> {
        frame_by_frame(&self.keyframes)
    }

    /// As a scene file.
    pub fn toml(&self) -> String {
        let keyframe = |&(frame, [x, y, phi]): &(usize, [f64; 3])| [frame as f64 / RATE, x, y, phi];
        let keyframes: Vec<_> = self.keyframes.iter().map(keyframe).collect();
        self.among.toml(&keyframes, RATE)
    }
}

/// The hand, frame by frame, on straight lines between the keyframes.
pub(crate) fn frame_by_frame(keyframes: &[(usize, [f64; 3])]) -> Vec<[f64; 3]> {
    let mut hands = vec![keyframes[0].1];
    for pair in keyframes.windows(2) {
        let ((first, from), (last, to)) = (pair[0], pair[1]);
        let part = |i: usize| i as f64 / (last - first) as f64;
        hands.extend((1..=last - first).map(|i| between(from, to, part(i))));
    }
    hands
}

/// The scene with this number.
pub fn world(number: u64) -> World {
    // A different sequence from that of the other random scenes.
    let draw = &mut Draw::new(0x0b57_ac1e + number);
    let body = pieces::body(draw);
    let start = [0.0, 0.0, draw.between(-3.0, 3.0)];
    let shape = placed(&body, start);
    let frictions = draw.below(4);
    let obstacles = obstacles(draw, (&body, &shape), frictions);
    let held = [draw.between(-0.3, 0.3), draw.between(-0.3, 0.3)];
    let stiffness = draw.one(&[0.02, 0.1, 0.5, 2.0]) * draw.between(0.5, 1.0);
    let weighs = draw.below(3) == 0;
    let weight = if weighs { draw.between(0.01, 0.3) } else { 0.0 };
    let mut setup = Setup::new(&body)
        .at(start)
        .held_at(held)
        .springs(1.0, stiffness)
        .weighing(weight);
    for [normal, [offset, _], friction] in half_planes(draw, &shape, frictions) {
        setup = setup.surface(normal, offset, friction);
    }
    let keyframes = path(draw, &setup, &obstacles);
    let among = Among { setup, obstacles };
    // The size of a point is 1 m, whatever its surroundings.
    let size = if body.len() == 1 {
        1.0
    } else {
        draw.one(&[0.01, 0.1, 1.0, 10.0])
    };
    scaled(
        World {
            among,
            keyframes,
            room: None,
        },
        size,
        draw.one(&[10.0, 500.0, 4000.0]),
    )
}

/// mu_s = mu_d, mu_s > mu_d, no friction, or a mixture of the three.
pub(crate) fn friction(draw: &mut Draw, kind: usize) -> [f64; 2] {
    let mu_s = draw.between(0.05, 1.2);
    let less = mu_s * draw.between(0.3, 0.95);
    let kind = if kind == 3 { draw.below(3) } else { kind };
    match kind {
        0 => [mu_s, mu_s],
        1 => [mu_s, less],
        _ => [0.0, 0.0],
    }
}

fn obstacles(draw: &mut Draw, (body, shape): (&[Point], &[Point]), kind: usize) -> Vec<Obstacle> {
    let mut all: Vec<Obstacle> = Vec::new();
    let count = 1 + draw.below(OBSTACLES);
    while all.len() < count {
        let group = pieces::group(draw, body);
        let friction = friction(draw, kind);
        let pins = body.len() == 1 && group.iter().any(|piece| piece.len() == 1);
        let is_clear = group.iter().all(|piece| separation(piece, shape) >= CLEAR);
        if !pins && is_clear && all.len() + group.len() <= OBSTACLES {
            all.extend(
                group
                    .into_iter()
                    .map(|vertices| Obstacle { vertices, friction }),
            );
        }
    }
    all
}

/// Up to two half-planes, a floor and a wall: normal, offset and friction of each.
fn half_planes(draw: &mut Draw, shape: &[Point], kind: usize) -> Vec<[[f64; 2]; 3]> {
    let count = draw.below(5).saturating_sub(2);
    let facing = [[0.0, 1.0], [-1.0, 0.0]];
    let mut half_plane = |[x, y]: Point| {
        let lean = draw.one(&[0.0, 0.0, 0.2, -0.3]);
        let normal = [x - lean * y, y + lean * x];
        let long = (1.0 + lean * lean).sqrt();
        let gaps = shape
            .iter()
            .map(|p| (normal[0] * p[0] + normal[1] * p[1]) / long);
        let nearest = gaps.fold(f64::INFINITY, f64::min);
        let offset = nearest - draw.between(CLEAR, 1.0);
        [
            normal.map(|n| n / long),
            [offset, 0.0],
            friction(draw, kind),
        ]
    };
    facing
        .into_iter()
        .take(count)
        .map(&mut half_plane)
        .collect()
}

/// Five to nine straight segments. The first one leads to an obstacle, as do half of the others.
fn path(draw: &mut Draw, setup: &Setup, obstacles: &[Obstacle]) -> Vec<(usize, [f64; 3])> {
    let ([x, y], theta) = (setup.grip(), setup.start[2]);
    let start = [x, y, theta];
    let mut keyframes = vec![(0, start)];
    let parts = 5 + draw.below(5);
    for part in 1..=parts {
        let from = keyframes[part - 1].1;
        let corners = &obstacles[draw.below(obstacles.len())].vertices;
        let goal = corners[draw.below(corners.len())];
        let share = draw.between(0.5, 1.3);
        let mut by = |most: f64| draw.between(-most, most);
        let (dx, dy, turn) = (by(1.0), by(1.0), by(0.4));
        let kind = if part == 1 { 0 } else { draw.below(6) };
        let to = match kind {
            0..=2 => [
                from[0] + share * (goal[0] - from[0]),
                from[1] + share * (goal[1] - from[1]),
                from[2] + turn,
            ],
            3 => [from[0] + dx, from[1] + dy, from[2] + 2.0 * turn],
            4 => [from[0] + 0.1 * dx, from[1] + 0.1 * dy, from[2] + 4.0 * turn],
            _ => [x + 0.3 * dx, y + 0.3 * dy, from[2] + turn],
        };
        let to = [to[0].clamp(-FAR, FAR), to[1].clamp(-FAR, FAR), to[2]];
        keyframes.push(((FRAMES - 1) * part / parts, to));
    }
    keyframes
}

/// The world with lengths multiplied by `size` and stiffnesses by `stiffness`.
fn scaled(world: World, size: f64, stiffness: f64) -> World {
    let World {
        among, keyframes, ..
    } = world;
    let Among {
        mut setup,
        mut obstacles,
    } = among;
    let point = |p: &Point| p.map(|x| x * size);
    let pose = |[x, y, angle]: [f64; 3]| [x * size, y * size, angle];
    setup.vertices = setup.vertices.iter().map(point).collect();
    setup.start = pose(setup.start);
    setup.holding_point = setup.holding_point.as_ref().map(point);
    setup.weight *= stiffness * size;
    setup.stiffness_translation *= stiffness;
    setup.stiffness_rotation *= stiffness * size * size;
    for surface in &mut setup.surfaces {
        surface.offset *= size;
    }
    for obstacle in &mut obstacles {
        obstacle.vertices = obstacle.vertices.iter().map(point).collect();
    }
    let scaled = |(frame, hand)| (frame, pose(hand));
    World {
        among: Among { setup, obstacles },
        keyframes: keyframes.into_iter().map(scaled).collect(),
        room: None,
    }
}
