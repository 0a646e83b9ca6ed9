//! The laws do not depend on position, direction, side or unit; and the path evolution does not depend on the frame
//! rate. Named scenes have few events, so rounding errors stay small: 1e-9 L over the whole run, in f64.

use stiction_core::{Evolution, StateKind, Status};
use stiction_tests::random::scenarios;
use stiction_tests::run::{Frame, run};
use stiction_tests::{Scenario, Setup, close, scenes};

/// A number of frames for which no event of a named scene falls on the end of a frame.
const FRAMES_PER_LEG: usize = 47;
const BOUND: f64 = 1e-9;

/// Runs a scene and its image in both evolutions and compares every frame: `pose` maps the pose of the scene, in SI
/// units, `units` the magnitudes of its lengths and forces. The size of a point is one metre in whatever units.
fn compare(
    name: &str,
    scenario: &Scenario,
    image: &Scenario,
    pose: impl Fn([f64; 3]) -> [f64; 3],
    units: [f64; 2],
) {
    let [length, force] = units;
    let l = scenario.setup.size() * length;
    for evolution in Evolution::ALL {
        let original = run::<f64>(&scenario.setup, evolution, &scenario.hands(FRAMES_PER_LEG));
        let mapped = run::<f64>(&image.setup, evolution, &image.hands(FRAMES_PER_LEG));
        for (i, (a, b)) in original.iter().zip(&mapped).enumerate() {
            let what = format!("{name}, {evolution:?}, frame {i}");
            assert_eq!(a.state, b.state, "{what}");
            let want = pose(a.pose);
            close(&format!("{what}: x"), b.pose[0], want[0], BOUND * l);
            close(&format!("{what}: y"), b.pose[1], want[1], BOUND * l);
            close(&format!("{what}: theta"), b.pose[2], want[2], BOUND);
            if determinate(a.state) {
                let scale = image.setup.stiffness_translation * l;
                close(
                    &format!("{what}: N"),
                    b.normal(),
                    a.normal() * force,
                    BOUND * scale,
                );
            }
        }
    }
}

/// Whether statics alone determines the reactions.
fn determinate(state: StateKind) -> bool {
    matches!(
        state,
        StateKind::NonContact | StateKind::SingleVertex | StateKind::Edge
    )
}

fn map_surfaces(setup: &Setup, map: impl Fn([f64; 2], f64) -> ([f64; 2], f64)) -> Setup {
    let mut image = setup.clone();
    for surface in &mut image.surfaces {
        (surface.normal, surface.offset) = map(surface.normal, surface.offset);
    }
    image
}

#[test]
fn mirror_image_evolves_as_a_mirror_image() {
    let flip = |[x, y]: [f64; 2]| [-x, y];
    let flip_pose = |[x, y, theta]: [f64; 3]| [-x, y, -theta];
    for (name, scenario) in scenes::all() {
        let mut setup = map_surfaces(&scenario.setup, |n, b| (flip(n), b));
        setup.vertices = scenario
            .setup
            .vertices
            .iter()
            .rev()
            .map(|&v| flip(v))
            .collect();
        setup.holding_point = scenario.setup.holding_point.map(flip);
        setup.start = flip_pose(setup.start);
        let keyframes = scenario
            .keyframes
            .iter()
            .map(|&hand| flip_pose(hand))
            .collect();
        compare(
            name,
            &scenario,
            &Scenario { setup, keyframes },
            flip_pose,
            [1.0; 2],
        );
    }
}

#[test]
fn turned_and_shifted_world_evolves_alike() {
    let (turn, shift) = (0.7f64, [0.3, -0.2]);
    let (sin, cos) = turn.sin_cos();
    let rotate = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    // Weight has its own direction.
    let weightless = |(_, scenario): &(&str, Scenario)| scenario.setup.weight == 0.0;
    for (name, scenario) in scenes::all().into_iter().filter(weightless) {
        let l = scenario.setup.size();
        let pose = |[x, y, theta]: [f64; 3]| {
            let [x, y] = rotate([x, y]);
            [x + shift[0] * l, y + shift[1] * l, theta + turn]
        };
        let mut setup = map_surfaces(&scenario.setup, |n, b| {
            let [x, y] = rotate(n);
            ([x, y], b + (x * shift[0] + y * shift[1]) * l)
        });
        setup.start = pose(setup.start);
        let keyframes = scenario.keyframes.iter().map(|&hand| pose(hand)).collect();
        compare(
            name,
            &scenario,
            &Scenario { setup, keyframes },
            pose,
            [1.0; 2],
        );
    }
}

#[test]
fn inches_and_pounds_evolve_as_metres_and_newtons() {
    let (inch, pound) = (1.0 / 0.0254, 1.0 / 4.448_221_615);
    let scaled = |p: [f64; 2]| p.map(|x| x * inch);
    let pose = |[x, y, theta]: [f64; 3]| [x * inch, y * inch, theta];
    for (name, scenario) in scenes::all() {
        let mut setup = map_surfaces(&scenario.setup, |n, b| (n.map(|x| x * 3.0), b * inch));
        setup.vertices = scenario.setup.vertices.iter().map(|&v| scaled(v)).collect();
        setup.holding_point = scenario.setup.holding_point.map(scaled);
        setup.start = pose(setup.start);
        setup.weight *= pound;
        setup.stiffness_translation *= pound / inch;
        setup.stiffness_rotation *= pound * inch;
        let keyframes = scenario.keyframes.iter().map(|&hand| pose(hand)).collect();
        let image = Scenario { setup, keyframes };
        compare(name, &scenario, &image, pose, [inch, pound]);
    }
}

/// One state, and one pose to within a bound (of the body size `l`, or rad).
fn ends_alike(name: &str, got: &Frame, want: &Frame, [bound, l]: [f64; 2]) {
    assert_eq!(got.state, want.state, "{name}");
    for (i, size) in [l, l, 1.0].into_iter().enumerate() {
        let what = ["x", "y", "theta"][i];
        close(
            &format!("{name}: {what}"),
            got.pose[i],
            want.pose[i],
            bound * size,
        );
    }
}

#[test]
fn path_evolution_ends_alike_at_every_frame_rate() {
    for (name, scenario) in scenes::all() {
        let l = scenario.setup.size();
        let end = |rate| run::<f64>(&scenario.setup, Evolution::Path, &scenario.hands(rate)).pop();
        let want: Frame = end(1000).expect("a path has frames");
        for rate in [31, 100] {
            let got = end(rate).expect("a path has frames");
            ends_alike(&format!("{name} at {rate} Hz"), &got, &want, [BOUND, l]);
        }
    }
}

/// Checks that random paths end alike in few frames per leg and in many. Counts those whose status is ok.
fn ends_at_every_rate(scenes: impl Iterator<Item = Scenario>, [few, many]: [usize; 2]) -> u32 {
    let mut count = 0;
    for (index, scenario) in scenes.enumerate() {
        let frames =
            |per_leg| run::<f64>(&scenario.setup, Evolution::Path, &scenario.hands(per_leg));
        let [few, many] = [few, many].map(frames);
        if few
            .iter()
            .chain(&many)
            .any(|frame| frame.status != Status::Ok)
        {
            continue;
        }
        let (Some(few), Some(many)) = (few.last(), many.last()) else {
            panic!("a path has frames");
        };
        // Slips, up to hundreds of them, amplify differences.
        let bound = [1e-6, scenario.setup.size()];
        ends_alike(&format!("scene {index}"), few, many, bound);
        count += 1;
    }
    count
}

/// The result does not depend on how the hand's path is cut into frames: contacts yield to the motion that is driven at that point
/// of the path, whatever the end of a long frame would drive; if none is driven yet, the path continues.
#[test]
fn random_path_ends_alike_in_one_frame_and_in_many() {
    let count = ends_at_every_rate(scenarios(1000, 4), [1, 7]);
    assert!(count > 500, "{count}");
}

/// Without friction, the body stays in its balance as long as that exists, however far the hand moves in a frame; and nothing
/// slips, so that no limit on slips is met.
#[test]
fn random_path_without_friction_ends_alike_in_one_frame_and_in_many() {
    let smooth = scenarios(2000, 4).map(|scenario| Scenario {
        setup: scenario.setup.smooth(),
        ..scenario
    });
    let count = ends_at_every_rate(smooth, [1, 30]);
    assert!(count > 1990, "{count}");
}

/// If mu_s = mu_d, the body slides with the hand, or two contacts jump: with few frames, it is at each of them where it is with many. The
/// end of a slide is found to 2^-23.
#[test]
fn named_slides_without_jumps_are_alike_at_every_frame_rate() {
    for (name, mut scenario) in scenes::all() {
        for surface in &mut scenario.setup.surfaces {
            surface.friction_dynamic = surface.friction_static;
        }
        let frames = |rate| run::<f64>(&scenario.setup, Evolution::Path, &scenario.hands(rate));
        let l = scenario.setup.size();
        for (i, (got, want)) in frames(7)
            .iter()
            .zip(frames(210).iter().step_by(30))
            .enumerate()
        {
            ends_alike(&format!("{name}, frame {i}"), got, want, [1e-7, l]);
        }
    }
}
