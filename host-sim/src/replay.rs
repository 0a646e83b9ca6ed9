//! `stiction replay`: runs a recording through the solver again, and compares every answer bit for bit with the recorded one.

use std::error::Error;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use serde_json::Value;
use stiction_live::body::{Body, Setting};
use stiction_live::number::parse_kind;
use stiction_live::record::{Frame, Run};
use stiction_live::session::Session;
use stiction_scene::{Sample, SceneFile, Source};

use crate::files::{self, Files};
use crate::options::trace_parser;
use crate::recording::{Change, Head, Recording, RecordingLine, this_build};
use crate::report;
use crate::trace::{Format, Record};

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

/// Replays a recording and reports whether every answer is the same. Returns false if one differs, or if the recording was cut.
pub(crate) fn replay(args: &ReplayArgs) -> Result<bool, Box<dyn Error>> {
    let input = [args.recording.as_path()];
    files::check(
        input,
        files::written(args.out.as_ref(), args.record.as_ref()),
    )?;
    let mut recording = Recording::open(&args.recording)?;
    let head = recording.head.clone();
    let (solver, run) = read(&recording)?;
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
        run,
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
    solver: Stepper,
    run: Run,
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
    ) -> Result<(), Box<dyn Error>> {
        let frame = self
            .solver
            .step(sample)
            .map_err(|problem| recording.error(problem))?;
        self.result.count += 1;
        if let Some(recorded) = recorded {
            self.result.compared += 1;
            if self.result.first.is_none() {
                let differs = difference(&recorded, &self.run.record(&frame));
                self.result.first = differs.map(|what| FirstDifference {
                    line: recording.line(),
                    t: sample.t,
                    what,
                });
            }
        }
        Ok(self.files.write(sample, Some(&frame))?)
    }

    fn change(&mut self, recording: &Recording, change: &Change) -> Result<(), Box<dyn Error>> {
        let refused = |problem| recording.error(problem);
        let setting = change.setting(recording.scene_name()).map_err(refused)?;
        self.solver.change(&setting).map_err(refused)?;
        self.run = Run::of(&setting.scene, setting.number, setting.evolution);
        Ok(self.files.change(change, &self.run)?)
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

/// The solver of a recording, in its number type, and the settings of the run.
fn read(recording: &Recording) -> Result<(Stepper, Run), Box<dyn Error>> {
    let head = &recording.head;
    let kind = parse_kind(&head.number, &head.evolution);
    let (number, evolution) = kind.map_err(|problem| recording.error(problem))?;
    let source = Source::new(recording.scene_name(), head.scene.as_str());
    let scene = SceneFile::parse(source, number.limit())?;
    let run = Run::of(&scene, number, evolution);
    let session = Session::new(&scene, number, evolution, budget(head))?;
    let setting = Setting {
        scene: Arc::new(scene),
        number,
        evolution,
    };
    let solver = match head.budget.is_none() {
        true => Stepper::Whole(setting, None),
        false => Stepper::Fixed(session),
    };
    Ok((solver, run))
}

fn budget(head: &Head) -> u32 {
    head.budget.unwrap_or(u32::MAX)
}

/// A solver with its state.
enum Stepper {
    /// With a budget: its setting stays.
    Fixed(Session),
    /// With an unlimited budget: its setting may change.
    Whole(Setting, Option<Box<dyn Body>>),
}

impl Stepper {
    /// Returns the answer to the next sample; the first one starts the scene.
    fn step(&mut self, sample: &Sample) -> Result<Frame, String> {
        match self {
            Self::Fixed(session) => Ok(session.step(sample)),
            Self::Whole(_, Some(body)) => {
                body.step(&sample.hand);
                Ok(body.frame(sample.t))
            }
            Self::Whole(setting, body) => {
                let begun = setting.start(&sample.hand)?;
                Ok(body.insert(begun).frame(sample.t))
            }
        }
    }

    /// Continues with the body under another setting.
    fn change(&mut self, to: &Setting) -> Result<(), String> {
        let Self::Whole(setting, body) = self else {
            return Err(
                "the setting changes in a recording with a budget, which this \
                 program cannot follow; allowed: a change where there are all parts and no budget"
                    .to_owned(),
            );
        };
        if let Some(body) = body {
            *body = to.carry(&body.present())?;
        }
        *setting = to.clone();
        Ok(())
    }
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
