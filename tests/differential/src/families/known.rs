//! Scenes from files: the bundled ones, the cases with known answers, and level tops that were found to catch a body.

use crate::case::Case;
use stiction_core::SurfaceDescription;
use stiction_scene::{Motion, ObstacleInfo, SceneFile, Source, SurfaceInfo};
use stiction_tests::Setup;
use stiction_tests::obstacles::cases;
use stiction_tests::obstacles::{Among, Obstacle};

macro_rules! bundled {
    ($($name:literal),*) => { [$(include_str!(concat!("../../../../host-sim/scenes/", $name, ".toml"))),*] };
}

/// The bundled scenes whose hand has keyframes.
const BUNDLED: [&str; 18] = bundled![
    "box-flat",
    "burst",
    "corner-stick-slip",
    "edge-about-to-slip",
    "hook",
    "ladder",
    "locked",
    "parallel-walls",
    "peg-in-hole",
    "plank-on-posts",
    "point-frictionless",
    "point-stick-slip",
    "rod-on-floor",
    "slide",
    "snap",
    "step",
    "table-edge",
    "vertex-stick-slip"
];

pub(super) fn bundled(seed: u64) -> Option<Case> {
    let text = BUNDLED.get(usize::try_from(seed).ok()?)?;
    Some(read(text))
}

pub(super) fn cases(seed: u64) -> Option<Case> {
    let mut sound = cases::all().into_iter().filter(|case| !case.refused);
    let case = sound.nth(usize::try_from(seed).ok()?)?;
    Some(Case::new(case.among, case.hands))
}

/// A level box of 0.10 m × 0.06 m across two boards: the end of the first, the beginning and the height of the second (m).
const SEAMS: [[f64; 3]; 6] = [
    [0.13, 0.131, 0.0],
    [0.13, 0.130001, 0.0],
    [0.13, 0.14, -1e-7],
    [0.13, 0.13, 1.49e-8],
    [0.13, 0.125, 0.0],
    [0.13, 0.14, -1e-6],
];

pub(super) fn faults(seed: u64) -> Option<Case> {
    let &[end, begin, height] = SEAMS.get(usize::try_from(seed).ok()?)?;
    let board = |[left, right, top]: [f64; 3]| Obstacle {
        vertices: vec![[left, -0.1], [right, -0.1], [right, top], [left, top]],
        friction: [0.5, 0.3],
    };
    let setup = Setup::new(&[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]])
        .at([0.0, 0.05, 0.0])
        .springs(500.0, 0.5);
    let twin = Among {
        setup: setup.clone().floor([0.5, 0.3]),
        obstacles: Vec::new(),
    };
    let boards = [[-0.5, end, 0.0], [begin, 1.0, height]];
    let among = Among {
        setup,
        obstacles: boards.map(board).to_vec(),
    };
    let keyframes = vec![
        [0.0, 0.0, 0.05, 0.0],
        [0.5, 0.0, 0.02, 0.0],
        [2.5, 0.3, 0.02, 0.0],
    ];
    Some(Case {
        twin: Some(twin),
        ..Case::along(among, keyframes, 200.0)
    })
}

fn read(text: &str) -> Case {
    let file = SceneFile::parse(Source::new("scene.toml", text), f64::MAX);
    let file = file.expect("a bundled scene is sound");
    let Some(Motion::Keyframes(path)) = &file.hand.motion else {
        unreachable!("a bundled scene has keyframes");
    };
    let keyframe = |sample: stiction_scene::Sample| {
        let [x, y] = sample.hand.position;
        let angle = sample.hand.angle;
        [
            sample.t,
            x,
            y,
            f64::from(angle.turns) * std::f64::consts::TAU + angle.rest,
        ]
    };
    let keyframes = path.frames(None).map(keyframe).collect();
    let written = &file.written;
    let surface = |s: &SurfaceInfo| SurfaceDescription {
        normal: s.normal,
        offset: s.offset,
        friction_static: s.friction_static,
        friction_dynamic: s.friction_dynamic,
        memory: s.memory,
    };
    let obstacle = |o: &ObstacleInfo| Obstacle {
        vertices: o.vertices.clone(),
        friction: [o.friction_static, o.friction_dynamic],
    };
    let setup = Setup {
        vertices: written.vertices.clone(),
        start: written.start,
        weight: written.weight,
        holding_point: written.holding_point,
        reach: written.reach,
        stiffness_translation: written.stiffness_translation,
        stiffness_rotation: written.stiffness_rotation,
        surfaces: written.surfaces.iter().map(surface).collect(),
    };
    let among = Among {
        setup,
        obstacles: written.obstacles.iter().map(obstacle).collect(),
    };
    Case::along(among, keyframes, file.hand.rate.unwrap_or(1000.0))
}
