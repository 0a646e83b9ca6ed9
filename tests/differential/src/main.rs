//! `differential`: two solvers side by side; see [`stiction_differential::command::run`].

use std::process::ExitCode;
use stiction_differential::{OLD, STATICS, command};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    command::run(&arguments, &[OLD.as_slice(), &STATICS].concat())
}
