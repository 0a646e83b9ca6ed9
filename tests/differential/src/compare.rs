//! Two solvers on one family: which frames are equal.

use crate::case::Case;
use crate::differences::Difference;
use crate::families::Family;
use crate::subject::Solver;
use crate::tally::{Spread, Tally};
use std::fmt;
use std::ops::Range;
use stiction_judge::{Contact, Frame, State, Status};

/// What two solvers did on a family.
#[derive(Clone, Debug, Default)]
pub struct Pair {
    runs: u64,
    /// Runs all of whose frames are equal.
    whole: u64,
    frames: u64,
    /// Frames equal in state, contacts and pose; those equal in the pose; those of the equal ones with the
    /// same signs, reactions and events; 0 if one of the two does not report these.
    equal: u64,
    poses: u64,
    signs: u64,
    reactions: u64,
    events: u64,
    slips: [u64; 2],
    statuses: [Tally; 2],
    /// Distances of the poses (L, rad) in the frames in which the body touches in either run.
    apart: Spread,
    /// Runs that one of the two did not finish.
    pub missing: Vec<String>,
    /// For every run that differs the first such frame.
    pub differences: Vec<Difference>,
}

/// Runs both over the seeds of a family.
pub fn compare(family: &Family, [a, b]: [Solver; 2], seeds: Range<u64>) -> Pair {
    let mut pair = Pair::default();
    for seed in seeds {
        let Some(case) = (family.case)(seed) else {
            break;
        };
        match (a.run(&case), b.run(&case)) {
            (Ok(one), Ok(other)) => pair.add(&case, seed, [(a, &one), (b, &other)]),
            (one, other) => {
                let words = |run: Result<_, String>| run.err().unwrap_or("ran".to_owned());
                let (one, other) = (words(one), words(other));
                let line = format!("{seed}: {}: {one}; {}: {other}", a.name, b.name);
                pair.missing.push(line);
            }
        }
    }
    pair.differences
        .sort_by_key(|difference| (difference.frame, difference.seed));
    pair
}

impl Pair {
    fn add(&mut self, case: &Case, seed: u64, runs: [(Solver, &[Frame]); 2]) {
        let [(a, one), (b, other)] = runs;
        let bound = a.digits.equal().max(b.digits.equal());
        let near = 1e-5 * case.among.setup.size();
        let unit = case.among.setup.stiffness_translation * case.among.setup.size();
        let mut first = None;
        for (i, frames) in one.iter().zip(other).enumerate() {
            let (x, y) = frames;
            let apart = case.apart(x.pose, y.pose);
            let pose = apart <= bound;
            let equal = pose && x.state == y.state && touch_alike(x, y, near);
            self.poses += u64::from(pose);
            self.equal += u64::from(equal);
            self.signs += u64::from(equal && signs(x) == signs(y));
            self.reactions += u64::from(equal && unbalance(x, y) <= 2.0 * bound * unit);
            self.events += u64::from(equal && x.events == y.events);
            if x.state != State::NonContact || y.state != State::NonContact {
                self.apart.add(apart);
            }
            if !equal && first.is_none() {
                first = Some(i);
            }
        }
        self.runs += 1;
        self.frames += one.len() as u64;
        self.whole += u64::from(first.is_none());
        for (k, frames) in [one, other].into_iter().enumerate() {
            self.slips[k] += slips(frames);
            for frame in frames.iter().filter(|frame| frame.status != Status::Ok) {
                self.statuses[k].add(frame.status.name());
            }
        }
        if let Some(frame) = first {
            self.differences
                .push(Difference::new(case, (seed, frame), runs));
        }
    }
}

/// Whether both have the same contacts: of the same features, or, where sides of obstacles adjoin, at the same place and with the same normal,
/// to within a length.
fn touch_alike(a: &Frame, b: &Frame, near: f64) -> bool {
    let is_in =
        |one: &Contact, all: &Frame| all.contacts.iter().any(|other| alike(one, other, near));
    a.contacts.len() == b.contacts.len()
        && a.contacts.iter().all(|contact| is_in(contact, b))
        && b.contacts.iter().all(|contact| is_in(contact, a))
}

fn alike(one: &Contact, other: &Contact, near: f64) -> bool {
    let apart = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let along = one.direction.zip(other.direction);
    one.touch == other.touch
        || along.is_some_and(|(n, m)| apart(n, m) <= 1e-5) && apart(one.point, other.point) <= near
}

/// The contacts that slide, and in which directions.
fn signs(frame: &Frame) -> Vec<i8> {
    let mut signs: Vec<i8> = frame
        .contacts
        .iter()
        .map(|c| c.sliding.unwrap_or(0))
        .collect();
    signs.sort_unstable();
    signs
}

/// The largest difference of a contact's N or T (N); contacts that only one has count nothing.
fn unbalance(a: &Frame, b: &Frame) -> f64 {
    let mut most = 0.0_f64;
    for one in &a.contacts {
        for other in b.contacts.iter().filter(|other| other.touch == one.touch) {
            let off = (one.normal - other.normal).abs();
            most = most.max(off).max((one.friction - other.friction).abs());
        }
    }
    most
}

/// The slips of a run.
pub(crate) fn slips(frames: &[Frame]) -> u64 {
    frames.iter().map(|frame| u64::from(frame.slips)).sum()
}

impl fmt::Display for Pair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = |n: u64| format!("{:.3} %", 100.0 * n as f64 / self.frames.max(1) as f64);
        let [a, b] = self.slips;
        writeln!(
            f,
            "runs {}, whole {}, frames {}",
            self.runs, self.whole, self.frames
        )?;
        writeln!(
            f,
            "equal in state, contacts, pose: {} ({})",
            part(self.equal),
            self.equal
        )?;
        let [poses, signs] = [self.poses, self.signs].map(part);
        let [reactions, events] = [self.reactions, self.events].map(part);
        writeln!(
            f,
            "pose alone {poses}; all three and signs {signs}, reactions {reactions}, events {events}"
        )?;
        writeln!(
            f,
            "slips {a} / {b}; pose 50 / 90 / 99 / 99.9 / 100 %: {}",
            self.apart
        )?;
        let [a, b] = &self.statuses;
        write!(f, "statuses {a} / {b}; not run: {}", self.missing.len())
    }
}
