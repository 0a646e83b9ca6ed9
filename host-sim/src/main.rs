//! The program `stiction`: without arguments it runs a bundled scene and leaves plots behind.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use stiction_host_sim::run::{RunArgs, run};

/// Statics-based contact of an object held in the hand
#[derive(Parser)]
#[command(name = "stiction", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Run a scene: a trace, a summary, plots
    Run(RunArgs),
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Some(Command::Run(args)) => run(&args),
        None => run(&RunArgs::demonstration()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
