//! Where the ground changes: from one friction to another in one line, and from one height to another by less than a thousandth.

use std::f64::consts::FRAC_PI_2;
use stiction_core::{Evolution, Status};
use stiction_tests::obstacles::Run;
use stiction_tests::obstacles::laws::Laws;
use stiction_tests::obstacles::scene::{Among, Obstacle};
use stiction_tests::run::polyline;
use stiction_tests::{Number, Setup, test_each};

test_each!(
    cases::point_lags_by_the_friction_of_its_ground,
    cases::box_over_two_grounds_is_lawful,
    cases::box_lies_across_a_step_of_less_than_a_thousandth,
    cases::side_that_nothing_turns_leans_on_a_pin,
);

/// A table between two x with its top at `y`.
fn table([from, to]: [f64; 2], y: f64, mu: f64) -> Obstacle {
    Obstacle {
        vertices: vec![[from, y - 0.2], [to, y - 0.2], [to, y], [from, y]],
        friction: [mu, mu],
    }
}

/// Two tables in one line, with a gap around x = 0.
fn two_grounds(setup: Setup, gap: f64, [left, right]: [f64; 2]) -> Among {
    let tables = [
        table([-2.0, -gap / 2.0], 0.0, left),
        table([gap / 2.0, 2.0], 0.0, right),
    ];
    Among {
        setup,
        obstacles: tables.into(),
    }
}

mod cases {
    use super::*;

    /// A point that is pressed by N = 0.2 and dragged follows at a distance of mu N / k_h; onto rougher ground it waits at the joint.
    pub(super) fn point_lags_by_the_friction_of_its_ground<R: Number>(evolution: Evolution) {
        const N: f64 = 0.2;
        for mu in [[0.5, 0.2], [0.2, 0.5], [0.4, 0.0], [0.0, 0.4]] {
            for way in [1.0, -1.0] {
                let grounds = if way > 0.0 { mu } else { [mu[1], mu[0]] };
                let setup = Setup::point().springs(1.0, 1.0).at([-0.3 * way, 0.0, 0.0]);
                let scene = two_grounds(setup, 0.0, grounds);
                let mut run = Run::<R>::start(&scene, evolution, [-0.3 * way, 0.0, 0.0]);
                run.step([-0.3 * way, -N, 0.0]);
                for k in 0..=70 {
                    let hand = -0.3 + 0.0097 * f64::from(k);
                    let frame = run.step([way * hand, -N, 0.0]);
                    assert_eq!(frame.status, Status::Ok, "{frame:?}");
                    let before = hand - mu[0] * N;
                    let expected = if before < 0.0 {
                        before.max(-0.3)
                    } else {
                        (hand - mu[1] * N).max(0.0)
                    };
                    R::near("x", way * frame.pose[0], expected);
                }
            }
        }
    }

    pub(super) fn box_over_two_grounds_is_lawful<R: Number>(evolution: Evolution) {
        let grounds = [[0.5, 0.2], [0.3, 0.6], [0.4, 0.0]];
        for (mu, gap) in grounds.into_iter().flat_map(|mu| [(mu, 0.0), (mu, 0.2)]) {
            let setup = Setup::block(1.0, 0.6).held_at([0.0, 0.2]);
            let setup = setup.springs(1.0, 0.5).at([-0.8, 0.0, 0.0]);
            let scene = two_grounds(setup, gap, mu);
            let laws = Laws::new::<R>(&scene);
            let mut run = Run::<R>::start(&scene, evolution, [-0.8, 0.2, 0.0]);
            let keyframes = [
                [-0.8, 0.0, 0.0],
                [1.0, 0.0, 0.05],
                [-0.2, 0.1, -0.05],
                [0.3, 0.05, 0.3],
                [-1.0, 0.0, 0.0],
            ];
            for hand in polyline(&keyframes, 50) {
                let frame = run.step(hand);
                assert_eq!(frame.status, Status::Ok, "{mu:?} {gap} {frame:?}");
                let broken = laws.broken(frame);
                assert!(broken.is_empty(), "{mu:?} {gap} {broken:?} {frame:?}");
            }
        }
    }

    /// On the lower table with a vertex, on the higher one's corner with its side.
    pub(super) fn box_lies_across_a_step_of_less_than_a_thousandth<R: Number>(
        evolution: Evolution,
    ) {
        for step in [3e-4, 6e-4] {
            let setup = Setup::block(1.0, 0.6).held_at([0.0, 0.2]).weighing(0.1);
            let scene = Among {
                setup: setup.springs(1.0, 0.5).at([0.0, 0.1, 0.0]),
                obstacles: vec![table([-1.0, -0.2], 0.0, 0.4), table([0.2, 1.0], step, 0.4)],
            };
            let laws = Laws::new::<R>(&scene);
            let mut run = Run::<R>::start(&scene, evolution, [0.0, 0.4, 0.0]);
            for k in 1..=20 {
                let frame = run.step([0.0, 0.4 - 0.02 * f64::from(k), 0.0]);
                assert_eq!(frame.status, Status::Ok, "{frame:?}");
                let broken = laws.broken(frame);
                assert!(broken.is_empty(), "{broken:?} {frame:?}");
            }
            assert_eq!(run.frame.contacts.len(), 2, "{:?}", run.frame);
            R::near("theta", run.frame.pose[2], (step / 0.7).asin());
        }
    }

    /// A side h below the holding point comes down on a pin, beside it by s; nothing holds the angle. At first the pin bears nothing: the
    /// holding point is at the hand, and the side turns. When the line to the pin enters the friction cone, h / cos from the holding point,
    /// the pin bears the whole pull along that line.
    pub(super) fn side_that_nothing_turns_leans_on_a_pin<R: Number>(evolution: Evolution) {
        const H: f64 = 0.2;
        for (mu, way) in [(0.3, 1.0), (0.3, -1.0), (0.0, 1.0), (0.0, -1.0)] {
            let setup = Setup::block(1.0, 0.4).held_at([0.0, H]).springs(1.0, 0.0);
            let start = [-0.15 * way, 0.05, 0.0];
            let scene = Among {
                setup: setup.at(start),
                obstacles: vec![Obstacle {
                    vertices: vec![[0.0, 0.0]],
                    friction: [mu, mu],
                }],
            };
            let bears = H * f64::hypot(1.0, mu);
            let down = polyline(&[[start[0], H + 0.05, 0.0], [start[0], 0.12, 0.0]], 40);
            let along = polyline(&[[start[0], 0.12, 0.0], [0.02 * way, 0.19, 0.0]], 20);
            let mut run = Run::<R>::start(&scene, evolution, down[0]);
            let mut borne = 0;
            for hand in down.into_iter().chain(along) {
                let frame = run.step(hand);
                assert_eq!(frame.status, Status::Ok, "{mu} {frame:?}");
                let far = hand[0].hypot(hand[1]);
                let grip = scene.setup.world(frame.pose, [0.0, H]);
                let out = if far < bears { bears / far } else { 1.0 };
                R::near("x of the holding point", grip[0], out * hand[0]);
                R::near("y of the holding point", grip[1], out * hand[1]);
                if far < bears {
                    borne += 1;
                }
                if !frame.contacts.is_empty() {
                    let (sin, cos) = (frame.pose[2] + FRAC_PI_2).sin_cos();
                    R::near("gap", cos * grip[0] + sin * grip[1], H);
                }
            }
            assert!(borne > 10, "{borne}");
        }
    }
}
