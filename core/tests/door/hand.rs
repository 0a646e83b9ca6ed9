//! The hand on the body: it takes hold and lets go, samples that are none, whole turns, far places; the body under other parameters; the
//! budget of a step.

use crate::bench::{
    Number, Of, Run, Setup, all_near, block, hand, in_every_number_type, near, solver_of,
};
use stiction_core::{
    Angle, CarryError, Description, Event, Evolution, Hand, Hold, Present, SiFloat, Solver,
    StateKind, Status,
};

in_every_number_type!(
    cases::it_takes_hold_where_it_is,
    cases::its_reach_ends_at_a_distance_from_the_body,
    cases::a_released_body_stays_and_is_taken_elsewhere,
    cases::a_lost_sample_leaves_every_bit,
    cases::a_hand_that_is_absent_at_first_takes_hold_later,
    cases::whole_turns_cost_no_digits,
    cases::pieces_end_in_the_bits_of_the_whole,
    cases::a_carried_body_keeps_pose_hold_and_wrench,
);

/// A block of 2 x 1 in the air that can be held anywhere.
fn loose() -> Setup {
    Setup {
        held: None,
        start: [0.0, 2.0, 0.2],
        ..block([2.0, 1.0], 0.5, [0.5, 0.3])
    }
}
/// A block that is pressed onto the floor.
fn pressed<R: Number>() -> (Setup, Run<R>) {
    let setup = block([2.0, 1.0], 0.5, [0.5, 0.3]);
    let run = Run::new(&setup, Evolution::Path, [0.0, 0.3, 0.0]);
    (setup, run)
}

mod cases {
    use super::*;

    pub(super) fn it_takes_hold_where_it_is<R: Number>() {
        let setup = loose();
        let [x, y] = setup.world(setup.start, [0.6, 0.3]);
        let mut run = Run::<R>::with(&setup, Evolution::Path, hand::<R>([x, y, 1.0]).released());
        assert!(!run.output.held && run.wrench() == [0.0; 3]);
        let reported = |run: &Run<R>, hold: Hold| hold.after(run.output.events(), run.output.held);
        let mut hold = reported(&run, Hold::Never);
        assert!(run.to([x, y, 1.0]).held && run.saw(Event::Grasp));
        hold = reported(&run, hold);
        assert_eq!((run.state.hold(), hold), (Hold::Taken, Hold::Taken));
        all_near::<R, 3>(run.pose(), setup.start);
        all_near::<R, 3>(run.wrench(), [0.0; 3]);
        run.to([x + 0.5, y + 0.2, 1.0]);
        assert_eq!(
            (run.state.hold(), reported(&run, hold)),
            (Hold::Taken, hold)
        );
        all_near::<R, 3>(run.pose(), [0.5, 2.2, 0.2]);
        run.to([x + 0.5, y + 0.2, 1.4]);
        near::<R>(run.pose()[2], 0.6);
        all_near::<R, 2>(setup.world(run.pose(), [0.6, 0.3]), [x + 0.5, y + 0.2]);
    }

    pub(super) fn its_reach_ends_at_a_distance_from_the_body<R: Number>() {
        let setup = Setup {
            reach: 0.1,
            start: [0.0, 2.0, 0.0],
            ..loose()
        };
        // Beside the right side, and off the upper right corner.
        for (at, held) in [
            ([0.7, 2.5], true),
            ([1.09, 2.5], true),
            ([1.11, 2.5], false),
            ([1.07, 3.07], true),
            ([1.08, 3.08], false),
            ([4.0, 2.5], false),
        ] {
            let mut run = Run::<R>::new(&setup, Evolution::Path, [at[0], at[1], 0.0]);
            assert_eq!(
                (run.output.held, run.saw(Event::Grasp)),
                (held, held),
                "{at:?}"
            );
            if !held {
                run.to([4.0, 4.0, 0.0]);
                all_near::<R, 3>(run.pose(), setup.start);
                assert_eq!(run.wrench(), [0.0; 3]);
            }
        }
    }

    pub(super) fn a_released_body_stays_and_is_taken_elsewhere<R: Number>() {
        let (setup, mut run) = pressed::<R>();
        run.lead([1.0, 0.3, 0.0], 50);
        let before = run.pose();
        run.feed(hand::<R>([1.0, 0.3, 0.0]).released());
        assert!(run.saw(Event::Release) && !run.output.held);
        for at in [[5.0, 5.0, 2.0], [-1.0, -1.0, 0.0]] {
            run.feed(hand::<R>(at).released());
            assert_eq!((run.pose(), run.wrench()), (before, [0.0; 3]));
            assert_eq!(run.solver.tangent(&run.state), None);
            assert_eq!(run.contacts().len(), 2);
            assert!(run.contacts().iter().all(|c| c.sliding == 0) && run.normal() == 0.0);
        }
        let [x, y] = setup.world(before, [0.8, 0.9]);
        run.to([x, y, 1.0]);
        assert!(run.saw(Event::Grasp) && run.output.held);
        all_near::<R, 3>(run.pose(), before);
        all_near::<R, 3>(run.wrench(), [0.0; 3]);
        run.lead([x, y + 1.0, 1.0], 20);
        assert_eq!(run.output.state, StateKind::NonContact);
        all_near::<R, 3>(run.pose(), [before[0], before[1] + 1.0, before[2]]);
    }

    pub(super) fn a_lost_sample_leaves_every_bit<R: Number>() {
        let (_, mut run) = pressed::<R>();
        run.lead([0.7, 0.3, 0.1], 20);
        let (state, pose) = (run.state.clone(), run.pose());
        let last = hand::<R>([0.7, 0.3, 0.1]);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(R::si) {
            let [x, y] = last.position;
            let turned = Angle {
                rest: bad,
                ..last.angle
            };
            for sample in [
                Hand {
                    position: [bad, y],
                    ..last
                },
                Hand {
                    position: [x, bad],
                    ..last
                },
                Hand {
                    angle: turned,
                    ..last
                },
                Hand { depth: bad, ..last },
            ] {
                assert_eq!(run.feed(sample).status, Status::HeldLast);
                assert_eq!((run.pose(), &run.state), (pose, &state));
            }
        }
        for far in [[1e30, 0.0, 0.0], [1e14, -1e14, 0.0], [0.0, 0.3, 1e30]] {
            assert_eq!(run.to(far).status, Status::Saturated);
            assert_eq!((run.pose(), &run.state), (pose, &state));
        }
        let tilted = Hand {
            tilted: true,
            ..last
        };
        assert_eq!(run.feed(tilted).status, Status::Twist);
    }

    pub(super) fn a_hand_that_is_absent_at_first_takes_hold_later<R: Number>() {
        let (setup, _) = pressed::<R>();
        let lost = Hand {
            depth: R::si(f64::NAN),
            ..hand::<R>([0.0, 0.3, 0.0])
        };
        let mut run = Run::<R>::with(&setup, Evolution::Path, lost);
        assert_eq!(
            (run.output.status, run.output.held),
            (Status::HeldLast, false)
        );
        assert_eq!((run.pose(), run.state.hold()), ([0.0; 3], Hold::Never));
        assert!(run.to([0.0, 0.3, 0.0]).held);
        near::<R>(run.normal(), 0.2);
    }

    /// The hand winds the body up by 2000 turns; the number type keeps what is beyond whole turns.
    pub(super) fn whole_turns_cost_no_digits<R: Number>() {
        let setup = loose();
        let mut run = Run::<R>::new(&setup, Evolution::Path, [0.0, 2.0, 0.2]);
        for k in 0..2000 {
            for rest in [0.3, 2.3] {
                let angle = Angle {
                    turns: k,
                    rest: R::si(rest),
                };
                run.feed(Hand {
                    angle,
                    ..hand::<R>([0.0, 2.0, 0.0])
                });
            }
        }
        assert_eq!(
            (run.output.status, run.output.angle.turns),
            (Status::Ok, 1999)
        );
        near::<R>(run.output.angle.rest.widen(), 2.3);
    }

    pub(super) fn pieces_end_in_the_bits_of_the_whole<R: Number>() {
        for evolution in Evolution::ALL {
            for budget in [0, 1, 2, 7] {
                let (setup, _) = pressed::<R>();
                let mut run = Run::<R>::new(&setup, evolution, [0.0, 0.3, 0.0]);
                let tight = run.solver.clone().with_budget(budget);
                let mut twin = run.state.clone();
                let mut cut = 0;
                for at in [[0.4, 0.2, 0.1], [1.0, 0.6, -0.2], [0.2, 0.1, 0.3]] {
                    let slips = run.to(at).slips;
                    let (mut left, mut counted) = (1.0, 0);
                    loop {
                        let output = tight.step(&mut twin, hand::<R>(at));
                        counted += output.slips;
                        assert!(output.work <= budget.max(1), "{output:?}");
                        let behind = output.behind.widen();
                        assert!(behind <= left, "{behind} {left}");
                        assert_eq!(behind > 0.0, output.status >= Status::Behind);
                        if behind == 0.0 {
                            break;
                        }
                        (left, cut) = (behind, cut + 1);
                    }
                    assert_eq!(counted, slips);
                    assert!(twin == run.state, "{budget} {at:?}");
                }
                assert!(cut > 0, "{budget}: {cut}");
            }
        }
    }

    pub(super) fn a_carried_body_keeps_pose_hold_and_wrench<R: Number>() {
        // With a rotational spring and without.
        for turning in [0.5, 0.0] {
            carried_with::<R>(turning);
        }
    }

    fn carried_with<R: Number>(turning: f64) {
        let setup = Setup {
            springs: [500.0, turning],
            ..block([0.1, 0.06], 0.05, [0.5, 0.3])
        };
        let along = hand::<f32>([0.02, 0.04, 0.0]);
        let aside = hand::<f32>([0.03, 0.05, 0.1]);
        let drawn = hand::<f32>([0.031, 0.045, 0.1]);
        let given = present(&setup, &[along]);
        let taken = present(&setup, &[along, aside.released(), aside, drawn]);
        assert_eq!((given.hold, taken.hold), (Hold::Given, Hold::Taken));
        for present in [given, taken] {
            assert!(present.wrench.force[1] < -2.0, "{present:?}");
            let carried = setup.described::<R, _>(|d| Of::<R>::carry(&present, d, solver_of::<R>));
            let carried = carried.expect("it fits");
            assert!(carried.output.held && carried.state.hold() == present.hold);
            let wrench = carried.solver.wrench(&carried.state);
            for k in 0..2 {
                let [was, is] = [
                    present.position[k].widen(),
                    carried.output.position[k].widen(),
                ];
                assert!((is - was).abs() < 1e-6, "{is} {was}");
                let [was, is] = [present.wrench.force[k].widen(), wrench.force[k].widen()];
                assert!((is - was).abs() < 5e-3, "{is} {was}");
            }
        }
    }
}

/// A body after its hand moved, in single precision.
fn present(setup: &Setup, hands: &[Hand<f32>]) -> Present<f32> {
    let mut run = Run::<f32>::new(setup, Evolution::Path, [0.0, 0.04, 0.0]);
    for &hand in hands {
        run.feed(hand);
    }
    Present {
        position: run.output.position,
        angle: run.output.angle,
        held: run.output.held,
        hold: run.state.hold(),
        holding_point: setup.held.map(|g| g.map(|x| x as f32)),
        hand: run.state.hand().turned(-run.output.angle.turns),
        wrench: run.solver.wrench(&run.state),
        stiffness: setup.springs.map(|k| k as f32),
    }
}

#[test]
fn a_body_that_does_not_fit_is_not_carried() {
    let setup = Setup {
        springs: [500.0, 0.5],
        ..block([0.1, 0.06], 0.05, [0.5, 0.3])
    };
    let here = present(&setup, &[hand::<f32>([0.02, 0.04, 0.0])]);
    let carried = |present: &Present<f32>, setup: &Setup| {
        let carried = setup.described::<f32, _>(|d: &Description<'_, f32>| {
            Solver::carry(present, d, solver_of::<f32>)
        });
        carried.map(drop)
    };
    let mut higher = setup.clone();
    higher.surfaces[0].offset = 0.01;
    let error = carried(&here, &higher).expect_err("in the floor");
    assert!(matches!(error, CarryError::Scene(_)), "{error:?}");
    assert!(error.to_string().contains("surface 0"), "{error}");
    let far = Present {
        hand: hand::<f32>([1e9, 0.04, 0.0]),
        ..here
    };
    let error = carried(&far, &setup).expect_err("out of range");
    assert_eq!(error, CarryError::Unsettled(Status::Saturated));
    assert!(error.to_string().contains("saturated"), "{error}");
    // Its hold is a metre outside of it.
    let aside = Present {
        hold: Hold::Taken,
        hand: hand::<f32>([1.0, 0.04, 0.0]),
        wrench: Default::default(),
        ..here
    };
    let error = carried(&aside, &setup).expect_err("no hold");
    assert_eq!(error, CarryError::OutOfReach);
    assert!(error.to_string().contains("out of reach"), "{error}");
}

/// A box of 0.1 m x 0.06 m, 10 km from the origin, where single precision distinguishes 1 mm, is pressed by 10 mm and dragged by 40 mm: 5 N
/// and 18 slips, to the rounding of the samples.
#[test]
fn far_from_the_origin_only_the_samples_are_rounded() {
    let far = 10_000.0;
    let mut setup = block([0.1, 0.06], 0.05, [0.5, 0.3]);
    setup.springs = [500.0, 0.5];
    setup.start = [far, far + 0.02, 0.0];
    setup.surfaces[0].offset = far;
    let mut run = Run::<f32>::new(&setup, Evolution::Path, [far, far + 0.07, 0.0]);
    run.lead([far, far + 0.04, 0.0], 30);
    assert_eq!(
        (run.output.state, run.output.status),
        (StateKind::Edge, Status::Ok)
    );
    assert!((run.normal() - 5.0).abs() <= 1.0, "{}", run.normal());
    let slips = run.lead([far + 0.04, far + 0.04, 0.0], 40);
    assert!((16..=20).contains(&slips), "{slips}");
    setup.start = [1e7, 0.0, 0.0];
    let error = setup.solver::<f32>().expect_err("no digit is left");
    assert_eq!(error.parameter, stiction_core::Parameter::Start);
}
