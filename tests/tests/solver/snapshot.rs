//! A clone of the state is a snapshot: restored, it replays bit for bit.

use stiction_core::Evolution;
use stiction_tests::{Number, Run, scenes, test_each};

test_each!(cases::restored_state_replays_bit_for_bit);

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
            let play = |run: &mut Run<R>| -> Vec<_> {
                second.iter().map(|&hand| run.step(hand).clone()).collect()
            };
            let once = play(&mut run);
            run.state = snapshot;
            assert_eq!(play(&mut run), once, "{name}");
        }
    }
}
