//! `stiction replay`: a recording through the solver again, every answer compared bit for bit with the recorded one.

use std::path::PathBuf;

use clap::Args;
use serde_json::Value;
use stiction_core::{Fixed, Parts, Real, SiFloat};
use stiction_scene::{HostModel, InputError, Sample, SceneFile, Source};

use crate::files::{self, Files, WriteError};
use crate::number::Number;
use crate::options::{parse_evolution, parse_number, trace_parser};
use crate::record::{Frame, Run};
use crate::recording::{Head, Recording, RecordingError, this_build};
use crate::report;
use crate::simulate::{Running, Task, with_solver};
use crate::trace::{Format, Record};

/// The arguments of `stiction replay`.
#[derive(Args, Clone, Debug)]
pub struct ReplayArgs {
    /// Recording, of `run --record` or `board --verify --record`
    recording: PathBuf,
    /// Trace to write: TRACE.jsonl or TRACE.csv, as the solver answers now
    #[arg(long, value_name = "TRACE", value_parser = trace_parser())]
    out: Option<(PathBuf, Format)>,
    /// Recording to write: the same samples with the answers of now
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Nothing where all is the same
    #[arg(long)]
    quiet: bool,
}

/// Why a replay gave nothing.
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

/// Replays a recording and says whether every answer is the same. False where one differs, or where the recording was cut.
///
/// # Errors
/// A recording that cannot be used, or output that cannot be written.
pub fn replay(args: &ReplayArgs) -> Result<bool, ReplayError> {
    let input = [args.recording.as_path()];
    files::check(
        input,
        files::written(args.out.as_ref(), args.record.as_ref()),
    )?;
    let mut recording = Recording::open(&args.recording)?;
    let head = recording.head.clone();
    let (scene, run) = read(&recording)?;
    let mut solver = stepper(&head, &run, &scene)?;
    let scenery = run.scenery();
    let head_now = Head {
        build: this_build(),
        ..head.clone()
    };
    let mut files = Files::trace(args.out.as_ref(), &run)?.with_recording(
        args.record.as_ref(),
        &head_now,
        &run,
    )?;
    let (mut count, mut compared, mut first) = (0_u64, 0_u64, None);
    while let Some((sample, recorded)) = recording.next()? {
        let frame = solver.step(&sample);
        count += 1;
        if let Some(recorded) = recorded {
            compared += 1;
            let record = Record::new(&frame, &scenery, run.number.is_single());
            let differs = || difference(&recorded, &record);
            first = first.or_else(|| Some((recording.line(), sample.t, differs()?)));
        }
        files.write(&sample, Some(&frame))?;
    }
    if count == 0 {
        let problem = "no sample follows the head, allowed: at least one".to_owned();
        return Err(recording.error(problem).into());
    }
    files.finish()?;
    let build = &head.build;
    let cut = recording.cut();
    cut.iter().for_each(report::tell);
    match first {
        Some((line, t, difference)) => {
            report::print(&format!(
                "frame {} differs (line {line}, t = {t} s): {difference}\n  recorded by {build}, now {}\n",
                line - 2,
                this_build()
            ));
            Ok(false)
        }
        None => {
            if !args.quiet {
                report::print(&format!(
                    "{compared} of {count} frames compared, the same bits; recorded by {build}\n"
                ));
            }
            Ok(cut.is_none())
        }
    }
}

/// The scene of a recording and what is run.
fn read(recording: &Recording) -> Result<(SceneFile, Run), ReplayError> {
    let head = &recording.head;
    let refused = |key: &str, name: &str, allowed: String| {
        recording.error(format!("`{key}` is {name:?}, {allowed}"))
    };
    let number =
        parse_number(&head.number).map_err(|allowed| refused("number", &head.number, allowed))?;
    let evolution = parse_evolution(&head.evolution)
        .map_err(|allowed| refused("evolution", &head.evolution, allowed))?;
    let source = Source::new(recording.scene_name(), head.scene.as_str());
    let scene = SceneFile::parse(source, number.limit())?;
    let run = Run::of(&scene, number, evolution);
    Ok((scene, run))
}

/// A solver with its state.
trait Stepper {
    /// The answer to the next sample; the first one starts the scene.
    fn step(&mut self, sample: &Sample) -> Frame;
}

impl<R: Real<Si: SiFloat>, M: HostModel> Stepper for Running<R, M> {
    fn step(&mut self, sample: &Sample) -> Frame {
        self.frame(sample)
    }
}

/// Any solver.
struct Boxed;

impl Task for Boxed {
    type Done = Box<dyn Stepper>;

    fn with<R: Real<Si: SiFloat>, M: HostModel>(self, running: Running<R, M>) -> Self::Done {
        Box::new(running)
    }
}

/// The solver of a recording: its number type, with the parts that it had.
fn stepper(head: &Head, run: &Run, scene: &SceneFile) -> Result<Box<dyn Stepper>, InputError> {
    match run.number {
        Number::F32 if lacks_parts(head) => with_parts::<f32>(head, run, scene),
        Number::Fixed if lacks_parts(head) => with_parts::<Fixed>(head, run, scene),
        // No board computes in f64, and this computer has all parts.
        _ => with_solver(scene, (run.number, run.evolution, budget(head)), Boxed),
    }
}

/// As the solver of a board may.
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

/// The first field in which an answer is not the recorded one, with both values; the texts are equal where the bits are.
fn difference(recorded: &str, record: &Record<'_>) -> Option<String> {
    let now = serde_json::to_string(record).unwrap_or_default();
    if now == recorded {
        return None;
    }
    let fields = |text: &str| serde_json::from_str::<serde_json::Map<String, Value>>(text);
    let (Ok(was), Ok(is)) = (fields(recorded), fields(&now)) else {
        return Some(format!("recorded {recorded}, now {now}"));
    };
    // A field that is missing on one side, or another order of fields, is a difference of the whole.
    let differs = is
        .iter()
        .find(|(key, value)| was.get(*key).is_some_and(|old| old != *value));
    Some(match differs {
        Some((key, value)) => format!("{key}: recorded {}, now {value}", was[key]),
        None => format!("recorded {recorded}, now {now}"),
    })
}
