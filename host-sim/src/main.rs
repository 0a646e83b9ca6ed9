//! The program `stiction`: without arguments it runs a bundled scene and leaves plots behind.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use stiction_host_sim::footprint::{FootprintArgs, footprint};
use stiction_host_sim::run::{RunArgs, run};
use stiction_host_sim::trade::{TradeArgs, trade};

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
    /// Measure every setting of the solver: errors, costs, and which one to take
    Trade(TradeArgs),
    /// Build the smallest solver for a scene, for two chips: why it is that, its size, what a frame costs (in QEMU)
    Footprint(FootprintArgs),
}

fn main() -> ExitCode {
    let result: Result<(), Box<dyn std::error::Error>> = match Cli::parse().command {
        Some(Command::Run(args)) => run(&args).map_err(Into::into),
        Some(Command::Trade(args)) => trade(&args).map_err(Into::into),
        Some(Command::Footprint(args)) => footprint(&args).map_err(Into::into),
        None => run(&RunArgs::demonstration()).map_err(Into::into),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
