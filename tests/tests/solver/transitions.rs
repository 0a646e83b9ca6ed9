//! Every arm of the transition table is reached by some scene (`--nocapture` prints which), and leads from one of the states
//! that it names to the other.

use stiction_core::{Evolution, StateKind, Transition};
use stiction_tests::random::scenarios;
use stiction_tests::run::{Frame, run};
use stiction_tests::{Scenario, scenes};

#[test]
fn every_transition_is_reached() {
    let named = scenes::all()
        .into_iter()
        .map(|(name, scenario)| (name.to_string(), scenario));
    let random = scenarios(2000, 4)
        .enumerate()
        .map(|(i, scenario)| (format!("random scene {i}"), scenario));
    let mut missing: Vec<Transition> = Transition::ALL.to_vec();
    for (name, scenario) in named.chain(random) {
        if missing.is_empty() {
            break;
        }
        let reached = reached(&scenario);
        missing.retain(|arm| {
            let new = reached.contains(arm);
            if new {
                println!("{:<40} {arm:?}: {}", name, arm.describe());
            }
            !new
        });
    }
    assert!(missing.is_empty(), "never reached: {missing:?}");
}

fn reached(scenario: &Scenario) -> Vec<Transition> {
    let frames = Evolution::ALL
        .iter()
        .flat_map(|&e| run::<f64>(&scenario.setup, e, &scenario.hands(40)));
    frames
        .flat_map(|frame| frame.transitions.iter().collect::<Vec<_>>())
        .collect()
}

#[test]
fn the_arms_of_a_frame_lead_from_its_first_state_to_its_last() {
    let named = scenes::all().into_iter().map(|(_, scenario)| scenario);
    for scenario in named.chain(scenarios(2000, 4)) {
        for evolution in Evolution::ALL {
            let frames = run::<f64>(&scenario.setup, evolution, &scenario.hands(40));
            for pair in frames.windows(2) {
                assert_chained(pair[0].state, &pair[1]);
            }
        }
    }
}

/// The arms of a frame form a chain from the state before the frame to the state after it.
fn assert_chained(before: StateKind, frame: &Frame) {
    let mut visited = vec![before];
    let mut arms: Vec<Transition> = frame.transitions.iter().collect();
    arms.retain(|&arm| arm != Transition::Stays);
    while let Some(i) = (arms.iter()).position(|a| a.before().is_some_and(|s| visited.contains(&s)))
    {
        visited.extend(arms.remove(i).after());
    }
    assert!(
        arms.is_empty(),
        "no chain from {before:?} through {arms:?}: {frame:?}"
    );
    assert!(
        visited.contains(&frame.state),
        "no chain from {before:?}: {frame:?}"
    );
}
