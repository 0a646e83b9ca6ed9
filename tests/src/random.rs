//! Random scenes and hand paths: convex bodies, one to three surfaces, ordinary grips. They are the same in every run.

use crate::run::polyline;
use crate::setup::Setup;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngAlgorithm, RngSeed, TestRng, TestRunner};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A scene and the keyframes of the hand's path through it.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// The scene.
    pub setup: Setup,
    /// x, y (m), phi (rad); the first keyframe is at the holding point.
    pub keyframes: Vec<[f64; 3]>,
}

impl Scenario {
    /// The hand's path with this many frames between two keyframes.
    pub fn hands(&self, frames_per_leg: usize) -> Vec<[f64; 3]> {
        polyline(&self.keyframes, frames_per_leg)
    }
}

/// Scenes with 1 to 6 vertices and 1 to 3 surfaces, some in contact at the start; size 0.01 to 10 m, k_h 10 to 10⁴ N/m,
/// k_theta / (k_h L²) 0.01 to 3, mu_s up to 1.5, weight up to 0.3 k_h L; the hand moves along `legs` straight lines,
/// each of which ends within 1.2 L and 1.5 rad of the start.
pub fn scenario(legs: usize) -> impl Strategy<Value = Scenario> {
    let parts = (body(), grip(), vec(surface(), 1..=3), vec(offset(), legs));
    parts.prop_map(|(vertices, grip, planes, offsets)| assemble(vertices, grip, planes, offsets))
}

/// `count` scenarios, the same in every run.
pub fn scenarios(count: usize, legs: usize) -> impl Iterator<Item = Scenario> {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(ProptestConfig::default(), rng);
    let strategy = scenario(legs);
    (0..count).map(move |_| {
        strategy
            .new_tree(&mut runner)
            .expect("no filter rejects")
            .current()
    })
}

/// A proptest configuration that draws the same `cases` in every run and writes no files.
pub fn same_every_run(cases: usize) -> ProptestConfig {
    ProptestConfig {
        cases: u32::try_from(cases).unwrap_or(u32::MAX),
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

#[derive(Clone, Debug)]
struct Grip {
    point: [f64; 2],
    theta: f64,
    translation: f64,
    rotation: f64,
    weight: f64,
}

#[derive(Clone, Copy, Debug)]
struct Plane {
    turn: f64,
    clearance: f64,
    friction: [f64; 2],
}

/// Corners on an ellipse, so that every polygon is strictly convex; between 0.01 and 10 m.
fn body() -> impl Strategy<Value = Vec<[f64; 2]>> {
    let shape = (-2.0..1.0f64, 0.3..1.0f64, vec(-0.35..0.35f64, 1..=6));
    shape.prop_map(|(magnitude, ratio, jitter)| {
        let (size, n) = (10f64.powf(magnitude) / 2.0, jitter.len() as f64);
        let corner = |(i, j): (usize, &f64)| {
            let angle = TAU * (i as f64 + j) / n;
            [size * angle.cos(), size * ratio * angle.sin()]
        };
        jitter.iter().enumerate().map(corner).collect()
    })
}

fn grip() -> impl Strategy<Value = Grip> {
    let point = [-0.2..0.2f64, -0.2..0.2f64];
    let weight = prop_oneof![Just(0.0), 0.0..0.3f64];
    (point, -3.0..3.0f64, 1.0..4.0f64, -2.0..0.5f64, weight).prop_map(
        |(point, theta, translation, rotation, weight)| Grip {
            point,
            theta,
            translation: 10f64.powf(translation),
            rotation: 10f64.powf(rotation),
            weight,
        },
    )
}

fn surface() -> impl Strategy<Value = Plane> {
    let clearance = prop_oneof![1 => Just(0.0), 3 => 0.0..0.6f64];
    (-0.4..0.4f64, clearance, 0.0..1.5f64, 0.0..1.0f64).prop_map(|(turn, clearance, mu, ratio)| {
        Plane {
            turn,
            clearance,
            friction: [mu, mu * ratio],
        }
    })
}

fn offset() -> impl Strategy<Value = [f64; 3]> {
    [-1.2..1.2f64, -1.2..1.2f64, -1.5..1.5f64]
}

/// Surfaces face the body from below, from the right and from the left, each turned by a small angle.
fn assemble(
    vertices: Vec<[f64; 2]>,
    grip: Grip,
    planes: Vec<Plane>,
    offsets: Vec<[f64; 3]>,
) -> Scenario {
    let body = Setup::new(&vertices);
    let l = body.size();
    let force = grip.translation * l;
    let mut setup = body
        .at([0.0, 0.0, grip.theta])
        .held_at(grip.point.map(|x| x * l))
        .springs(grip.translation, grip.rotation * force * l)
        .weighing(grip.weight * force);
    let corners: Vec<_> = vertices
        .iter()
        .map(|&v| setup.world(setup.start, v))
        .collect();
    for (plane, facing) in planes.into_iter().zip([FRAC_PI_2, 0.0, 2.0 * FRAC_PI_2]) {
        let (sin, cos) = (facing + plane.turn).sin_cos();
        let lowest = corners
            .iter()
            .map(|c| cos * c[0] + sin * c[1])
            .fold(f64::INFINITY, f64::min);
        setup = setup.surface([cos, sin], lowest - plane.clearance * l, plane.friction);
    }
    let [x, y] = setup.grip();
    let start = [x, y, grip.theta];
    let hand = |[dx, dy, turn]: [f64; 3]| [x + dx * l, y + dy * l, grip.theta + turn];
    let keyframes = std::iter::once(start)
        .chain(offsets.into_iter().map(hand))
        .collect();
    Scenario { setup, keyframes }
}
