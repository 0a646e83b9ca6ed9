//! The walk whose bits are compared goes everywhere and stays within bounds, and its hash is that of its answers.

use std::collections::HashMap;
use stiction_core::{Evolution, Fixed, Real, SiFloat, StateKind, Status};
use stiction_firmware::bits::{follow, of_walk};

const FRAMES: u32 = 10_000;

/// How often each state was held in, after checking what must hold for every answer.
fn held_states<R: Real<Si: SiFloat>>(evolution: Evolution) -> HashMap<StateKind, u32> {
    let (mut seen, mut limited, mut states) = (0, 0, HashMap::new());
    follow::<R>(evolution, FRAMES, |answer| {
        let output = &answer.output;
        seen += 1;
        limited += u32::from(output.status != Status::Ok);
        let [x, y] = output.position.map(SiFloat::widen);
        assert!(x.hypot(y) < 0.35, "at {x}, {y}");
        if output.held {
            *states.entry(output.state).or_default() += 1;
        }
    });
    assert_eq!(seen, FRAMES);
    assert!(limited < FRAMES / 200, "{limited} frames are limited");
    states
}

#[test]
fn the_walk_visits_every_state() {
    for evolution in [Evolution::Path, Evolution::Frame] {
        for states in [
            held_states::<f32>(evolution),
            held_states::<Fixed>(evolution),
        ] {
            for state in StateKind::ALL {
                let visits = states.get(&state).copied().unwrap_or(0);
                assert!(visits >= 10, "{evolution:?}: {} {visits}", state.name());
            }
        }
    }
}

#[test]
fn the_hash_is_that_of_the_answers() {
    assert_eq!(of_walk::<f32>(2_000), of_walk::<f32>(2_000));
    assert_ne!(of_walk::<f32>(2_000), of_walk::<f32>(1_999));
    assert_ne!(of_walk::<f32>(2_000), of_walk::<Fixed>(2_000));
}
