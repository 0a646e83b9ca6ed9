//! Compares stiction with a physics engine: the same scenes and the same hand, in one run; prints a table.
//!
//! ```sh
//! cargo bench -p stiction-lab --features rivals               # the table
//! cargo bench -p stiction-lab --features rivals -- --write    # also writes it into the README
//! ```
//!
//! Under `cargo test --benches` a short run shows that everything works.

mod case;
mod engine;
mod measure;
mod rapier;
mod table;

use std::time::Duration;

use case::Case;
use engine::{Engine, Stiction};
use measure::{Findings, observe, statics, time};
use rapier::Rapier;
use stiction_host_sim::trade::machine::processor;
use stiction_lab::markdown::Destination;
use table::{Row, Setting};

/// Name in the table and bundled scene.
const SCENES: [(&str, &str); 3] = [
    ("vertex", "vertex-stick-slip"),
    ("ladder", "ladder"),
    ("edge", "box-flat"),
];

/// The amount of work in a run.
#[derive(Clone, Copy)]
struct Effort {
    repeats: usize,
    /// The drag has at most this many frames.
    frames: usize,
}

const FULL: Effort = Effort {
    repeats: 30,
    frames: usize::MAX,
};
const SHORT: Effort = Effort {
    repeats: 1,
    frames: 100,
};

/// An engine in a case that has not run yet.
struct Entry {
    case: Case,
    engine: String,
    is_rival: bool,
    time: fn(&Case) -> Vec<Duration>,
    observe: fn(&Case) -> Findings,
}

impl Entry {
    fn of<E: Engine>(case: &Case, is_rival: bool) -> Self {
        Self {
            case: case.clone(),
            engine: E::name(),
            is_rival,
            time: time::<E>,
            observe: observe::<E>,
        }
    }

    fn row(&self, best: &[Duration]) -> Row {
        let findings = (self.observe)(&self.case);
        let statics = statics(&self.case, findings.pressed);
        let whole: Duration = best.iter().sum();
        Row {
            scene: self.case.name,
            engine: self.engine.clone(),
            is_rival: self.is_rival,
            friction: self.case.friction(),
            time: whole.as_secs_f64() / self.case.drag.len() as f64,
            error: self.case.distance(findings.held, statics),
            findings,
        }
    }
}

/// Every engine in every case. The runs of one entry are spread over the whole time, so that a disturbance affects all
/// entries alike.
fn rows(effort: Effort) -> Vec<Row> {
    let mut entries = Vec::new();
    for (name, file) in SCENES {
        let two = Case::new(name, file, effort.frames);
        let one = two.with_one_coefficient();
        entries.push(Entry::of::<Rapier>(&one, true));
        entries.push(Entry::of::<Stiction>(&one, false));
        entries.push(Entry::of::<Stiction>(&two, false));
    }
    let mut best: Vec<_> = entries
        .iter()
        .map(|entry| (entry.time)(&entry.case))
        .collect();
    for _ in 1..effort.repeats {
        for (entry, best) in entries.iter().zip(&mut best) {
            for (best, now) in best.iter_mut().zip((entry.time)(&entry.case)) {
                *best = now.min(*best);
            }
        }
    }
    let rows = entries.iter().zip(&best);
    rows.map(|(entry, best)| entry.row(best)).collect()
}

/// Whether this entry's name contains one of the names on the command line, if there are any.
fn is_asked_for(arguments: &[String]) -> bool {
    let mut names = arguments
        .iter()
        .filter(|argument| !argument.starts_with('-'));
    let asks = |name: &String| "rivals".contains(name.as_str());
    names.clone().next().is_none() || names.any(asks)
}

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let has = |flag: &str| arguments.iter().any(|argument| argument == flag);
    if has("--list") {
        println!("rivals: benchmark");
        return Ok(());
    }
    if !is_asked_for(&arguments) {
        return Ok(());
    }
    // cargo passes --bench only under `cargo bench`.
    let full = has("--bench") && !has("--test");
    let effort = if full { FULL } else { SHORT };
    let setting = Setting {
        processor: processor(),
        repeats: effort.repeats,
    };
    let rows = rows(effort);
    let text = table::markdown(&rows, &setting);
    if !full {
        println!(
            "rivals: ok, too short to be measured; `cargo bench -p stiction-lab --features rivals` gives the table"
        );
        return Ok(());
    }
    let write = has("--write");
    Destination { write }.put("host-sim/lab/README.md", "rivals", &text)
}
