//! The program `stiction`: without arguments it shows a bundled scene, to be held with the mouse.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use stiction_host_sim::board::{BoardArgs, InfoArgs, board, info};
use stiction_host_sim::check::{CheckArgs, check};
use stiction_host_sim::code::{CodeArgs, code};
use stiction_host_sim::footprint::{FootprintArgs, footprint};
use stiction_host_sim::image::{ImageArgs, image};
use stiction_host_sim::replay::{ReplayArgs, replay};
use stiction_host_sim::run::{RunArgs, run};
use stiction_host_sim::sweep::{SweepArgs, sweep};
use stiction_host_sim::trade::{TradeArgs, trade};
use stiction_host_sim::view::{ViewArgs, view};
use stiction_host_sim::{report, stop};

/// Statics-based contact of an object held in the hand
#[derive(Parser)]
#[command(name = "stiction", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

/// What is done where no command is given, with all that is not said.
#[derive(Parser)]
struct Unasked {
    #[command(flatten)]
    view: ViewArgs,
}

#[derive(Subcommand)]
enum Command {
    /// The live page: hold the body with the mouse; poses for renderers (without a command: this)
    View(Box<ViewArgs>),
    /// Run a scene: a trace, a summary, plots
    Run(RunArgs),
    /// Run a recording again: every answer bit for bit, or the first frame that differs
    Replay(ReplayArgs),
    /// Check a trace, of this program or another one, against the laws of statics and friction
    Check(CheckArgs),
    /// Measure every setting of the solver: errors, costs, and which one to take
    Trade(TradeArgs),
    /// Parameter studies: a grid or random points over all cores, to one table; in shards, continued where it was ended
    Sweep(SweepArgs),
    /// Build the smallest solver for a scene, for two chips: why it is that, its size, what a frame costs (in QEMU)
    Footprint(FootprintArgs),
    /// Stream a hand's motion to a board in real time: rate, latency, losses, a trace; with --verify bit for bit
    Board(BoardArgs),
    /// What a board says about itself
    Info(InfoArgs),
    /// Build the image of a board: a file for its drive (UF2), or for a debug probe (ELF)
    Image(ImageArgs),
    /// A scene as C code, for the C library
    Code(CodeArgs),
}

/// Input that cannot be used, or output that cannot be written.
const UNUSABLE: u8 = 2;

fn main() -> ExitCode {
    stop::begin();
    let exit = match command() {
        Ok(command) => done(command),
        // Also where help was asked for.
        Err(said) => {
            report::printed(said.print());
            ExitCode::from(said.exit_code() as u8)
        }
    };
    match report::failure() {
        Some(error) => {
            report::tell(format_args!("error: standard output: {error}"));
            ExitCode::from(UNUSABLE)
        }
        None => exit,
    }
}

/// What the arguments ask for.
fn command() -> Result<Command, clap::Error> {
    match Cli::try_parse()?.command {
        Some(command) => Ok(command),
        None => {
            let Unasked { view } = Unasked::try_parse_from(["stiction"])?;
            Ok(Command::View(Box::new(view)))
        }
    }
}

fn done(command: Command) -> ExitCode {
    // False where the work was done and its outcome is bad.
    let result: Result<bool, Box<dyn std::error::Error>> = match command {
        Command::Run(args) => run(&args).map(|()| true).map_err(Into::into),
        Command::Replay(args) => replay(&args).map_err(Into::into),
        Command::Check(args) => check(&args),
        Command::Trade(args) => trade(&args).map(|()| true).map_err(Into::into),
        Command::Sweep(args) => sweep(&args).map_err(Into::into),
        Command::Footprint(args) => footprint(&args).map(|()| true).map_err(Into::into),
        Command::Board(args) => board(&args).map_err(Into::into),
        Command::Info(args) => info(&args).map(|()| true).map_err(Into::into),
        Command::Image(args) => image(&args).map(|()| true).map_err(Into::into),
        Command::Code(args) => code(&args).map(|()| true).map_err(Into::into),
        Command::View(args) => view(&args).map(|()| true).map_err(Into::into),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            report::tell(format_args!("error: {error}"));
            ExitCode::from(UNUSABLE)
        }
    }
}
