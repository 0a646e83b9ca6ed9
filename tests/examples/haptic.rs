//! Measures whole runs of ordinary haptic use, with scenes of each kind: how far number types, evolutions and frames cut into
//! three differ, the slips, the statuses other than ok, and the states. Prints tables in Markdown.
//!
//! ```sh
//! cargo run --release -p stiction-tests --example haptic -- 200   # scenes of each kind
//! ```

use std::panic::resume_unwind;
use std::process::ExitCode;
use std::thread;
use stiction_core::{Evolution, Fixed, StateKind, Status};
use stiction_tests::haptic::measures::{Comparison, Samples, Tally, led};
use stiction_tests::haptic::{Kind, scenes};
use stiction_tests::{Frame, Scenario};
use stiction_tools::table::{aligned, thousands};

/// The number of scenes of each kind, unless the command line gives another.
const SCENES: usize = 200;
const QUANTILES: [(&str, f64); 5] = [
    ("50 %", 0.5),
    ("90 %", 0.9),
    ("99 %", 0.99),
    ("99.9 %", 0.999),
    ("most", 1.0),
];

/// One variant in which every scene of a kind is run.
struct Way {
    name: &'static str,
    tally: Tally,
    /// The runs that it is compared with, and the result.
    beside: Option<(&'static str, Comparison)>,
}

impl Way {
    fn new(name: &'static str, beside: Option<&'static str>) -> Self {
        Self {
            name,
            tally: Tally::default(),
            beside: beside.map(|name| (name, Comparison::default())),
        }
    }
    fn add(&mut self, scenario: &Scenario, run: &[Frame], reference: &[Frame]) {
        self.tally.add(run);
        if let Some((_, comparison)) = &mut self.beside {
            comparison.add(&scenario.setup, run, reference);
        }
    }
}

/// Every variant for a kind; the first is f64 by path evolution.
fn measure(kind: Kind, count: usize) -> Vec<Way> {
    let reference = Some("f64 path");
    let mut ways = [
        Way::new("f64 path", None),
        Way::new("f32 path", reference),
        Way::new("fixed path", reference),
        Way::new("f64 frame", reference),
        Way::new("f32 frame", reference),
        Way::new("fixed frame", reference),
        Way::new("f64 path, cut in three", reference),
        Way::new("f32 path, cut in three", Some("f32 path")),
    ];
    for scenario in scenes(kind).take(count) {
        let double = led::<f64>(&scenario, Evolution::Path, 1);
        let single = led::<f32>(&scenario, Evolution::Path, 1);
        let runs = [
            led::<Fixed>(&scenario, Evolution::Path, 1),
            led::<f64>(&scenario, Evolution::Frame, 1),
            led::<f32>(&scenario, Evolution::Frame, 1),
            led::<Fixed>(&scenario, Evolution::Frame, 1),
            led::<f64>(&scenario, Evolution::Path, 3),
        ];
        ways[0].add(&scenario, &double, &double);
        ways[1].add(&scenario, &single, &double);
        for (way, run) in ways[2..7].iter_mut().zip(&runs) {
            way.add(&scenario, run, &double);
        }
        let cut = led::<f32>(&scenario, Evolution::Path, 3);
        ways[7].add(&scenario, &cut, &single);
    }
    ways.into()
}

type Kinds = [(Kind, Vec<Way>)];

/// The rows of a table: kind, variant and its cells; a variant without cells has no row.
fn rows(
    kinds: &mut Kinds,
    mut cells: impl FnMut(&mut Way) -> Option<Vec<String>>,
) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for (kind, ways) in kinds {
        for way in ways {
            if let Some(cells) = cells(way) {
                let names = [kind.name().to_owned(), way.name.to_owned()];
                rows.push(names.into_iter().chain(cells).collect());
            }
        }
    }
    rows
}

/// Prints a table whose columns are numbers, after kind, variant and `words` more columns.
fn print(
    title: &str,
    words: usize,
    head: impl IntoIterator<Item = String>,
    rows: Vec<Vec<String>>,
) {
    let names = ["kind", "run"].map(str::to_owned).into_iter();
    let head: Vec<String> = names.chain(head).collect();
    let words = words + 2;
    let rule = |k| if k < words { "---" } else { "---:" }.to_owned();
    let rule = (0..head.len()).map(rule).collect();
    let lines: Vec<_> = [head, rule].into_iter().chain(rows).collect();
    println!("\n{title}\n");
    for line in aligned(&lines, words) {
        println!("| {} |", line.join(" | "));
    }
}

fn errors(kinds: &mut Kinds) {
    let rows = rows(kinds, |way| {
        let (against, comparison) = way.beside.as_mut()?;
        let mut cells = vec![against.to_string()];
        let mut add = |samples: &mut Samples, form: fn(f64) -> String| {
            cells.extend(QUANTILES.map(|(_, part)| form(samples.quantile(part))));
        };
        add(&mut comparison.errors, |x| format!("{x:.1e}"));
        add(&mut comparison.metres, |x| format!("{:.3}", 1e6 * x));
        Some(cells)
    });
    let columns = |unit| QUANTILES.map(|(name, _)| format!("{name} ({unit})"));
    let head = ["against".to_owned()]
        .into_iter()
        .chain(columns("L"))
        .chain(columns("µm"));
    let title = "Distance of the poses in the frames in which the body touches in either run:";
    print(title, 1, head, rows);
}

fn slips(kinds: &mut Kinds) {
    let rows = rows(kinds, |way| {
        let slips = &mut way.tally.slips;
        let mut cells = vec![
            thousands(slips.sum() as u64),
            format!("{:.4}", slips.mean()),
        ];
        cells.extend([0.9999, 1.0].map(|part| slips.quantile(part).to_string()));
        Some(cells)
    });
    let head = ["slips", "mean", "99.99 %", "most"].map(str::to_owned);
    print("Slips of all runs and of one frame:", 0, head, rows);
}

fn statuses(kinds: &mut Kinds) {
    let graver = &Status::ALL[1..];
    let rows = rows(kinds, |way| {
        let share = |&status| match way.tally.share(status) {
            0.0 => "0".to_owned(),
            share => format!("{share:.1e}"),
        };
        Some(graver.iter().map(share).collect())
    });
    let head = graver.iter().map(|status| status.name().to_owned());
    print("Share of the frames whose status is not ok:", 0, head, rows);
}

fn states(kinds: &mut Kinds) {
    let touching = &StateKind::ALL[1..];
    let rows = rows(kinds, |way| {
        let tally = &way.tally;
        let percent = |share: f64| format!("{:.1} %", 100.0 * share);
        let counts = [thousands(tally.frames), percent(tally.share_in_contact())];
        let shares = touching.iter().map(|&s| percent(tally.share_of_contact(s)));
        way.beside
            .is_none()
            .then(|| counts.into_iter().chain(shares).collect())
    });
    let head = ["frames", "in contact"].into_iter();
    let head = head.chain(touching.iter().map(|state| state.name()));
    let title = "Frames in contact, and shares of them by state:";
    print(title, 0, head.map(str::to_owned), rows);
}

fn main() -> ExitCode {
    let count = match std::env::args().nth(1).map(|text| text.parse()) {
        None => SCENES,
        Some(Ok(count)) => count,
        Some(Err(_)) => {
            eprintln!("haptic: the number of scenes must be a whole number");
            return ExitCode::from(2);
        }
    };
    let mut kinds = thread::scope(|scope| {
        let measured = Kind::ALL.map(|kind| (kind, scope.spawn(move || measure(kind, count))));
        measured.map(|(kind, ways)| {
            (
                kind,
                ways.join().unwrap_or_else(|panic| resume_unwind(panic)),
            )
        })
    });
    println!("{count} scenes of each kind.");
    errors(&mut kinds);
    slips(&mut kinds);
    statuses(&mut kinds);
    states(&mut kinds);
    ExitCode::SUCCESS
}
