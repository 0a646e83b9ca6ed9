//! Measures the cost of single frames of ordinary haptic use, counted in operations on numbers: quantiles over all frames, and the states
//! before and after the most expensive ones. Writes the tables into the README.
//!
//! ```sh
//! cargo run --release -p stiction-tests --example worst          # 100 scenes of each kind
//! cargo run --release -p stiction-tests --example worst -- 20    # another number of scenes, printed only
//! ```

use std::collections::BTreeMap;
use std::env::args;
use std::fmt::Write as _;
use std::path::Path;

use stiction_core::{Evolution, Full, Solver, StateKind};
use stiction_tests::counted::{Counted, counted};
use stiction_tests::haptic::measures::Samples;
use stiction_tests::haptic::{Kind, scenes};
use stiction_tests::run::planar;
use stiction_tests::setup::{SURFACES, VERTICES};
use stiction_tools::readme::Section;
use stiction_tools::table::thousands;

const SCENES: usize = 100;
const QUANTILES: [f64; 5] = [0.5, 0.99, 0.999, 0.9999, 1.0];
/// The frames above this quantile are the most expensive.
const DEAREST: f64 = 0.9999;

/// The cost of a frame, and the states before and after it.
struct Cost {
    operations: u64,
    states: [StateKind; 2],
}

/// The cost of every frame of the scenes of a kind.
fn costs(kind: Kind, evolution: Evolution, count: usize) -> Vec<Cost> {
    let mut costs = Vec::new();
    for scenario in scenes(kind).take(count) {
        let scene = scenario
            .setup
            .scene_of::<Counted, VERTICES, SURFACES, Full>();
        let solver = Solver::new(scene.expect("a sound scene"), evolution);
        let mut hands = scenario.hands(1).into_iter();
        let first = hands.next().expect("a path");
        let (mut state, output) = solver.start(planar::<Counted>(first));
        let mut before = output.state;
        for hand in hands {
            let (output, operations) = counted(|| solver.step(&mut state, planar::<Counted>(hand)));
            costs.push(Cost {
                operations,
                states: [before, output.state],
            });
            before = output.state;
        }
    }
    costs
}

/// The states before and after the most expensive frames, most frequent first.
fn dearest(costs: &[Cost], above: u64) -> String {
    let mut counts = BTreeMap::new();
    for cost in costs.iter().filter(|cost| cost.operations > above) {
        let [before, after] = cost.states.map(StateKind::name);
        let entry: &mut usize = counts.entry(format!("{before} to {after}")).or_default();
        *entry += 1;
    }
    let mut counts: Vec<_> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| usize::MAX - count);
    let words = counts
        .iter()
        .take(4)
        .map(|(name, count)| format!("{name} ({count})"));
    words.collect::<Vec<_>>().join(", ")
}

fn main() -> std::io::Result<()> {
    let asked = args().nth(1).and_then(|count| count.parse().ok());
    let count = asked.unwrap_or(SCENES);
    let mut text = format!(
        "Written by `cargo run --release -p stiction-tests --example worst`: operations on numbers per frame in {count} scenes of \
         ordinary haptic\nuse of each kind, and the states before and after the most expensive of ten thousand frames:\n\n\
         | kind | evolution | frames | mean | 50 % | 99 % | 99.9 % | 99.99 % | most | most expensive |\n\
         |---|---|---:|---:|---:|---:|---:|---:|---:|---|\n"
    );
    for kind in Kind::ALL {
        for evolution in Evolution::ALL {
            let costs = costs(kind, evolution, count);
            let mut samples = Samples::default();
            for cost in &costs {
                samples.add(cost.operations as f64);
            }
            let quantiles = QUANTILES.map(|part| thousands(samples.quantile(part) as u64));
            let above = samples.quantile(DEAREST) as u64;
            let _ = writeln!(
                text,
                "| {} | {} | {} | {:.0} | {} | {} |",
                kind.name(),
                evolution.name(),
                thousands(costs.len() as u64),
                samples.mean(),
                quantiles.join(" | "),
                dearest(&costs, above)
            );
        }
    }
    print!("{text}");
    if asked.is_none() {
        let readme = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md"));
        Section::find(readme, "worst")?.write(&text)?;
    }
    Ok(())
}
