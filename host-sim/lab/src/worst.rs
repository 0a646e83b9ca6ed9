//! Measures the cost of single frames of ordinary haptic use, counted in operations on numbers: quantiles over all frames, and the states
//! before and after the most expensive ones.

use std::collections::BTreeMap;
use std::io;

use stiction_core::{Evolution, Solver, StateKind};
use stiction_host_sim::columns::thousands;
use stiction_tests::counted::{Counted, counted};
use stiction_tests::haptic::measures::Samples;
use stiction_tests::haptic::{Kind, scenes};
use stiction_tests::run::planar;
use stiction_tests::setup::{SURFACES, VERTICES};

use crate::markdown::{Destination, Table};

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
        let scene = scenario.setup.scene_of::<Counted, VERTICES, SURFACES, 0>();
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

/// Measures so many scenes of each kind.
///
/// # Errors
/// The document cannot be written.
pub fn worst(count: usize, output: Destination) -> io::Result<()> {
    let mut table = Table::new(
        "kind | evolution | frames: | mean: | 50 %: | 99 %: | 99.9 %: | 99.99 %: | most: | most expensive",
    );
    for kind in Kind::ALL {
        for evolution in Evolution::ALL {
            let costs = costs(kind, evolution, count);
            let mut samples = Samples::default();
            for cost in &costs {
                samples.add(cost.operations as f64);
            }
            let mut cells = vec![
                kind.name().to_owned(),
                evolution.name().to_owned(),
                thousands(costs.len() as u64),
                format!("{:.0}", samples.mean()),
            ];
            cells.extend(QUANTILES.map(|part| thousands(samples.quantile(part) as u64)));
            cells.push(dearest(&costs, samples.quantile(DEAREST) as u64));
            table.row(cells);
        }
    }
    let text = format!(
        "Written by `cargo run --release -p stiction-lab -- worst --write`: operations on numbers per frame in {count} scenes of \
         ordinary haptic\nuse of each kind, and the states before and after the most expensive of ten thousand frames:\n\n{table}"
    );
    output.put("tests/README.md", "worst", &text)
}
