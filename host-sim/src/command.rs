//! The command line: the commands with their arguments and examples. From the words that were typed to a command, or to an error
//! message with a suggestion.

use std::error::Error;
use std::ffi::OsString;
use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::board::{BoardArgs, InfoArgs, KnobArgs, board, info, knob};
use crate::check::{CheckArgs, check};
use crate::code::{CodeArgs, code};
use crate::figures::{FiguresArgs, figures};
use crate::image::{ImageArgs, image};
use crate::list::{ScenesArgs, scenes};
use crate::new::{NewArgs, new};
use crate::replay::{ReplayArgs, replay};
use crate::run::{RunArgs, run};
use crate::shell::{CompletionsArgs, ManArgs, complete, completions, man};
use crate::sweep::{SweepArgs, sweep};
use crate::trade::{TradeArgs, trade};
use crate::view::{ViewArgs, view};
use crate::{examples, mistakes, report, stop};

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
    /// Draw the figures of the paper that the method is from
    Figures(FiguresArgs),
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
    /// Print the numbers of a board's knob, or store others on the board
    Knob(KnobArgs),
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

/// Exit status for input that cannot be used, or output that cannot be written.
const UNUSABLE: u8 = 2;

/// Runs the program with the words of its command line.
pub fn main() -> ExitCode {
    // Before any output.
    complete();
    stop::begin();
    let exit = match parsed(std::env::args_os()) {
        Ok(command) => done(command),
        // Also for a request for help.
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

fn done(command: Command) -> ExitCode {
    // False if the command ran but its result is bad.
    let result: Result<bool, Box<dyn Error>> = match command {
        Command::Run(args) => run(&args).map(|()| true),
        Command::Figures(args) => figures(&args).map(|()| true),
        Command::Replay(args) => replay(&args),
        Command::Check(args) => check(&args),
        Command::Trade(args) => trade(&args).map(|()| true),
        Command::Sweep(args) => sweep(&args),
        Command::Board(args) => board(&args).map_err(Into::into),
        Command::Info(args) => info(&args).map(|()| true).map_err(Into::into),
        Command::Knob(args) => knob(&args).map(|()| true).map_err(Into::into),
        Command::Image(args) => image(&args).map(|()| true).map_err(Into::into),
        Command::Code(args) => code(&args).map(|()| true).map_err(Into::into),
        Command::Scenes(args) => scenes(&args).map(|()| true),
        Command::New(args) => new(&args).map(|()| true),
        Command::Completions(args) => completions(&args).map(|()| true).map_err(Into::into),
        Command::Man(args) => man(&args).map(|()| true).map_err(Into::into),
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
