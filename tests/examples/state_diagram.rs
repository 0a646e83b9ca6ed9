//! Writes the transition table into the documentation of the solver: as a picture, `core/states.svg`, and as a table in
//! `core/STATICS.md`.
//!
//! ```sh
//! cargo run -p stiction-tests --example state_diagram
//! ```

use std::error::Error;
use std::process::ExitCode;
use stiction_tests::diagram::{Diagram, document, table};
use stiction_tools::readme::Section;

fn main() -> ExitCode {
    match write() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn write() -> Result<(), Box<dyn Error>> {
    let svg = Diagram::new()?.svg()?;
    let statics = document("STATICS.md");
    let about = |e| format!("{}: {e}", statics.display());
    let section = Section::find(&statics, "transitions").map_err(about)?;
    std::fs::write(document("states.svg"), svg)?;
    section.write(&table()).map_err(about)?;
    Ok(())
}
