//! True traces with a fault: against laws, in events, and excused by a status.

mod events;
mod laws;
mod statuses;

use stiction_judge::{Frame, Scene, State, Status};

use crate::truth::Truth;

/// The category of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Of {
    Laws,
    Events,
    Statuses,
}

/// A fault in a trace.
#[derive(Clone, Debug)]
pub(crate) struct Mutant {
    pub(crate) of: Of,
    /// What was changed, and where.
    pub(crate) kind: String,
    /// The first frame that differs.
    pub(crate) from: usize,
    /// The trace from there on, as far as it is judged.
    pub(crate) frames: Vec<Frame>,
}

/// The suffix for an event that is not the only one of its frame.
pub(crate) const BESIDE: &str = " with others";

/// Frames that are judged after a fault.
const TAIL: usize = 60;
/// Positions in a trace at which a fault is introduced.
const PLACES: usize = 2;

/// All faults of a true trace.
pub(crate) fn mutants(truth: &Truth) -> Vec<Mutant> {
    let mut maker = Maker {
        truth,
        of: Of::Events,
        made: Vec::new(),
    };
    maker.events();
    maker.laws();
    maker.statuses();
    maker.made
}

struct Maker<'a> {
    truth: &'a Truth,
    /// The category of the faults that are made now.
    of: Of,
    made: Vec<Mutant>,
}

impl Maker<'_> {
    /// Some frames that satisfy a condition, spread over the trace.
    fn places(&self, is: impl Fn(&[Frame], usize) -> bool) -> Vec<usize> {
        let frames = &self.truth.frames;
        let all: Vec<usize> = (2..frames.len().saturating_sub(2))
            .filter(|&i| is(frames, i))
            .collect();
        let mut some: Vec<usize> = (0..PLACES)
            .filter_map(|k| all.get(k * all.len() / PLACES).copied())
            .collect();
        some.dedup();
        some
    }

    /// The frames from `at` on, with that frame changed.
    fn add(&mut self, kind: &str, at: usize, change: impl FnOnce(&mut Vec<Frame>)) {
        let frames = &self.truth.frames;
        let mut tail = frames[at..frames.len().min(at + TAIL)].to_vec();
        change(&mut tail);
        if tail[..] != frames[at..frames.len().min(at + TAIL)] {
            self.made.push(Mutant {
                of: self.of,
                kind: kind.to_owned(),
                from: at,
                frames: tail,
            });
        }
    }
}

/// The largest force of a frame (N).
fn largest(frame: &Frame) -> f64 {
    let forces = frame.contacts.iter().map(|c| c.normal.hypot(c.friction));
    forces.fold(frame.wrench[0].hypot(frame.wrench[1]), f64::max)
}

/// Whether nothing happens in a frame, before and after it.
fn is_quiet(frames: &[Frame], i: usize) -> bool {
    let quiet = |frame: &Frame| frame.events.is_empty() && frame.held && frame.status == Status::Ok;
    quiet(&frames[i - 1])
        && quiet(&frames[i])
        && quiet(&frames[i + 1])
        && is_still_there(&frames[i - 1], &frames[i])
}

fn is_still_there(last: &Frame, next: &Frame) -> bool {
    let touches = |frame: &Frame| frame.contacts.iter().map(|c| c.touch).collect::<Vec<_>>();
    touches(last) == touches(next)
}

fn slide(frame: &Frame) -> bool {
    frame.contacts.iter().any(|c| c.sliding != Some(0))
}

fn by_count(frame: &Frame) -> State {
    match frame.contacts.as_slice() {
        [] => State::NonContact,
        [_] => State::SingleVertex,
        [a, b] if a.touch == b.touch => State::Edge,
        [_, _] => State::TwoVertex,
        _ => State::Locked,
    }
}

pub(crate) fn size(scene: &Scene) -> f64 {
    stiction_judge::size(&scene.vertices)
}
