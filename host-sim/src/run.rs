//! `stiction run`: runs a scene file and the hand's motion through the solver, and writes a trace, a summary and plots.

use std::error::Error;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::ProgressBar;

use crate::figure_options::FigureOptions;
use crate::files::{self, Files};
use crate::input::{self, open_scene};
use crate::options::trace_parser;
use crate::progress;
use crate::recording::Head;
use crate::report;
use crate::settings::Settings;
use crate::shell::scene_completer;
use crate::summary::Summary;
use crate::trace::Format;
use stiction_live::input::{open_path, remarks};
use stiction_live::record::Run;
use stiction_scene::{HandPath, InputError, SceneFile};

/// The arguments of `stiction run`.
#[derive(Args, Clone, Debug)]
pub struct RunArgs {
    /// Scene file (TOML), or the name of a bundled scene
    #[arg(add = scene_completer())]
    pub(crate) scene: PathBuf,
    /// How it is run.
    #[command(flatten)]
    pub(crate) settings: Settings,
    /// Trace to write: TRACE.jsonl or TRACE.csv; the summary goes to standard error then, without it to standard output
    #[arg(long, value_name = "TRACE", value_parser = trace_parser())]
    pub(crate) out: Option<(PathBuf, Format)>,
    /// Recording to write, for `stiction replay`: scene, settings, every sample of the hand and every answer
    #[arg(long, value_name = "FILE")]
    pub(crate) record: Option<PathBuf>,
    /// Its pictures.
    #[command(flatten)]
    pub(crate) figure: FigureOptions,
    /// Print neither summary nor progress
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Runs a scene and writes the requested output.
///
/// # Errors
/// Fails if the input cannot be used, or the output cannot be written; there is then no trace.
pub fn run(args: &RunArgs) -> Result<(), Box<dyn Error>> {
    let settings = &args.settings;
    let mut scene = open_scene(&args.scene, settings.number)?;
    let mut notes = scene.notes.clone();
    let mut record = Run::of(&scene, settings.number, settings.evolution);
    let pictures = args.figure.pictures()?;
    let plots = pictures.places(&record);
    files::check(
        input::files(&args.scene, &scene, settings.hand.as_deref()),
        files::written(args.out.as_ref(), args.record.as_ref()).chain(plots),
    )?;
    let (path, rate) = opened(&mut scene, settings, &mut notes)?;
    pictures.check(&record, path.frames(rate).map(|sample| sample.t))?;
    if !args.quiet {
        report::notes(notes);
    }
    let mut summary = Summary::new(&record);
    let head = Head::new(&scene, settings);
    let mut files = Files::trace(args.out.as_ref(), &record)?.with_recording(
        args.record.as_ref(),
        &head,
        &record,
    )?;
    let (frames, mut samples) = (path.frames(rate), path.frames(rate));
    let mut progress = RunProgress::new(frames.len(), args.quiet);
    let time = settings.simulate(&scene, frames, |frame| {
        progress.advance();
        summary.add(&frame);
        if let Some(sample) = samples.next() {
            files.write(&sample, Some(&frame))?;
        }
        if pictures.any() {
            record.frames.push(frame);
        }
        Ok::<_, Box<dyn Error>>(())
    })?;
    summary.set_solver_time(time);
    let mut text = summary.to_string();
    let plots = pictures.write(&record)?;
    files.finish()?;
    let written = [
        ("trace", args.out.as_ref().map(|(file, _)| file)),
        ("recording", args.record.as_ref()),
    ];
    for (what, file) in written {
        text += &file.map_or_else(String::new, |file| report::written(what, file));
    }
    text += &plots;
    match args.out {
        _ if args.quiet => {}
        // A user who requests a trace may redirect standard output, and expects nothing there.
        Some(_) => report::tell(text.trim_end()),
        None => report::print(&text),
    }
    Ok(())
}

/// The hand's path and the rate to which it is resampled; adds what is to be said about it.
fn opened(
    scene: &mut SceneFile,
    settings: &Settings,
    notes: &mut Vec<String>,
) -> Result<(HandPath, Option<f64>), InputError> {
    let hand = settings.hand.as_deref();
    if let Some(hand) = hand.filter(|_| settings.fit) {
        notes.push(input::fit(scene, hand)?);
    }
    let given = settings.rate.map(|rate| ("--rate", rate));
    let (path, rate) = open_path(scene, hand, given)?;
    notes.extend(remarks(scene, hand, &path));
    Ok((path, rate))
}

/// A progress bar that appears after a second, on a terminal.
struct RunProgress {
    begun: Instant,
    done: u64,
    total: u64,
    bar: Option<ProgressBar>,
    quiet: bool,
}

impl RunProgress {
    /// The bar is updated once in this number of frames.
    const INTERVAL: u64 = 1024;

    fn new(total: usize, quiet: bool) -> Self {
        Self {
            begun: Instant::now(),
            done: 0,
            total: total as u64,
            bar: None,
            quiet,
        }
    }

    fn advance(&mut self) {
        self.done += 1;
        if self.quiet || !self.done.is_multiple_of(Self::INTERVAL) {
            return;
        }
        if self.bar.is_none() && self.begun.elapsed() > Duration::from_secs(1) {
            let template = "{bar:40} {percent}% of {len} frames, {eta} left";
            self.bar = Some(progress::bar(self.total, template));
        }
        if let Some(bar) = &self.bar {
            bar.set_position(self.done);
        }
    }
}
