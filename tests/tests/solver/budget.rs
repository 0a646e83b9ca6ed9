//! The budget of a step, in pieces (R41): no step exceeds it, a step that is cut goes on to the same bits, and a new sample of the hand is
//! followed straight from where the body is certain to be.

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
    cases::cut_steps_end_in_the_same_bits,
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

/// Where the hand was followed to: the other end of the position spring (m).
fn followed(setup: &Setup, frame: &Frame) -> [f64; 2] {
    let [x, y] = setup.world(frame.pose, setup.holding_point.unwrap_or_default());
    let [fx, fy, _] = frame.wrench.map(|f| f / setup.stiffness_translation);
    [x + fx, y + fy]
}

/// How far a point is from the segment between two others.
fn off_segment([from, to]: [[f64; 2]; 2], point: [f64; 2]) -> f64 {
    let sub = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let (way, along) = (sub(to, from), sub(point, from));
    let part = (dot(way, along) / dot(way, way).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let off = sub(along, way.map(|x| x * part));
    dot(off, off).sqrt()
}

/// How far a point is from a triangle.
fn off_triangle([a, b, c]: [[f64; 2]; 3], point: [f64; 2]) -> f64 {
    let sides = [[a, b], [b, c], [c, a]];
    let side = |[[fx, fy], [tx, ty]]: [[f64; 2]; 2]| {
        (tx - fx) * (point[1] - fy) - (ty - fy) * (point[0] - fx)
    };
    let turns = sides.map(side);
    if turns.iter().all(|t| *t > 0.0) || turns.iter().all(|t| *t < 0.0) {
        return 0.0;
    }
    sides
        .into_iter()
        .map(|side| off_segment(side, point))
        .fold(f64::INFINITY, f64::min)
}

mod cases {
    use super::*;

    /// A step that is cut goes on to the same bits, wherever it is cut: a piece leaves plain data behind.
    pub(super) fn cut_steps_end_in_the_same_bits<R: Number>(evolution: Evolution) {
        let mut cuts = 0;
        for pieces in [1, 3, 7] {
            for scenario in scenarios(60, 8) {
                let whole = solver::<R>(&scenario.setup, evolution);
                let tight = whole.clone().with_budget(pieces);
                let hands = scenario.hands(FRAMES_PER_LEG);
                let (mut at_once, _) = whole.start(planar::<R>(hands[0]));
                let (mut in_parts, _) = tight.start(planar::<R>(hands[0]));
                while step::<R>(&tight, &mut in_parts, hands[0]).1 {}
                for &hand in &hands {
                    let (should, _) = step::<R>(&whole, &mut at_once, hand);
                    let mut slips = 0;
                    let is = loop {
                        let (frame, is_behind) = step::<R>(&tight, &mut in_parts, hand);
                        slips += frame.slips;
                        if !is_behind {
                            break frame;
                        }
                        cuts += 1;
                    };
                    let bits = |f: &Frame| (f.pose, f.state, f.contacts.clone(), f.wrench);
                    assert_eq!(bits(&is), bits(&should), "{pieces} {hand:?}: {scenario:?}");
                    assert_eq!(slips, should.slips, "{pieces} {hand:?}: {scenario:?}");
                }
            }
        }
        assert!(cuts > 1000, "{cuts}");
    }

    /// A new sample in every step: the hand's path leads straight from where it is certain to the present sample, or ends an event on the way
    /// to an earlier one; and the body catches up with a sample that stays.
    pub(super) fn new_sample_leads_straight_from_where_it_stands<R: Number>(evolution: Evolution) {
        let (mut behind, mut caught_up, mut most) = (0, 0, 0);
        for (pieces, scenario) in [1, 12].into_iter().cycle().zip(scenarios(100, 8)) {
            let setup = &scenario.setup;
            let tight = solver::<R>(setup, evolution).with_budget(pieces);
            let hands = scenario.hands(FRAMES_PER_LEG);
            let (mut state, output) = tight.start(planar::<R>(hands[0]));
            let mut before = followed(setup, &Frame::new(&tight, &state, &output));
            let mut samples = Vec::new();
            for &hand in &hands[1..] {
                let (frame, is_behind) = step::<R>(&tight, &mut state, hand);
                samples.push([hand[0], hand[1]]);
                let after = followed(setup, &frame);
                // Along an earlier path, from where that is certain to the sample.
                let way = |&to: &[f64; 2]| off_triangle([before, to, [hand[0], hand[1]]], after);
                let off = samples.iter().map(way).fold(f64::INFINITY, f64::min);
                assert!(off <= 1e-4 * setup.size(), "{off}: {frame:?}");
                if after != before {
                    let last = samples.pop();
                    samples.clear();
                    samples.extend(last);
                }
                before = after;
                if is_behind {
                    stays_outside::<R>(setup, &frame);
                    behind += 1;
                } else {
                    assert_lawful::<R>(setup, std::slice::from_ref(&frame));
                    samples.clear();
                    caught_up += 1;
                }
            }
            let (last, mut steps) = (hands[hands.len() - 1], 0);
            while step::<R>(&tight, &mut state, last).1 {
                steps += 1;
                assert!(steps < 20_000, "{scenario:?}");
            }
            most = most.max(steps);
        }
        println!("{behind} behind, {caught_up} not; {most} steps to catch up");
        assert!(behind > 300 && caught_up > 300, "{behind} {caught_up}");
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

/// A step takes no more pieces than its budget, and no piece more operations on numbers than the dearest window.
#[test]
fn no_step_takes_more_than_its_budget() {
    let mut dearest = (0.0, 0, 0);
    for evolution in Evolution::ALL {
        for scenario in scenarios(200, 8) {
            dear_piece(&scenario, evolution, &mut dearest);
        }
    }
    let (per_piece, operations, work) = dearest;
    println!("at most {per_piece:.0} operations a piece: {operations} in {work}");
    assert!(per_piece <= OPERATIONS_PER_PIECE, "{per_piece}");
}

/// The most operations on numbers of a piece: a look at whether contacts jam. A window takes 4700 with the certain end of the one before,
/// which is evaluated again.
const OPERATIONS_PER_PIECE: f64 = 7000.0;

fn dear_piece(scenario: &Scenario, evolution: Evolution, dearest: &mut (f64, u64, u32)) {
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
        let per_piece = operations as f64 / f64::from(output.work);
        if per_piece > dearest.0 {
            *dearest = (per_piece, operations, output.work);
        }
    }
}
