//! `stiction trade`: accuracy and cost of every setting of the solver, over a suite of scenes. From the suite to a table, CSV,
//! JSON, pictures and a recommendation:
//!
//! ```text
//! suite ─ reference ─ measure (accuracy, cost) ─┬ rows ─┬─ table, report
//!       └ emulated (instructions, memory) ──────┘       ├─ front (pictures)
//!                                                       └─ advice
//! ```

mod accuracy;
mod advice;
mod cost;
mod emulated;
mod files;
mod front;
mod hand;
mod measure;
mod place;
mod random;
mod readme;
mod reference;
mod report;
mod setting;
mod suite;
mod table;

pub use setting::{FINEST, Memory, RATES, Setting};
pub use suite::{Case, Group, Suite};

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;
use stiction_scene::InputError;
use stiction_tools::machine::processor;
use stiction_tools::process::EmulatorError;

use crate::emulator::{Board, Chip};
use crate::files::{WriteError, check};
use crate::plot::{self, PlotError};
use crate::progress::measuring;
use emulated::Count;
use files::Folder;
use measure::measure;
use place::Place;
use readme::Readme;
use report::Report;

/// The arguments of `stiction trade`.
#[derive(Args, Clone, Debug)]
pub struct TradeArgs {
    /// Folder for trade.csv, trade.json and the pictures
    #[arg(long, value_name = "DIR", default_value = "trade")]
    out: PathBuf,
    /// Recorded hand path (csv, tum, txt) instead of the synthetic one
    #[arg(long, value_name = "FILE")]
    hand: Option<PathBuf>,
    /// Measure a few scenes only
    #[arg(long)]
    quick: bool,
    /// Also count instructions or cycles, flash and memory on four emulated chips (needs QEMU)
    #[arg(long)]
    emulated: bool,
    /// Prints the whole table, too, after the recommendation; it is in trade.csv in any case
    #[arg(long)]
    table: bool,
    /// Writes the results between the marks <!-- trade: begin --> and <!-- trade: end --> of this file as well, and in short
    /// between <!-- settings: begin --> and <!-- settings: end -->, where it has them; can be given again for other files
    #[arg(long, value_name = "FILE")]
    readme: Vec<PathBuf>,
}

/// The reason why there are no results.
#[derive(Debug, thiserror::Error)]
pub enum TradeError {
    /// The hand's path cannot be used, or a scene is refused.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An emulated chip is not available, or fails.
    #[error(transparent)]
    Emulator(#[from] EmulatorError),
    /// A result would replace the hand's path, or another result.
    #[error(transparent)]
    Name(#[from] WriteError),
    /// The folder or the file cannot be written.
    #[error("{}: cannot be written: {error}", place.display())]
    Write {
        /// The folder or file.
        place: PathBuf,
        /// The system's message.
        error: io::Error,
    },
    /// The pictures' folder is not below that of the README.
    #[error(
        "{}: is not in the folder of {}, allowed: a folder there, so that its pictures can be shown",
        out.display(), readme.display()
    )]
    Elsewhere {
        /// The folder.
        out: PathBuf,
        /// The README.
        readme: PathBuf,
    },
    /// A picture cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
}

impl TradeError {
    /// The message that a place cannot be written, and why.
    fn write(place: &Path) -> impl FnOnce(io::Error) -> Self {
        let place = place.to_owned();
        |error| Self::Write { place, error }
    }
}

/// The files of the results, except the pictures.
const TABLE: &str = "trade.csv";
const DATA: &str = "trade.json";

/// All files that may be written into a folder.
fn results(out: &Path) -> Vec<PathBuf> {
    let pictures = Place::all().flat_map(Place::pictures);
    let names = [TABLE, DATA].map(str::to_owned).into_iter().chain(pictures);
    names.map(|name| out.join(name)).collect()
}

/// Measures the suite and writes all results.
///
/// # Errors
/// [`TradeError`]; before any measurement if possible.
pub fn trade(args: &TradeArgs) -> Result<(), TradeError> {
    let results = results(&args.out).into_iter().map(|file| ("--out", file));
    let readmes = args.readme.iter().map(|file| ("--readme", file.clone()));
    check(args.hand.as_deref(), results.chain(readmes))?;
    let suite = Suite::new(args.hand.as_deref(), args.quick)?;
    let readmes = args.readme.iter().map(|file| Readme::find(file));
    let readmes: Vec<_> = readmes.collect::<Result<_, _>>()?;
    let folder = Folder::open(&args.out).map_err(TradeError::write(&args.out))?;
    let pictures = readmes.iter().map(|readme| readme.pictures(&args.out));
    let pictures: Vec<_> = pictures.collect::<Result<_, _>>()?;
    let counts = match args.emulated {
        true => counts(&suite)?,
        false => Vec::new(),
    };
    let report = report(&suite, &counts)?;
    let mut files = vec![
        (
            TABLE.to_owned(),
            report.csv().map_err(TradeError::write(&args.out))?,
        ),
        (DATA.to_owned(), report.json()),
    ];
    let rows = report.overall();
    for place in Place::of(&rows) {
        let (svg, png) = plot::fronts(&front::picture(place, &rows, &report.machine))?;
        let [as_svg, as_png] = place.pictures();
        files.extend([(as_svg, svg.into_bytes()), (as_png, png)]);
    }
    let files = folder.write(&files).map_err(TradeError::write(&args.out))?;
    for (readme, pictures) in readmes.iter().zip(&pictures) {
        readme.write(&report, pictures)?;
    }
    let list: String = files
        .iter()
        .map(|file| format!("  {}\n", file.display()))
        .collect();
    let mut text = report.recommendation();
    match args.table {
        true => text += &report.table(),
        false => text += "the whole table: --table; files:\n",
    }
    crate::report::print(&(text + &list));
    Ok(())
}

/// Counts on emulated chips, with a progress bar.
fn counts(suite: &Suite) -> Result<Vec<Count>, EmulatorError> {
    Board::require_all(&Chip::ALL.map(Chip::board))?;
    let bar = measuring("emulated chips", emulated::extent() as u64);
    let counts = emulated::count(suite, |chip| {
        bar.advance(1, chip);
    });
    let counts = counts?;
    bar.end();
    Ok(counts)
}

/// Measures the suite, with a progress bar.
fn report(suite: &Suite, counts: &[Count]) -> Result<Report, InputError> {
    let bar = measuring("scenes on this computer", suite.frame_count() as u64);
    let rows = measure(suite, |case| {
        bar.advance(case.frame_count() as u64, &case.scene.title);
    });
    let mut rows = rows?;
    bar.end();
    counts.iter().for_each(|count| count.enter(&mut rows));
    let mut report = Report {
        machine: processor(),
        scenes: suite.to_string(),
        rows,
        advice: Vec::new(),
    };
    report.advice = advice::advice(&report.overall(), &report.machine);
    Ok(report)
}
