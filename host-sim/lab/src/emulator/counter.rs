//! The instruction bench on an emulated board: from a scene and the hand's samples, as messages to a board, to the instructions of every
//! frame and the stack, as messages from a board and printed totals; see [`stiction_firmware::count`].

use std::fs;

use stiction_core::{Evolution, Hand, narrow_hand};
use stiction_firmware::count::Totals;
use stiction_host_sim::firmware::process::EmulatorError;
use stiction_scene::{NumberType, SceneFile};
use stiction_wire::{Command, Decoder, Mode, Pose, Report, SceneCommand};

use super::image::Image;
use super::{Board, Profile};

/// A frame of a job.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// Instructions or cycles of the step, including its call; `u32::MAX` if there were more than can be counted.
    pub instructions: u32,
    /// The pose of the body.
    pub pose: Pose,
    /// Slips that ended in this frame.
    pub slips: u32,
    /// The pieces of work that the step took.
    pub work: u32,
}

/// The results of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct Counted {
    /// The frames; the first one is the start.
    pub frames: Vec<Frame>,
    /// Stack and sizes.
    pub totals: Totals,
}

impl Counted {
    /// The frames without the start.
    pub fn steps(&self) -> &[Frame] {
        self.frames.get(1..).unwrap_or_default()
    }

    /// Instructions or cycles of a step, on average; 0 without one.
    pub fn mean(&self) -> f64 {
        let steps = self.steps();
        let sum: f64 = steps.iter().map(|step| f64::from(step.instructions)).sum();
        sum / steps.len().max(1) as f64
    }

    /// Instructions or cycles of the longest step; 0 without one.
    pub fn worst(&self) -> u32 {
        let instructions = self.steps().iter().map(|step| step.instructions);
        instructions.max().unwrap_or(0)
    }

    /// From the reports of a board, and the totals that it prints.
    fn read(reports: &[u8], printed: &str) -> Result<Self, EmulatorError> {
        let unread =
            |what: &str| EmulatorError::Output(format!("the results of the board: {what}"));
        let mut decoder = Decoder::<256>::new();
        let mut frames: Vec<Frame> = Vec::new();
        for &byte in reports {
            let Some(received) = decoder.push::<Report<'_>>(byte) else {
                continue;
            };
            let received = received.map_err(|fault| unread(fault.kind.name()))?;
            if let Report::Pose(pose) = received.message {
                frames.push(Frame {
                    instructions: received.time,
                    pose,
                    ..Frame::default()
                });
            } else if let (Report::Events(events), Some(last)) =
                (received.message, frames.last_mut())
            {
                (last.slips, last.work) = (events.slips, received.time);
            } else {
                return Err(unread("a report that is none"));
            }
        }
        let numbers = printed.split_whitespace().map(str::parse);
        let numbers: Result<Vec<u32>, _> = numbers.collect();
        match numbers.as_deref() {
            Ok(&[stack, solver, state]) => Ok(Self {
                frames,
                totals: Totals {
                    stack,
                    solver,
                    state,
                },
            }),
            _ => Err(unread(printed)),
        }
    }
}

/// A job for a [`Counter`]: the scene, the evolution, and a hand sample for every frame, as messages to a board.
pub fn job(scene: &SceneFile, evolution: Evolution, hands: &[Hand<f64>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    scene.described::<f32, _>(|description| {
        add(&mut bytes, Command::Scene(SceneCommand::from(description)));
    });
    let mode = Mode {
        evolution,
        ..Mode::DEFAULT
    };
    add(&mut bytes, Command::Mode(mode));
    for hand in hands {
        add(&mut bytes, Command::Hand(narrow_hand(hand)));
    }
    bytes
}

/// Adds a message. One that is too long is left out, and the board refuses the job.
fn add(bytes: &mut Vec<u8>, message: Command<'_>) {
    let frame = stiction_wire::Frame {
        sequence: 0,
        time: 0,
        message,
    };
    bytes.extend_from_slice(frame.encode(&mut [0; 1024]).unwrap_or_default());
}

/// The instruction bench of a board, built once for many jobs.
pub struct Counter {
    board: Board,
    image: Image,
}

impl Counter {
    /// Builds it.
    ///
    /// # Errors
    /// Fails if cargo or the target is missing, or the image cannot be built.
    pub fn new(board: Board, number: NumberType, profile: Profile) -> Result<Self, EmulatorError> {
        let image = Image::of_board(board, &format!("count_{}", number.name()), profile)?;
        Ok(Self { board, image })
    }

    /// Builds one with f32 for scenes among obstacles, of at most 4 vertices, one half-plane and 17 obstacles of 4 corners.
    ///
    /// # Errors
    /// Fails if cargo or the target is missing, or the image cannot be built.
    pub fn among(board: Board, profile: Profile) -> Result<Self, EmulatorError> {
        let image = Image::of_board(board, "count_among", profile)?;
        Ok(Self { board, image })
    }

    /// Builds one with the number type, V, S, the model and the evolution of `scene`, which is Rust code, see
    /// [`rust_source`](stiction_scene::rust_source): for jobs whose scenes run in them.
    ///
    /// # Errors
    /// Fails if cargo or the target is missing, or the image cannot be built.
    pub fn of_model(board: Board, profile: Profile, scene: &str) -> Result<Self, EmulatorError> {
        let image = Image::of_scene(board, "count_scene", profile, scene)?;
        Ok(Self { board, image })
    }

    /// Runs a job, with a budget for each step: the instructions of every frame. Without a model of its own, it has room for 8 vertices and
    /// 4 surfaces.
    ///
    /// # Errors
    /// Fails if the emulator is missing, or the job ends with an error.
    pub fn count(&self, job: &[u8], budget: u32) -> Result<Counted, EmulatorError> {
        let folder = tempfile::tempdir()?;
        fs::write(folder.path().join("job"), job)?;
        let budget = budget.to_string();
        let line = ["count", "job", "results", &budget];
        let printed = self.board.run(&self.image, (folder.path(), &line), true)?;
        Counted::read(&fs::read(folder.path().join("results"))?, &printed)
    }
}
