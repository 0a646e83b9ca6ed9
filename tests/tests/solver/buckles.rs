//! Two contacts slide while the hand turns, then the balance folds and the body snaps to the next balance (R28): a rod on
//! smooth walls, whose balance is known in closed form.

use std::f64::consts::{FRAC_PI_4, SQRT_2};
use stiction_core::{Event, Evolution, StateKind, Status};
use stiction_tests::laws::assert_lawful;
use stiction_tests::{Number, Run, Setup, scenes, test_each};

test_each!(
    cases::rod_follows_its_branches_and_snaps_between_them,
    cases::rod_that_buckles_on_a_smooth_floor_stays_below_the_hand,
    cases::hand_that_hardly_turns_leads_no_body_past_its_fold,
);

/// m of `scenes::rod_buckles`
const M: f64 = SQRT_2 / 2.0 / scenes::BUCKLING;

/// The root u of u - m sin u = beta on the side of a sign, beyond the fold.
fn balance(beta: f64, side: f64) -> f64 {
    let fold = side * (1.0 / M).acos();
    let (mut inner, mut outer) = (fold, side * FRAC_PI_4);
    for _ in 0..100 {
        let middle = (inner + outer) / 2.0;
        if side * (middle - M * middle.sin() - beta) > 0.0 {
            outer = middle;
        } else {
            inner = middle;
        }
    }
    (inner + outer) / 2.0
}

mod cases {
    use super::*;

    pub(super) fn rod_follows_its_branches_and_snaps_between_them<R: Number>(evolution: Evolution) {
        let scenario = scenes::rod_buckles();
        let fold = (1.0 / M).acos();
        let folds_at = fold - M * fold.sin();
        let hands = scenario.hands(40);
        let mut run = Run::<R>::start(&scenario.setup, evolution, hands[0]);
        let (mut side, mut snaps) = (1.0, 0);
        for hand in hands {
            let frame = run.step(hand).clone();
            assert_lawful::<R>(&scenario.setup, std::slice::from_ref(&frame));
            let beta = -hand[2] - FRAC_PI_4;
            if (beta * side) < folds_at {
                side = -side;
                snaps += 1;
                assert!(frame.saw(Event::Snap), "{frame:?}");
            }
            assert_eq!(
                (frame.state, frame.status),
                (StateKind::TwoVertex, Status::Ok)
            );
            assert_eq!(frame.slips, 0);
            R::near("theta", frame.pose[2], -FRAC_PI_4 - balance(beta, side));
        }
        assert_eq!(snaps, 2);
    }

    /// A rod that stands upright on a smooth floor, pressed until it buckles, by a hand that also moves along: nothing holds it back, so that
    /// its holding point stays below the hand, wherever within a frame it snaps.
    pub(super) fn rod_that_buckles_on_a_smooth_floor_stays_below_the_hand<R: Number>(
        evolution: Evolution,
    ) {
        for (turn, side) in [(0.0, 1.0), (-std::f64::consts::PI, -1.0)] {
            let setup = Setup::new(&[[0.0, 0.5], [0.0, -0.5]])
                .held_at([0.0, side * 0.0625])
                .springs(1.0, 1e-3)
                .at([0.0, 0.0, turn])
                .surface([0.0, 1.0], -0.5, [0.0; 2]);
            for count in 5..40 {
                let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.0625, turn]);
                for frame in run.lead([0.056_25, 0.056_25, turn], count) {
                    let held = setup.world(frame.pose, [0.0, side * 0.0625]);
                    R::near("the holding point", held[0], frame.hand[0]);
                }
            }
        }
    }

    /// A rod hangs from a hand that turns it over its fold (STATICS 16, kappa 2) while it moves by a rod's length: it snaps below the hand and
    /// does not touch a wall that only a hand farther on would lead it to.
    pub(super) fn hand_that_hardly_turns_leads_no_body_past_its_fold<R: Number>(
        evolution: Evolution,
    ) {
        let setup = Setup::new(&[[0.0, 0.5], [0.0, -0.5]])
            .held_at([0.0, 0.25])
            .weighing(0.4)
            .springs(1.0, 0.05)
            .surface([-1.0, 0.0], -1.9, [0.0; 2]);
        for turn in [1e-4, 1e-5, 1e-6] {
            let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.25, 0.0]);
            run.lead([0.0, 0.25, 3.826_445_9 - turn / 2.0], 40);
            let frames = run.lead([1.0, 0.25, 3.826_445_9 + turn / 2.0], 1);
            let frame = run.step([1.0, 0.25, 3.83]).clone();
            for frame in frames.iter().chain([&frame]) {
                assert!(
                    frame.contacts.is_empty() && !frame.saw(Event::Touch),
                    "{frame:?}"
                );
            }
            R::near("theta", frame.pose[2], 5.389_176_889);
        }
    }
}
