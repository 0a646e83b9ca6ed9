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

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use module::{Extent, Module};

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

/// Why the build failed.
#[derive(Debug, thiserror::Error)]
enum BuildError {
    /// The compiler failed and printed the reason.
    #[error("cargo failed; if the target is missing: rustup target add wasm32-unknown-unknown")]
    Cargo,
    /// wasm-bindgen rejects the compiler's output.
    #[error("wasm-bindgen: {0}")]
    Bindgen(String),
    #[error("{}: {error}", .place.display())]
    File { place: PathBuf, error: io::Error },
    /// A file of the page does not have the form that this program expects.
    #[error("{0}")]
    Page(String),
}

/// Adds the path of the file.
fn of(place: &Path) -> impl Fn(io::Error) -> BuildError + '_ {
    |error| BuildError::File {
        place: place.to_owned(),
        error,
    }
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

fn build(arguments: &Arguments) -> Result<(), BuildError> {
    let whole = Module::compile(Extent::Whole)?;
    if let Some(out) = &arguments.out {
        let part = Module::compile(Extent::Part)?;
        let page = folder::Page::new(&part, &whole)?;
        folder::write(out, &page.files())?;
        let one = one_file::page(&page)?;
        folder::write(out, &[("stiction.html".to_owned(), one.into_bytes())])?;
    }
    if let Some(npm) = &arguments.npm {
        folder::write(npm, &folder::package(&whole)?)?;
    }
    Ok(())
}
