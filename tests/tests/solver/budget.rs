//! The budget of a step: no step exceeds it, and a new sample of the hand is followed straight from the body's current pose. That a cut
//! step continues to the same bits is shown among obstacles.

use stiction_core::{Evolution, Solver, State, Status};
use stiction_tests::counted::{Counted, counted};
use stiction_tests::laws::{FINITE, assert_lawful, judge};
use stiction_tests::random::scenarios;
use stiction_tests::run::planar;
use stiction_tests::setup::{SURFACES, VERTICES};
use stiction_tests::{Frame, Number, Scenario, Setup, test_each};

/// So few frames per keyframe that much happens in one frame.
const FRAMES_PER_LEG: usize = 3;

test_each! {
    cases::new_sample_leads_straight_from_where_it_stands,
    cases::hand_that_lets_go_leaves_nothing_to_do,
}

type Of<R> = Solver<R, VERTICES, SURFACES, 0>;

fn solver<R: Number>(setup: &Setup, evolution: Evolution) -> Of<R> {
    Solver::new(setup.scene::<R>().expect("a sound scene"), evolution)
}

/// The frame of a step, and whether anything is left to do.
fn step<R: Number>(solver: &Of<R>, state: &mut State<R>, hand: [f64; 3]) -> (Frame, bool) {
    let output = solver.step(state, planar::<R>(hand));
    let behind = R::wide(output.behind);
    assert!((0.0..=1.0).contains(&behind), "{output:?}");
    let is_behind = behind > 0.0;
    assert!(!is_behind || output.status >= Status::Behind, "{output:?}");
    assert!(is_behind || output.status != Status::Behind, "{output:?}");
    (Frame::new(solver, state, &output), is_behind)
}

/// No vertex is inside a surface, although the body may be out of balance.
fn stays_outside<R: Number>(setup: &Setup, frame: &Frame) {
    let findings = judge::<R>(setup, frame).into_iter();
    let gaps =
        findings.filter(|finding| ["no vertex is inside a surface", FINITE].contains(&finding.law));
    gaps.for_each(|finding| assert!(finding.holds(), "{finding:?}: {frame:?}"));
}

mod cases {
    use super::*;

    /// However a hand was followed before it stops, the body comes to rest lawfully and stays.
    pub(super) fn new_sample_leads_straight_from_where_it_stands<R: Number>(evolution: Evolution) {
        let (mut behind, mut caught_up) = (0, 0);
        for scenario in scenarios(100, 8) {
            let tight = solver::<R>(&scenario.setup, evolution).with_budget(1);
            let hands = scenario.hands(FRAMES_PER_LEG);
            let (mut state, _) = tight.start(planar::<R>(hands[0]));
            for &hand in &hands[1..] {
                let (frame, is_behind) = step::<R>(&tight, &mut state, hand);
                if is_behind {
                    stays_outside::<R>(&scenario.setup, &frame);
                    behind += 1;
                } else {
                    assert_lawful::<R>(&scenario.setup, std::slice::from_ref(&frame));
                    caught_up += 1;
                }
            }
        }
        assert!(behind > 20 && caught_up > 500, "{behind} {caught_up}");
    }

    /// A hand lets go in mid-step: the body stays where it is, and a hand that grasps it later starts a new path.
    pub(super) fn hand_that_lets_go_leaves_nothing_to_do<R: Number>(evolution: Evolution) {
        let mut count = 0;
        for scenario in scenarios(100, 8) {
            let tight = solver::<R>(&scenario.setup, evolution).with_budget(0);
            let hands = scenario.hands(FRAMES_PER_LEG);
            let (mut state, _) = tight.start(planar::<R>(hands[0]));
            for &hand in &hands[1..] {
                let (frame, is_behind) = step::<R>(&tight, &mut state, hand);
                if !is_behind {
                    continue;
                }
                let open = planar::<R>(hand).released();
                let output = tight.step(&mut state, open);
                assert_eq!((output.status, output.held), (Status::Ok, false));
                assert_eq!(R::wide(output.behind), 0.0);
                let still = Frame::new(&tight, &state, &output);
                assert_eq!(still.pose, frame.pose);
                count += 1;
                while step::<R>(&tight, &mut state, hand).1 {}
            }
        }
        assert!(count > 20, "{count}");
    }
}

/// The cost of steps in operations on numbers is proportional to that in units of work, and neither exceeds a budget.
#[test]
fn no_step_takes_more_than_its_budget() {
    let mut dearest = (0.0, 0, 0);
    for evolution in Evolution::ALL {
        for scenario in scenarios(200, 8) {
            dear_unit(&scenario, evolution, &mut dearest);
        }
    }
    let (per_unit, operations, work) = dearest;
    println!("at most {per_unit:.0} operations a unit: {operations} in {work}");
    assert!(per_unit <= OPERATIONS_PER_UNIT, "{per_unit}");
}

/// The largest number of operations on numbers per unit of work.
const OPERATIONS_PER_UNIT: f64 = 200.0;

fn dear_unit(scenario: &Scenario, evolution: Evolution, dearest: &mut (f64, u64, u32)) {
    let scene = (scenario.setup).scene_of::<Counted, VERTICES, SURFACES, 0>();
    let solver = Solver::new(scene.expect("a sound scene"), evolution).with_budget(1);
    let mut hands = scenario.hands(FRAMES_PER_LEG).into_iter();
    let first = hands.next().expect("a path");
    let (mut state, _) = solver.start(planar::<Counted>(first));
    for hand in hands {
        let (output, operations) = counted(|| solver.step(&mut state, planar::<Counted>(hand)));
        assert!(output.work <= solver.budget(), "{output:?}");
        if output.work == 0 {
            continue;
        }
        let per_unit = operations as f64 / f64::from(output.work);
        if per_unit > dearest.0 {
            *dearest = (per_unit, operations, output.work);
        }
    }
}
