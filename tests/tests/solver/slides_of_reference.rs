//! The slow reference against answers known in closed form: when it slides, when it sticks and slips, and what the stiction
//! bit remembers.

mod bodies;

use stiction_tests::close;
use stiction_tests::reference::{Reference, Scene, Surface};

const K_H: f64 = 200.0;
const SUBSTEPS: usize = 20;
/// Stick-slip from 10 N on for 0.5 and 0.3: a depth of 0.05 m.
const MEMORY: f64 = 0.01;

fn floor([mu_s, mu_d]: [f64; 2]) -> Surface {
    Surface {
        normal: [0.0, 1.0],
        offset: 0.0,
        mu_s,
        mu_d,
        memory: MEMORY,
    }
}

/// A body held at its origin that cannot turn much, above a floor.
fn held(vertices: &[[f64; 2]], k_theta: f64, friction: [f64; 2]) -> Scene {
    Scene {
        vertices: vertices.to_vec(),
        holding_point: [0.0, 0.0],
        k_h: K_H,
        k_theta,
        weight: 0.0,
        surfaces: vec![floor(friction)],
        obstacles: Vec::new(),
    }
}

/// A tool that is a point, its tip above the origin, pressed to a depth.
fn point(friction: [f64; 2], depth: f64) -> Reference {
    let mut tool = Reference::new(
        held(&[[0.0, 0.0]], 1.0, friction),
        [0.0, 0.1, 0.0],
        [0.0, 0.1, 0.0],
    );
    tool.step([0.0, -depth, 0.0], SUBSTEPS);
    tool
}

/// The position of the only contact, and the direction in which it slides.
fn foot(tool: &Reference) -> (f64, i8) {
    let contacts = tool.contacts();
    assert_eq!(contacts.len(), 1, "{contacts:?}");
    (tool.pose()[0], contacts[0].slides)
}

#[test]
fn a_point_pressed_lightly_slides() {
    let mut tool = point([0.5, 0.3], 0.03);
    for i in 1..=20 {
        let x = 0.01 * f64::from(i);
        tool.step([x, -0.03, 0.0], SUBSTEPS);
        assert_eq!((tool.slips(), tool.stiction()), (0, false));
        let (place, slides) = foot(&tool);
        close("foot", place, (x - 0.3 * 0.03).max(0.0), 1e-12);
        assert_eq!(slides, i8::from(x > 0.009), "at {x}");
    }
}

#[test]
fn a_point_pressed_hard_sticks_and_slips() {
    let mut tool = point([0.5, 0.3], 0.1);
    assert!(tool.stiction());
    let mut slips = 0;
    for i in 1..=100 {
        tool.step([0.01 * f64::from(i), -0.1, 0.0], SUBSTEPS);
        slips += tool.slips();
        assert!(tool.stiction() && foot(&tool).1 == 0);
    }
    // After a lag of 0.05, one slip every (mu_s - mu_d) N / k_h = 0.02 m.
    assert_eq!(slips, 48);
    close("foot", foot(&tool).0, 48.0 * 0.02, 1e-9);
}

#[test]
fn a_point_with_one_coefficient_never_slips() {
    for depth in [0.001, 0.03, 1.0] {
        let mut tool = point([0.4, 0.4], depth);
        for i in 1..=20 {
            tool.step([0.1 * f64::from(i), -depth, 0.0], SUBSTEPS);
            assert_eq!((tool.slips(), tool.stiction()), (0, false));
        }
        assert_eq!(foot(&tool).1, 1);
        close("foot", foot(&tool).0, 2.0 - 0.4 * depth, 1e-12);
    }
}

#[test]
fn a_load_that_grows_past_the_threshold_stops_a_slide_there() {
    let mut tool = point([0.5, 0.3], 0.03);
    let hand = |x: f64| [x, -0.03 - 0.5 * x, 0.0];
    tool.step(hand(0.03), SUBSTEPS);
    assert_eq!(foot(&tool).1, 1);
    tool.step(hand(0.05), 7);
    assert!(tool.stiction());
    assert_eq!(foot(&tool).1, 0);
    // The depth is 0.05 at x = 0.04.
    close("foot", foot(&tool).0, 0.04 - 0.3 * 0.05, 1e-12);
}

#[test]
fn the_bit_outlives_a_load_that_falls_and_is_lost_in_a_short_slip() {
    let mut tool = point([0.5, 0.3], 0.1);
    tool.step([0.0, -0.03, 0.0], SUBSTEPS);
    assert!(tool.stiction());
    tool.step([0.0149, -0.03, 0.0], SUBSTEPS);
    assert_eq!((foot(&tool), tool.slips()), ((0.0, 0), 0));
    tool.step([0.1, -0.03, 0.0], SUBSTEPS);
    assert_eq!((tool.slips(), tool.stiction()), (1, false));
    assert_eq!(foot(&tool).1, 1);
    close("foot", foot(&tool).0, 0.1 - 0.009, 1e-12);
}

#[test]
fn a_hand_that_turns_back_leaves_the_foot_until_dynamic_friction_has_turned_too() {
    let mut tool = point([0.5, 0.3], 0.03);
    for (x, place, slides) in [(0.2, 0.191, 1), (0.183, 0.191, 0), (0.1, 0.109, -1)] {
        tool.step([x, -0.03, 0.0], SUBSTEPS);
        close("foot", foot(&tool).0, place, 1e-12);
        assert_eq!(
            (foot(&tool).1, tool.slips(), tool.stiction()),
            (slides, 0, false)
        );
    }
}

#[test]
fn an_oblique_touch_slides_and_a_steep_one_sticks() {
    for (x, place, slides) in [(0.1, 0.1 - 0.3 * 0.02, 1), (0.005, 0.0, 0)] {
        let mut tool = Reference::new(
            held(&[[0.0, 0.0]], 1.0, [0.5, 0.3]),
            [-x, 0.02, 0.0],
            [-x, 0.02, 0.0],
        );
        tool.step([x, -0.02, 0.0], SUBSTEPS);
        close("foot", foot(&tool).0, place, 1e-11);
        assert_eq!((foot(&tool).1, tool.slips()), (slides, 0));
    }
}
