//! Builds everything that a browser needs to run the solver itself. From `host-sim/wasm` and `host-sim/web` it builds
//!
//! * a folder that any web host can serve, with `stiction.html`, the same page in one file, for `file://`,
//! * the folder of the npm package `stiction`.
//!
//! ```sh
//! rustup target add wasm32-unknown-unknown
//! cargo run --release -p stiction-page -- --out page --npm package
//! ```

mod folder;
mod module;
mod one_file;

use std::error::Error;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use module::Module;

/// What is built, and where.
#[derive(Debug, Parser)]
#[command(version, about, long_about = None)]
struct Arguments {
    /// Folder of the page
    #[arg(long, value_name = "DIR", required_unless_present = "npm")]
    out: Option<PathBuf>,
    /// Folder of the npm package
    #[arg(long, value_name = "DIR")]
    npm: Option<PathBuf>,
}

/// What is built, or why it is not.
type Built<T> = Result<T, Box<dyn Error>>;

/// Adds the path of the file.
fn of(place: &Path) -> impl Fn(io::Error) -> String + '_ {
    |error| format!("{}: {error}", place.display())
}

fn main() -> ExitCode {
    match build(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn build(arguments: &Arguments) -> Built<()> {
    let module = Module::compile()?;
    if let Some(out) = &arguments.out {
        let page = folder::Page::new(&module)?;
        folder::write(out, &page.files())?;
        let one = one_file::page(&page)?;
        folder::write(out, &[("stiction.html".to_owned(), one.into_bytes())])?;
    }
    if let Some(npm) = &arguments.npm {
        folder::write(npm, &folder::package(&module)?)?;
    }
    Ok(())
}
