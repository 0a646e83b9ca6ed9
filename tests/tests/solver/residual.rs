//! The worst residual of 1000 random scenes × 200 frames, by law, number type and evolution: no frame violates a law, and
//! none evades the laws of balance by being ambiguous.

use std::collections::BTreeMap;
use stiction_core::{Evolution, Fixed, Status, Wrench};
use stiction_tests::laws::{Finding, worst};
use stiction_tests::random::scenarios;
use stiction_tests::run::run;
use stiction_tests::{Number, judge, times};

fn survey<R: Number>(evolution: Evolution) {
    let mut laws: BTreeMap<&str, Finding> = BTreeMap::new();
    let (mut frames, mut broken, mut limited, mut ambiguous) = (0, 0, 0, 0);
    let mut first = None;
    for (i, scenario) in scenarios(times(30, 1000), 4).enumerate() {
        for (k, frame) in run::<R>(&scenario.setup, evolution, &scenario.hands(50))
            .iter()
            .enumerate()
        {
            let findings = judge::<R>(&scenario.setup, frame);
            let gravest = worst(findings.iter().copied());
            frames += 1;
            limited += usize::from(frame.status != Status::Ok);
            ambiguous += usize::from(frame.status == Status::Ambiguous);
            if !gravest.holds() {
                broken += 1;
                first.get_or_insert((i, k, gravest));
            }
            for finding in findings {
                let known = laws.entry(finding.law).or_insert(finding);
                if finding.severity() > known.severity() {
                    *known = finding;
                }
            }
        }
    }
    println!(
        "{} {evolution:?}: {frames} frames, {limited} limited, {ambiguous} ambiguous, {broken} unlawful",
        R::NAME
    );
    for finding in laws.values() {
        println!(
            "  {:<45} {:9.2e} (bound {:.0e})",
            finding.law, finding.residual, finding.bound
        );
    }
    assert_eq!(ambiguous, 0, "{} {evolution:?}", R::NAME);
    assert_eq!(
        broken,
        0,
        "{} {evolution:?}: first in scene, frame: {first:?}",
        R::NAME
    );
}

/// The force of the body on the hand is opposite to that of the hand on the body.
#[test]
fn feedback_is_the_opposite_wrench() {
    let wrench = Wrench {
        force: [1.5, -5.0],
        moment: 0.25,
    };
    let opposite = Wrench {
        force: [-1.5, 5.0],
        moment: -0.25,
    };
    assert_eq!(wrench.feedback(), opposite);
}

#[test]
fn no_frame_of_any_random_scene_violates_a_law_f64() {
    for evolution in Evolution::ALL {
        survey::<f64>(evolution);
    }
}

#[test]
fn no_frame_of_any_random_scene_violates_a_law_f32() {
    for evolution in Evolution::ALL {
        survey::<f32>(evolution);
    }
}

#[test]
fn no_frame_of_any_random_scene_violates_a_law_fixed() {
    for evolution in Evolution::ALL {
        survey::<Fixed>(evolution);
    }
}
