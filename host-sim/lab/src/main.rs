//! The program `lab`: a command for each table of the documents. Each prints its table, and with `--write` also writes it into the document
//! that has it.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use stiction_lab::footprint::FootprintArgs;
use stiction_lab::markdown::Destination;
use stiction_lab::{budget, footprint, lawful, measure, obstacles, rates, trade, worst};

/// Measures stiction
#[derive(Parser)]
#[command(name = "lab")]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Also writes what is measured into the document that has it
    #[arg(long, global = true)]
    write: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Every setting: accuracy and time on this computer, instructions, flash and memory on emulated chips
    Trade,
    /// The smallest solver of a scene, or of a few bundled ones: its size and time on emulated chips
    Footprint(FootprintArgs),
    /// The effect of a budget on random drags, on emulated chips
    Budget {
        /// The number of drags
        #[arg(default_value_t = 100)]
        drags: usize,
    },
    /// The cost of obstacles on an emulated chip
    Obstacles,
    /// The frames of the scenes of `trade`, judged by the laws alone
    Lawful {
        /// A recorded hand path (csv, tum, txt) instead of the synthetic one
        hand: Option<PathBuf>,
    },
    /// Residuals of random scenes, the range of number types
    Measure,
    /// Slips of the same hand at several rates of frames
    Rates,
    /// The cost of single frames of ordinary use at 1 kHz, in operations on numbers
    Worst {
        /// The number of scenes of each kind
        #[arg(default_value_t = 100)]
        scenes: usize,
    },
}

fn main() -> ExitCode {
    let Cli { command, write } = Cli::parse();
    match run(command, Destination { write }) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(command: Command, output: Destination) -> Result<(), Box<dyn Error>> {
    match command {
        Command::Trade => trade::trade(output),
        Command::Footprint(args) => footprint::footprint(&args, output),
        Command::Budget { drags } => budget::budget(drags, output),
        Command::Obstacles => obstacles::obstacles(output),
        Command::Lawful { hand } => lawful::lawful(hand.as_deref(), output),
        Command::Measure => Ok(measure::measure(output)?),
        Command::Rates => rates::rates(output),
        Command::Worst { scenes } => Ok(worst::worst(scenes, output)?),
    }
}
