//! A clone of the state is a snapshot: restored, it replays bit for bit.

use stiction_core::Evolution;
use stiction_tests::{Number, Run, scenes, test_each};

test_each!(
    cases::restored_state_replays_bit_for_bit,
    cases::two_runs_are_equal_bit_for_bit
);

const FRAMES_PER_LEG: usize = 50;

mod cases {
    use super::*;

    pub(super) fn restored_state_replays_bit_for_bit<R: Number>(evolution: Evolution) {
        for (name, scenario) in scenes::all() {
            let hands = scenario.hands(FRAMES_PER_LEG);
            let mut run = Run::<R>::start(&scenario.setup, evolution, hands[0]);
            let (first, second) = hands[1..].split_at(hands.len() / 2);
            first.iter().for_each(|&hand| {
                run.step(hand);
            });
            let snapshot = run.state.clone();
            let mut play = || {
                second
                    .iter()
                    .map(|&hand| run.step(hand).clone())
                    .collect::<Vec<_>>()
            };
            let once = play();
            run.state = snapshot;
            let mut play = || {
                second
                    .iter()
                    .map(|&hand| run.step(hand).clone())
                    .collect::<Vec<_>>()
            };
            assert_eq!(play(), once, "{name}");
        }
    }

    pub(super) fn two_runs_are_equal_bit_for_bit<R: Number>(evolution: Evolution) {
        for (name, scenario) in scenes::all() {
            let hands = scenario.hands(FRAMES_PER_LEG);
            let mut runs = [(); 2].map(|()| Run::<R>::start(&scenario.setup, evolution, hands[0]));
            for &hand in &hands[1..] {
                let [a, b] = &mut runs;
                assert_eq!(a.step(hand), b.step(hand), "{name}");
                assert_eq!(a.state, b.state, "{name}");
            }
        }
    }
}
