//! The measurements of an engine in a case: the time of a frame, the held pose compared with statics, creep, slips and allocations.

use std::time::{Duration, Instant};

use stiction_tests::reference::{Foot, Reference, Scene, Surface, Touch};

use stiction_scene::SurfaceInfo;

use crate::case::{Case, Pose, hand_pose};
use crate::engine::Engine;

/// The number of frames that are timed together.
const STRETCH: usize = 100;
/// A vertex this close to a surface touches it (m).
const TOUCHES: f64 = 1e-4;
/// A foot that moves less than this in a frame is at rest (m): 1 mm/s at 1 kHz.
const STANDS: f64 = 1e-6;
/// A shorter motion of the foot is not a slip (m); the slips of the statics are longer than 1 mm here.
const SETTLES: f64 = 1e-4;

#[derive(Clone, Debug)]
pub(crate) struct Findings {
    /// The pose after the first leg.
    pub(crate) pressed: Pose,
    /// The last pose of the first second of holding.
    pub(crate) held: Pose,
    /// The largest displacement of a vertex in the next second (m).
    pub(crate) creep: f64,
    /// Slips of the foot: motions that end while the hand still moves, each with its length (m).
    pub(crate) slips: Vec<f64>,
    /// Heap allocations per frame of the drag.
    pub(crate) allocations: f64,
}

/// One run: press, drag, hold.
pub(crate) fn observe<E: Engine>(case: &Case) -> Findings {
    let (mut engine, drag) = pressed::<E>(case);
    let (mut poses, mut slips) = (Vec::with_capacity(drag.len() + 1), Slips::default());
    poses.push(engine.pose());
    let used = allocation_counter::measure(|| {
        for &hand in &drag {
            engine.step(hand);
            poses.push(engine.pose());
        }
    });
    for pair in poses.windows(2) {
        slips.add(case.foot_moves(pair[0], pair[1]));
    }
    let stopped = E::hand(case.last());
    let second = case.rate as usize;
    let mut hold = || {
        (0..second).for_each(|_| engine.step(stopped));
        engine.pose()
    };
    let held = hold();
    Findings {
        pressed: poses[0],
        held,
        creep: case.distance(held, hold()),
        slips: slips.lengths,
        allocations: used.count_total as f64 / drag.len() as f64,
    }
}

/// The time of every stretch of the drag. The work is the same in every run, so the shortest time over many runs is the
/// one without interruption.
pub(crate) fn time<E: Engine>(case: &Case) -> Vec<Duration> {
    let (mut engine, drag) = pressed::<E>(case);
    let stretch = |hands: &[E::Hand]| {
        let begun = Instant::now();
        for &hand in hands {
            engine.step(hand);
            std::hint::black_box(engine.pose());
        }
        begun.elapsed()
    };
    drag.chunks(STRETCH).map(stretch).collect()
}

/// The pose of the body according to statics when the hand has stopped: followed from a pressed pose by the slow reference of
/// the tests, which shares no code with the solver. It starts from the pressed pose, so that the position where an engine has
/// set the body down does not count as an error of its drag. There the hand turns from pressing to dragging, so nothing slides;
/// and if static friction exceeds dynamic friction, the normal force is far above what stiction needs.
pub(crate) fn statics(case: &Case, pressed: Pose) -> Pose {
    let scene = reference_scene(case);
    let start = case.press.last().unwrap_or(case.first());
    let sticks = |(vertex, surface)| Foot {
        touch: Touch::Surface { vertex, surface },
        slides: 0,
    };
    let touching = case.touching(pressed, TOUCHES);
    let stiction = touching.iter().any(|&(_, surface)| {
        let surface = &scene.surfaces[surface];
        surface.mu_s > surface.mu_d
    });
    let contacts: Vec<_> = touching.into_iter().map(sticks).collect();
    let mut reference = Reference::resumed(scene, pressed, (&contacts, stiction), hand_pose(start));
    for sample in &case.drag {
        reference.step(hand_pose(sample), 1);
        assert!(!reference.ambiguous(), "{}: t = {}", case.name, sample.t);
    }
    reference.pose()
}

fn reference_scene(case: &Case) -> Scene {
    let default = case.size() / 4096.0;
    let surface = |s: &SurfaceInfo| Surface {
        normal: s.normal,
        offset: s.offset,
        mu_s: s.friction_static,
        mu_d: s.friction_dynamic,
        memory: s.memory.unwrap_or(default),
    };
    Scene {
        vertices: case.scene.vertices.clone(),
        holding_point: case.holding_point(),
        k_h: case.scene.stiffness_translation,
        k_theta: case.scene.stiffness_rotation,
        weight: case.scene.weight,
        surfaces: case.scene.surfaces.iter().map(surface).collect(),
        obstacles: Vec::new(),
    }
}

/// The engine after the first leg, and the remaining frames of the hand.
fn pressed<E: Engine>(case: &Case) -> (E, Vec<E::Hand>) {
    let mut engine = E::new(case);
    for sample in &case.press {
        engine.step(E::hand(sample));
    }
    (engine, case.drag.iter().map(E::hand).collect())
}

/// Detects slips from the motion of the foot, frame by frame.
#[derive(Default)]
struct Slips {
    sliding: f64,
    lengths: Vec<f64>,
}

impl Slips {
    fn add(&mut self, way: f64) {
        if way.abs() > STANDS {
            self.sliding += way;
        } else if self.sliding != 0.0 {
            if self.sliding.abs() > SETTLES {
                self.lengths.push(self.sliding.abs());
            }
            self.sliding = 0.0;
        }
    }
}
