//! Runs of the cases, checked by the judge of traces: every frame, and its consistency with the frames before it.

use stiction_core::Evolution;
use stiction_judge::{Bounds, Frame, Judge};
use stiction_tests::Number;
use stiction_tests::obstacles::cases::{Case, all};
use stiction_tests::obstacles::run::Run;

fn is_lawful<R: Number>(case: &Case, evolution: Evolution, bounds: Bounds) -> bool {
    let mut judge = Judge::new(case.among.judged::<R>(), bounds, evolution);
    let mut run = Run::<R>::start(&case.among, evolution, case.hands[0]);
    let mut broken = Vec::new();
    for (i, &hand) in case.hands.iter().enumerate() {
        if i > 0 {
            run.step(hand);
        }
        let frame = Frame {
            t: i as f64,
            ..run.frame.clone()
        };
        let findings = judge.next(frame).into_iter();
        broken.extend(findings.filter(|f| !f.holds()).map(|finding| (i, finding)));
    }
    if let Some(first) = broken.first() {
        println!("{}, {}, {evolution:?}: {first:?}", case.name, R::NAME);
    }
    broken.is_empty()
}

#[test]
fn cases_are_lawful() {
    let cases = all().into_iter();
    let mut unlawful = 0;
    for case in cases.filter(|case| !case.refused) {
        for evolution in [Evolution::Path, Evolution::Frame] {
            unlawful += usize::from(!is_lawful::<f64>(&case, evolution, Bounds::DOUBLE));
            unlawful += usize::from(!is_lawful::<f32>(&case, evolution, Bounds::SINGLE));
        }
    }
    assert_eq!(unlawful, 0);
}
