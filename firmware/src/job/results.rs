//! The results of a job: to bytes on the board, from bytes on the host.

use stiction_core::{Angle, Output, SiFloat, StateKind, Status};

use super::fields::{Fields, Record};
use super::{FormatError, VERSION};

/// The bytes of a frame.
pub(crate) const FRAME_BYTES: usize = 48;
const HEAD_BYTES: usize = 8;
const TOTALS_BYTES: usize = 24;
const MARK: [u8; 4] = *b"strs";
const END: [u8; 4] = *b"done";

/// One frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Instructions of the step, including its call; `u32::MAX` if there were more than can be counted.
    pub instructions: u32,
    /// Position of the body's origin (m).
    pub position: [f64; 2],
    /// Orientation of the body.
    pub angle: Angle<f64>,
    /// Slips that ended in this frame.
    pub slips: u32,
    /// The contact state.
    pub state: StateKind,
    /// What limited the answer.
    pub status: Status,
    /// The units of work that the step took.
    pub work: u32,
}

impl Frame {
    /// The frame of an answer that took this many instructions.
    pub fn new<F: SiFloat>(instructions: u32, output: &Output<F>) -> Self {
        Self {
            instructions,
            position: output.position.map(F::widen),
            angle: Angle {
                turns: output.angle.turns,
                rest: output.angle.rest.widen(),
            },
            slips: output.slips,
            state: output.state,
            status: output.status,
            work: output.work,
        }
    }

    /// The frame as bytes.
    pub fn encode(&self) -> [u8; FRAME_BYTES] {
        let [x, y] = self.position;
        let mut record = Record::new();
        record.u32(self.instructions).i32(self.angle.turns);
        record.f64(x).f64(y).f64(self.angle.rest).u32(self.slips);
        record.u8(index_of(&StateKind::ALL, self.state));
        record.u8(index_of(&Status::ALL, self.status));
        record.u8(0).u8(0).u32(self.work);
        record.bytes()
    }

    /// The frame of these bytes.
    ///
    /// # Errors
    /// The state or the status has no meaning.
    pub fn decode(bytes: &[u8; FRAME_BYTES]) -> Result<Self, FormatError> {
        let mut fields = Fields::new(bytes);
        let (instructions, turns) = (fields.u32(), fields.i32());
        let position = [fields.f64(), fields.f64()];
        let rest = fields.f64();
        let slips = fields.u32();
        let state = at_index(&StateKind::ALL, fields.u8())?;
        let status = at_index(&Status::ALL, fields.u8())?;
        let [_, _]: [u8; 2] = fields.take();
        Ok(Self {
            instructions,
            position,
            angle: Angle { turns, rest },
            slips,
            state,
            status,
            work: fields.u32(),
        })
    }
}

fn index_of<T: PartialEq>(all: &[T], wanted: T) -> u8 {
    let index = all.iter().position(|one| *one == wanted);
    index.and_then(|i| u8::try_from(i).ok()).unwrap_or(u8::MAX)
}

fn at_index<T: Copy>(all: &[T], index: u8) -> Result<T, FormatError> {
    let one = all.get(usize::from(index));
    one.copied().ok_or(FormatError::Value)
}

/// The totals of a job.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Frames.
    pub frames: u32,
    /// The largest stack of a step below its caller (bytes).
    pub stack: u32,
    /// Size of the solver with its scene (bytes).
    pub solver: u32,
    /// Size of the state (bytes).
    pub state: u32,
    /// Size of the answer of a step (bytes).
    pub output: u32,
}

impl Totals {
    /// The totals as bytes: the end of the results.
    pub fn encode(&self) -> [u8; TOTALS_BYTES] {
        let mut record = Record::new();
        record.put(END).u32(self.frames).u32(self.stack);
        record.u32(self.solver).u32(self.state).u32(self.output);
        record.bytes()
    }

    fn decode(bytes: &[u8; TOTALS_BYTES]) -> Result<Self, FormatError> {
        let mut fields = Fields::new(bytes);
        if fields.take() != END {
            return Err(FormatError::Short);
        }
        Ok(Self {
            frames: fields.u32(),
            stack: fields.u32(),
            solver: fields.u32(),
            state: fields.u32(),
            output: fields.u32(),
        })
    }
}

/// The results of a job, read from their bytes.
#[derive(Clone, Copy, Debug)]
pub struct Results<'a> {
    frames: &'a [[u8; FRAME_BYTES]],
    /// The totals of the job.
    pub totals: Totals,
}

impl<'a> Results<'a> {
    /// The bytes before the first frame.
    pub fn head() -> [u8; HEAD_BYTES] {
        Record::new().put(MARK).u8(VERSION).bytes()
    }

    /// Reads the results from all bytes.
    ///
    /// # Errors
    /// They are not results of this version, or the job did not reach its end.
    pub fn read(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let body = bytes.strip_prefix(&Self::head()).ok_or(FormatError::Mark)?;
        let (frames, end) = body.split_last_chunk().ok_or(FormatError::Short)?;
        let totals = Totals::decode(end)?;
        let (frames, rest) = frames.as_chunks();
        if !rest.is_empty() || u32::try_from(frames.len()) != Ok(totals.frames) {
            return Err(FormatError::Short);
        }
        Ok(Self { frames, totals })
    }

    /// The frames, in the order of the samples.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = Result<Frame, FormatError>> + use<'a> {
        self.frames.iter().map(Frame::decode)
    }
}
