//! The judge's verdicts on mutants.

use stiction_judge::Judge;

use crate::mutants::{Mutant, mutants};
use crate::truth::Truth;

/// The laws that each mutant of a true trace breaks: none for one that passes.
pub(crate) fn verdicts(truth: &Truth) -> Vec<(Mutant, Vec<&'static str>)> {
    let mut all = mutants(truth);
    all.sort_by_key(|mutant| mutant.from);
    let mut judge = Judge::new(truth.scene.clone(), truth.number.bounds(), truth.evolution);
    let mut judged = 0;
    let verdict = |mutant: Mutant| {
        while judged < mutant.from {
            let _ = judge.next(truth.frames[judged].clone());
            judged += 1;
        }
        let mut judge = judge.clone();
        let findings = mutant
            .frames
            .iter()
            .flat_map(|frame| judge.next(frame.clone()));
        let mut broken: Vec<_> = findings.filter(|f| !f.holds()).map(|f| f.law).collect();
        broken.sort_unstable();
        broken.dedup();
        (mutant, broken)
    };
    all.into_iter().map(verdict).collect()
}
