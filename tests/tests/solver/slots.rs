//! A rod that fits a slot almost exactly: its contacts are opposite each other, and bear moments only over the short lever between them.

use stiction_core::{Evolution, Status};
use stiction_tests::expect::close;
use stiction_tests::laws::assert_lawful;
use stiction_tests::{Number, Run, Setup, test_each};

test_each!(
    cases::rod_across_a_slot_follows_the_hand_along_it,
    cases::rod_that_just_fits_turns_with_the_hand,
);

const LENGTH: f64 = 0.1;
const STIFFNESS: f64 = 500.0;

/// A rod upright between floor and ceiling, tilted counter-clockwise, held at its middle.
fn rod_across(tilt: f64) -> Setup {
    let wall = LENGTH / 2.0 * tilt.cos();
    Setup::new(&[[0.0, -LENGTH / 2.0], [0.0, LENGTH / 2.0]])
        .at([0.0, 0.0, tilt])
        .held_at([0.0, 0.0])
        .springs(STIFFNESS, STIFFNESS * LENGTH * LENGTH)
        .surface([0.0, 1.0], -wall, [0.0, 0.0])
        .surface([0.0, -1.0], -wall, [0.0, 0.0])
}

mod cases {
    use super::*;

    /// Nothing resists along the slot. A moment M towards upright is borne by N = M / (L sin tilt) on both sides; without one neither presses.
    pub(super) fn rod_across_a_slot_follows_the_hand_along_it<R: Number>(evolution: Evolution) {
        // Nearer to upright the moment of 1 N turns it by what its gaps are known to, and the force along the slot is known to rounding over
        // that lever.
        let cases = [
            (0.3, 1.0),
            (0.03, 1.0),
            (0.01, 1.0),
            (0.03, 0.0),
            (0.003, 0.0),
            (0.0015, 0.0),
        ];
        for (tilt, normal) in cases {
            let setup = rod_across(tilt);
            let lever = LENGTH * f64::sin(tilt);
            let phi = tilt - normal * lever / (STIFFNESS * LENGTH * LENGTH);
            let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.0, tilt]);
            run.step([0.0, 0.0, phi]);
            for x in [0.01, 0.02, -0.02, -0.0199, 0.03] {
                for frame in run.lead([x, 0.0, phi], 3) {
                    if tilt >= 0.01 {
                        assert_lawful::<R>(&setup, std::slice::from_ref(&frame));
                    }
                    assert_eq!(frame.status, Status::Ok, "{tilt} {normal}: {frame:?}");
                }
                let what = format!("{} at {tilt} under {normal} N", R::NAME);
                let [there, _, theta] = run.frame.pose;
                close(&what, there, x, 1e3 * R::ROUNDING * LENGTH / tilt.sin());
                close(&what, theta, tilt, 1e3 * R::ROUNDING / tilt.sin());
                if normal > 0.0 {
                    let ends: Vec<f64> = run.frame.contacts.iter().map(|c| c.normal).collect();
                    let [floor, ceiling] = *ends else {
                        panic!("{what}: {:?}", run.frame);
                    };
                    let known = 1e3 * R::ROUNDING * STIFFNESS * LENGTH / tilt.sin();
                    close(&what, floor, normal, known);
                    close(&what, ceiling, normal, known);
                }
            }
        }
    }
    /// As long as the slot is wide, the rod presses nothing when it is upright and touches nothing otherwise.
    pub(super) fn rod_that_just_fits_turns_with_the_hand<R: Number>(evolution: Evolution) {
        let setup = rod_across(0.0);
        let mut run = Run::<R>::start(&setup, evolution, [0.0; 3]);
        for hand in [
            [0.01, 0.0, 0.0],
            [0.02, 0.0, 0.1],
            [-0.02, 0.0, -0.2],
            [0.0, 0.0, 0.0],
        ] {
            for frame in run.lead(hand, 7) {
                assert_lawful::<R>(&setup, std::slice::from_ref(&frame));
                assert_eq!(frame.status, Status::Ok, "{frame:?}");
                let [x, _, phi] = frame.hand;
                let [there, _, theta] = frame.pose;
                // Within the angle at which its ends are a touch away it may be held.
                let touch = R::GAP.sqrt();
                close(R::NAME, theta, phi, 2.0 * touch);
                close(R::NAME, there, x, 2.0 * touch * LENGTH);
            }
        }
    }
}
