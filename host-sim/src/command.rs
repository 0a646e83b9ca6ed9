//! The command line: the commands with their arguments and examples. From the words that were typed to a command, or to an error
//! message with a suggestion.

use std::ffi::OsString;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::board::{BoardArgs, InfoArgs};
use crate::check::CheckArgs;
use crate::code::CodeArgs;
use crate::image::ImageArgs;
use crate::list::ScenesArgs;
use crate::new::NewArgs;
use crate::replay::ReplayArgs;
use crate::run::RunArgs;
use crate::shell::{CompletionsArgs, ManArgs};
use crate::sweep::SweepArgs;
use crate::trade::TradeArgs;
use crate::view::ViewArgs;
use crate::{examples, mistakes};

/// Statics-based contact of an object held in the hand
#[derive(Parser)]
#[command(name = "stiction", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

/// What is done where no command is given: `view` with its defaults.
#[derive(Parser)]
struct Unasked {
    #[command(flatten)]
    view: ViewArgs,
}

/// A command with its arguments.
#[derive(Subcommand)]
pub enum Command {
    /// Show a scene in the browser, to be held with the mouse; send poses to renderers (the default)
    View(Box<ViewArgs>),
    /// Run a scene: a trace, a summary, plots
    Run(RunArgs),
    /// List the bundled scenes, or write their files
    Scenes(ScenesArgs),
    /// Write a scene file to start from, with a comment on every key
    New(NewArgs),
    /// Run a recording again and compare every answer bit for bit
    Replay(ReplayArgs),
    /// Check a trace, of this program or another one, against the laws of statics and friction
    Check(CheckArgs),
    /// Measure how exact every setting of the solver is and what it costs; recommend one
    Trade(TradeArgs),
    /// Run scenes with many values of their parameters, on all cores, to one table
    Sweep(SweepArgs),
    /// Stream a hand's motion to a board in real time: rate, latency, losses, a trace
    Board(BoardArgs),
    /// Print what a board says about itself
    Info(InfoArgs),
    /// Build the image of a board: UF2 for its drive, or ELF for a debug probe
    Image(ImageArgs),
    /// Print a scene as C code, for the C library
    Code(CodeArgs),
    /// Print what a shell needs to complete commands, options, scenes and files
    Completions(CompletionsArgs),
    /// Write the manual pages of all commands
    Man(ManArgs),
}

/// All commands as clap describes them, with examples in their help.
pub fn described() -> clap::Command {
    examples::add(Cli::command())
}

/// The command that was typed; the first word is the name of the program.
///
/// # Errors
/// Requested help, or an error.
pub fn parsed<W: Into<OsString> + Clone>(
    words: impl IntoIterator<Item = W>,
) -> Result<Command, clap::Error> {
    let matches = described()
        .try_get_matches_from(words)
        .map_err(mistakes::explained)?;
    match Cli::from_arg_matches(&matches)?.command {
        Some(command) => Ok(command),
        None => {
            let Unasked { view } = Unasked::try_parse_from(["stiction"])?;
            Ok(Command::View(Box::new(view)))
        }
    }
}
