//! True traces of the solver, in which the judge finds no fault, and the same with a fault, which it must find: faults against laws, in
//! events, and excused by a status, on all bundled scenes and on random ones, in every number type and both evolutions.

mod mutants;
mod physics;
mod refused;
mod scenes;
mod truth;

use std::collections::BTreeMap;

use mutants::{BESIDE, Of};
use stiction_judge::Judge;
use truth::{EVOLUTIONS, Number, Truth, truth};

/// Random scenes of each kind.
const RANDOM: usize = 4;

/// Kinds of mutants that two frames do not decide (see the documentation of the crate): some may pass, for the reason given.
const UNDECIDED: [&str; 12] = [
    // The other events of the frame may explain it.
    BESIDE,
    // The number of slips of two contacts, and of one that slid in the same frame.
    "slips of several",
    "1 slip counted as",
    // A fold of two contacts that slide, or of one at a corner.
    "invented Snap in sliding",
    // Whether the body had stiction.
    "slip called a slide",
    // Whether reactions bear a load that is close to their limit.
    "Jammed: ",
    // If static friction gives way so gradually that its position, and so the end of the slip, is uncertain by that amount.
    "a slip 1 % short",
    // Events exactly at the end of the frame, within rounding.
    "a slip a frame late",
    "a slip a frame early",
    // The start of a slide without friction.
    "Slide not reported",
    ": nothing reported",
    // Which of two contacts at the same place opened.
    "Tip called Lift",
];
/// The number of laws that notice a mutant: all but those of a hand that grasps, of a path, of features that touch unreported, and of what
/// is not in the scene, which have tests of their own in the test `judge`.
const LAWS: usize = 34;
/// The fraction of all mutants that may pass.
const PASSING: f64 = 0.02;

/// Every scene once, cycling through number types and evolutions.
fn traces() -> impl Iterator<Item = Truth> {
    let scenes = scenes::bundled()
        .into_iter()
        .chain(scenes::random(RANDOM))
        .chain(scenes::among(RANDOM as u64));
    scenes.enumerate().map(|(i, (name, text))| {
        let number = Number::ALL[i % 3];
        truth(&name, &text, number, EVOLUTIONS[i / 3 % 2])
    })
}

#[test]
fn true_traces_are_lawful() {
    for truth in traces() {
        let mut judge = Judge::new(truth.scene.clone(), truth.number.bounds(), truth.evolution);
        for (i, frame) in truth.frames.iter().enumerate() {
            let findings = judge.next(frame.clone());
            let broken: Vec<_> = findings.iter().filter(|finding| !finding.holds()).collect();
            assert!(broken.is_empty(), "{} frame {i}: {broken:?}", truth.name);
        }
    }
}

/// How many mutants of a kind there were, how many passed, and where.
#[derive(Debug, Default)]
struct Kind {
    made: usize,
    passed: Vec<String>,
}

#[test]
fn mutants_are_refused() {
    let mut kinds: BTreeMap<(Of, String), Kind> = BTreeMap::new();
    let mut laws: BTreeMap<&str, usize> = BTreeMap::new();
    for truth in traces() {
        for (mutant, broken) in refused::verdicts(&truth) {
            let place = format!("{} {:?} {}", truth.name, truth.number, mutant.from);
            for law in &broken {
                *laws.entry(law).or_default() += 1;
            }
            let kind = kinds.entry((mutant.of, mutant.kind)).or_default();
            kind.made += 1;
            if broken.is_empty() {
                kind.passed.push(place);
            }
        }
    }
    println!("mutants that break a law: {laws:#?}");
    assert!(laws.len() >= LAWS, "{laws:?}");
    for (of, least) in [(Of::Laws, 35), (Of::Events, 63), (Of::Statuses, 30)] {
        let all = || kinds.iter().filter(|(kind, _)| kind.0 == of);
        let made: usize = all().map(|(_, kind)| kind.made).sum();
        let passed: usize = all().map(|(_, kind)| kind.passed.len()).sum();
        println!(
            "{of:?}: {made} mutants of {} kinds, {passed} pass",
            all().count()
        );
        for (kind, found) in all().filter(|(_, kind)| !kind.passed.is_empty()) {
            println!(
                "  {}: {} of {}: {:?}",
                kind.1,
                found.passed.len(),
                found.made,
                found.passed
            );
        }
        assert!(made >= least);
        assert!((passed as f64) <= PASSING * made as f64, "{of:?}");
        for (kind, _) in all().filter(|(_, found)| !found.passed.is_empty()) {
            let may_pass = UNDECIDED.iter().any(|part| kind.1.contains(part));
            assert!(may_pass, "{} passes", kind.1);
        }
    }
}
