//! `stiction board`, `stiction info` and `stiction knob`: send a hand's motion in real time to a board on a serial port, behind a socket or in an
//! emulator. The wire format is that of `core/wire/FRAME.md`.
//!
//! ```text
//! scene.toml ─ setup ──────────┐                          ┌─ record ─ trace, recording
//!                              ├─ session ─ line ─ link ══╪═ board (or emulate)
//! hand.csv ─┬─ feed ─ stream ──┘  message ─ steps ─ pending ┤
//! tracker ──┘                                             ├─ verify: the host's solver on the same samples
//!                                                         └─ counts, latency ─ print
//! ```

mod address;
mod audience;
mod counts;
mod emulate;
mod error;
mod feed;
mod info;
mod knob;
mod latency;
mod line;
mod link;
mod live;
mod message;
mod pending;
mod print;
mod reconnect;
mod record;
mod refusal;
mod request;
mod session;
mod setup;
mod steps;
mod stream;
mod tracker;
mod usb;
mod verify;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::Args;
use stiction_core::Evolution;
use stiction_scene::SceneFile;

pub use address::ConnectArgs;
pub(crate) use address::PLACE;
pub use emulate::EmulatedBoard;
pub use error::BoardError;
pub use knob::{KnobArgs, knob};
pub(crate) use live::{Identity, LiveBoard, Word};
pub use tracker::{HoldButton, TrackerArgs};

use crate::files::{self, Files};
use crate::input::{self, open_scene};
use crate::options::{evolution_parser, parse_rate, trace_parser};
use crate::recording::{Head, Maker};
use crate::shell::scene_completer;
use crate::trace::Format;
use crate::{report, stop};
use audience::Console;
use emulate::Image;
use feed::Feed;
use message::About;
use print::Screen;
use session::{Inbox, Session};
use setup::Setup;
use stiction_live::input::{open_path, remarks};
use stiction_live::number::Number;
use stiction_live::record::Run;
use stiction_live::scenes;
use stream::Stream;

/// The arguments of `stiction board`.
#[derive(Args, Clone, Debug)]
#[command(mut_group(PLACE, |group| group.required(true)))]
pub struct BoardArgs {
    /// Scene file (TOML), or the name of a bundled scene
    #[arg(default_value = scenes::DEFAULT, add = scene_completer())]
    scene: PathBuf,
    /// Where the board is.
    #[command(flatten)]
    connect: ConnectArgs,
    /// Recorded hand path (csv, tum, txt) instead of the one in the scene file
    #[arg(long, value_name = "FILE")]
    hand: Option<PathBuf>,
    /// Samples per second, instead of the rate in the scene file
    #[arg(long, value_name = "HZ", value_parser = parse_rate, allow_negative_numbers = true)]
    rate: Option<f64>,
    /// A tracker instead of a path.
    #[command(flatten)]
    tracker: TrackerArgs,
    /// path: events are found along the hand's straight line between two samples; frame: at samples only
    #[arg(long, default_value = "path", value_parser = evolution_parser())]
    evolution: Evolution,
    /// Ticks per second of the board, instead of its own setting
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    tick: Option<u16>,
    /// Make a step with every sample on the board and on this computer, and compare every bit of every answer
    #[arg(long)]
    verify: bool,
    /// Keep the scene that the board has; the body stays where it is
    #[arg(long, conflicts_with = "verify")]
    keep: bool,
    /// Trace to write: TRACE.jsonl or TRACE.csv
    #[arg(long, value_name = "TRACE", value_parser = trace_parser())]
    out: Option<(PathBuf, Format)>,
    /// Recording to write, for `stiction replay`: scene, mode, every sample and every answer of the board
    #[arg(long, value_name = "FILE", requires = "verify")]
    record: Option<PathBuf>,
    /// Print only errors and the verdict of --verify
    #[arg(long)]
    quiet: bool,
}

/// The arguments of `stiction info`.
#[derive(Args, Clone, Debug)]
#[command(mut_group(PLACE, |group| group.required(true)))]
pub struct InfoArgs {
    /// Where the board is.
    #[command(flatten)]
    connect: ConnectArgs,
}

/// Streams to a board. Returns false if `--verify` found a difference.
///
/// # Errors
/// Fails if the input cannot be used, or if the board is missing, refuses something or is disconnected.
pub fn board(args: &BoardArgs) -> Result<bool, BoardError> {
    let scene = Arc::new(usable_scene(args)?);
    let rate = args.rate.map(|rate| ("--rate", rate));
    let path = match args.tracker.is_wanted() {
        true => None,
        false => Some(open_path(&scene, args.hand.as_deref(), rate)?),
    };
    if let Some((path, _)) = path.as_ref().filter(|_| !args.quiet) {
        report::notes(&scene.notes);
        report::notes(remarks(&scene, args.hand.as_deref(), path));
    }
    let feed = match &path {
        Some((path, rate)) => Feed::path(path.frames(*rate)),
        None => Feed::live(),
    };
    // A board sends f32, whatever the number type of its solver.
    let run = Run::of(&scene, Number::F32, args.evolution);
    let console = Console {
        screen: Screen::new(args.quiet),
        files: Files::trace(args.out.as_ref(), &run)?,
    };
    stop::listen();
    let setup = setup(args, &scene);
    let (mut stream, session) = Stream::connect(&args.connect, setup, feed, console)?;
    if args.verify {
        stream = compared(stream, args, &run)?;
    }
    let (placement, timeout) = (&scene.hand.placement, args.connect.timeout());
    args.tracker
        .start(placement, timeout, stream.inbox.sender.clone())?;
    let result = stream.run(session);
    let is_good = end(stream, args)?;
    result.map(|()| is_good)
}

/// Returns the scene; checks that no output would replace it or its path.
fn usable_scene(args: &BoardArgs) -> Result<SceneFile, BoardError> {
    let scene = open_scene(&args.scene, Number::F32)?;
    if !args.keep {
        input::suits_boards(&scene)?;
    }
    let inputs = input::files(&args.scene, &scene, args.hand.as_deref());
    let written = files::written(args.out.as_ref(), args.record.as_ref());
    files::check(inputs, written)?;
    Ok(scene)
}

/// The settings that the board receives at the beginning.
fn setup(args: &BoardArgs, scene: &Arc<SceneFile>) -> Setup {
    Setup {
        scene: Arc::clone(scene),
        evolution: args.evolution,
        tick: args.tick,
        keep: args.keep,
        per_sample: args.verify,
    }
}

/// A stream whose answers are compared with those of this computer, and recorded if requested.
fn compared<'a>(
    mut stream: Stream<'a, Console>,
    args: &BoardArgs,
    run: &Run,
) -> Result<Stream<'a, Console>, BoardError> {
    let (about, setup) = (&stream.about, &stream.setup);
    stream.twin = Some(verify::twin(about, &setup.scene)?);
    let head = recording_head(about, &setup.scene);
    let files = stream.audience.files;
    stream.audience.files = files.with_recording(args.record.as_ref(), &head, run)?;
    Ok(stream)
}

/// Moves the files to their final places and prints the result. Returns false if a comparison found a difference.
fn end(stream: Stream<'_, Console>, args: &BoardArgs) -> Result<bool, BoardError> {
    let (scene, name) = (&stream.setup.scene.title, &stream.about.name);
    let title = format!("{scene} on {name} ({})", stream.address);
    let Stream {
        audience: Console { mut screen, files },
        counts,
        verdict,
        ..
    } = stream;
    screen.clear();
    files.finish()?;
    let begun = counts.begun;
    let seconds = begun.map_or(0.0, |begun| begun.elapsed().as_secs_f64());
    if !args.quiet {
        report::print(&print::summary(&title, &counts, seconds));
    }
    if args.verify {
        report::print(&format!("{verdict}\n"));
    }
    Ok(!args.verify || verdict.is_good())
}

/// The description of a board in a recording.
fn recording_head(about: &About, scene: &SceneFile) -> Head {
    let evolution = about.mode.evolution;
    Head::of(scene, about.number.into(), evolution, &maker(about))
}

/// The board as the maker of a recording.
fn maker(about: &About) -> Maker {
    let [major, minor, patch] = about.version;
    Maker {
        build: format!("{} {major}.{minor}.{patch}", about.name),
        budget: (about.budget < u32::MAX).then_some(about.budget),
    }
}

/// Prints a board's description of itself.
///
/// # Errors
/// Fails if the board is missing or does not answer.
pub fn info(args: &InfoArgs) -> Result<(), BoardError> {
    stop::listen();
    let (mut address, mut inbox) = (args.connect.address(Image::Plain)?, Inbox::new());
    let timeout = args.connect.timeout();
    let (mut session, about) = Session::begin(&mut address, &mut inbox, timeout, Instant::now())?;
    report::print(&info::about(&about));
    // Only the mode can request it, and the user of the board chooses the mode.
    if about.mode.health_every == 0 {
        report::print("how it fares: not sent in this mode\n");
        return Ok(());
    }
    let period = Duration::from_millis(about.mode.health_every.into());
    let text = match session.wait_for_health(&mut inbox, period + timeout)? {
        Some(health) => info::health(&health),
        None => "how it fares: it did not say so in time\n".to_owned(),
    };
    report::print(&text);
    Ok(())
}
