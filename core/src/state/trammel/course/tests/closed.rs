//! Motions with a closed form: a peg in its hole, a rod over a step, a rod whose sides slide past two pins, and the ends of sides.

use super::*;

type Scene2 = Scene<f64, 4, 1, WithObstacles<2, 8, Full>>;

fn obstacle<'a>(vertices: &'a [[f64; 2]], mu: f64) -> ObstacleDescription<'a, f64> {
    ObstacleDescription {
        vertices,
        friction_static: mu,
        friction_dynamic: mu,
        memory: None,
    }
}

fn scene(vertices: &[[f64; 2]], obstacles: &[ObstacleDescription<'_, f64>]) -> Scene2 {
    let scene = Scene2::new(&Description {
        obstacles,
        ..description(vertices)
    });
    scene.expect("a sound scene")
}

fn description(vertices: &[[f64; 2]]) -> Description<'_, f64> {
    Description {
        vertices,
        start: [0.0, 50.0, 0.0],
        weight: 0.0,
        holding_point: Some([0.0, 0.0]),
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: 1.0,
        surfaces: &[],
        obstacles: &[],
    }
}

/// A state of two contacts at a pose that has both gaps closed, and a course from there in a sense.
fn along<W: World<f64>>(
    scene: &W,
    pose: Pose<f64>,
    [first, other]: [Pair; 2],
    sense: f64,
    mut look: impl FnMut(&Course<'_, f64, W>),
) {
    let pivot = Pivot::at(scene, &pose, first);
    let grip = Grip {
        holding_point: Vec2::ZERO,
        hand: pose.position,
        angle: pose.orientation.angle(),
    };
    let trammel = Trammel::in_sense(scene, (&pivot, other), &grip, sense);
    look(&Course::of(scene, (&pivot, other), &grip, &trammel));
}

/// A peg of width d, one tip on the wall of a hole of width D at a depth z, the mouth of the other wall on its far side: D cos(theta) - z
/// sin(theta) = d, wherever it moves.
#[test]
fn peg_keeps_the_relation_of_depth_and_tilt() {
    let (hole, width) = (0.3, 0.28);
    let half = width / 2.0;
    let body = [[-half, 0.0], [half, 0.0], [half, 0.96], [-half, 0.96]];
    let left = [[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]];
    let right = [[hole, -1.0], [1.0, -1.0], [1.0, 0.0], [hole, 0.0]];
    let scene = scene(&body, &[obstacle(&left, 0.1), obstacle(&right, 0.1)]);
    // Turned clockwise by theta it touches the left wall with vertex 0 and the mouth on the right with side 1.
    for theta in [0.05_f64, 0.08, 0.12] {
        let depth = (hole * theta.cos() - width) / theta.sin();
        let orientation = Orientation::new(Angle::from_radians(-theta));
        let tip = Vec2::new(0.0, -depth);
        let pose = Pose {
            position: tip - orientation.rotation().apply(Vec2::new(-half, 0.0)),
            orientation,
        };
        let first = scene.surface_indices().end;
        let contacts = [
            Pair {
                vertex: 0,
                surface: first + 1,
            },
            Pair::of_corner(first + 7, 1),
        ];
        for sense in [1.0, -1.0] {
            along(&scene, pose, contacts, sense, |course| {
                let longest = course.longest();
                assert!(longest > 1e-3, "{longest}");
                for k in 0..=10 {
                    let spot = course.spot(longest * f64::from(k) / 10.0);
                    let pose = spot.pivot.placed(&scene).pose();
                    let rotation = pose.orientation.rotation();
                    let tip = pose.position + rotation.apply(Vec2::new(-half, 0.0));
                    let (cos, sin) = (rotation.cos, -rotation.sin);
                    let left = hole * cos + tip.y * sin - width;
                    assert!(
                        left.abs() < 1e-14 && tip.x.abs() < 1e-14,
                        "{theta} {k} {left}"
                    );
                }
            });
        }
    }
}

/// The sides of a wedge slide past two pins: in its frame the pins move as a trammel, so that the pins' distance and the angle between the
/// sides keep its tip on a circle through both pins.
#[test]
fn tip_of_a_wedge_between_two_pins_goes_round_a_circle() {
    let body = [[0.0, 0.0], [0.28, 0.96], [-0.28, 0.96]];
    let scene = scene(
        &body,
        &[obstacle(&[[-0.1, 0.0]], 0.0), obstacle(&[[0.1, 0.0]], 0.0)],
    );
    // Half of the tip's angle has the tangent 28/96.
    let depth = 0.1 * 0.96 / 0.28;
    let pose = Pose {
        position: Vec2::new(0.0, -depth),
        orientation: Orientation::new(Angle::default()),
    };
    let first = scene.surface_indices().end;
    // Side 0 is on the right, side 2 on the left.
    let contacts = [Pair::of_corner(first, 2), Pair::of_corner(first + 1, 0)];
    let [sine, cosine] = [2.0 * 0.28 * 0.96, 0.96 * 0.96 - 0.28 * 0.28];
    let radius = 0.1 / sine;
    let centre = Vec2::new(0.0, -radius * cosine);
    for sense in [1.0, -1.0] {
        along(&scene, pose, contacts, sense, |course| {
            let longest = course.longest();
            for k in 0..=10 {
                let spot = course.spot(longest * f64::from(k) / 10.0);
                let tip = spot.pivot.placed(&scene).pose().position;
                let turn = spot.pivot.orientation.angle().radians();
                let off = (tip - centre).length() - radius;
                assert!(off.abs() < 1e-14, "{k} {off}");
                // The inscribed angle is half of the central angle.
                let arm = tip - centre;
                let round = libm::atan2(arm.x, -arm.y);
                assert!((round - 2.0 * turn).abs() < 1e-14, "{round} {turn}");
            }
        });
    }
}

/// A bar upright in a gap between parallel sides: it shifts and does not turn.
#[test]
fn bar_in_a_gap_shifts_without_a_turn() {
    let body = [[-0.14, -0.48], [0.14, -0.48], [0.14, 0.48], [-0.14, 0.48]];
    let scene = scene(
        &body,
        &[
            obstacle(&[[-0.14, -0.2]], 0.3),
            obstacle(&[[0.14, 0.3]], 0.3),
        ],
    );
    let pose = Pose {
        position: Vec2::ZERO,
        orientation: Orientation::new(Angle::default()),
    };
    let first = scene.surface_indices().end;
    let contacts = [Pair::of_corner(first, 3), Pair::of_corner(first + 1, 1)];
    for sense in [1.0, -1.0] {
        along(&scene, pose, contacts, sense, |course| {
            let spot = course.spot(0.1);
            let end = spot.pivot.placed(&scene).pose();
            assert_eq!(spot.turn.value, 0.0);
            assert!((end.position.y.abs() - 0.1).abs() < 1e-15 && end.position.x.abs() < 1e-15);
            assert_eq!(end.orientation.angle().radians(), 0.0);
        });
    }
}

/// Two walls that end at one point are no obstacle to a side that slides past it.
#[test]
fn side_slides_past_a_place_that_two_walls_share() {
    let body = [[-0.14, -0.48], [0.14, -0.48], [0.14, 0.48], [-0.14, 0.48]];
    let walls = [[-0.6, -0.4], [-0.6, 0.1]].map(|from| [from, [-0.14, -0.2]]);
    let [low, high] = &walls;
    let scene = Scene::<f64, 4, 1, WithObstacles<3, 8, Full>>::new(&Description {
        obstacles: &[
            obstacle(low, 0.3),
            obstacle(high, 0.3),
            obstacle(&[[0.14, 0.3]], 0.3),
        ],
        ..description(&body)
    });
    let scene = scene.expect("a sound scene");
    let first = scene.surface_indices().end;
    for held in [first + 1, first + 3] {
        let contacts = [Pair::of_corner(held, 3), Pair::of_corner(first + 4, 1)];
        for turn in [0.0, 1e-3] {
            let pose = Pose {
                position: Vec2::ZERO,
                orientation: Orientation::new(Angle::from_radians(turn)),
            };
            for sense in [1.0, -1.0] {
                along(&scene, pose, contacts, sense, |course| {
                    let x = course.longest();
                    assert!(course.reached(x).0.is_none(), "{held} {turn} {sense}");
                });
            }
        }
    }
}

/// A slip along a gap ends where a side of the bar ends at a pin: at the pin that is reached first.
#[test]
fn slip_ends_where_a_contact_leaves_its_side() {
    let body = [[-0.14, -0.48], [0.14, -0.48], [0.14, 0.48], [-0.14, 0.48]];
    let scene = scene(
        &body,
        &[
            obstacle(&[[-0.14, -0.43]], 0.1),
            obstacle(&[[0.14, 0.42]], 0.1),
        ],
    );
    let pose = Pose {
        position: Vec2::ZERO,
        orientation: Orientation::new(Angle::default()),
    };
    let first = scene.surface_indices().end;
    let contacts = [Pair::of_corner(first, 3), Pair::of_corner(first + 1, 1)];
    for (hand, which, way) in [([0.0, 2.0], 0, 0.05), ([0.0, -2.0], 1, -0.06)] {
        let pivot = Pivot::at(&scene, &pose, contacts[0]);
        let mut state = TwoVertex::new(pivot, contacts[1]);
        let grip = Grip {
            holding_point: Vec2::ZERO,
            hand: Vec2::new(hand[0], hand[1]),
            angle: Angle::default(),
        };
        let moved = state.slip_to_the_end(&scene, &grip);
        let Trigger::Off { contact, .. } = moved.trigger else {
            panic!("{:?}", moved.trigger);
        };
        let end = state.pivot.placed(&scene).pose().position;
        assert_eq!(contact, which);
        assert!((end.y - way).abs() < 1e-9, "{} {way}", end.y);
    }
}
