//! Compares stiction with a physics engine: the same scenes and the same hand, in one run; prints a table.
//!
//! ```sh
//! cargo bench -p stiction-lab --features rivals               # the table
//! cargo bench -p stiction-lab --features rivals -- --write    # also writes it into the README
//! ```

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
use stiction_lab::markdown::Destination;
use table::Row;

/// Name in the table and bundled scene.
const SCENES: [(&str, &str); 3] = [
    ("vertex", "vertex-stick-slip"),
    ("ladder", "ladder"),
    ("edge", "box-flat"),
];

/// Runs, of which the best time counts.
const REPEATS: usize = 30;

/// An engine in a case that has not run yet.
struct Entry {
    case: Case,
    engine: String,
    time: fn(&Case) -> Vec<Duration>,
    observe: fn(&Case) -> Findings,
}

impl Entry {
    fn of<E: Engine>(case: &Case) -> Self {
        Self {
            case: case.clone(),
            engine: E::name(),
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
            friction: self.case.friction(),
            time: whole.as_secs_f64() / self.case.drag.len() as f64,
            error: self.case.distance(findings.held, statics),
            findings,
        }
    }
}

/// Every engine in every case. The runs of one entry are spread over the whole time, so that a disturbance affects all
/// entries alike.
fn rows() -> Vec<Row> {
    let mut entries = Vec::new();
    for (name, file) in SCENES {
        let two = Case::new(name, file);
        let one = two.with_one_coefficient();
        entries.push(Entry::of::<Rapier>(&one));
        entries.push(Entry::of::<Stiction>(&one));
        entries.push(Entry::of::<Stiction>(&two));
    }
    let mut best: Vec<_> = entries
        .iter()
        .map(|entry| (entry.time)(&entry.case))
        .collect();
    for _ in 1..REPEATS {
        for (entry, best) in entries.iter().zip(&mut best) {
            for (best, now) in best.iter_mut().zip((entry.time)(&entry.case)) {
                *best = now.min(*best);
            }
        }
    }
    let rows = entries.iter().zip(&best);
    rows.map(|(entry, best)| entry.row(best)).collect()
}

fn main() -> std::io::Result<()> {
    let has = |flag: &str| std::env::args().any(|argument| argument == flag);
    // cargo passes it only under `cargo bench`.
    if !has("--bench") {
        return Ok(());
    }
    let text = table::markdown(&rows(), REPEATS);
    let write = has("--write");
    Destination { write }.put("host-sim/lab/README.md", "rivals", &text)
}
