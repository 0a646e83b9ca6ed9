//! Bodies with a lever, an edge or two contacts.

use super::{K_H, SUBSTEPS, floor, held};
use stiction_tests::close;
use stiction_tests::reference::{Foot, Reference, Scene, Surface};

#[test]
fn a_stiff_lever_slides_behind_the_hand_by_its_friction() {
    let (lever, depth) = ([0.1, -0.3], 0.03);
    for side in [1.0, -1.0] {
        let scene = held(&[lever], 1e9, [0.5, 0.3]);
        let mut tool = Reference::new(scene, [0.0, 0.4, 0.0], [0.0, 0.4, 0.0]);
        tool.step([0.0, 0.3 - depth, 0.0], SUBSTEPS);
        tool.step([side, 0.3 - depth, 0.0], SUBSTEPS);
        let contact = tool.contacts()[0];
        assert_eq!((f64::from(contact.slides), tool.slips()), (side, 0));
        close(
            "friction",
            contact.friction,
            -side * 0.3 * contact.normal,
            1e-9,
        );
        let tip = tool.pose()[0] + lever[0];
        close(
            "foot",
            tip,
            side + lever[0] - side * 0.3 * contact.normal / K_H,
            1e-7,
        );
    }
}

/// A block that stands on the floor, held at its middle and pressed to a depth.
fn block(friction: [f64; 2], depth: f64) -> Reference {
    let corners = [[-0.5, -0.1], [0.5, -0.1], [0.5, 0.1], [-0.5, 0.1]];
    let start = [0.0, 0.2, 0.0];
    let mut block = Reference::new(held(&corners, 50.0, friction), start, start);
    block.step([0.0, 0.1 - depth, 0.0], SUBSTEPS);
    assert_eq!(block.state(), "edge");
    block
}

#[test]
fn an_edge_slides_or_slips_by_the_same_threshold() {
    for (friction, depth, slips) in [
        ([0.5, 0.3], 0.04, 0),
        ([0.5, 0.3], 0.1, 48),
        ([0.4, 0.4], 0.5, 0),
    ] {
        let mut block = block(friction, depth);
        let mut count = 0;
        for i in 1..=100 {
            block.step([0.01 * f64::from(i), 0.1 - depth, 0.0], SUBSTEPS);
            count += block.slips();
        }
        assert_eq!(count, slips, "{friction:?} at {depth}");
        let feet: Vec<i8> = block
            .contacts()
            .iter()
            .map(|contact| contact.slides)
            .collect();
        assert_eq!(feet, [i8::from(slips == 0); 2]);
        let place = if slips == 0 {
            1.0 - friction[1] * depth
        } else {
            48.0 * 0.02
        };
        close("pose", block.pose()[0], place, 1e-9);
        assert_eq!(block.stiction(), slips > 0);
    }
}

/// A rod between floor and wall.
fn ladder(friction: [f64; 2]) -> Scene {
    let wall = Surface {
        normal: [-1.0, 0.0],
        offset: -1.0,
        ..floor(friction)
    };
    Scene {
        k_theta: 100.0,
        surfaces: vec![floor(friction), wall],
        obstacles: Vec::new(),
        ..held(&[[-0.35, -0.4], [0.35, 0.4]], 0.0, friction)
    }
}

#[test]
fn a_ladder_slides_in_balance_at_dynamic_friction() {
    let mut rod = Reference::new(ladder([0.3, 0.3]), [0.6, 0.45, 0.0], [0.6, 0.45, 0.0]);
    let mut slides = 0;
    for i in 0..=100 {
        // The pose of a rod that is in contact with both, and slightly further in.
        let angle = 0.004 * f64::from(i);
        let (sin, cos) = angle.sin_cos();
        let hand = [
            1.02 - 0.35 * cos + 0.4 * sin,
            0.35 * sin + 0.4 * cos - 0.02,
            angle,
        ];
        rod.step(hand, SUBSTEPS);
        let (pose, contacts) = (rod.pose(), rod.contacts());
        let [floor, wall] = contacts.as_slice() else {
            continue;
        };
        if floor.slides == 0 {
            continue;
        }
        slides += 1;
        for contact in [floor, wall] {
            close(
                "friction",
                contact.friction,
                -0.3 * f64::from(contact.slides) * contact.normal,
                1e-9,
            );
        }
        close(
            "force",
            K_H * (hand[0] - pose[0]) + floor.friction - wall.normal,
            0.0,
            1e-9,
        );
        // Along the wall t = (0, 1).
        close(
            "force",
            K_H * (hand[1] - pose[1]) + floor.normal + wall.friction,
            0.0,
            1e-9,
        );
        let (sin, cos) = pose[2].sin_cos();
        let top = [0.35 * cos - 0.4 * sin, 0.35 * sin + 0.4 * cos];
        let moment = 100.0 * (hand[2] - pose[2]) - top[0] * floor.normal
            + top[1] * floor.friction
            + top[0] * wall.friction
            + top[1] * wall.normal;
        close("moment", moment, 0.0, 1e-8);
        assert_eq!(rod.slips(), 0);
    }
    assert!(slides > 50, "{slides} frames slide");
}

#[test]
fn two_contacts_of_a_slot_slide_or_slip_by_the_length_of_the_slip() {
    let ceiling = Surface {
        normal: [0.0, -1.0],
        offset: -1.0,
        ..floor([0.5, 0.3])
    };
    let scene = Scene {
        k_theta: 100.0,
        surfaces: vec![floor([0.5, 0.3]), ceiling],
        obstacles: Vec::new(),
        ..held(&[[-0.3, -0.5], [0.3, 0.5]], 0.0, [0.5, 0.3])
    };
    // An upright rod is held by a couple of 0.6 N, so that a slip is 2 (mu_s - mu_d) N / k_h long: 0.0067 or 0.02 m.
    for (turn, slips, place) in [(0.02, 0, 0.99), (0.06, 48, 0.96)] {
        let start = [0.0, 0.5, -0.1];
        let mut rod = Reference::new(scene.clone(), start, start);
        rod.step([0.0, 0.5, turn], SUBSTEPS);
        assert_eq!(rod.state(), "two-vertex");
        let mut count = 0;
        for i in 1..=100 {
            rod.step([0.01 * f64::from(i), 0.5, turn], SUBSTEPS);
            count += rod.slips();
        }
        assert_eq!((count, rod.stiction()), (slips, slips > 0));
        close("foot", rod.pose()[0], place, 1e-9);
        let slides: Vec<i8> = rod.contacts().iter().map(|c| c.slides).collect();
        // The tangent of the ceiling is -x.
        assert_eq!(slides, if slips > 0 { [0, 0] } else { [1, -1] });
    }
}

#[test]
fn a_body_without_torque_swings_out_of_the_way() {
    let triangle = [[-0.2, -0.3], [0.3, -0.2], [0.0, 0.4]];
    let start = [0.0, 0.5, 0.0];
    let mut body = Reference::new(held(&triangle, 0.0, [0.5, 0.3]), start, start);
    let mut touched = 0;
    for i in 0..=20 {
        let hand = [0.005 * f64::from(i), 0.31 - 0.0025 * f64::from(i), 0.0];
        body.step(hand, SUBSTEPS);
        for contact in body.contacts() {
            touched += 1;
            close("normal force", contact.normal, 0.0, 1e-9);
        }
        close("pose", body.pose()[0], hand[0], 1e-9);
        close("pose", body.pose()[1], hand[1], 1e-9);
    }
    assert!(touched > 0);
}

#[test]
fn a_run_goes_on_from_where_another_one_stopped() {
    let hand = |i: i32| {
        let i = f64::from(i);
        [
            0.72 + 0.06 * (0.31 * i).sin(),
            0.36 + 0.03 * (0.17 * i).sin(),
            0.3 * (0.11 * i).sin(),
        ]
    };
    let scene = ladder([0.4, 0.25]);
    let mut whole = Reference::new(scene.clone(), [0.6, 0.45, 0.0], [0.6, 0.45, 0.0]);
    let mut met = [false; 3];
    for i in 0..200 {
        let feet: Vec<Foot> = whole
            .contacts()
            .iter()
            .map(|contact| Foot {
                touch: contact.touch,
                slides: contact.slides,
            })
            .collect();
        let before = if i == 0 {
            [0.6, 0.45, 0.0]
        } else {
            hand(i - 1)
        };
        let held = (feet.as_slice(), whole.stiction());
        let mut part = Reference::resumed(scene.clone(), whole.pose(), held, before);
        whole.step(hand(i), SUBSTEPS);
        part.step(hand(i), SUBSTEPS);
        let slides = feet.iter().any(|foot| foot.slides != 0);
        met = [
            met[0] | slides,
            met[1] | whole.stiction(),
            met[2] | (whole.slips() > 0),
        ];
        for k in 0..3 {
            close("pose", part.pose()[k], whole.pose()[k], 1e-9);
        }
        assert_eq!(
            (part.state(), part.slips()),
            (whole.state(), whole.slips()),
            "frame {i}"
        );
        assert_eq!(
            (part.contacts().len(), part.stiction()),
            (whole.contacts().len(), whole.stiction())
        );
    }
    assert_eq!(met, [true; 3]);
}
