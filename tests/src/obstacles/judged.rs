//! A run of the solver, compared with the known values of a case.

use super::cases::{Answer, Case, Check, Known};
use super::run::Run;
use crate::number::Number;
use std::fmt;
use stiction_core::Evolution;
use stiction_judge::{Contact, Frame, Status};

/// The bound in f64 for cases with closed formulas, relative to the scale of a check.
const CLOSED: f64 = 1e-9;

/// How far a run deviates from a case.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// Largest error of a pose, in body sizes and rad.
    pub pose: f64,
    /// Largest error of a force, relative to the largest force of its frame.
    pub force: f64,
    /// The first check that fails: its frame, and a description.
    pub first_off: Option<(usize, String)>,
    /// Statuses other than `ok`, with the first frame and the number of frames of each.
    pub statuses: Vec<(Status, usize, usize)>,
}

impl Verdict {
    fn take(&mut self, frame: usize, words: impl FnOnce() -> String) {
        if self.first_off.is_none() {
            self.first_off = Some((frame, words()));
        }
    }
    fn count(&mut self, frame: usize, status: Status) {
        if status == Status::Ok {
            return;
        }
        match self.statuses.iter_mut().find(|s| s.0 == status) {
            Some(known) => known.2 += 1,
            None => self.statuses.push((status, frame, 1)),
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "pose {:8.1e}  force {:8.1e}", self.pose, self.force)?;
        for (status, first, count) in &self.statuses {
            write!(f, "  {} x{count} from frame {first}", status.name())?;
        }
        match &self.first_off {
            None => write!(f, "  right"),
            Some((frame, words)) => write!(f, "  OFF in frame {frame}: {words}"),
        }
    }
}

/// Runs a case in a number type and an evolution.
pub fn verdict<R: Number>(case: &Case, evolution: Evolution) -> Verdict {
    let mut verdict = Verdict::default();
    if case.refused {
        if case.among.scene::<R>().is_ok() {
            verdict.take(0, || "it is not refused".to_owned());
        }
        return verdict;
    }
    let mut run = Run::<R>::start(&case.among, evolution, case.hands[0]);
    let twin = case.twin.as_ref();
    let mut twin = twin.map(|twin| Run::<R>::start(twin, evolution, case.hands[0]));
    let mut slips = run.frame.slips;
    for (i, &hand) in case.hands.iter().enumerate() {
        if i > 0 {
            slips += run.step(hand).slips;
        }
        verdict.count(i, run.frame.status);
        if let Some(twin) = &mut twin {
            if i > 0 {
                twin.step(hand);
            }
            same::<R>(case, (i, &run.frame, &twin.frame), &mut verdict);
        }
        let answer = answer(&run.frame, slips);
        for check in case.checks.iter().filter(|check| check.frame == i) {
            compare::<R>(case, (check, &answer), &mut verdict);
        }
    }
    verdict
}

/// The answer that a frame gives, with the slips so far.
pub fn answer(frame: &Frame, slips: u32) -> Answer {
    let contact = |c: &Contact| (c.touch, [c.normal, c.friction]);
    Answer {
        pose: frame.pose,
        contacts: frame.contacts.iter().map(contact).collect(),
        pull: frame.wrench[1],
        slips,
        state: frame.state.name(),
    }
}

/// The bound of a number type, relative to the scale of a check.
fn bound<R: Number>(case: &Case) -> f64 {
    let exact = R::ROUNDING <= f64::ROUNDING;
    match case.tolerance {
        [wide, _] if exact && case.closed => wide.min(CLOSED),
        [wide, _] if exact => wide,
        [_, narrow] => narrow,
    }
}

fn compare<R: Number>(case: &Case, (check, answer): (&Check, &Answer), verdict: &mut Verdict) {
    let error = check.error(answer);
    if check.value.is_pose() {
        verdict.pose = verdict.pose.max(error);
    }
    if check.value.is_force() {
        verdict.force = verdict.force.max(error);
    }
    let bound = bound::<R>(case);
    if error > bound {
        verdict.take(check.frame, || {
            let got = match check.value {
                Known::Contacts(_) | Known::State(_) => {
                    let touches: Vec<_> = answer.contacts.iter().map(|c| c.0).collect();
                    format!("{} {touches:?}", answer.state)
                }
                _ => format!("{answer:?}"),
            };
            format!(
                "{:?} off by {error:.1e}, allowed {bound:.0e}: {got}",
                check.value
            )
        });
    }
}

/// Compares a run with that of the twin: pose and forces of the hand.
fn same<R: Number>(case: &Case, (i, one, other): (usize, &Frame, &Frame), verdict: &mut Verdict) {
    let size = case.among.setup.size();
    let [x, y, theta] = [0, 1, 2].map(|k| (one.pose[k] - other.pose[k]).abs());
    let pose = (x.max(y) / size).max(theta);
    let force = |f: [f64; 3]| f[0].hypot(f[1]).max(f[2].abs() / size);
    let off = force([0, 1, 2].map(|k| one.wrench[k] - other.wrench[k]));
    let unit = case.among.setup.stiffness_translation * size;
    let off = off / force(other.wrench).max(1e-3 * unit);
    verdict.pose = verdict.pose.max(pose);
    verdict.force = verdict.force.max(off);
    let bound = bound::<R>(case);
    if pose > bound || off > bound || one.slips != other.slips {
        verdict.take(i, || {
            let slips = [one.slips, other.slips];
            format!(
                "differs from the half-plane: pose by {pose:.1e}, force by {off:.1e}, slips {slips:?}"
            )
        });
    }
}
