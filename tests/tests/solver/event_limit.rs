//! The bound on the events of a frame: what is within it keeps every bit, what is not is a lawful balance all the same, says
//! so, and tells no more events apart than allowed.

use stiction_core::{Evolution, MAX_EVENT_LIMIT, Solver, Status};
use stiction_tests::laws::{assert_lawful, creep};
use stiction_tests::random::scenarios;
use stiction_tests::run::planar;
use stiction_tests::{Frame, Number, Scenario, scenes, test_each};

const LIMITS: [u8; 4] = [1, 2, 4, 8];

test_each! {
    cases::within_the_limit_every_bit_is_the_same,
    cases::limited_frames_obey_every_law,
    cases::slips_are_no_more_than_events_and_a_jump,
    cases::limit_out_of_range_is_its_nearer_end,
}

/// A solver with a limit along a path, and in every frame one without from the same state.
fn beside<R: Number>(
    scenario: &Scenario,
    (evolution, limit): (Evolution, u8),
    mut look: impl FnMut(&Frame, &Frame, &Frame),
) {
    let scene = || scenario.setup.scene::<R>().expect("a sound scene");
    let free = Solver::new(scene(), evolution);
    let limited = Solver::new(scene(), evolution).with_event_limit(limit);
    let hands = scenario.hands(20);
    let (mut state, output) = limited.start(planar::<R>(hands[0]));
    let mut last = Frame::new(&limited, &state, &output);
    for &hand in &hands[1..] {
        let mut twin = state.clone();
        let output = free.step(&mut twin, planar::<R>(hand));
        let whole = Frame::new(&free, &twin, &output);
        let output = limited.step(&mut state, planar::<R>(hand));
        let bounded = Frame::new(&limited, &state, &output);
        look(&last, &bounded, &whole);
        last = bounded;
    }
}

mod cases {
    use super::*;

    pub(super) fn within_the_limit_every_bit_is_the_same<R: Number>(evolution: Evolution) {
        for limit in LIMITS {
            let (mut frames, mut limited) = (0, 0);
            for scenario in scenarios(100, 4) {
                beside::<R>(&scenario, (evolution, limit), |_, bounded, whole| {
                    frames += 1;
                    limited += u32::from(bounded != whole);
                    let says_so = bounded.status >= Status::EventLimit;
                    assert!(bounded == whole || says_so, "limit {limit}: {bounded:?}");
                });
            }
            println!("at most {limit} events: {limited} of {frames} frames limited");
            let jumps = evolution == Evolution::Frame;
            assert!(if jumps { limited == 0 } else { limited > 0 });
        }
    }

    pub(super) fn limited_frames_obey_every_law<R: Number>(evolution: Evolution) {
        for limit in LIMITS {
            for scenario in scenarios(100, 4) {
                let setup = &scenario.setup;
                beside::<R>(&scenario, (evolution, limit), |last, bounded, _| {
                    assert_lawful::<R>(setup, std::slice::from_ref(bounded));
                    let creep = creep::<R>(setup, last, bounded);
                    assert!(creep.holds(), "{creep:?}: {bounded:?}");
                });
            }
        }
    }

    /// A dragged box of which every event is a slip: those of the limit, and the one that the jump ends with.
    pub(super) fn slips_are_no_more_than_events_and_a_jump<R: Number>(evolution: Evolution) {
        let mut scenario = scenes::box_flat();
        scenario.keyframes = vec![[0.0, 0.04, 0.0], [0.1, 0.04, 0.0], [0.2, 0.04, 0.0]];
        for limit in LIMITS {
            beside::<R>(&scenario, (evolution, limit), |_, bounded, _| {
                assert!(bounded.slips <= u32::from(limit) + 1, "{bounded:?}");
            });
        }
    }

    pub(super) fn limit_out_of_range_is_its_nearer_end<R: Number>(evolution: Evolution) {
        let scene = || {
            scenes::box_flat()
                .setup
                .scene::<R>()
                .expect("a sound scene")
        };
        let with = |limit| Solver::new(scene(), evolution).with_event_limit(limit);
        assert_eq!(with(0), with(1));
        assert_eq!(with(u8::MAX), with(MAX_EVENT_LIMIT));
        assert_eq!(with(MAX_EVENT_LIMIT), Solver::new(scene(), evolution));
    }
}
