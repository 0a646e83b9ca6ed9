//! How far a slip goes: what is driven moves, and what leads nowhere leaves the body where it was.

use super::*;

/// However near to where it stops: what drives it is not nothing to the search.
#[test]
fn what_is_driven_moves() {
    let mut count = 0;
    driven(Demand::Pressed, |case, trammel, seed| {
        let (run, ending) = trammel.run(&case.scene, &case.state, Demand::Pressed);
        if ending != Ending::Stopped {
            return;
        }
        let (mut slide, mut turn) = (run.slide, run.turn);
        for _ in 0..60 {
            (slide, turn) = (0.5 * slide, 0.5 * turn);
            let pivot = case.state.pivot.moved(run.slide - slide, run.turn - turn);
            let state = TwoVertex {
                pivot,
                ..case.state.clone()
            };
            if let Some(near) = Trammel::driven(&case.scene, &state, &case.grip, Demand::Pressed) {
                let (run, _) = near.run(&case.scene, &state, Demand::Pressed);
                assert!(run.slide != 0.0 || run.turn != 0.0, "{seed} {slide}");
                count += 1;
            }
        }
    });
    assert!(cfg!(miri) || count > 1000, "{count}");
}

/// Where a slip does not get away, the body stays to the bit.
#[test]
fn slip_that_leads_nowhere_leaves_the_body_where_it_was() {
    let mut count = 0;
    driven(Demand::AtTheEnd, |case, _, seed| {
        let mut state = case.state.clone();
        for _ in 0..4 {
            let begin = state.clone();
            let moved = state.slide(&case.scene, &case.grip);
            if moved.trigger == Trigger::Undriven {
                assert_eq!(state, begin, "{seed}");
                count += 1;
            }
        }
    });
    assert!(cfg!(miri) || count > 10, "{count}");
}
