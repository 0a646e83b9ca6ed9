//! A body jammed between two walls or in a wedge (R43): the contact forces needed to hold it are known in closed form, and so is the load
//! above which they hold it only with reactions beyond 64 k_h L. There the body stays and its status reports it.

use std::f64::consts::FRAC_PI_2;
use stiction_core::{Evolution, StateKind, Status};
use stiction_tests::expect::close;
use stiction_tests::laws::assert_lawful;
use stiction_tests::run::polyline;
use stiction_tests::{Number, Run, Setup, test_each};

test_each!(
    cases::rod_says_where_it_jams_and_never_moves,
    cases::vertex_says_where_it_jams_in_a_wedge,
);

/// Angle of the rod's line against the walls' normal (rad).
const TILT: f64 = 0.3;
const LENGTH: f64 = 0.1;

/// A rod of length L leans between two walls, held at its middle. A moment M that turns it across the slot is borne by N on each
/// wall with a lever of L sin(tilt) between them, and by friction mu N with a lever of L cos(tilt).
fn jammed_from(mu: f64) -> f64 {
    64.0 * (TILT.sin() + mu * TILT.cos())
}

mod cases {
    use super::*;

    pub(super) fn rod_says_where_it_jams_and_never_moves<R: Number>(evolution: Evolution) {
        for mu in [0.5, 0.0] {
            rod_jams::<R>(evolution, mu);
        }
    }

    fn rod_jams<R: Number>(evolution: Evolution, mu: f64) {
        let from = jammed_from(mu);
        let wall = LENGTH / 2.0 * TILT.cos();
        // k_theta = k_h L², so that a turn of the hand by 1 rad gives a moment of 1.
        let setup = Setup::new(&[[-LENGTH / 2.0, 0.0], [LENGTH / 2.0, 0.0]])
            .at([0.0, 0.0, TILT])
            .held_at([0.0, 0.0])
            .springs(500.0, 500.0 * LENGTH * LENGTH)
            .surface([1.0, 0.0], -wall, [mu, mu])
            .surface([-1.0, 0.0], -wall, [mu, mu]);
        let most = 60.0;
        assert!(from < most);
        let there = [[0.0, 0.0, TILT], [0.0, 0.0, TILT - most]];
        let hands = polyline(&[there[0], there[1], there[0]], 241);
        let mut run = Run::<R>::start(&setup, evolution, hands[0]);
        let begin = run.frame.pose;
        let mut found = [0; 2];
        for hand in hands {
            let frame = run.step(hand).clone();
            assert_lawful::<R>(&setup, std::slice::from_ref(&frame));
            assert_eq!((frame.state, frame.pose), (StateKind::TwoVertex, begin));
            let moment = TILT - hand[2];
            // Too close to the limit: within the rounding of both.
            if (moment / from - 1.0).abs() < 1e-4 {
                continue;
            }
            let is_jammed = moment > from;
            let status = if is_jammed {
                Status::Jammed
            } else {
                Status::Ok
            };
            assert_eq!(frame.status, status, "{moment}");
            found[usize::from(is_jammed)] += 1;
        }
        assert!(found.iter().all(|count| *count > 50), "{found:?}");
        assert_eq!(run.frame.status, Status::Ok);
    }
    /// The lower vertex of an upright rod is pulled down into a wedge that opens by 2 alpha: its walls bear 2 N (sin alpha + mu cos alpha). Or up
    /// and out of it: where mu > tan alpha they hold it, with 2 N (mu cos alpha - sin alpha).
    pub(super) fn vertex_says_where_it_jams_in_a_wedge<R: Number>(evolution: Evolution) {
        for (alpha, mu, down) in [(0.01_f64, 0.005, 1.0), (0.5, 0.57, -1.0)] {
            let (sin, cos) = alpha.sin_cos();
            let setup = Setup::new(&[[0.0, 0.0], [LENGTH, 0.0]])
                .at([0.0, 0.0, FRAC_PI_2])
                .held_at([0.0, 0.0])
                .springs(500.0, 500.0 * LENGTH * LENGTH)
                .surface([cos, sin], 0.0, [mu, mu])
                .surface([-cos, sin], 0.0, [mu, mu]);
            let jammed_from = 128.0 * (down * sin + mu * cos) * LENGTH;
            let hand = |depth: f64| [0.0, -down * depth, FRAC_PI_2];
            let mut run = Run::<R>::start(&setup, evolution, hand(0.0));
            for part in [0.5, 0.9, 0.999, 1.001, 1.5, 1.001, 0.999, 0.1] {
                let frame = run.step(hand(part * jammed_from)).clone();
                assert_lawful::<R>(&setup, std::slice::from_ref(&frame));
                let status = if part > 1.0 {
                    Status::Jammed
                } else {
                    Status::Ok
                };
                assert_eq!((frame.state, frame.status), (StateKind::Corner, status));
                let [x, y, _] = frame.pose;
                close("the vertex", x.hypot(y), 0.0, 1e-6 * LENGTH);
            }
        }
    }
}
