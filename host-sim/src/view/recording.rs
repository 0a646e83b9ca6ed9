//! A recording: the hand of every tick and the setting. Its trace is computed from these, by the code of `stiction run`; that
//! of a board is what the board said.

use std::fmt::Write as _;
use std::fs::File;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

use tempfile::TempDir;

use super::body::Setting;
use super::guide::HandPose;
use super::stage::Stage;
use crate::record::{Frame, Run};
use crate::run::{RunArgs, run};
use crate::settings::Settings;
use crate::trace::{Format, TraceWriter};

/// A recording ends by itself after so many ticks (ms).
pub(super) const LONGEST: usize = 600_000;
/// Ticks that are stored together: what is stored is never moved.
const CHUNK: usize = 4096;

/// The hand of every tick, and the setting.
#[derive(Debug)]
pub(super) struct Recording {
    /// The scene file.
    pub(super) scene: String,
    /// As it is read from that file.
    pub(super) setting: Setting,
    pub(super) stage: Stage,
    chunks: Vec<Vec<HandPose>>,
    /// What a board said.
    heard: Option<Heard>,
    /// The folder of the trace, once somebody has asked for it.
    computed: Mutex<Option<TempDir>>,
}

impl Recording {
    /// With the hand at the beginning. `is_heard`: of a board.
    ///
    /// # Errors
    /// There is no room for what a board says.
    pub(super) fn begin(
        scene: String,
        setting: Setting,
        stage: Stage,
        is_heard: bool,
    ) -> Result<Self, String> {
        let heard = match is_heard {
            true => Some(Heard::begin(&setting).map_err(|error| error.to_string())?),
            false => None,
        };
        let home = HandPose::of(&stage.home);
        let mut recording = Self {
            scene,
            setting,
            stage,
            chunks: Vec::with_capacity(LONGEST / CHUNK + 1),
            heard,
            computed: Mutex::default(),
        };
        recording.add(home);
        Ok(recording)
    }

    /// The board said something.
    pub(super) fn hear(&mut self, frame: &Frame) {
        if let Some(heard) = &mut self.heard {
            heard.add(frame);
        }
    }

    /// It is over.
    pub(super) fn finish(&mut self) {
        if let Some(heard) = &mut self.heard {
            heard.finish();
        }
    }

    /// The hand of the next tick.
    pub(super) fn add(&mut self, hand: HandPose) {
        match self.chunks.last_mut() {
            Some(chunk) if chunk.len() < CHUNK => chunk.push(hand),
            _ => {
                let mut chunk = Vec::with_capacity(CHUNK);
                chunk.push(hand);
                self.chunks.push(chunk);
            }
        }
    }

    /// How many ticks.
    pub(super) fn len(&self) -> usize {
        let full = self.chunks.len().saturating_sub(1) * CHUNK;
        full + self.chunks.last().map_or(0, Vec::len)
    }

    /// From the first tick to the last (s).
    pub(super) fn seconds(&self) -> f64 {
        self.len().saturating_sub(1) as f64 / 1000.0
    }

    /// The hand of a tick.
    pub(super) fn get(&self, k: usize) -> Option<&HandPose> {
        self.chunks.get(k / CHUNK)?.get(k % CHUNK)
    }

    /// A recorded hand path with the digits that read back to the same values.
    pub(super) fn hand_csv(&self) -> String {
        let mut text = "t,x,y,phi,held\n".to_owned();
        for (k, hand) in self.chunks.iter().flatten().enumerate() {
            let ([x, y, phi], held) = (hand.pose, u8::from(hand.held));
            // Writing to a string does not fail.
            let _ = writeln!(text, "{:?},{x:?},{y:?},{phi:?},{held}", k as f64 / 1000.0);
        }
        text
    }

    /// The trace, as `stiction run` writes it. It is computed once, while others who ask for it wait.
    ///
    /// # Errors
    /// There is no room for its files.
    pub(super) fn trace(&self) -> Result<File, String> {
        if let Some(heard) = &self.heard {
            return heard.trace();
        }
        let mut computed = self.computed.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = match computed.take() {
            Some(folder) => folder,
            None => self.compute()?,
        };
        let file = File::open(folder.path().join("trace.jsonl"));
        *computed = Some(folder);
        file.map_err(|error| error.to_string())
    }

    /// A folder with the trace.
    fn compute(&self) -> Result<TempDir, String> {
        let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
        let file = |name| folder.path().join(name);
        let (scene, hand, trace) = (file("scene.toml"), file("hand.csv"), file("trace.jsonl"));
        fs::write(&scene, &self.scene).map_err(|error| error.to_string())?;
        fs::write(&hand, self.hand_csv()).map_err(|error| error.to_string())?;
        let args = RunArgs {
            scene,
            settings: Settings {
                hand: Some(hand),
                number: self.setting.number,
                evolution: self.setting.evolution,
                ..Settings::default()
            },
            out: Some((trace, Format::JsonLines)),
            record: None,
            plot: None,
            quiet: true,
        };
        run(&args).map_err(|error| error.to_string())?;
        Ok(folder)
    }
}

/// The answers of a board, in a file.
#[derive(Debug)]
struct Heard {
    folder: TempDir,
    writer: Option<TraceWriter>,
    /// Time of the last one (s).
    last: f64,
    problem: Option<String>,
}

impl Heard {
    fn begin(setting: &Setting) -> io::Result<Self> {
        let folder = tempfile::tempdir()?;
        let run = Run::of(&setting.scene, setting.number, setting.evolution);
        let writer = TraceWriter::create(&Self::file(&folder), Format::JsonLines, &run)?;
        Ok(Self {
            folder,
            writer: Some(writer),
            last: f64::NEG_INFINITY,
            problem: None,
        })
    }

    fn file(folder: &TempDir) -> PathBuf {
        folder.path().join("trace.jsonl")
    }

    /// A hand that rests sends the same sample again: its first answer counts.
    fn add(&mut self, frame: &Frame) {
        if let Some(writer) = &mut self.writer
            && frame.t > self.last
        {
            self.last = frame.t;
            let written = writer.write(frame);
            self.note(written);
        }
    }

    fn finish(&mut self) {
        if let Some(writer) = self.writer.take() {
            let finished = writer.finish();
            self.note(finished);
        }
    }

    fn note(&mut self, result: io::Result<()>) {
        if let Err(error) = result {
            self.problem.get_or_insert(error.to_string());
        }
    }

    fn trace(&self) -> Result<File, String> {
        match &self.problem {
            Some(problem) => Err(problem.clone()),
            None => File::open(Self::file(&self.folder)).map_err(|error| error.to_string()),
        }
    }
}
