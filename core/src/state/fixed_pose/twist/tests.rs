//! Velocities of the motions that can begin: sticking contacts rest, sliding ones move along their surfaces, the load drives, and an
//! opening shows in the rates of the gaps.

use super::*;
use crate::fixtures::{Random, sampled};
use crate::geometry::{Angle, Orientation, Pose};
use crate::scene::{Description, Scene, SurfaceDescription};
use crate::state::tests::{pair, scene};

/// A triangle each of whose vertices is on a surface of its own, pushed.
fn case(random: &mut Random) -> Option<(Scene<f64, 3, 3>, FixedPose<f64>, Grip<f64>)> {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [0.4, 0.3]];
    let pose = Pose {
        position: random.vector(),
        orientation: Orientation::new(Angle::from_radians(3.0 * random.next())),
    };
    let surfaces = vertices.map(|[x, y]| {
        let (sin, cos) = libm::sincos(3.0 * random.next());
        let point = pose.position + pose.orientation.rotation().apply(Vec2::new(x, y));
        SurfaceDescription {
            normal: [-sin, cos],
            offset: cos * point.y - sin * point.x,
            friction_static: 0.5,
            friction_dynamic: 0.3,
            memory: None,
        }
    });
    let scene = Scene::new(&Description {
        vertices: &vertices,
        start: [
            pose.position.x,
            pose.position.y,
            pose.orientation.angle().radians(),
        ],
        weight: 0.0,
        holding_point: None,
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: 1.0,
        surfaces: &surfaces,
        obstacles: &[],
    });
    let scene = scene.ok()?;
    let pivot = Pivot::at(&scene, &pose, pair(0, 0));
    let contacts = [pair(0, 0), pair(1, 1), pair(2, 2)].into_iter().collect();
    let fixed_pose = FixedPose::new(&scene, &pivot, (&contacts, true));
    let grip = Grip {
        holding_point: random.vector(),
        hand: pose.position + random.vector() * 2.0,
        angle: pose.orientation.angle().plus(random.next()),
    };
    Some((scene, fixed_pose, grip))
}

const STEP: f64 = 1e-6;

/// While one contact slides alone the body turns so that the moment about it is constant, to first order.
#[test]
fn lasting_contacts_stay_on_their_surfaces() {
    let mut seen = [0; 3];
    for seed in sampled(0..3000, 97) {
        let Some((scene, fixed_pose, grip)) = case(&mut Random(seed)) else {
            continue;
        };
        let placed = fixed_pose.pivot.placed(&scene);
        let wrench = fixed_pose.pivot.load(&scene, &grip).wrench();
        let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        let signs = [None, Some(1.0), Some(-1.0)];
        for ((i, k), sliding) in pairs.iter().flat_map(|&p| signs.map(|s| (p, s))) {
            if sliding.is_none() && i != k {
                continue;
            }
            let mode = ([i, k], sliding);
            let opens = fixed_pose.opens(&scene, &grip, &mode);
            let is_consistent = fixed_pose.is_consistent(&scene, &grip, &mode);
            let Some(twist) = fixed_pose.twist(&scene, &grip, &mode, Demand::Pressed) else {
                assert!(!opens && !is_consistent);
                continue;
            };
            let velocity = |c: Pair| {
                let arm = placed.arm(&scene, c.vertex);
                twist.velocity + arm.turned() * twist.turn
            };
            let [a, b] = [i, k].map(|i| fixed_pose.contact(i));
            for c in [a, b] {
                let along = scene.surface(c.surface).normal.dot(velocity(c));
                assert!(along.abs() < 1e-12, "{seed} {mode:?}");
            }
            let power = wrench.force.dot(twist.velocity) + wrench.moment * twist.turn;
            match sliding {
                None => {
                    assert!(velocity(a).length_bound() < 1e-12 && power > 0.0, "{seed}");
                    seen[0] += 1;
                }
                Some(sign) if a == b => {
                    let tangent = scene.surface(a.surface).tangent;
                    let off = velocity(a) - tangent * sign;
                    assert!(off.length_bound() < 1e-12, "{seed}");
                    assert!(wrench.force.dot(velocity(a)) > 0.0, "{seed}");
                    let moment = |step: f64| {
                        let about = Pivot::at(&scene, &placed.pose(), a);
                        let moved = about.moved(sign * step, twist.turn * step);
                        moved.load(&scene, &grip).moment()
                    };
                    let change = (moment(STEP) - moment(-STEP)) / (2.0 * STEP);
                    assert!(
                        change.abs() < 1e-6 * (1.0 + twist.turn.abs()),
                        "{seed}: {change}"
                    );
                    seen[1] += 1;
                }
                Some(_) => {
                    assert!(power > 0.0, "{seed}");
                    seen[2] += 1;
                }
            }
            let others = fixed_pose.contacts.iter().filter(|c| **c != a && **c != b);
            let rates = others.map(|&c| scene.surface(c.surface).normal.dot(velocity(c)));
            let slowest = rates.fold(f64::INFINITY, f64::min);
            if slowest.abs() > 1e-9 {
                let is_opening = slowest > 0.0;
                assert_eq!([opens, is_consistent], [is_opening; 2], "{seed}");
            }
        }
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 50),
        "{seen:?}"
    );
}

/// A block that is clamped across its diagonal slides along a slot: no gap opens or closes.
#[test]
fn slide_along_a_slot_neither_opens_nor_closes() {
    let mut count = 0;
    for angle in [0.0, 1.0, -1.0, 2.0].map(|n| core::f64::consts::PI + n * 1e-16) {
        let slot = scene(&[(angle, [0.0, 0.6 + 2e-6])]);
        let contacts = [pair(0, 0), pair(1, 0), pair(2, 1), pair(3, 1)];
        let contacts = contacts.into_iter().collect();
        let pivot = crate::fixtures::pivot(0.0);
        let fixed_pose = FixedPose::new(&slot, &pivot, (&contacts, true));
        for seed in sampled(0..200, 29) {
            let mut random = Random(seed);
            let middle = Vec2::new(0.4, 0.3);
            let grip = Grip {
                holding_point: middle,
                hand: middle + Vec2::new(2.0 * random.next(), 0.3 * random.next()),
                angle: Angle::from_radians(0.3 * random.next()),
            };
            for (i, k) in [(0, 2), (1, 3)] {
                for sign in [1.0, -1.0] {
                    let mode = ([i, k], Some(sign));
                    if fixed_pose
                        .twist(&slot, &grip, &mode, Demand::Pressed)
                        .is_some()
                    {
                        assert!(
                            fixed_pose.is_consistent(&slot, &grip, &mode),
                            "{angle} {seed}"
                        );
                        assert!(!fixed_pose.opens(&slot, &grip, &mode), "{angle} {seed}");
                        count += 1;
                    }
                }
            }
        }
    }
    assert!(cfg!(miri) || count > 20, "{count}");
}
