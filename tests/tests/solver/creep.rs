//! A sticking contact does not creep: not by one bit in a million frames.

use stiction_core::{Evolution, StateKind};
use stiction_tests::{Number, Run, Scenario, scenes, test_each, times};

test_each!(
    cases::still_hand_leaves_every_bit,
    cases::hand_within_the_cone_leaves_the_foot
);

fn number_of_frames() -> usize {
    times(100_000, 1_000_000)
}

/// The scene after its first leg: pressed down, at rest.
fn pressed<R: Number>(scenario: &Scenario, evolution: Evolution) -> Run<R> {
    let mut run = Run::start(&scenario.setup, evolution, scenario.keyframes[0]);
    run.lead(scenario.keyframes[1], 20);
    run
}

mod cases {
    use super::*;

    pub(super) fn still_hand_leaves_every_bit<R: Number>(evolution: Evolution) {
        for scenario in [
            scenes::box_on_a_vertex(),
            scenes::box_flat(),
            scenes::box_as_a_ladder(),
        ] {
            let mut run = pressed::<R>(&scenario, evolution);
            let hand = *scenario.keyframes.last().expect("a path has keyframes");
            run.lead(hand, 100);
            let settled = run.step(hand).clone();
            assert_ne!(settled.state, StateKind::NonContact);
            for frame in 0..number_of_frames() / 3 {
                assert_eq!(*run.step(hand), settled, "frame {frame}");
            }
        }
    }

    /// The hand circles with a radius of 1 mm at 10 mm depth: |T| stays below mu_s N.
    pub(super) fn hand_within_the_cone_leaves_the_foot<R: Number>(evolution: Evolution) {
        for scenario in [scenes::box_on_a_vertex(), scenes::box_flat()] {
            let mut run = pressed::<R>(&scenario, evolution);
            let [x, y, phi] = scenario.keyframes[1];
            let feet = |run: &Run<R>| {
                run.frame
                    .contacts
                    .iter()
                    .map(|c| (c.touch, c.point))
                    .collect::<Vec<_>>()
            };
            let settled = feet(&run);
            for i in 0..number_of_frames() / 2 {
                let (sin, cos) = (i as f64 * 0.1).sin_cos();
                run.step([x + 0.001 * cos, y + 0.001 * sin, phi]);
                assert_eq!(feet(&run), settled, "frame {i}: {:?}", run.frame);
            }
        }
    }
}
