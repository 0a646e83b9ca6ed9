//! The program `stiction`: without arguments it displays a bundled scene that the user can hold with the mouse.

use std::process::ExitCode;

use stiction_host_sim::board::{board, info};
use stiction_host_sim::check::check;
use stiction_host_sim::code::code;
use stiction_host_sim::command::{Command, parsed};
use stiction_host_sim::image::image;
use stiction_host_sim::list::scenes;
use stiction_host_sim::new::new;
use stiction_host_sim::replay::replay;
use stiction_host_sim::run::run;
use stiction_host_sim::shell::{complete, completions, man};
use stiction_host_sim::sweep::sweep;
use stiction_host_sim::trade::trade;
use stiction_host_sim::view::view;
use stiction_host_sim::{report, stop};

/// Exit status for input that cannot be used, or output that cannot be written.
const UNUSABLE: u8 = 2;

fn main() -> ExitCode {
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
    let result: Result<bool, Box<dyn std::error::Error>> = match command {
        Command::Run(args) => run(&args).map(|()| true),
        Command::Replay(args) => replay(&args),
        Command::Check(args) => check(&args),
        Command::Trade(args) => trade(&args).map(|()| true),
        Command::Sweep(args) => sweep(&args),
        Command::Board(args) => board(&args).map_err(Into::into),
        Command::Info(args) => info(&args).map(|()| true).map_err(Into::into),
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
