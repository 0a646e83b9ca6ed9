//! `stiction trade`: accuracy and cost of every setting of the solver, over a suite of scenes. From the suite to a table, CSV,
//! JSON, pictures and a recommendation:
//!
//! ```text
//! suite ─ reference ─ measure (accuracy, time) ─┬ rows ─┬─ table, report
//! counts on emulated chips (trade/chips.csv) ───┘       ├─ front (pictures)
//!                                                       └─ advice
//! ```
//!
//! The lab counts on the chips, and writes what this measures into documents.

mod accuracy;
mod advice;
pub mod chip;
mod cost;
pub mod counts;
mod files;
mod front;
mod hand;
pub mod machine;
mod measure;
mod place;
mod random;
mod reference;
mod report;
mod setting;
mod suite;
pub mod table;

pub use cost::Emulated;
pub use report::Report;
pub use setting::{FINEST, Memory, RATES, Setting};
pub use suite::{Case, Group, Suite, drags};

use std::error::Error;
use std::path::{Path, PathBuf};

use clap::Args;
use stiction_scene::InputError;

use crate::files::{WriteError, check};
use crate::plot;
use crate::progress::Activity;
use counts::{Count, counted};
use files::Folder;
use machine::processor;
use measure::measure;
use place::Place;

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
    /// Also instructions or cycles, flash and memory on four chips, as they were counted in emulation for the bundled scenes
    #[arg(long)]
    emulated: bool,
    /// Prints the whole table, too, after the recommendation; it is in trade.csv in any case
    #[arg(long)]
    table: bool,
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
/// Fails if the hand's path cannot be used, or the folder cannot be written; before any measurement if possible.
pub fn trade(args: &TradeArgs) -> Result<(), Box<dyn Error>> {
    let results = results(&args.out).into_iter().map(|file| ("--out", file));
    check(args.hand.as_deref(), results)?;
    let suite = Suite::new(args.hand.as_deref(), args.quick)?;
    let folder = Folder::open(&args.out).map_err(WriteError::of(&args.out))?;
    let counts = match args.emulated {
        true => counted().map_err(|error| format!("the costs on chips: {error}"))?,
        false => Vec::new(),
    };
    let report = Report::of(&suite, &counts)?;
    let files = folder.write(&report.files()?);
    let files = files.map_err(WriteError::of(&args.out))?;
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

/// Name and contents.
type NamedBytes = (String, Vec<u8>);

impl Report {
    /// Measures the suite, with a progress bar, and adds what was counted on chips.
    ///
    /// # Errors
    /// A number type refuses a scene.
    pub fn of(suite: &Suite, counts: &[Count]) -> Result<Self, InputError> {
        let bar = Activity::measuring("scenes on this computer", suite.frame_count() as u64);
        let rows = measure(suite, |case| {
            bar.advance(case.frame_count() as u64, &case.scene.title);
        });
        let mut rows = rows?;
        bar.end();
        counts.iter().for_each(|count| count.enter(&mut rows));
        let mut report = Self {
            machine: processor(),
            scenes: suite.to_string(),
            rows,
            advice: Vec::new(),
        };
        report.advice = advice::advice(&report.overall(), &report.machine);
        Ok(report)
    }

    /// The files of a folder of results: names and contents.
    ///
    /// # Errors
    /// A picture cannot be drawn.
    pub fn files(&self) -> Result<Vec<NamedBytes>, Box<dyn Error>> {
        let table = self.csv().map_err(WriteError::of(Path::new(TABLE)))?;
        let mut files = vec![(TABLE.to_owned(), table), (DATA.to_owned(), self.json())];
        let rows = self.overall();
        for place in Place::of(&rows) {
            let (svg, png) = plot::fronts(&front::picture(place, &rows, &self.machine))?;
            let [as_svg, as_png] = place.pictures();
            files.extend([(as_svg, svg.into_bytes()), (as_png, png)]);
        }
        Ok(files)
    }
}
