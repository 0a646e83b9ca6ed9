//! The walk whose bits are compared visits every state and stays within bounds, and its hash is that of its answers.

use std::collections::HashMap;
use stiction_core::{Evolution, Fixed, Real, SiFloat, StateKind, Status, Touch};
use stiction_firmware::bits::{CORNERS, follow, of_walk};

const FRAMES: u32 = 10_000;

/// How often each state was held, after checking what must hold for every answer.
fn held_states<R: Real<Si: SiFloat>, const C: usize>(
    evolution: Evolution,
) -> HashMap<StateKind, u32> {
    let (mut seen, mut limited, mut states) = (0, 0, HashMap::new());
    follow::<R, C>(evolution, FRAMES, |answer| {
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
            held_states::<f32, 0>(evolution),
            held_states::<Fixed, 0>(evolution),
            held_states::<f32, CORNERS>(evolution),
            held_states::<Fixed, CORNERS>(evolution),
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
    let of_2000 = of_walk::<f32, 0>(2_000);
    assert_eq!(of_2000, of_walk::<f32, 0>(2_000));
    assert_ne!(of_2000, of_walk::<f32, 0>(1_999));
    assert_ne!(of_2000, of_walk::<Fixed, 0>(2_000));
    assert_ne!(of_2000, of_walk::<f32, CORNERS>(2_000));
}

#[test]
fn the_walk_among_obstacles_touches_sides_and_corners_of_each() {
    let (mut sides, mut corners) = ([0; 3], [0; 3]);
    follow::<f32, CORNERS>(Evolution::Path, FRAMES, |answer| {
        for touching in answer.contacts.iter() {
            match touching.touch {
                Touch::Side { obstacle, .. } => sides[obstacle] += 1,
                Touch::Corner { obstacle, .. } => corners[obstacle] += 1,
                Touch::Surface { .. } => panic!("there is none"),
            }
        }
    });
    assert!(sides[..2].iter().all(|&visits| visits > 100), "{sides:?}");
    assert_eq!(sides[2], 0, "a pin has no sides");
    assert!(corners.iter().all(|&visits| visits > 100), "{corners:?}");
}
