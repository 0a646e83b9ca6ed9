//! Random scenes of a body among convex obstacles, with paths of a hand that pushes it against them; body sizes of 1 m.

use stiction_tests::draw::{Draw, polygon};
use stiction_tests::obstacles::shape::{placed, separation};
use stiction_tests::reference::{Obstacle, Scene, Surface};

/// The body is at least this far from every obstacle at the start, m.
const CLEAR: f64 = 0.05;
/// Frames of a straight segment of a path.
const FRAMES: usize = 20;

/// A scene, the body's start pose and the hand's.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub(crate) scene: Scene,
    pub(crate) start: [f64; 3],
    pub(crate) hands: Vec<[f64; 3]>,
}

/// A polygon of 3 to 6 corners, a rod or wall, or a point or pin.
fn shape(draw: &mut Draw, size: f64) -> Vec<[f64; 2]> {
    match draw.below(8) {
        0 => vec![[0.0, 0.0]],
        1 => vec![[-0.5 * size, 0.0], [0.5 * size, 0.1 * size]],
        n => polygon(draw, 3 + n % 4, size),
    }
}

/// Coefficients of friction, static and dynamic, sometimes equal.
pub(crate) fn friction(draw: &mut Draw) -> [f64; 2] {
    let mu_s = draw.between(0.05, 1.2);
    let equal = draw.below(4) == 0;
    [
        mu_s,
        mu_s * if equal { 1.0 } else { draw.between(0.3, 1.0) },
    ]
}

/// A body among up to three obstacles, which may overlap each other.
pub(crate) fn world(draw: &mut Draw) -> World {
    let vertices = shape(draw, 1.0);
    let k_theta = draw.power(-0.5, 2.0);
    let weighs = draw.below(3) == 0;
    let weight = if weighs { draw.between(0.0, 10.0) } else { 0.0 };
    let start = [0.0, 0.0, draw.between(-3.0, 3.0)];
    let body = placed(&vertices, start);
    let mut obstacles: Vec<Obstacle> = Vec::new();
    let count = 1 + draw.below(3);
    while obstacles.len() < count {
        let size = draw.power(-0.5, 0.5);
        let at = [
            draw.between(-1.5, 1.5),
            draw.between(-1.5, 1.5),
            draw.between(-3.0, 3.0),
        ];
        let corners = placed(&shape(draw, size), at);
        let points = vertices.len() + corners.len() == 2;
        if !points && separation(&corners, &body) >= CLEAR {
            let [mu_s, mu_d] = friction(draw);
            obstacles.push(Obstacle {
                vertices: corners,
                mu_s,
                mu_d,
                memory: 1.0 / 1024.0,
            });
        }
    }
    let holding_point = [draw.between(-0.2, 0.2), draw.between(-0.2, 0.2)];
    let held = placed(&[holding_point], start)[0];
    let hands = path(draw, [held[0], held[1], start[2]], &obstacles);
    let scene = Scene {
        vertices,
        holding_point,
        k_h: 100.0,
        k_theta,
        weight,
        surfaces: Vec::new(),
        obstacles,
    };
    World {
        scene,
        start,
        hands,
    }
}

/// A body among up to four obstacles, in half of the scenes above a floor.
pub(crate) fn crowded(draw: &mut Draw) -> World {
    let [mut among, more] = [world(draw), world(draw)];
    let body = placed(&among.scene.vertices, among.start);
    let lowest = body.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let clear = |o: &Obstacle| {
        let points = body.len() + o.vertices.len() == 2;
        !points && separation(&o.vertices, &body) >= CLEAR
    };
    let more = more.scene.obstacles.into_iter().filter(clear);
    among.scene.obstacles.extend(more);
    among.scene.obstacles.truncate(4);
    if draw.below(2) == 0 {
        let [mu_s, mu_d] = friction(draw);
        among.scene.surfaces.push(Surface {
            normal: [0.0, 1.0],
            offset: lowest - draw.between(CLEAR, 1.0),
            mu_s,
            mu_d,
            memory: 1.0 / 1024.0,
        });
    }
    among
}

/// Five straight segments: most of them towards a corner of an obstacle, up to it or past it; some turn the hand, some go anywhere.
fn path(draw: &mut Draw, start: [f64; 3], obstacles: &[Obstacle]) -> Vec<[f64; 3]> {
    let mut hands = vec![start];
    for _ in 0..5 {
        let from = hands[hands.len() - 1];
        let corners = &obstacles[draw.below(obstacles.len())].vertices;
        let goal = corners[draw.below(corners.len())];
        let part = draw.between(0.2, 1.2);
        let mut by = |most: f64| draw.between(-most, most);
        let (x, y, turn) = (by(0.5), by(0.5), by(0.3));
        let to = match draw.below(4) {
            0 => [from[0], from[1], from[2] + 5.0 * turn],
            1 => [from[0] + x, from[1] + y, from[2] + 2.0 * turn],
            _ => [
                from[0] + part * (goal[0] - from[0]),
                from[1] + part * (goal[1] - from[1]),
                from[2] + turn,
            ],
        };
        hands.extend((1..=FRAMES).map(|i| {
            let part = i as f64 / FRAMES as f64;
            [0, 1, 2].map(|k| from[k] + part * (to[k] - from[k]))
        }));
    }
    hands
}
