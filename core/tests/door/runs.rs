//! Whole runs in f64 with known answers: closed forms of stick, slip, slide, fold, edge and pair; nothing creeps; pieces give the bits of
//! the whole; the tangent.

use crate::bench::{Number, Run, Setup, block, hand, in_every_number_type, near, side};
use stiction_core::{Event, Evolution, SiFloat, StateKind, Status, SurfaceDescription};

in_every_number_type!(cases::pieces_give_the_bits_of_the_whole_and_a_hand_at_rest_moves_nothing);

/// The triangle (0, 0), (.5, 2), (-.5, 2) on a floor, held at (0, 1).
fn triangle(turning: f64, start: [f64; 3], mu: [f64; 2]) -> Setup {
    Setup {
        vertices: vec![[0.0, 0.0], [0.5, 2.0], [-0.5, 2.0]],
        held: Some([0.0, 1.0]),
        springs: [1.0, turning],
        start,
        surfaces: vec![side([0.0, 1.0], 0.0, mu)],
        ..Setup::default()
    }
}

fn begun(setup: &Setup, at: [f64; 3]) -> Run<f64> {
    Run::new(setup, Evolution::Path, at)
}

/// N and T of the first contact.
fn reaction(run: &Run<f64>) -> [f64; 2] {
    let first = run.contacts()[0];
    [first.normal, first.friction]
}

#[test]
fn a_weighted_block_slips_eight_times_to_the_left() {
    let setup = Setup {
        springs: [200.0, 5.0],
        weight: 3.0,
        start: [0.0, 0.3, 0.0],
        ..block([2.0, 1.0], 0.5, [0.8, 0.35])
    };
    let mut run = begun(&setup, [0.0, 0.8, 0.0]);
    run.lead([0.0, 0.49, 0.0], 10);
    assert_eq!(run.lead([-0.1, 0.49, 0.0], 10), 8);
    near::<f64>(run.pose()[0], -0.09);
}

#[test]
fn a_pinned_triangle_turns_to_its_balance() {
    let cases = [
        (0.5, 0.413829085628, 0.11558779394, 0.197881868616),
        (0.99, 0.470458503603, 0.0913605444938, 0.146704974967),
        (5.0, 0.586224831198, 0.0330351096529, 0.0467798755599),
        (50.0, 0.636765743008, 0.00402304292379, 0.00540186138236),
    ];
    for (kappa, theta, normal, friction) in cases {
        let setup = triangle(1.0 / kappa, [0.0, 0.0, 0.3], [50.0, 50.0]);
        let run = begun(&setup, [-0.6, 0.8, 0.3]);
        near::<f64>(run.pose()[2], theta);
        let [n, t] = reaction(&run);
        near::<f64>(n, normal);
        near::<f64>(t, friction);
    }
}

#[test]
fn a_pinned_triangle_snaps_where_its_balance_folds() {
    let cases = [
        (1.2, 0.1, 1.23164469549, -0.0776394146139, -1.19302715562),
        (1.05, 0.02, 0.681264770302, -0.01031157213, -0.622724540491),
    ];
    for (kappa, phi, theta, fold, jump) in cases {
        let setup = triangle(1.0 / kappa, [0.0, 0.0, theta], [0.95, 0.95]);
        let mut run = begun(&setup, [0.0, -1.0, phi]);
        near::<f64>(run.pose()[2], theta);
        run.lead([0.0, -1.0, fold + 1e-9], 7);
        assert!(run.pose()[2] > 0.0 && run.output.events().is_empty());
        run.to([0.0, -1.0, fold - 1e-9]);
        assert!(run.saw(Event::Snap));
        assert!((run.pose()[2] - jump).abs() < 1e-8, "{:?}", run.pose());
    }
}

#[test]
fn a_triangle_slips_once() {
    #[rustfmt::skip]
    let cases = [
        ([0.6, 0.3], 0.5, 0.6, 0.665709348072, 0.158969736777, -0.426407124356),
        ([0.4, 0.1], 5.0, 0.9, 0.0481468100788, 0.0361062510487, -0.00204076868341),
        ([1.5, 0.5], 0.05, 0.3, 1.00275420433, 0.0404688113105, -1.20859932215),
    ];
    for (mu, stiffness, h, trigger, slip, theta) in cases {
        let setup = triangle(stiffness, [0.0, 0.5, 0.0], mu);
        let mut run = begun(&setup, [0.0, 1.5, 0.0]);
        run.lead([0.0, h, 0.0], 5);
        assert_eq!(run.lead([trigger - 1e-9, h, 0.0], 5), 0);
        assert_eq!(run.to([trigger + 1e-9, h, 0.0]).slips, 1);
        assert!((run.output.longest_slip - slip).abs() < 1e-8);
        assert!((run.pose()[2] - theta).abs() < 1e-8);
    }
}

#[test]
fn a_low_block_slides_and_a_high_one_tips() {
    let led = |mu: f64, x: f64| {
        let setup = block([1.0, 1.6], 0.8, [mu, 0.4]);
        let mut run = begun(&setup, [0.0, 0.6, 0.0]);
        run.lead([x, 0.6, 0.0], 3);
        run
    };
    let slid = led(0.6, 0.13);
    assert_eq!(slid.output.state, StateKind::Edge);
    near::<f64>(slid.pose()[0], 0.04);
    let tipped = led(0.65, 0.1251);
    assert_eq!(tipped.output.state, StateKind::SingleVertex);
    near::<f64>(tipped.pose()[2], -4.79774505504e-05);
}

#[test]
fn a_wall_locks_a_block_and_lets_it_go() {
    let mut setup = block([2.0, 1.0], 0.5, [0.5, 0.3]);
    setup.surfaces.push(side([-1.0, 0.0], -1.5, [0.5, 0.3]));
    let mut run = begun(&setup, [0.0, 0.3, 0.0]);
    run.lead([1.5, 0.3, 0.0], 20);
    near::<f64>(run.pose()[0], 0.5);
    assert_eq!(run.output.state, StateKind::Locked);
    assert_eq!(run.lead([0.4 + 1e-9, 0.3, 0.0], 5), 0);
    assert_eq!(run.to([0.4 - 1e-8, 0.3, 0.0]).slips, 1);
    near::<f64>(run.pose()[0], 0.46);
}

#[test]
fn a_vertex_without_friction_glides() {
    let setup = triangle(0.5, [0.0, 0.5, 0.3], [0.0, 0.0]);
    let mut run = begun(&setup, [0.0, 1.5, 0.3]);
    run.to([0.0, 0.5, 0.3]);
    run.lead([0.7, 0.5, 0.5], 9);
    near::<f64>(run.pose()[2], 0.789770235333);
    near::<f64>(run.pose()[0], 1.41019153488);
    near::<f64>(reaction(&run)[0], 0.204008511155);
}

#[test]
fn a_ladder_slips_to_its_next_balance() {
    // Against the wall x = 0, its foot on the floor; a third vertex makes it a body.
    let (sin, cos) = 1.0_f64.sin_cos();
    let mu = [0.4, 0.2];
    let setup = Setup {
        vertices: vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]],
        held: Some([1.0, 0.0]),
        springs: [1.0, 4.0],
        start: [-2.0 * cos, 0.0, 1.0],
        surfaces: vec![side([0.0, 1.0], 0.0, mu), side([-1.0, 0.0], 0.0, mu)],
        ..Setup::default()
    };
    let mut run = begun(&setup, [-cos, sin - 2.0, 1.9054642884]);
    // At first the moment holds the rod off the wall.
    let trigger = 0.905464288398;
    assert_eq!(run.lead([-cos, sin - 2.0, trigger + 1e-9], 20), 0);
    assert_eq!(run.output.state, StateKind::TwoVertex);
    assert_eq!(run.to([-cos, sin - 2.0, trigger - 1e-9]).slips, 1);
    assert!((run.pose()[2] - 0.761291830571).abs() < 1e-8);
}

/// A hand that wanders above and into a corner.
fn wander(k: u32) -> [f64; 3] {
    let t = f64::from(k) * 0.01;
    [
        0.9 * (1.3 * t).sin() + 0.4 * (3.1 * t).sin(),
        0.35 + 0.45 * (0.9 * t).cos() + 0.2 * (4.3 * t).sin(),
        0.6 * (0.7 * t).sin(),
    ]
}

/// A block with a weight in that corner of floor and wall.
fn cornered(start: [f64; 3]) -> Setup {
    let mut setup = Setup {
        held: Some([0.05, 0.2]),
        springs: [2.0, 0.1],
        weight: 0.3,
        start,
        ..block([0.8, 0.5], 0.2, [0.5, 0.3])
    };
    setup.surfaces.push(side([-1.0, 0.0], -1.0, [0.4, 0.2]));
    setup
}

mod cases {
    use super::*;

    /// A run in whole frames and in single pieces of work, and with hands that rest.
    pub(super) fn pieces_give_the_bits_of_the_whole_and_a_hand_at_rest_moves_nothing<R: Number>() {
        let mut setup = cornered([0.0, 0.9, 0.0]);
        let without = |s: &mut SurfaceDescription<f64>| s.memory = None;
        setup.surfaces.iter_mut().for_each(without);
        let mut whole = Run::<R>::new(&setup, Evolution::Path, wander(0));
        let mut pieces = whole.state.clone();
        let mut kinds = [false; 6];
        for k in 1..1200 {
            let all = whole.to(wander(k)).clone();
            let one = loop {
                let at = hand::<R>(wander(k));
                let output = whole.solver.step_until(&mut pieces, at, || false);
                if output.status != Status::Behind {
                    break output;
                }
            };
            assert_eq!(
                (all.position, all.angle, all.state),
                (one.position, one.angle, one.state)
            );
            assert!(all.status <= Status::EventLimit, "{all:?} in frame {k}");
            let again = whole.to(wander(k));
            assert_eq!(
                (again.position, again.angle, again.slips),
                (all.position, all.angle, 0)
            );
            let kind = StateKind::ALL.iter().position(|kind| *kind == all.state);
            kinds[kind.unwrap_or(0)] = true;
            // Nothing penetrates.
            for c in whole.contacts() {
                assert!(c.normal.widen() >= 0.0 && c.normal.widen().is_finite());
            }
        }
        let seen = kinds.iter().filter(|&&seen| seen).count();
        assert!(seen >= 4, "{kinds:?}");
    }
}

#[test]
fn a_hand_that_comes_back_leaves_no_creep() {
    let mut setup = cornered([0.0; 3]);
    setup.surfaces.truncate(1);
    let mut run = begun(&setup, [0.0, 0.1, 0.0]);
    run.to([0.03, 0.1, 0.0]);
    let place = run.output.position;
    for _ in 0..1000 {
        run.to([0.03, 0.1, 0.01]);
        run.to([0.02, 0.09, 0.0]);
        run.to([0.03, 0.1, 0.0]);
    }
    assert_eq!(run.output.position, place);
}

/// By differences of steps, wherever nothing happens.
#[test]
fn the_tangent_is_that_of_small_steps() {
    let mut run = begun(&cornered([0.0, 0.9, 0.0]), wander(0));
    let mut compared = 0;
    for k in 1..1200 {
        run.to(wander(k));
        let Some(tangent) = run.solver.tangent(&run.state) else {
            continue;
        };
        if k % 7 != 0 || !run.output.events().is_empty() {
            continue;
        }
        let step = 1e-6;
        for column in 0..3 {
            let stepped = |sign: f64| {
                let mut state = run.state.clone();
                let mut at = run.at();
                at[column] += sign * step;
                let output = run.solver.step(&mut state, hand::<f64>(at));
                let wrench = run.solver.wrench(&state);
                let same = output.events().is_empty() && output.state == run.output.state;
                same.then_some((output.angle.radians(), wrench.feedback().force[1]))
            };
            if let (Some(after), Some(before)) = (stepped(1.0), stepped(-1.0)) {
                let turn = (after.0 - before.0) / (2.0 * step);
                let felt = (after.1 - before.1) / (2.0 * step);
                assert!(
                    (turn - tangent.compliance[2][column]).abs() < 1e-4,
                    "{k} {column}"
                );
                assert!(
                    (felt - tangent.stiffness[1][column]).abs() < 1e-4,
                    "{k} {column}"
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 150, "{compared}");
}
