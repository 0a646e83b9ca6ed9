//! `stiction sweep`: a scene with many values of its parameters, run on all cores to one table. From a sweep file to CSV:
//!
//! ```text
//! sweep.toml ─ plan (scenes, keys, axes) ─ point(index) ─ parallel ─ row ─ output (shard i of n)
//! ```
//!
//! A row is a function of the sweep file and its index: it is the same in any shard, on any number of threads and after any
//! interruption.

mod axis;
mod beside;
mod key;
mod output;
mod parallel;
mod plan;
mod progress;
mod row;

use std::error::Error;
use std::fmt::Write as _;
use std::io;
use std::path::{Path, PathBuf};

use clap::Args;
use rayon::ThreadPoolBuilder;
use sha2::{Digest, Sha256};
use stiction_scene::HandPath;

use crate::files;
use crate::{report, stop};
use output::{Output, Rows};
use plan::Plan;
use progress::Progress;

/// The arguments of `stiction sweep`.
#[derive(Args, Clone, Debug)]
pub struct SweepArgs {
    /// Sweep file (TOML): scenes, what varies in them, the design
    sweep: PathBuf,
    /// Table to write, and to continue where it is there: SWEEP.csv, with --shard SWEEP.I-of-N.csv
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Part I of N alone, from 1: the rows whose index leaves I-1 when divided by N. The first part has the header, the
    /// others have none, so that `cat` in their order makes one table
    #[arg(long, value_name = "I/N", value_parser = parse_shard, default_value = "1/1", hide_default_value = true)]
    shard: Shard,
    /// Number of threads, instead of one per core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Add a last column: the time of the solver's steps (s), which differs from run to run
    #[arg(long)]
    time: bool,
    /// Print the number of points and the first of them; run nothing
    #[arg(long)]
    dry_run: bool,
    /// Print neither progress nor summary
    #[arg(long)]
    quiet: bool,
}

/// Part `part` of `of`, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    part: u64,
    of: u64,
}

fn parse_shard(text: &str) -> Result<Shard, String> {
    let shard = text.split_once('/').and_then(|(part, of)| {
        let (part, of) = (part.parse().ok()?, of.parse().ok()?);
        ((1..=of).contains(&part) && of <= plan::MOST).then_some(Shard { part, of })
    });
    shard.ok_or_else(|| {
        format!(
            "allowed: I/N, with I from 1 to N, and N up to {}",
            plan::MOST
        )
    })
}

/// Runs the missing rows of a table; returns false if the user ended it before the table was complete.
pub(crate) fn sweep(args: &SweepArgs) -> Result<bool, Box<dyn Error>> {
    let plan = Plan::read(&args.sweep)?;
    let shard = args.shard;
    let header = row::line(&row::header(&plan, args.time))?;
    let rows = Rows {
        header: (shard.part == 1).then(|| header.clone()),
        first: shard.part - 1,
        step: shard.of,
        count: (plan.count() + shard.of - shard.part) / shard.of,
    };
    if args.dry_run {
        report::print(&outline(&plan, &rows));
        return Ok(true);
    }
    let mut pool = ThreadPoolBuilder::new();
    if let Some(threads) = args.threads {
        pool = pool.num_threads(threads.into());
    }
    let fewer = |error| format!("{error}, allowed: fewer --threads");
    let pool = pool.build().map_err(fewer)?;
    let place = args.out.clone();
    let place = place.unwrap_or_else(|| self::place(&args.sweep, shard));
    let (read, beside) = (plan.files(), beside::beside(&place));
    let written = [place.clone(), beside].map(|file| ("--out", file));
    files::check(read.iter().map(PathBuf::as_path), written)?;
    let inputs = inputs(&plan, shard, &header);
    let mut output = Output::open(&place, &inputs, &rows)?;
    let before = output.rows();
    let mut progress = Progress::new(before, rows.count, args.quiet);
    stop::listen();
    let work = |k| {
        let row = || row::row(&plan, &plan.point(rows.index(k)), args.time);
        (!stop::asked()).then(row)
    };
    let mut refused = 0;
    parallel::in_order(&pool, before..rows.count, work, |row| {
        output.append(&row::line(&row.cells)?)?;
        refused += u64::from(row.is_refused);
        progress.set(output.rows(), rows.count);
        Ok::<_, Box<dyn Error>>(())
    })?;
    drop(progress);
    let done = output.rows();
    let is_whole = done == rows.count;
    if !args.quiet {
        let mut text = format!("{}: {done} of {} rows", place.display(), rows.count);
        if before > 0 {
            let _ = write!(text, ", {before} of them from before");
        }
        if refused > 0 {
            let _ = write!(text, ", {refused} refused now: its `status` says why");
        }
        if !is_whole {
            text += "; the same command continues";
        }
        report::print(&(text + "\n"));
    }
    // A study of which nothing ran has no result.
    Ok(is_whole && (refused == 0 || refused < done - before))
}

/// The default place of the table; names of parts are numbered such that any list sorts them.
fn place(sweep: &Path, Shard { part, of }: Shard) -> PathBuf {
    let mut name = sweep.file_stem().unwrap_or_default().to_owned();
    if of > 1 {
        let width = of.to_string().len();
        name.push(format!(".{part:0width$}-of-{of}"));
    }
    name.push(".csv");
    name.into()
}

/// The number of points, and the first ones as a table.
fn outline(plan: &Plan, rows: &Rows) -> String {
    const SHOWN: u64 = 5;
    let mut text = format!("{} points", plan.count());
    if rows.step > 1 {
        let _ = write!(text, ", {} of them in this shard", rows.count);
    }
    text.push('\n');
    let names = row::header(plan, false);
    let varied = 2 + plan.axes.len();
    text += &names[..varied].join(",");
    for k in 0..rows.count.min(SHOWN) {
        text.push('\n');
        text += &row::varied(&plan.point(rows.index(k))).join(",");
    }
    text + if rows.count > SHOWN { "\n...\n" } else { "\n" }
}

/// The inputs of the rows, one per line: a table is continued only from the same inputs.
fn inputs(plan: &Plan, shard: Shard, header: &[u8]) -> String {
    let digest = |bytes: &[u8]| format!("{:x}", Sha256::digest(bytes));
    let mut text = format!(
        "program: stiction {}\nshard: {}/{}\ncolumns: {}\nsweep file: {}\n",
        env!("CARGO_PKG_VERSION"),
        shard.part,
        shard.of,
        digest(header),
        digest(plan.source.text().as_bytes()),
    );
    // Writing to a string does not fail.
    for scene in &plan.scenes {
        let digest = digest(scene.source.text().as_bytes());
        let _ = writeln!(text, "scene {:?}: {digest}", scene.name);
    }
    for (i, file) in plan.hand_files().iter().enumerate() {
        // If it cannot be read, its rows report this.
        let digest = digest_of(file).unwrap_or_else(|_| "none".to_owned());
        let name = file.file_name().unwrap_or_default();
        let _ = writeln!(text, "hand {} {name:?}: {digest}", i + 1);
    }
    text
}

/// The digest of a file, which may be long.
fn digest_of(file: &Path) -> Result<String, String> {
    let mut file = stiction_scene::text::open(file, HandPath::LONGEST)?;
    let mut digest = Sha256::new();
    io::copy(&mut file, &mut digest).map_err(|error| error.to_string())?;
    Ok(format!("{:x}", digest.finalize()))
}
