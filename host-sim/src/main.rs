//! The program `stiction`: without arguments it displays a bundled scene that the user can hold with the mouse.

use std::process::ExitCode;

fn main() -> ExitCode {
    stiction_host_sim::command::main()
}
