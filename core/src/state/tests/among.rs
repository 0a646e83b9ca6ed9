//! Bodies among obstacles: what begins to slide together, and where a turn about the end of a side ends.

use super::*;
use crate::geometry::Vec2;
use crate::model::WithObstacles;
use crate::scene::ObstacleDescription;

type Among = Scene<f64, 4, 1, WithObstacles<2, 8>>;

/// A body among obstacles of the same friction, static equal to dynamic; it starts far above them.
fn among(vertices: &[[f64; 2]], obstacles: &[&[[f64; 2]]], (stiffness, mu): (f64, f64)) -> Among {
    let obstacle = |vertices| ObstacleDescription {
        vertices,
        friction_static: mu,
        friction_dynamic: mu,
        memory: None,
    };
    let list = [0, obstacles.len() - 1].map(|i| obstacle(obstacles[i]));
    let description = Description {
        vertices,
        start: [0.0, 8.0, 0.0],
        weight: 0.0,
        holding_point: Some([0.0, 0.0]),
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: stiffness,
        surfaces: &[],
        obstacles: &list[..obstacles.len()],
    };
    Scene::new(&description).expect("a sound scene")
}

/// A box of diagonal 1, tilted between a wall that a vertex touches and the corner of a block, without friction. The hand pulls it down
/// into the slot. About the vertex the hand turns it against the corner, about the corner off the wall; so both slide, although a slip that
/// drags equally at both contacts would leave the corner unpressed.
#[test]
fn what_presses_a_body_onto_another_contact_takes_that_one_along() {
    let wall = [[-1.0, -4.0], [0.0, -4.0], [0.0, 0.0], [-1.0, 0.0]];
    let block = [[0.8, -4.0], [2.0, -4.0], [2.0, 0.0], [0.8, 0.0]];
    let vertices = [[-0.4, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.4, 0.3]];
    let scene = among(&vertices, &[&wall, &block], (0.07, 0.0));
    let [on_wall, corner] = [pair(1, 1), Pair::of_corner(7, 2)];
    let orientation = Orientation::new(Angle::from_radians(-2.0));
    let turned = |v: Vec2<f64>| orientation.rotation().apply(v);
    // Both gaps are closed.
    let (c1, c2) = (turned(Vec2::new(0.4, -0.3)), turned(Vec2::new(0.4, 0.3)));
    let normal = -turned(Vec2::new(0.0, 1.0));
    let x = -c1.x;
    let y = (normal.dot(Vec2::new(0.8, 0.0) - c2) - normal.x * x) / normal.y;
    let pose = Pose {
        position: Vec2::new(x, y),
        orientation,
    };
    let state = ContactState::seated(&scene, Pivot::at(&scene, &pose, on_wall), &[corner]);
    assert_eq!(state.kind(), StateKind::TwoVertex);
    let ContactState::TwoVertex(both) = state else {
        return;
    };
    let grip = Grip {
        holding_point: Vec2::new(0.12, 0.12),
        hand: pose.position + Vec2::new(-0.4, -0.4),
        angle: orientation.angle().plus(0.9),
    };
    let load = both.pivot.load(&scene, &grip);
    let arm = both.pivot.placed(&scene).arm_to(&scene, corner);
    assert!(
        load.moment() * normal.dot(arm.turned()) < 0.0,
        "it turns onto the corner"
    );
    let about_corner = load.moment() - arm.cross(load.force);
    assert!(
        about_corner * -arm.turned().x > 0.0,
        "it turns off the wall"
    );
    let moved = both.relax(&scene, &grip, Relax::default());
    assert!(matches!(moved.trigger, Trigger::Slide(_)), "{moved:?}");
}

/// A rod that lies level to the left of a block, its right end at the upper corner of the block's left side, turns over that end: upright
/// it comes to the end of what supports it there, whatever the rounding.
#[test]
fn a_turn_from_level_about_the_end_of_a_side_ends_upright() {
    let block = [[0.0, -2.0], [2.0, -2.0], [2.0, 0.0], [0.0, 0.0]];
    let scene = among(&[[0.0, 0.0], [1.0, 0.0]], &[&block], (1.0, 2.0));
    let left = pair(0, 3);
    for off in [-1e-9, -1e-12, 0.0, 1e-12, 1e-9] {
        let pose = Pose {
            position: Vec2::ZERO,
            orientation: Orientation::new(Angle::from_radians(core::f64::consts::PI + off)),
        };
        let mut state = SingleVertex::new(Pivot::at(&scene, &pose, left));
        state.regime = Regime::Stick { stiction: true };
        let grip = Grip {
            holding_point: Vec2::new(0.5, 0.0),
            hand: Vec2::new(0.5, 0.125),
            angle: Angle::default(),
        };
        let moved = state.relax(&scene, &grip, None);
        let tips = Trigger::Off {
            contact: 0,
            sign: 0.0,
        };
        assert_eq!(moved.trigger, tips, "{off}");
        let angle = state.pivot.orientation.angle().radians();
        assert!((angle - core::f64::consts::FRAC_PI_2).abs() < 1e-9, "{off}");
    }
}
