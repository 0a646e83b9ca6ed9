//! Frames before the judge.

use crate::bear::borne;
use crate::case::Case;
use crate::subject::Solver;
use stiction_judge::{Evolution, Finding, Frame, Judge};
use stiction_tests::obstacles::Among;

/// A judge of a run of a solver, frame by frame.
pub(crate) struct Lawful<'a> {
    case: &'a Case,
    solver: Solver,
    judge: Judge,
}

impl<'a> Lawful<'a> {
    pub(crate) fn new(case: &'a Case, solver: Solver) -> Self {
        Self::in_scene(case, &case.among, solver)
    }

    /// A judge of a run in another scene.
    pub(crate) fn in_scene(case: &'a Case, among: &Among, solver: Solver) -> Self {
        let scene = solver.digits.judged(among);
        let evolution = match solver.name.ends_with("-frame") {
            true => Evolution::Frame,
            false => Evolution::Path,
        };
        Self {
            case,
            solver,
            judge: Judge::new(scene, solver.digits.bounds(), evolution),
        }
    }

    fn seen(&self, frame: &Frame) -> Frame {
        if self.solver.tells_reactions {
            return frame.clone();
        }
        borne(self.case, frame.clone()).0
    }

    /// The laws that a frame breaks by itself.
    pub(crate) fn alone(&self, frame: &Frame) -> Vec<Finding> {
        broken(self.judge.alone(&self.seen(frame)))
    }

    /// The laws that the next frame of the run breaks; of a solver without events only those of a single frame.
    pub(crate) fn next(&mut self, frame: &Frame) -> Vec<Finding> {
        if !self.solver.tells_events {
            return self.alone(frame);
        }
        let seen = self.seen(frame);
        broken(self.judge.next(seen))
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
