//! The solver on number types built from functions of other crates, in the named scenes and in random ones: every number
//! is finite and nothing panics; the other guarantees differ.
//!
//! | type | what holds |
//! |---|---|
//! | `LibmSingle` | every law, within the bounds of `f32` |
//! | `CordicFixed` | every law within ten times the bounds of `Fixed`, gaps within the bounds of `Fixed`; in random scenes, one frame in a thousand may violate a law |
//! | `MicromathSingle` | if the scene is not refused, the geometry to 2e-3 L; forces do not balance |

use stiction_core::{CordicFixed, Evolution, LibmSingle, MicromathSingle};
use stiction_tests::laws::{assert_lawful, judge};
use stiction_tests::random::scenarios;
use stiction_tests::run::{Frame, run};
use stiction_tests::{Number, Scenario, Setup, scenes, times};

fn named() -> impl Iterator<Item = Scenario> {
    scenes::all().into_iter().map(|(_, scenario)| scenario)
}

fn random() -> impl Iterator<Item = Scenario> {
    scenarios(times(20, 300), 4)
}

fn is_accepted<R: Number>(scenario: &Scenario) -> bool {
    scenario.setup.scene::<R>().is_ok()
}

/// Examines the frames of every scenario in both evolutions.
fn each<R: Number>(
    scenarios: impl Iterator<Item = Scenario>,
    mut look: impl FnMut(&Setup, &[Frame]),
) {
    for scenario in scenarios {
        for evolution in Evolution::ALL {
            let frames = run::<R>(&scenario.setup, evolution, &scenario.hands(40));
            look(&scenario.setup, &frames);
        }
    }
}

#[test]
fn libm_carries_every_law() {
    each::<LibmSingle>(named().chain(random()), assert_lawful::<LibmSingle>);
}

#[test]
fn cordic_carries_every_law_of_the_named_scenes() {
    each::<CordicFixed>(named(), assert_lawful::<CordicFixed>);
}

#[test]
fn cordic_carries_the_laws_of_most_random_scenes() {
    let (mut frames, mut broken) = (0, 0);
    each::<CordicFixed>(random(), |setup, run| {
        for frame in run {
            let findings = judge::<CordicFixed>(setup, frame);
            assert!(findings.iter().all(|f| f.residual.is_finite()), "{frame:?}");
            frames += 1;
            broken += usize::from(!findings.iter().all(|f| f.holds()));
        }
    });
    assert!(1000 * broken <= frames, "{broken} of {frames}");
}

#[test]
fn micromath_carries_the_geometry() {
    let all: Vec<_> = named().chain(random()).collect();
    let accepted = || {
        all.iter()
            .filter(|s| is_accepted::<MicromathSingle>(s))
            .cloned()
    };
    assert!(2 * accepted().count() > all.len());
    each::<MicromathSingle>(accepted(), assert_lawful::<MicromathSingle>);
}
