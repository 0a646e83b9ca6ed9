//! The tangent is the derivative of the steps themselves: central differences of the pose and of the wrench by the hand.

use std::collections::BTreeMap;

use stiction_core::{Evolution, Status, Tangent};
use stiction_tests::random::{Scenario, scenarios};
use stiction_tests::run::Frame;
use stiction_tests::{Run, times};

/// A displacement of the hand, in body sizes and rad: its third power and the rounding of a pose are below 10⁻¹⁰ of it.
const LITTLE: f64 = 1e-5;
/// What differences of poses leave, of the square of an entry, or of 1; of a slide, whose difference is one-sided, also what the curvature adds.
const ERROR: f64 = 1e-4;
const ERROR_OF_SLIDE: f64 = 1e-3;

fn number_of_scenes() -> usize {
    times(40, 400)
}

/// x, y of the holding point and angle of the body, lengths in body sizes; then what the hand feels, in k_h L and k_h L².
fn felt(frame: &Frame, scenario: &Scenario) -> [[f64; 3]; 2] {
    let (setup, size) = (&scenario.setup, scenario.setup.size());
    let point = setup.holding_point.expect("a grip");
    let [x, y] = setup.world(frame.pose, point);
    let [force_x, force_y, moment] = frame.wrench;
    let force = setup.stiffness_translation * size;
    [
        [x / size, y / size, frame.pose[2]],
        [-force_x / force, -force_y / force, -moment / (force * size)],
    ]
}

/// The tables of a tangent in the same units.
fn tables(tangent: &Tangent<f64>, scenario: &Scenario) -> [[[f64; 3]; 3]; 2] {
    let (setup, size) = (&scenario.setup, scenario.setup.size());
    let lengths = [size, size, 1.0];
    let force = setup.stiffness_translation * size;
    let wrenches = [force, force, force * size];
    let scaled = |table: &[[f64; 3]; 3], rows: [f64; 3]| {
        std::array::from_fn(|row| {
            std::array::from_fn(|column| table[row][column] * lengths[column] / rows[row])
        })
    };
    [
        scaled(&tangent.compliance, lengths),
        scaled(&tangent.stiffness, wrenches),
    ]
}

/// What a step by `LITTLE` along an axis of the hand leads to; none if anything happens.
fn moved(run: &Run<f64>, axis: usize, sense: f64, size: f64) -> Option<Frame> {
    let mut other = Run::<f64> {
        solver: run.solver.clone(),
        state: run.state.clone(),
        frame: run.frame.clone(),
    };
    let mut hand = run.frame.hand;
    hand[axis] += sense * LITTLE * [size, size, 1.0][axis];
    let frame = other.step(hand).clone();
    let sliding = |frame: &Frame| frame.contacts.iter().map(|c| c.sliding).collect::<Vec<_>>();
    let is_same = frame.events.is_empty()
        && frame.status == Status::Ok
        && sliding(&frame) == sliding(&run.frame);
    is_same.then_some(frame)
}

fn slides(frame: &Frame) -> bool {
    frame.contacts.iter().any(|c| c.sliding != 0)
}

/// How far the tables are from the differences along an axis, as a part of what is allowed. Of contacts that slide the tangent holds in the direction of the slide.
fn error(run: &Run<f64>, scenario: &Scenario, axis: usize) -> Option<f64> {
    let tangent = run.solver.tangent(&run.state)?;
    let tables = tables(&tangent, scenario);
    let size = scenario.setup.size();
    let [ahead, back] = [1.0, -1.0].map(|sense| {
        let frame = moved(run, axis, sense, size)?;
        Some(felt(&frame, scenario))
    });
    let off = |one: &[[f64; 3]; 2], other: &[[f64; 3]; 2], way: f64| {
        let mut most = 0.0_f64;
        for kind in 0..2 {
            for row in 0..3 {
                let entry = tables[kind][row][axis];
                let difference = (one[kind][row] - other[kind][row]) / way;
                most = most.max((difference - entry).abs() / entry.abs().max(1.0).powi(2));
            }
        }
        most
    };
    if slides(&run.frame) {
        let here = felt(&run.frame, scenario);
        let sides = [(ahead, LITTLE), (back, -LITTLE)];
        let all = sides
            .into_iter()
            .filter_map(|(side, way)| Some(off(&side?, &here, way)));
        all.reduce(f64::min).map(|least| least / ERROR_OF_SLIDE)
    } else {
        Some(off(&ahead?, &back?, 2.0 * LITTLE) / ERROR)
    }
}

#[test]
fn tangent_is_the_derivative_of_the_steps() {
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let mut wrong = Vec::new();
    for (number, scenario) in scenarios(number_of_scenes(), 3).enumerate() {
        let hands = scenario.hands(30);
        let mut run = Run::<f64>::start(&scenario.setup, Evolution::Path, hands[0]);
        for (i, &hand) in hands.iter().enumerate() {
            run.step(hand);
            if run.frame.status != Status::Ok {
                continue;
            }
            let how = if slides(&run.frame) { ", slides" } else { "" };
            let kind = format!("{}{how}", run.frame.state.name());
            for axis in 0..3 {
                let Some(error) = error(&run, &scenario, axis) else {
                    continue;
                };
                *seen.entry(kind.clone()).or_default() += 1;
                if error > 1.0 {
                    wrong.push((number, i, axis, kind.clone(), error));
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {seen:?}: {:?}",
        wrong.len(),
        wrong.first()
    );
    for kind in [
        "non-contact",
        "single-vertex",
        "single-vertex, slides",
        "edge",
        "two-vertex",
        "corner",
        "locked",
    ] {
        assert!(seen.contains_key(kind), "{kind}: {seen:?}");
    }
}
