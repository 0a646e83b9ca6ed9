//! Bytes as a scene, its parameters and a hand's path, with the laws checked on every frame in every number type.

use crate::case::Case;
use crate::clamp;
use crate::draw::Draw;
use stiction_core::{Contact, Fixed, Hand, Solver, State};
use stiction_tests::laws::{Bounds, Finding, judge_within, judged, law};
use stiction_tests::run::planar;
use stiction_tests::{Frame, Number};

/// # Panics
/// If a law is violated.
pub fn solver(bytes: &[u8]) {
    if let Some(case) = Case::read(Draw::new(bytes)) {
        follow::<f32>(&case);
        follow::<Fixed>(&case);
        follow::<f64>(&case);
    }
}

/// The case in these bytes as a scene file, a recorded hand path and the options of `stiction run`; `None` if there are too few bytes.
pub fn as_files(bytes: &[u8]) -> Option<(String, String, String)> {
    Case::read(Draw::new(bytes)).map(|case| case.as_files())
}

/// All frames of a case; none if its scene is refused.
fn follow<R: Number>(case: &Case) {
    let Ok(scene) = case.setup.scene::<R>() else {
        return;
    };
    let solver = Solver::new(scene, case.evolution);
    let cut = solver.clone().with_budget(0);
    let frame = |state: &State<R>, output| Frame::new(&solver, state, &output);
    let (mut state, output) = solver.start(hand::<R>(case.home));
    let mut judge = judge_within::<R>(&case.setup, case.evolution, bounds::<R>());
    let mut last = frame(&state, output);
    let mut is_clamped = clamps::<R>(case, &last);
    holds::<R>(
        case,
        judge.next(judged(0, &last)),
        (&last, &last),
        is_clamped,
    );
    for (i, to) in (1..).zip(case.hands()) {
        let (mut twin, mut pieces) = (state.clone(), state.clone());
        let output = solver.step(&mut state, hand::<R>(to));
        let next = frame(&state, output);
        let output = solver.step(&mut twin, hand::<R>(to));
        assert_eq!(next, frame(&twin, output), "the same bits when repeated");
        if case.is_cut {
            let zero = Default::default();
            while cut.step(&mut pieces, hand::<R>(to)).behind > zero {}
            assert_eq!(pieces, state, "the same bits within a budget");
        }
        is_clamped = clamps::<R>(case, &next) || (is_clamped && shared(&next, &last) > 1);
        holds::<R>(
            case,
            judge.next(judged(i, &next)),
            (&last, &next),
            is_clamped,
        );
        last = next;
    }
}

/// A hand at x, y (m), phi (rad) that holds the body or does not.
fn hand<R: Number>((pose, held): ([f64; 3], bool)) -> Hand<R::Si> {
    let hand = planar::<R>(pose);
    if held { hand } else { hand.released() }
}

/// Coarser bounds than those of `stiction check`, which are for practical scenes: these scenes are degenerate. A body may start up to 1e-5
/// of its size inside a surface. The unbalanced rest of a load counts as zero up to four of its roundings (STATICS 16).
fn bounds<R: Number>() -> Bounds {
    match R::NAME {
        "f64" => Bounds {
            residual: 1e-6,
            gap: 1.1e-5,
            far: false,
            slip: 1e-9,
            exact: 2e-6,
            // The part of a load that two contacts leave unbalanced counts as zero up to 1e-10 k_h L.
            rounding: 64.0 * Bounds::DOUBLE.rounding,
        },
        _ => Bounds {
            residual: 2e-3,
            gap: 2e-5,
            far: true,
            slip: 1e-4,
            exact: 4e-5,
            rounding: 4.0 * Bounds::SINGLE.rounding,
        },
    }
}

/// Laws about where slips begin and end, and about the events that lead from frame to frame: they are judged on less degenerate scenes.
const SLIPS: [&str; 4] = [
    law::SLIP_BEGINS,
    law::SLIP_ENDS,
    law::SLIP_LAST,
    law::SLIP_FIRST,
];

/// Whether every law holds that the frame has to obey.
fn holds<R: Number>(
    case: &Case,
    findings: Vec<Finding>,
    (last, next): (&Frame, &Frame),
    is_clamped: bool,
) {
    for finding in findings {
        let of_events = finding.law != law::SLIDE_REPORTED && law::OF_EVENTS.contains(&finding.law);
        let waived = SLIPS.contains(&finding.law) || of_events;
        assert!(
            finding.holds() || waived || is_clamped,
            "{}: {finding:?}\nbefore: {last:?}\nframe: {next:?}\ncase: {case:?}",
            R::NAME
        );
    }
}

/// The number of contacts that two frames share.
fn shared(a: &Frame, b: &Frame) -> usize {
    let [a, b] = [a, b].map(|frame| {
        let contacts = frame.contacts.iter();
        contacts.map(|c| c.touch).collect::<Vec<_>>()
    });
    a.iter().filter(|contact| b.contains(contact)).count()
}

/// Whether reactions of a frame exceed what the number type computes exactly.
fn clamps<R: Number>(case: &Case, frame: &Frame) -> bool {
    let setup = &case.setup;
    let reaction = |c: &Contact<f64>| {
        let surface = c.touch.surface().expect("there is nothing else");
        let slope = setup.surfaces[surface].friction_static;
        (c.normal, c.friction, slope)
    };
    clamp::clamps::<R>(setup, frame.contacts.iter().map(reaction))
}
