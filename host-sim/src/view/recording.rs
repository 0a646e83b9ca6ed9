//! A recording: the hand of every tick and the settings, to be replayed; and a file with the same and with the answers of the
//! solver or a board. The file has every tick as soon as it is over, however the program ends.

use std::collections::VecDeque;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Seek, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use stiction_live::guide::HandPose;
use stiction_live::replay::Recorded;
use stiction_live::stage::Stage;
use stiction_scene::Sample;

use super::archive::Archive;
use crate::recording::{Change, Head, LiveWriter, Maker, Recording, RecordingLine};
use stiction_live::body::Setting;
use stiction_live::record::{Frame, Run};

/// Number of ticks (ms) after which a recording ends by itself.
const LONGEST: usize = 600_000;
/// Number of ticks that are stored together: stored ticks are never moved.
const CHUNK: usize = 4096;
/// Maximum number of samples that wait for the answer of a board: more than are on their way to it.
const MOST_UNANSWERED: usize = 1024;
/// Ticks per second.
const RATE: f64 = 1000.0;

/// The hand of every tick, and the settings.
#[derive(Debug)]
pub(super) struct LiveRecording {
    pub(super) scene: String,
    /// The settings as read from that file.
    pub(super) setting: Setting,
    pub(super) stage: Stage,
    chunks: Vec<Vec<HandPose>>,
    /// The ticks from which on other settings hold.
    changes: Vec<(usize, Setting)>,
    /// Its file, and the writer until the recording ends.
    place: PathBuf,
    writer: Option<LiveWriter>,
    /// For a board: samples that it has not answered yet.
    unanswered: Option<VecDeque<Sample>>,
    /// Why its file is incomplete.
    pub(super) problem: Option<String>,
    /// It was made before the program was started.
    pub(super) is_earlier: bool,
}

impl LiveRecording {
    /// Creates one before its first tick, without a file. `is_of_board`: the answers come from a board.
    pub(super) fn new(setting: Setting, stage: Stage, is_of_board: bool) -> Self {
        Self {
            scene: setting.scene.source().text().to_owned(),
            setting,
            stage,
            chunks: Vec::with_capacity(LONGEST / CHUNK + 1),
            changes: Vec::new(),
            place: PathBuf::new(),
            writer: None,
            unanswered: is_of_board.then(VecDeque::new),
            problem: None,
            is_earlier: false,
        }
    }

    pub(super) fn open(&mut self, archive: &Archive, maker: &Maker) -> Result<(), String> {
        let Setting {
            scene,
            number,
            evolution,
        } = &self.setting;
        let head = Head::of(scene, *number, *evolution, maker);
        let writer = archive.begin(&head, &Run::of(scene, *number, *evolution))?;
        writer.place().clone_into(&mut self.place);
        self.writer = Some(writer);
        Ok(())
    }

    /// Reads the complete part of a recording from a file.
    pub(super) fn read(place: &Path) -> Result<Self, String> {
        let mut reader = Recording::open(place).map_err(|error| error.to_string())?;
        let Head {
            number,
            evolution,
            scene,
            name,
            ..
        } = reader.head.clone();
        let named = |change: &Change| change.setting(PathBuf::from(&name));
        let setting = named(&Change {
            number,
            evolution,
            scene,
        })?;
        let scene = Arc::clone(&setting.scene);
        let mut recording: Option<Self> = None;
        let line = |reader: &mut Recording| reader.next().map_err(|error| error.to_string());
        while let Some(line) = line(&mut reader)? {
            let known = recording.as_ref().map_or(0, Self::count);
            match line {
                RecordingLine::Sample(sample, _) if known <= LONGEST => {
                    if sample.t != known as f64 / RATE {
                        return Err("its ticks are not milliseconds".to_owned());
                    }
                    let stage = || Stage {
                        scene: Arc::clone(&scene),
                        path: None,
                        home: sample.hand,
                    };
                    let begun = || Self::new(setting.clone(), stage(), false);
                    let hand = HandPose::of(&sample.hand);
                    recording.get_or_insert_with(begun).keep(hand);
                }
                RecordingLine::Sample(..) => break,
                RecordingLine::Change(change) => {
                    let setting = named(&change)?;
                    if let Some(recording) = &mut recording {
                        recording.changes.push((known, setting));
                    }
                }
            }
        }
        let recording = recording.ok_or("no sample is whole in it")?;
        Ok(Self {
            place: place.to_owned(),
            is_earlier: true,
            ..recording
        })
    }

    pub(super) fn place(&self) -> &Path {
        &self.place
    }

    /// Adds the hand of the next tick, and the answer to it; a board's answer arrives later.
    pub(super) fn add(&mut self, hand: HandPose, answer: &Frame) {
        let sample = Sample {
            t: self.count() as f64 / RATE,
            hand: hand.hand(),
        };
        self.keep(hand);
        match &mut self.unanswered {
            None => self.write(&sample, Some(answer)),
            Some(waiting) => {
                waiting.push_back(sample);
                if waiting.len() > MOST_UNANSWERED
                    && let Some(oldest) = waiting.pop_front()
                {
                    self.write(&oldest, None);
                }
            }
        }
    }

    /// Adds the board's answer to the sample of this time; the samples before it have none. A hand that rests sends the same
    /// sample again: its first answer counts.
    pub(super) fn answer(&mut self, frame: &Frame) {
        let due = |waiting: &mut VecDeque<Sample>| {
            let is_due = waiting.front().is_some_and(|sample| sample.t <= frame.t);
            is_due.then(|| waiting.pop_front()).flatten()
        };
        while let Some(sample) = self.unanswered.as_mut().and_then(due) {
            self.write(&sample, (sample.t == frame.t).then_some(frame));
        }
    }

    /// Changes the settings from the next tick on.
    pub(super) fn change(&mut self, setting: &Setting) {
        let unanswered = self.unanswered.as_ref().map_or(0, VecDeque::len);
        self.changes
            .push((self.count() - unanswered, setting.clone()));
        let change = Change {
            number: setting.number.name().to_owned(),
            evolution: setting.evolution.name().to_owned(),
            scene: setting.scene.source().text().to_owned(),
        };
        let run = Run::of(&setting.scene, setting.number, setting.evolution);
        let written = self
            .writer
            .as_mut()
            .map(|writer| writer.change(&change, &run));
        self.note(written);
    }

    /// Endpoints it: samples that a board has not answered yet remain unanswered.
    pub(super) fn finish(&mut self) {
        for sample in self.unanswered.take().into_iter().flatten() {
            self.write(&sample, None);
        }
        let finished = self.writer.take().map(LiveWriter::finish_live);
        self.note(finished);
    }

    /// The message for the terminal when it has ended.
    pub(super) fn farewell(&self) -> String {
        let (seconds, place) = (self.seconds(), self.place.display());
        match &self.problem {
            Some(problem) => {
                format!("the recording has ended after {seconds:.3} s: {problem}\n")
            }
            None if self.is_full() => {
                format!("recorded {seconds:.3} s, the longest that is allowed: {place}\n")
            }
            None => format!("recorded {seconds:.3} s: {place}\n"),
        }
    }

    fn write(&mut self, sample: &Sample, answer: Option<&Frame>) {
        let written = self
            .writer
            .as_mut()
            .map(|writer| writer.write(sample, answer));
        self.note(written);
    }

    /// Stops writing after a failure.
    fn note(&mut self, result: Option<io::Result<()>>) {
        if let Some(Err(error)) = result {
            let problem = format!("{}: cannot be written: {error}", self.place.display());
            self.problem.get_or_insert(problem);
            self.writer = None;
        }
    }

    fn keep(&mut self, hand: HandPose) {
        match self.chunks.last_mut() {
            Some(chunk) if chunk.len() < CHUNK => chunk.push(hand),
            _ => {
                let mut chunk = Vec::with_capacity(CHUNK);
                chunk.push(hand);
                self.chunks.push(chunk);
            }
        }
    }

    /// Returns whether it has the maximum number of ticks, and one.
    pub(super) fn is_full(&self) -> bool {
        self.count() > LONGEST
    }

    /// Time from the first tick to the last (s).
    pub(super) fn seconds(&self) -> f64 {
        self.count().saturating_sub(1) as f64 / RATE
    }

    /// The recorded hand path, with the digits that read back to the same values.
    pub(super) fn hand_csv(&self) -> String {
        let mut text = "t,x,y,phi,held\n".to_owned();
        for (k, hand) in self.chunks.iter().flatten().enumerate() {
            let ([x, y, phi], held) = (hand.pose, u8::from(hand.held));
            // Writing to a string does not fail.
            let _ = writeln!(text, "{:?},{x:?},{y:?},{phi:?},{held}", k as f64 / RATE);
        }
        text
    }

    /// The trace: the answers in its file.
    pub(super) fn trace(&self) -> Result<File, String> {
        let mut reader = Recording::open(&self.place).map_err(|error| error.to_string())?;
        let file = tempfile::tempfile().map_err(|error| error.to_string())?;
        let mut trace = BufWriter::new(file);
        while let Some(line) = reader.next().map_err(|error| error.to_string())? {
            if let RecordingLine::Sample(_, Some(answer)) = line {
                writeln!(trace, "{answer}").map_err(|error| error.to_string())?;
            }
        }
        let mut file = trace.into_inner().map_err(|error| error.to_string())?;
        file.rewind().map_err(|error| error.to_string())?;
        Ok(file)
    }

    pub(super) fn file(&self) -> Result<File, String> {
        let opened = stiction_scene::text::open(&self.place, u64::MAX);
        opened.map_err(|problem| format!("{}: {problem}", self.place.display()))
    }
}

impl Recorded for LiveRecording {
    fn count(&self) -> usize {
        let full = self.chunks.len().saturating_sub(1) * CHUNK;
        full + self.chunks.last().map_or(0, Vec::len)
    }

    fn get(&self, k: usize) -> Option<&HandPose> {
        self.chunks.get(k / CHUNK)?.get(k % CHUNK)
    }

    fn change_at(&self, k: usize) -> Option<&Setting> {
        // Of several, the last one applies.
        let mut changes = self.changes.iter().rev();
        changes
            .find(|(from, _)| *from == k)
            .map(|(_, setting)| setting)
    }
}
