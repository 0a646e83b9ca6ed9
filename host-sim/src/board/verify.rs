//! Runs the host's solver in parallel with the board's, on the same samples, and compares every bit of every answer.

use std::fmt;

use stiction_core::{Contacts, Fixed, Hand, Output, Real, Wrench};
use stiction_scene::{HostSolver, InputError, SceneFile};
use stiction_wire::{EventSet, NumberType};

use super::message::About;
use super::steps::Step;
use stiction_live::simulate::Running;

/// The result of the host's solver for a sample.
#[derive(Clone, Debug)]
pub(super) struct Expected {
    output: Output<f32>,
    wrench: Wrench<f32>,
    contacts: Contacts<f32>,
    has_budget: bool,
}

impl Expected {
    /// The part of the hand's displacement that is not yet followed, if a step has a budget.
    pub(super) fn behind(&self) -> Option<f64> {
        self.has_budget.then(|| self.output.behind.into())
    }
}

/// The host's solver, with the number type and the model of a board.
pub(super) trait Twin: Send {
    fn step(&mut self, hand: Hand<f32>) -> Expected;
}

impl<R: Real<Si = f32> + Send> Twin for Running<R>
where
    HostSolver<R>: Send,
{
    fn step(&mut self, hand: Hand<f32>) -> Expected {
        let (solver, state, output) = Self::step(self, hand);
        Expected {
            output,
            wrench: solver.wrench(state),
            contacts: solver.contacts(state),
            has_budget: solver.budget() < u32::MAX,
        }
    }
}

/// The twin of a board, before its first sample: with its evolution and its budget.
pub(super) fn twin(about: &About, scene: &SceneFile) -> Result<Box<dyn Twin>, InputError> {
    match about.number {
        NumberType::F32 => host::<f32>(about, scene),
        NumberType::Fixed => host::<Fixed>(about, scene),
    }
}

fn host<R: Real<Si = f32> + Send + 'static>(
    about: &About,
    scene: &SceneFile,
) -> Result<Box<dyn Twin>, InputError>
where
    HostSolver<R>: Send,
{
    let running = Running::<R>::of(scene, about.mode.evolution, about.budget)?;
    Ok(Box::new(running))
}

fn same<T: PartialEq + fmt::Debug>(what: &str, board: T, host: T) -> Result<(), String> {
    if board == host {
        return Ok(());
    }
    Err(format!("{what}: board {board:?}, host {host:?}"))
}

fn same_bits(what: &str, board: f32, host: f32) -> Result<(), String> {
    if board.to_bits() == host.to_bits() {
        return Ok(());
    }
    let shown = |value: f32| format!("{value:?} ({:#010x})", value.to_bits());
    Err(format!(
        "{what}: board {}, host {}",
        shown(board),
        shown(host)
    ))
}

/// Compares a whole step with the expected one: fails with the first values that are not equal. `before`: the events of steps whose poses did not arrive since the last one that
/// did; the board adds them to this one if it did not send these poses.
pub(super) fn compare(step: &Step, expected: &Expected, before: EventSet) -> Result<(), String> {
    let (pose, output) = (&step.pose, &expected.output);
    let ([x, y], [host_x, host_y]) = (pose.position, output.position);
    same_bits("pose x", x, host_x)?;
    same_bits("pose y", y, host_y)?;
    same_bits("pose theta", pose.rest, output.angle.rest)?;
    same_bits("depth", pose.depth, output.depth)?;
    same(
        "turns modulo 8",
        i32::from(pose.turns),
        output.angle.turns & 7,
    )?;
    same("state", pose.state.name(), output.state.name())?;
    same("status", pose.status.name(), output.status.name())?;
    same("held", pose.held, output.held)?;
    let happened = EventSet::of(output.events());
    if pose.events != happened.union(before) {
        same("events of the pose", pose.events, happened)?;
    }
    if before == EventSet::default() {
        compare_events(step, output)?;
    }
    compare_forces(step, expected)
}

fn compare_events(step: &Step, output: &Output<f32>) -> Result<(), String> {
    let reported = step.events.clone().unwrap_or_default();
    same("slips", reported.slips, output.slips)?;
    same_bits("longest slip", reported.longest_slip, output.longest_slip)?;
    let names = |list: &[stiction_core::Event]| -> Vec<_> {
        list.iter().map(|event| event.name()).collect()
    };
    same("events", names(&reported.list), names(output.events()))
}

fn compare_forces(step: &Step, expected: &Expected) -> Result<(), String> {
    let forces = match &step.forces {
        Some(forces) => forces,
        None if step.is_whole => return Ok(()),
        None => return Err("the forces did not come".to_owned()),
    };
    let ([x, y], [host_x, host_y]) = (forces.wrench.force, expected.wrench.force);
    same_bits("wrench x", x, host_x)?;
    same_bits("wrench y", y, host_y)?;
    same_bits(
        "wrench moment",
        forces.wrench.moment,
        expected.wrench.moment,
    )?;
    same("turns", forces.turns, expected.output.angle.turns)?;
    same("contacts", forces.contacts.len(), expected.contacts.len())?;
    for (i, (board, host)) in forces
        .contacts
        .iter()
        .zip(expected.contacts.iter())
        .enumerate()
    {
        same(
            &format!("what touches what in contact {i}"),
            board.touch,
            host.touch,
        )?;
        let ([n_x, n_y], [host_x, host_y]) = (board.direction, host.direction);
        for (what, board, host) in [
            ("normal x", n_x, host_x),
            ("normal y", n_y, host_y),
            ("point x", board.point[0], host.point[0]),
            ("point y", board.point[1], host.point[1]),
            ("N", board.normal, host.normal),
            ("T", board.friction, host.friction),
        ] {
            same_bits(&format!("{what} of contact {i}"), board, host)?;
        }
        same(
            &format!("sliding of contact {i}"),
            board.sliding,
            host.sliding,
        )?;
    }
    Ok(())
}

/// The number of equal frames, and the first one that differs.
#[derive(Clone, Debug, Default)]
pub(super) struct Verdict {
    frames: u64,
    equal: u64,
    lost: u64,
    first: Option<(u64, f64, String)>,
    missed: EventSet,
}

impl Verdict {
    /// Adds the answer to a sample (index, time).
    pub(super) fn add(&mut self, index: u64, t: f64, step: &Step, expected: &Expected) {
        self.frames += 1;
        let missed = std::mem::take(&mut self.missed);
        if !step.is_whole {
            self.lost += 1;
        }
        match compare(step, expected, missed) {
            Ok(()) if step.is_whole => self.equal += 1,
            Ok(()) => self.note(index, t, "a part of the answer did not come"),
            Err(difference) => self.note(index, t, &difference),
        }
    }

    pub(super) fn lose(&mut self, index: u64, t: f64, expected: &Expected) {
        self.frames += 1;
        self.lost += 1;
        self.missed = self.missed.union(EventSet::of(expected.output.events()));
        self.note(index, t, "no pose came");
    }

    fn note(&mut self, index: u64, t: f64, what: &str) {
        if self.first.as_ref().is_none_or(|(first, ..)| index < *first) {
            self.first = Some((index, t, what.to_owned()));
        }
    }

    /// Returns whether every frame is equal, and there was at least one.
    pub(super) const fn is_good(&self) -> bool {
        self.frames > 0 && self.equal == self.frames
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} frames equal", self.equal, self.frames)?;
        if self.lost > 0 {
            write!(f, ", {} lost", self.lost)?;
        }
        match &self.first {
            Some((index, t, what)) => {
                write!(f, "; first difference: frame {index} (t = {t} s), {what}")
            }
            None => Ok(()),
        }
    }
}
