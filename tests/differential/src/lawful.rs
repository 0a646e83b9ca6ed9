//! Frames before the judge.

use crate::case::Case;
use crate::subject::Solver;
use stiction_judge::{Evolution, Finding, Frame, Judge};
use stiction_tests::obstacles::Among;

/// A judge of a run of a solver, frame by frame.
pub(crate) struct Lawful {
    judge: Judge,
}

impl Lawful {
    pub(crate) fn new(case: &Case, solver: Solver) -> Self {
        Self::in_scene(&case.among, solver)
    }

    /// A judge of a run in another scene.
    pub(crate) fn in_scene(among: &Among, solver: Solver) -> Self {
        let scene = solver.digits.judged(among);
        let evolution = match solver.name.ends_with("-frame") {
            true => Evolution::Frame,
            false => Evolution::Path,
        };
        Self {
            judge: Judge::new(scene, solver.digits.bounds(), evolution),
        }
    }

    /// The laws that a frame breaks by itself.
    pub(crate) fn alone(&self, frame: &Frame) -> Vec<Finding> {
        broken(self.judge.alone(frame))
    }

    /// The laws that the next frame of the run breaks.
    pub(crate) fn next(&mut self, frame: &Frame) -> Vec<Finding> {
        broken(self.judge.next(frame.clone()))
    }
}

fn broken(findings: Vec<Finding>) -> Vec<Finding> {
    findings
        .into_iter()
        .filter(|finding| !finding.holds())
        .collect()
}

/// `lawful`, or the worst of the laws that are broken.
pub(crate) fn verdict(findings: &[Finding]) -> String {
    let worst = findings
        .iter()
        .max_by(|a, b| a.severity().total_cmp(&b.severity()));
    worst.map_or("lawful".to_owned(), |f| {
        format!("{} ({:.0e} x)", f.law, f.severity())
    })
}
