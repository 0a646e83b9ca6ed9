//! The instruction bench: runs a job through the solver, frame by frame. It measures the instructions of every step and the stack of the
//! whole job, with the few functions that a board must provide for that.
//!
//! A job consists of messages to a board (FRAME 4): a scene, the mode, of which the evolution counts, and the samples of the hand, the first
//! of which is where the solver starts. The results are messages from a board (FRAME 5): for every sample a pose and its events. The clock
//! in their heads is not one of time: in that of a pose it is the number of instructions of the step, `u32::MAX` if there were more than can
//! be counted, and in that of the events the pieces of work.

use core::mem::size_of;
use heapless::Vec;
use stiction_core::{Evolution, Hand, Output, Parameter, Real, Scene, SceneError, Solver, State};
use stiction_wire::{Command, Decoder, EventSet, Events, Frame, List, Pose, Report, wire_bytes};

use crate::obstacles::{NOWHERE, StoredObstacles};

/// The longest message of a job (bytes): a scene of 4 vertices and 17 obstacles of 4 corners has 891.
const LONGEST: usize = 1024;
/// So much of a job is read at a time (bytes).
const CHUNK: usize = 512;
/// So much of the results is written at a time (bytes), and the most that a frame adds: a pose, and 16 events.
const WRITTEN: usize = 1024;
const ADDED: usize = wire_bytes(20) + wire_bytes(9 + 16);

/// The files of a job.
pub trait Files {
    /// Fills `bytes` with the next bytes of the job, as many as there are. Returns their number: 0 at the end.
    ///
    /// # Errors
    /// They cannot be read.
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, FileError>;
    /// Appends to the results.
    ///
    /// # Errors
    /// They cannot be written.
    fn write(&mut self, bytes: &[u8]) -> Result<(), FileError>;
}

/// A file that could not be read or written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileError;

/// What a board measures.
pub trait Instruments {
    /// Does some work and counts its instructions; `u32::MAX` if there are more than can be counted.
    fn count<T>(&mut self, work: impl FnOnce() -> T) -> (u32, T);
    /// From now on, watches how deep the stack grows below the caller.
    fn watch_stack(&mut self);
    /// The depth that it reached (bytes).
    fn deepest_stack(&mut self) -> u32;
}

/// The totals of a job.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// The largest stack of a step below its caller (bytes).
    pub stack: u32,
    /// Size of the solver with its scene (bytes).
    pub solver: u32,
    /// Size of the state (bytes).
    pub state: u32,
}

/// Why a job was not done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The job cannot be read, or the results cannot be written.
    File,
    /// The bytes are not messages, or not those of a job.
    Format,
    /// The numbers do not make a scene, or this program has no room for it.
    Scene(Parameter),
}

impl From<FileError> for Failure {
    fn from(_: FileError) -> Self {
        Self::File
    }
}

impl From<SceneError<f32>> for Failure {
    fn from(error: SceneError<f32>) -> Self {
        Self::Scene(error.parameter)
    }
}

/// Does the job with the number type R in a solver of V vertices and S surfaces, in a model, with a budget for each step. An evolution that
/// is given here, where the compiler knows it, replaces that of the job.
///
/// # Errors
/// See [`Failure`]; the scene of the job may need something that the model lacks.
#[inline(always)]
pub fn run<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>(
    evolution: Option<Evolution>,
    budget: u32,
    files: &mut impl Files,
    instruments: &mut impl Instruments,
) -> Result<Totals, Failure> {
    let mut job = Job::new(files);
    let scene = job.next(|command| scene::<R, V, S, C>(&command))?;
    let scene = scene.unwrap_or(Err(Failure::Format))?;
    let mode = job.next(|command| {
        let Command::Mode(mode) = command else {
            return Err(Failure::Format);
        };
        Ok(mode)
    })?;
    let mode = mode.unwrap_or(Err(Failure::Format))?;
    let evolution = evolution.unwrap_or(mode.evolution);
    let mut ride = Ride {
        solver: Solver::new(scene, evolution).with_budget(budget),
        state: None,
    };
    instruments.watch_stack();
    while let Some(hand) = job.hand()? {
        let (instructions, output) = ride.frame(hand, instruments);
        job.report(instructions, &output)?;
    }
    job.flush()?;
    let bytes = |size: usize| u32::try_from(size).unwrap_or(u32::MAX);
    Ok(Totals {
        stack: instruments.deepest_stack(),
        solver: bytes(size_of::<Solver<R, V, S, C>>()),
        state: bytes(size_of::<State<R>>()),
    })
}

fn scene<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>(
    command: &Command<'_>,
) -> Result<Scene<R, V, S, C>, Failure> {
    let Command::Scene(scene) = command else {
        return Err(Failure::Format);
    };
    let (mut vertices, mut surfaces) = ([[0.0; 2]; V], [NOWHERE; S]);
    Ok(StoredObstacles::<C>::with_received(
        scene,
        &mut vertices,
        &mut surfaces,
        |description| Scene::new(description),
    )??)
}

struct Job<'f, F> {
    files: &'f mut F,
    decoder: Decoder<LONGEST>,
    read: [u8; CHUNK],
    /// The part of `read` that is still to be decoded.
    begin: usize,
    end: usize,
    /// Samples so far; a sequence number of a report.
    samples: u8,
    results: Vec<u8, WRITTEN>,
}

impl<'f, F: Files> Job<'f, F> {
    const fn new(files: &'f mut F) -> Self {
        Self {
            files,
            decoder: Decoder::new(),
            read: [0; CHUNK],
            begin: 0,
            end: 0,
            samples: 0,
            results: Vec::new(),
        }
    }

    /// The next byte; `None` at the end.
    fn byte(&mut self) -> Result<Option<u8>, Failure> {
        if self.begin == self.end {
            self.end = self.files.read(&mut self.read)?;
            self.begin = 0;
        }
        let part = self.read.get(self.begin..self.end).unwrap_or_default();
        let byte = part.first().copied();
        self.begin += usize::from(byte.is_some());
        Ok(byte)
    }

    /// What `take` makes of the next message; `None` at the end.
    fn next<T>(&mut self, take: impl FnOnce(Command<'_>) -> T) -> Result<Option<T>, Failure> {
        while let Some(byte) = self.byte()? {
            if let Some(received) = self.decoder.push::<Command<'_>>(byte) {
                let frame = received.map_err(|_| Failure::Format)?;
                return Ok(Some(take(frame.message)));
            }
        }
        Ok(None)
    }

    /// The next sample of the hand; `None` at the end.
    fn hand(&mut self) -> Result<Option<Hand<f32>>, Failure> {
        let hand = self.next(|command| {
            let Command::Hand(hand) = command else {
                return Err(Failure::Format);
            };
            Ok(hand)
        })?;
        hand.transpose()
    }

    fn report(&mut self, instructions: u32, output: &Output<f32>) -> Result<(), Failure> {
        let events = output.events();
        let pose = Pose::new(output, EventSet::of(events), self.samples);
        self.add(instructions, Report::Pose(pose))?;
        let events = Events {
            slips: output.slips,
            longest_slip: output.longest_slip,
            list: List::from(events),
        };
        self.add(output.work, Report::Events(events))?;
        self.samples = self.samples.wrapping_add(1);
        if self.results.len() + ADDED > WRITTEN {
            self.flush()?;
        }
        Ok(())
    }

    fn add(&mut self, time: u32, message: Report<'_>) -> Result<(), Failure> {
        let frame = Frame {
            sequence: self.samples,
            time,
            message,
        };
        let mut bytes = [0; ADDED];
        let bytes = frame.encode(&mut bytes).ok_or(Failure::File)?;
        let added = self.results.extend_from_slice(bytes);
        added.map_err(|_| Failure::File)
    }

    fn flush(&mut self) -> Result<(), Failure> {
        self.files.write(&self.results)?;
        self.results.clear();
        Ok(())
    }
}

/// A run of the solver; it has no state before the first sample.
struct Ride<R: Real, const V: usize, const S: usize, const C: usize> {
    solver: Solver<R, V, S, C>,
    state: Option<State<R>>,
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Ride<R, V, S, C> {
    /// One frame. Inlined, so that the stack is measured from the caller.
    #[inline(always)]
    fn frame(&mut self, hand: Hand<f32>, instruments: &mut impl Instruments) -> (u32, Output<f32>) {
        let solver = &self.solver;
        match &mut self.state {
            Some(state) => instruments.count(|| step(solver, state, hand)),
            None => {
                let (instructions, (state, output)) = instruments.count(|| start(solver, hand));
                self.state = Some(state);
                (instructions, output)
            }
        }
    }
}

/// [`Solver::start`] as a call of its own, so that nothing else is counted with it.
#[inline(never)]
fn start<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>(
    solver: &Solver<R, V, S, C>,
    hand: Hand<f32>,
) -> (State<R>, Output<f32>) {
    solver.start(hand)
}

/// [`Solver::step`], likewise.
#[inline(never)]
fn step<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>(
    solver: &Solver<R, V, S, C>,
    state: &mut State<R>,
    hand: Hand<f32>,
) -> Output<f32> {
    solver.step(state, hand)
}
