//! Closed forms in every number type: stick and slip, ladders, both evolutions, nothing creeps.

use crate::bench::{Number, Run, Setup, block, in_every_number_type, near, side};
use core::f64::consts::PI;
use stiction_core::{Evolution, SiFloat, StateKind, Status};

in_every_number_type!(
    cases::a_dragged_block_slips_by_the_difference_of_the_frictions,
    cases::where_the_hand_jumps_it_slips_once,
    cases::a_path_may_end_where_friction_gives_way,
    cases::slips_shrink_geometrically_as_the_hand_rises,
    cases::a_ladder_sticks_up_to_its_critical_angle,
    cases::a_hand_within_the_cone_leaves_the_foot,
    cases::a_body_that_nothing_presses_lifts,
    cases::an_edge_bears_any_load_without_a_jam,
);

mod cases {
    use super::*;

    /// Pressed by d = 0.2 it breaks away at a lag of mu_s d = 0.1 and stops at mu_d d = 0.06; then every 0.04.
    pub(super) fn a_dragged_block_slips_by_the_difference_of_the_frictions<R: Number>() {
        let setup = block([2.0, 1.0], 0.5, [0.5, 0.3]);
        let mut run = Run::<R>::new(&setup, Evolution::Path, [0.0, 0.3, 0.0]);
        assert_eq!(run.output.state, StateKind::Edge);
        let near_to = R::NEAR.max(1e-6);
        assert_eq!(run.to([0.1 - near_to, 0.3, 0.0]).slips, 0);
        assert_eq!(run.to([0.1 + near_to, 0.3, 0.0]).slips, 1);
        near::<R>(run.output.longest_slip.widen(), 0.04);
        near::<R>(run.pose()[0], 0.04);
        near::<R>(run.wrench()[0], 0.06 + near_to);
        near::<R>(run.normal(), 0.2);
        assert_eq!(run.lead([1.9999, 0.3, 0.0], 7), 47);
        near::<R>(run.pose()[0], 1.92);
    }

    /// In one frame it slips 48 times along the path; where the hand jumps, once at the first event and once to the end.
    pub(super) fn where_the_hand_jumps_it_slips_once<R: Number>() {
        let setup = block([2.0, 1.0], 0.5, [0.5, 0.3]);
        let drag = |evolution| {
            let mut run = Run::<R>::new(&setup, evolution, [0.0, 0.3, 0.0]);
            run.to([1.9999, 0.3, 0.0]);
            near::<R>(run.wrench()[1], -0.2);
            assert_eq!(
                (run.output.state, run.output.status),
                (StateKind::Edge, Status::Ok)
            );
            (run.output.slips, run.wrench()[0])
        };
        let (slips, pull) = drag(Evolution::Path);
        near::<R>(pull, 0.0799);
        assert_eq!(slips, 48);
        let (slips, pull) = drag(Evolution::Frame);
        near::<R>(pull, 0.06);
        assert_eq!(slips, 2);
    }

    /// Where the path ends within rounding of the point at which the block breaks away, it has slipped or it has not; a little further it has.
    pub(super) fn a_path_may_end_where_friction_gives_way<R: Number>() {
        let setup = block([2.0, 1.0], 0.5, [0.5, 0.3]);
        for evolution in Evolution::ALL {
            for k in -20..=20 {
                let end = 0.1 + f64::from(k) * 1e-9 * R::NEAR;
                let mut run = Run::<R>::new(&setup, evolution, [0.0, 0.3, 0.0]);
                let slips = run.to([end, 0.3, 0.0]).slips;
                assert_eq!(run.output.status, Status::Ok);
                near::<R>(run.pose()[0], 0.04 * f64::from(slips));
                let more = run.to([0.101, 0.3, 0.0]).slips;
                assert_eq!(slips + more, 1, "{k}");
                assert!((run.pose()[0] - 0.04).abs() < 0.0011, "{:?}", run.pose());
            }
        }
    }

    /// Rising at 45 degrees: each slip is (1 + mu_s) / (1 + mu_d) times as long as the next one.
    pub(super) fn slips_shrink_geometrically_as_the_hand_rises<R: Number>() {
        let setup = block([2.0, 1.0], 0.5, [0.5, 0.3]);
        let mut run = Run::<R>::new(&setup, Evolution::Path, [0.0, 0.1, 0.0]);
        let mut lengths = Vec::new();
        for k in 1..=330 {
            let way = f64::from(k) * 0.001;
            if run.to([way, 0.1 + way, 0.0]).slips > 0 {
                assert_eq!(run.output.slips, 1);
                lengths.push(run.output.longest_slip.widen());
            }
        }
        assert!(lengths.len() > 4, "{lengths:?}");
        for pair in lengths.windows(2) {
            near::<R>(pair[1], pair[0] * (1.0 + 0.3) / (1.0 + 0.5));
        }
    }

    /// A ladder between floor and wall, loaded straight down at its middle, sticks from the start up to tan(alpha) = (1 - mu²) / (2 mu).
    pub(super) fn a_ladder_sticks_up_to_its_critical_angle<R: Number>() {
        for mu in [0.3_f64, 0.5, 0.8] {
            let critical = ((1.0 - mu * mu) / (2.0 * mu)).atan();
            for (alpha, sticks) in [(critical + 1e-3, true), (critical - 1e-3, false)] {
                let setup = Setup {
                    vertices: vec![[0.0, 0.0], [2.0, 0.0]],
                    held: Some([1.0, 0.0]),
                    springs: [1.0, 1.0],
                    start: [2.0 * alpha.cos(), 0.0, PI - alpha],
                    surfaces: vec![
                        side([0.0, 1.0], 0.0, [mu, mu / 2.0]),
                        side([1.0, 0.0], 0.0, [mu, mu / 2.0]),
                    ],
                    ..Setup::default()
                };
                let [x, y] = setup.world(setup.start, [1.0, 0.0]);
                for evolution in Evolution::ALL {
                    let run = Run::<R>::new(&setup, evolution, [x, y - 1.0, PI - alpha]);
                    let stays = (run.pose()[2] - setup.start[2]).abs() < 1e-5;
                    let is = run.output.state == StateKind::TwoVertex && stays;
                    assert_eq!(is, sticks, "{mu} {alpha} {:?}", run.output);
                }
            }
        }
    }

    /// The hand circles so that |T| stays below mu_s N: contacts stay to the last bit, of a vertex and of an edge.
    pub(super) fn a_hand_within_the_cone_leaves_the_foot<R: Number>() {
        for tilt in [0.0_f64, 0.5] {
            let mut setup = block([2.0, 1.0], 0.5, [0.5, 0.3]);
            setup.springs = [1.0, 10.0];
            // Vertex 0 at the origin of the world.
            setup.start = [tilt.cos(), tilt.sin(), tilt];
            let [x, y] = setup.world(setup.start, [0.0, 0.5]);
            for evolution in Evolution::ALL {
                let mut run = Run::<R>::new(&setup, evolution, [x, y - 0.2, tilt]);
                let points = |run: &Run<R>| -> Vec<_> {
                    let contacts = run.contacts();
                    contacts.iter().map(|c| (c.touch, c.point)).collect()
                };
                let settled = points(&run);
                assert!(!settled.is_empty());
                for k in 0..300 {
                    let (sin, cos) = (f64::from(k) * 0.1).sin_cos();
                    run.to([x + 0.02 * cos, y - 0.2 + 0.02 * sin, tilt]);
                    assert_eq!(points(&run), settled, "{tilt} {k}");
                    let (pose, work) = (run.pose(), run.output.work);
                    run.to([x + 0.02 * cos, y - 0.2 + 0.02 * sin, tilt]);
                    assert_eq!((run.pose(), run.output.work), (pose, 0), "{work}");
                }
            }
        }
    }

    /// The hand jumps to where it pulls along the floor and does not press: no friction holds the body.
    pub(super) fn a_body_that_nothing_presses_lifts<R: Number>() {
        let setup = block([2.0, 1.0], 0.5, [0.5, 0.25]);
        for evolution in Evolution::ALL {
            let mut run = Run::<R>::new(&setup, evolution, [0.0, 0.25, 0.0]);
            run.to([0.5, 0.5, 0.0]);
            assert_eq!(
                run.output.status,
                Status::Ok,
                "{evolution:?} {:?}",
                run.output
            );
            near::<R>(run.pose()[0], 0.5);
            near::<R>(run.wrench()[0], 0.0);
        }
    }

    /// Contacts in one line have no inner force that could jam, however far the hand presses.
    pub(super) fn an_edge_bears_any_load_without_a_jam<R: Number>() {
        let mut setup = block([0.1, 0.06], 0.03, [0.5, 0.3]);
        setup.springs = [1.0, 0.01];
        let most = if R::NEAR < 1e-6 { 30.0 } else { 1.2 };
        let mut run = Run::<R>::new(&setup, Evolution::Path, [0.0, 0.03, 0.0]);
        for k in 1..=50 {
            let pull = most * f64::from(k) / 50.0;
            run.to([0.0, 0.03 - pull, 0.0]);
            assert_eq!(
                (run.output.state, run.output.status),
                (StateKind::Edge, Status::Ok)
            );
            assert!((run.normal() - pull).abs() <= R::NEAR * most, "{pull}");
        }
    }
}
