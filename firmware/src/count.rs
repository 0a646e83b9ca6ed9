//! The instruction bench: runs a job through the solver, frame by frame. It measures the instructions of every step and
//! the stack of the whole job, with the few functions that a board must provide for that.

use core::mem::size_of;
use stiction_core::{
    Evolution, Hand, Model, Output, Parameter, Real, Scene, SceneError, SiFloat, Solver, State,
    narrow_hand,
};

use crate::job::{self, FormatError, Frame, Head, Results, Totals};

/// This many frames are read and written at a time.
const BATCH: usize = 16;

/// The files of a job.
pub trait Files {
    /// Fills `bytes` with the next bytes of the job.
    ///
    /// # Errors
    /// There are not enough, or they cannot be read.
    fn read(&mut self, bytes: &mut [u8]) -> Result<(), FileError>;
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

/// Why a job was not done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The job cannot be read, or the results cannot be written.
    File,
    /// The bytes are not a job of this version, or there are more vertices or surfaces than this program has room for.
    Format(FormatError),
    /// The numbers do not make a scene.
    Scene(Parameter),
}

impl From<FileError> for Failure {
    fn from(_: FileError) -> Self {
        Self::File
    }
}

impl From<FormatError> for Failure {
    fn from(error: FormatError) -> Self {
        Self::Format(error)
    }
}

impl<F> From<SceneError<F>> for Failure {
    fn from(error: SceneError<F>) -> Self {
        Self::Scene(error.parameter)
    }
}

/// Does the job with the number type R in a solver of V vertices and S surfaces.
///
/// # Errors
/// See [`Failure`].
pub fn run<R: Real<Si: SiFloat>, const V: usize, const S: usize>(
    files: &mut impl Files,
    instruments: &mut impl Instruments,
) -> Result<(), Failure> {
    let head = head(files)?;
    let scene: Scene<R, V, S> = head.scene(|bytes| files.read(bytes).map_err(Failure::from))?;
    let solver = Solver::new(scene, head.evolution).with_budget(head.budget);
    ride(solver, head.samples, files, instruments)
}

/// The same in a solver among at most O obstacles with at most C corners together.
///
/// # Errors
/// See [`Failure`].
pub fn run_among<R, const V: usize, const S: usize, const O: usize, const C: usize>(
    files: &mut impl Files,
    instruments: &mut impl Instruments,
) -> Result<(), Failure>
where
    R: Real<Si: SiFloat>,
{
    let head = head(files)?;
    let scene =
        head.among::<R, V, S, O, C, Failure>(|bytes| files.read(bytes).map_err(Failure::from))?;
    let solver = Solver::new(scene, head.evolution).with_budget(head.budget);
    ride(solver, head.samples, files, instruments)
}

/// Does the job in a model of the solver, with an evolution that the compiler knows: that of the job is ignored.
///
/// # Errors
/// See [`Failure`]; the scene of the job may need something that the model lacks.
#[inline(always)]
pub fn run_in_model<R: Real<Si: SiFloat>, const V: usize, const S: usize, M: Model>(
    evolution: Evolution,
    files: &mut impl Files,
    instruments: &mut impl Instruments,
) -> Result<(), Failure> {
    let head = head(files)?;
    let scene: Scene<R, V, S, M> = head.scene(|bytes| files.read(bytes).map_err(Failure::from))?;
    ride(
        Solver::new(scene, evolution).with_budget(head.budget),
        head.samples,
        files,
        instruments,
    )
}

fn head(files: &mut impl Files) -> Result<Head, Failure> {
    let mut bytes = [0; job::HEAD_BYTES];
    files.read(&mut bytes)?;
    Ok(Head::decode(&bytes)?)
}

/// All samples of a job.
#[inline(always)]
fn ride<R: Real<Si: SiFloat>, const V: usize, const S: usize, M: Model>(
    solver: Solver<R, V, S, M>,
    samples: u32,
    files: &mut impl Files,
    instruments: &mut impl Instruments,
) -> Result<(), Failure> {
    let mut ride = Ride {
        solver,
        state: None,
    };
    files.write(&Results::head())?;
    instruments.watch_stack();
    let mut left = samples;
    while left > 0 {
        let mut batch = [[0; job::SAMPLE_BYTES]; BATCH];
        let mut frames = [[0; job::FRAME_BYTES]; BATCH];
        let count = BATCH.min(usize::try_from(left).unwrap_or(BATCH));
        let (batch, _) = batch.split_at_mut(count);
        files.read(batch.as_flattened_mut())?;
        for (sample, frame) in batch.iter().zip(&mut frames) {
            let hand = narrow_hand(&job::decode_sample(sample));
            *frame = ride.frame(hand, instruments).encode();
        }
        let (frames, _) = frames.split_at(count);
        files.write(frames.as_flattened())?;
        left -= u32::try_from(count).unwrap_or(left);
    }
    let bytes = |size: usize| u32::try_from(size).unwrap_or(u32::MAX);
    let totals = Totals {
        frames: samples,
        stack: instruments.deepest_stack(),
        solver: bytes(size_of::<Solver<R, V, S, M>>()),
        state: bytes(size_of::<State<R>>()),
        output: bytes(size_of::<Output<R::Si>>()),
    };
    files.write(&totals.encode())?;
    Ok(())
}

/// A run of the solver; it has no state before the first sample.
struct Ride<R: Real, const V: usize, const S: usize, M: Model> {
    solver: Solver<R, V, S, M>,
    state: Option<State<R>>,
}

impl<R: Real<Si: SiFloat>, const V: usize, const S: usize, M: Model> Ride<R, V, S, M> {
    /// One frame. Inlined, so that the stack is measured from the caller.
    #[inline(always)]
    fn frame(&mut self, hand: Hand<R::Si>, instruments: &mut impl Instruments) -> Frame {
        let solver = &self.solver;
        let (instructions, output) = match &mut self.state {
            Some(state) => instruments.count(|| step(solver, state, hand)),
            None => {
                let (instructions, (state, output)) = instruments.count(|| start(solver, hand));
                self.state = Some(state);
                (instructions, output)
            }
        };
        Frame::new(instructions, &output)
    }
}

/// [`Solver::start`] as a call of its own, so that nothing else is counted with it.
#[inline(never)]
fn start<R: Real<Si: SiFloat>, const V: usize, const S: usize, M: Model>(
    solver: &Solver<R, V, S, M>,
    hand: Hand<R::Si>,
) -> (State<R>, Output<R::Si>) {
    solver.start(hand)
}

/// [`Solver::step`], likewise.
#[inline(never)]
fn step<R: Real<Si: SiFloat>, const V: usize, const S: usize, M: Model>(
    solver: &Solver<R, V, S, M>,
    state: &mut State<R>,
    hand: Hand<R::Si>,
) -> Output<R::Si> {
    solver.step(state, hand)
}
