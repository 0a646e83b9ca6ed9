//! `stiction replay`: runs a recording through the solver again, and compares every answer bit for bit with the recorded one.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use serde_json::Value;
use stiction_core::{Fixed, Parts, Real, SiFloat};
use stiction_scene::{HostModel, InputError, Sample, SceneFile, Source};

use crate::files::{self, Files, WriteError};
use crate::options::trace_parser;
use crate::recording::{Change, Head, Recording, RecordingError, RecordingLine, this_build};
use crate::report;
use crate::trace::{Format, Record};
use stiction_live::body::{Body, Setting};
use stiction_live::number::Number;
use stiction_live::number::{parse_evolution, parse_number};
use stiction_live::record::{Frame, Run, Scenery};
use stiction_live::simulate::{Kind, Running, Task, with_solver};

/// The arguments of `stiction replay`.
#[derive(Args, Clone, Debug)]
pub struct ReplayArgs {
    /// Recording, of `view`, `run --record` or `board --verify --record`
    recording: PathBuf,
    /// Trace of the new answers to write: TRACE.jsonl or TRACE.csv
    #[arg(long, value_name = "TRACE", value_parser = trace_parser())]
    out: Option<(PathBuf, Format)>,
    /// Recording to write: the same samples with the new answers
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Print nothing if every answer is the same
    #[arg(long)]
    quiet: bool,
}

/// The reason why a replay has no result.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {
    /// The recording cannot be used.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Its scene cannot be used.
    #[error(transparent)]
    Scene(#[from] InputError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Replays a recording and reports whether every answer is the same. Returns false if one differs, or if the recording was cut.
///
/// # Errors
/// Fails if the recording cannot be used, or the output cannot be written.
pub fn replay(args: &ReplayArgs) -> Result<bool, ReplayError> {
    let input = [args.recording.as_path()];
    files::check(
        input,
        files::written(args.out.as_ref(), args.record.as_ref()),
    )?;
    let mut recording = Recording::open(&args.recording)?;
    let head = recording.head.clone();
    let (scene, run) = read(&recording)?;
    let solver = stepper(&head, &run, scene)?;
    let head_now = Head {
        build: this_build(),
        ..head.clone()
    };
    let files = Files::trace(args.out.as_ref(), &run)?.with_recording(
        args.record.as_ref(),
        &head_now,
        &run,
    )?;
    let mut again = Again {
        solver,
        scenery: run.scenery(),
        number: run.number,
        files,
        result: Comparison::default(),
    };
    while let Some(line) = recording.next()? {
        match line {
            RecordingLine::Sample(sample, recorded) => again.step(&recording, &sample, recorded)?,
            RecordingLine::Change(change) => again.change(&recording, &change)?,
        }
    }
    if again.result.count == 0 {
        let problem = "no sample follows the head, allowed: at least one".to_owned();
        return Err(recording.error(problem).into());
    }
    again.files.finish()?;
    let cut = recording.cut();
    cut.iter().for_each(report::tell);
    let is_same = again.result.report(&head.build, args.quiet);
    Ok(is_same && cut.is_none())
}

/// A recording that is run again.
struct Again {
    solver: Box<dyn Stepper>,
    scenery: Scenery,
    number: Number,
    files: Files,
    result: Comparison,
}

#[derive(Default)]
struct Comparison {
    count: u64,
    compared: u64,
    first: Option<FirstDifference>,
}

/// The first answer that differs from the recorded one.
struct FirstDifference {
    /// Of the recording.
    line: usize,
    /// Time (s).
    t: f64,
    /// The field, and both values.
    what: String,
}

impl Again {
    fn step(
        &mut self,
        recording: &Recording,
        sample: &Sample,
        recorded: Option<String>,
    ) -> Result<(), ReplayError> {
        let frame = self
            .solver
            .step(sample)
            .map_err(|problem| recording.error(problem))?;
        self.result.count += 1;
        if let Some(recorded) = recorded {
            self.result.compared += 1;
            if self.result.first.is_none() {
                let record = Record::new(&frame, &self.scenery, self.number.is_single());
                let differs = difference(&recorded, &record);
                self.result.first = differs.map(|what| FirstDifference {
                    line: recording.line(),
                    t: sample.t,
                    what,
                });
            }
        }
        Ok(self.files.write(sample, Some(&frame))?)
    }

    fn change(&mut self, recording: &Recording, change: &Change) -> Result<(), ReplayError> {
        let refused = |problem| recording.error(problem);
        let setting = change.setting(recording.scene_name()).map_err(refused)?;
        self.solver.change(&setting).map_err(refused)?;
        let run = Run::of(&setting.scene, setting.number, setting.evolution);
        (self.scenery, self.number) = (run.scenery(), run.number);
        Ok(self.files.change(change, &run)?)
    }
}

impl Comparison {
    /// Prints the first difference from the answers of `build`, or unless `quiet` that there is none. Returns whether there is none.
    fn report(&self, build: &str, quiet: bool) -> bool {
        if let Some(FirstDifference { line, t, what }) = &self.first {
            let (frame, now) = (line - 2, this_build());
            report::print(&format!(
                "frame {frame} differs (line {line}, t = {t} s): {what}\n  recorded by {build}, now {now}\n"
            ));
            return false;
        }
        if !quiet {
            report::print(&format!(
                "{} of {} frames compared, the same bits; recorded by {build}\n",
                self.compared, self.count
            ));
        }
        true
    }
}

fn read(recording: &Recording) -> Result<(SceneFile, Run), ReplayError> {
    let head = &recording.head;
    let number = parse_number(&head.number)
        .map_err(|allowed| recording.error(format!("`number` is {:?}, {allowed}", head.number)))?;
    let evolution = parse_evolution(&head.evolution).map_err(|allowed| {
        recording.error(format!("`evolution` is {:?}, {allowed}", head.evolution))
    })?;
    let source = Source::new(recording.scene_name(), head.scene.as_str());
    let scene = SceneFile::parse(source, number.limit())?;
    let run = Run::of(&scene, number, evolution);
    Ok((scene, run))
}

/// A solver with its state.
trait Stepper {
    /// Returns the answer to the next sample; the first one starts the scene.
    fn step(&mut self, sample: &Sample) -> Result<Frame, String>;
    /// Continues with the body under another setting.
    fn change(&mut self, setting: &Setting) -> Result<(), String>;
}

impl<R: Real<Si: SiFloat>, M: HostModel> Stepper for Running<R, M> {
    fn step(&mut self, sample: &Sample) -> Result<Frame, String> {
        Ok(self.frame(sample))
    }

    fn change(&mut self, _: &Setting) -> Result<(), String> {
        Err("the setting changes in a recording with a budget, or of a solver without friction or weight, which this \
             program cannot follow; allowed: a change where there are all parts and no budget"
            .to_owned())
    }
}

/// A solver with all parts and an unlimited budget, whose setting may change.
struct AllParts {
    setting: Setting,
    body: Option<Box<dyn Body>>,
}

impl Stepper for AllParts {
    fn step(&mut self, sample: &Sample) -> Result<Frame, String> {
        match &mut self.body {
            Some(body) => body.step(&sample.hand),
            None => self.body = Some(self.setting.start(&sample.hand)?),
        }
        let frame = self.body.as_ref().map(|body| body.frame(sample.t));
        frame.ok_or_else(|| "there is no body".to_owned())
    }

    fn change(&mut self, setting: &Setting) -> Result<(), String> {
        if let Some(body) = &mut self.body {
            *body = setting.carry(&body.present())?;
        }
        self.setting = setting.clone();
        Ok(())
    }
}

/// Any solver.
struct Boxed;

impl Task for Boxed {
    type Done = Box<dyn Stepper>;

    fn with<R: Real<Si: SiFloat>, M: HostModel>(self, running: Running<R, M>) -> Self::Done
    where
        Running<R, M>: Send + Sync,
    {
        Box::new(running)
    }
}

/// The solver of a recording: its number type, with the parts that it had.
fn stepper(head: &Head, run: &Run, scene: SceneFile) -> Result<Box<dyn Stepper>, InputError> {
    match run.number {
        Number::F32 if lacks_parts(head) => with_parts::<f32>(head, run, &scene),
        Number::Fixed if lacks_parts(head) => with_parts::<Fixed>(head, run, &scene),
        // No board computes in f64, and this computer has all parts.
        Number::F32 | Number::F64 | Number::Fixed => {
            let kind = Kind {
                number: run.number,
                evolution: run.evolution,
                budget: budget(head),
            };
            let running = with_solver(&scene, kind, Boxed)?;
            let whole = AllParts {
                setting: Setting {
                    scene: Arc::new(scene),
                    number: run.number,
                    evolution: run.evolution,
                },
                body: None,
            };
            Ok(match head.budget {
                Some(_) => running,
                None => Box::new(whole),
            })
        }
    }
}

/// Returns whether the solver lacks parts, as that of a board may.
fn lacks_parts(head: &Head) -> bool {
    !(head.friction && head.weight)
}

fn budget(head: &Head) -> u32 {
    head.budget.unwrap_or(u32::MAX)
}

fn with_parts<R: Real<Si: SiFloat>>(
    head: &Head,
    run: &Run,
    scene: &SceneFile,
) -> Result<Box<dyn Stepper>, InputError> {
    match (head.friction, head.weight) {
        (true, _) => stepped::<R, Parts<true, false>>(head, run, scene),
        (false, true) => stepped::<R, Parts<false, true>>(head, run, scene),
        (false, false) => stepped::<R, Parts<false, false>>(head, run, scene),
    }
}

fn stepped<R: Real<Si: SiFloat>, M: HostModel>(
    head: &Head,
    run: &Run,
    scene: &SceneFile,
) -> Result<Box<dyn Stepper>, InputError> {
    let running = Running::<R, M>::of(scene, run.evolution, budget(head))?;
    Ok(Box::new(running))
}

/// The first field in which an answer differs from the recorded one, with both values; equal bits have equal texts.
fn difference(recorded: &str, record: &Record<'_>) -> Option<String> {
    let now = serde_json::to_string(record).unwrap_or_default();
    if now == recorded {
        return None;
    }
    let fields = |text: &str| serde_json::from_str::<serde_json::Map<String, Value>>(text);
    let (Ok(was), Ok(is)) = (fields(recorded), fields(&now)) else {
        return Some(format!("recorded {recorded}, now {now}"));
    };
    // A field that is missing on one side, or another order of fields, is a difference as a whole.
    let differs = is
        .iter()
        .find(|(key, value)| was.get(*key).is_some_and(|old| old != *value));
    Some(match differs {
        Some((key, value)) => format!("{key}: recorded {}, now {value}", was[key]),
        None => format!("recorded {recorded}, now {now}"),
    })
}
