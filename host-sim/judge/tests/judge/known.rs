//! Slips with known answers (STATICS 11, and whole evolutions to 12 digits): lawful if they end at the first root, unlawful
//! if they end at another one.

use std::collections::BTreeSet;

use stiction_judge::{Contact, Event, Evolution, Frame, Scene, State, law};

use stiction_tests::change;

use crate::write::{self, broken, frame, on, only, scene};

const EVOLUTIONS: [Evolution; 2] = [Evolution::Path, Evolution::Frame];

/// A body whose vertex 0, its origin, stands at `x` on the floor; all forces from the springs.
fn standing(scene: &Scene, hand: [f64; 3], x: f64, theta: f64) -> Frame {
    let [gx, gy] = scene.holding_point.expect("a point");
    let (sin, cos) = theta.sin_cos();
    let lever = [cos * gx - sin * gy, sin * gx + cos * gy];
    let k = scene.stiffness_translation;
    let force = [k * (hand[0] - x - lever[0]), k * (hand[1] - lever[1])];
    let moment = scene.stiffness_rotation * (hand[2] - theta);
    write::standing(hand, [x, theta], [force[0], force[1], moment])
}

/// The laws broken by a slip from one position and angle to another, with the hand at rest.
fn slip(scene: &Scene, hand: [f64; 3], ends: [[f64; 2]; 2]) -> BTreeSet<&'static str> {
    let [before, after] = ends.map(|[x, theta]| standing(scene, hand, x, theta));
    let after = Frame {
        t: 1.0,
        slips: 1,
        events: vec![Event::Slip],
        ..after
    };
    let [path, jump] =
        EVOLUTIONS.map(|evolution| broken(scene, evolution, &[before.clone(), after.clone()]));
    assert_eq!(path, jump);
    path
}

/// STATICS 11: k_h 500, k_theta 0.5, D 0.06, mu_d 0.3, the hand 0.02 above the floor, Phi = 1.2. A slip that begins where the
/// lever is at `psi`, for which mu_s is chosen, and ends at another angle.
fn of_section_11(begin: f64, end: f64) -> BTreeSet<&'static str> {
    const HAND: [f64; 3] = [0.0, 0.02, 1.2];
    let place = |psi: f64| (0.02 * psi.cos() + (1.2 - psi) / 60.0) / psi.sin();
    let mut scene = scene(
        "[body]\nvertices = [[0.0, 0.0]]\nstart = [0.0, 0.0, 0.0]\n[grasp]\npoint = [0.06, 0.0]\n\
         [spring]\ntranslation = 500.0\nrotation = 0.5\n\
         [[surface]]\nname = \"floor\"\nnormal = [0.0, 1.0]\noffset = 0.0\nstatic = 9.0\ndynamic = 0.3\n",
    );
    let contact = standing(&scene, HAND, -place(begin), begin).contacts[0];
    scene.surfaces[0].friction_static = (contact.friction / contact.normal).abs();
    slip(&scene, HAND, [begin, end].map(|psi| [-place(psi), psi]))
}

#[test]
fn slips_of_section_11_end_at_the_first_root() {
    assert_eq!(of_section_11(0.4, 0.540_336_797_9), BTreeSet::new());
    assert_eq!(of_section_11(1.0, 0.624_560_421_9), BTreeSet::new());
    assert_eq!(of_section_11(2.6, 2.385_415_897_0), BTreeSet::new());
}

/// At all three roots |T| = mu_d N against the motion, in balance: they differ only in the path to them.
#[test]
fn slip_that_ends_at_a_wrong_root_is_found() {
    for wrong in [1.335_960_925_5, 0.624_560_421_9] {
        assert_eq!(of_section_11(2.6, wrong), only(law::SLIP_FIRST));
    }
}

/// A point that is held at itself, or so close to itself that a trace does not show it, without rotational stiffness: whatever its
/// angle, it breaks away when the pull is mu_s N and stops when it is mu_d N.
#[test]
fn slip_of_a_point_with_any_angle_is_known() {
    for lever in [0.0, 1e-17] {
        let mut scene = scene(
            "[body]\nvertices = [[0.0, 0.0]]\nstart = [0.0, 0.0, 0.0]\n[grasp]\npoint = [0.0, 0.0]\n\
             [spring]\ntranslation = 1.0\nrotation = 0.0\n\
             [[surface]]\nname = \"floor\"\nnormal = [0.0, 1.0]\noffset = 0.0\nstatic = 0.5\ndynamic = 0.2\n",
        );
        scene.holding_point = Some([lever, 0.0]);
        let to = |end| slip(&scene, [0.05, -0.1, 0.0], [[0.0, 1.0], [end, 1.0]]);
        assert_eq!(to(0.03), BTreeSet::new());
        assert!(to(0.02).contains(law::SLIP_ENDS));
    }
}

/// A rod of length 2 between floor and wall, at an angle `theta`, under a load of 2; the hand's angle is that at which it slips
/// from theta = 1 (k = 1, k_theta = 4, mu 0.4 / 0.2). The ratio T/N that both contacts need, the same for both, is found by
/// bisection.
fn leaning(theta: f64) -> Frame {
    let (sin, cos) = theta.sin_cos();
    let start = 1.0_f64;
    let hand = [-start.cos(), start.sin() - 2.0, 0.905_464_288_398];
    let force = [hand[0] + cos, hand[1] - sin];
    let reactions = |mu: f64| {
        // Force balance: F_x + mu N_1 - N_2 = 0, F_y + N_1 + mu N_2 = 0.
        let foot = -(force[1] + mu * force[0]) / (1.0 + mu * mu);
        [foot, force[0] + mu * foot]
    };
    let moment = |mu: f64| {
        let [foot, head] = reactions(mu);
        // The feet are at ∓(cos, sin) from the middle, where the hand holds.
        4.0 * (hand[2] - theta) + (-cos * foot + sin * mu * foot) + (cos * mu * head + sin * head)
    };
    let ratio = change(-0.5, 0.5, |mu| moment(mu) > 0.0);
    let contact = |vertex: usize, point: [f64; 2]| Contact {
        touch: on(vertex, vertex),
        direction: None,
        point,
        normal: reactions(ratio)[vertex],
        friction: ratio * reactions(ratio)[vertex],
        sliding: None,
    };
    Frame {
        state: State::TwoVertex,
        contacts: vec![contact(0, [-2.0 * cos, 0.0]), contact(1, [0.0, 2.0 * sin])],
        wrench: [force[0], force[1], 4.0 * (hand[2] - theta)],
        ..frame(0.0, hand, [-2.0 * cos, 0.0, theta])
    }
}

#[test]
fn known_slip_of_a_ladder_is_lawful_and_a_hundredth_more_is_not() {
    let scene = scene(
        "[body]\nvertices = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]]\nstart = [0.0, 0.0, 0.0]\n[grasp]\npoint = [1.0, 0.0]\n\
         [spring]\ntranslation = 1.0\nrotation = 4.0\n[friction]\nstatic = 0.4\ndynamic = 0.2\n\
         [[surface]]\nname = \"floor\"\nnormal = [0.0, 1.0]\noffset = 0.0\n\
         [[surface]]\nname = \"wall\"\nnormal = [-1.0, 0.0]\noffset = 0.0\n",
    );
    let end = 0.761_291_830_571_f64;
    for evolution in EVOLUTIONS {
        let slip = |part: f64| {
            let after = Frame {
                t: 1.0,
                slips: 1,
                events: vec![Event::Slip],
                ..leaning(1.0 + part * (end - 1.0))
            };
            broken(&scene, evolution, &[leaning(1.0), after])
        };
        assert_eq!(slip(1.0), BTreeSet::new());
        for part in [0.99, 1.01] {
            assert_eq!(slip(part), only(law::SLIP_ENDS), "{part}");
        }
    }
}
