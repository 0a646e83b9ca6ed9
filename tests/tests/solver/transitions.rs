//! Every arm of the transition table is reached by some scene. With `--nocapture` it prints which.

use stiction_core::Transition;
use stiction_tests::random::scenarios;
use stiction_tests::run::run;
use stiction_tests::{EVOLUTIONS, Scenario, scenes};

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
    let frames = EVOLUTIONS
        .iter()
        .flat_map(|&e| run::<f64>(&scenario.setup, e, &scenario.hands(40)));
    frames
        .flat_map(|frame| frame.transitions.iter().collect::<Vec<_>>())
        .collect()
}
