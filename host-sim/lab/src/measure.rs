//! The worst residuals of random scenes, and the range of every number type.

use std::collections::BTreeMap;
use std::io;

use stiction_core::{Evolution, Fixed, Status};
use stiction_host_sim::columns::thousands;
use stiction_tests::Number;
use stiction_tests::extremes::{Outcome, SWEEPS, Sweep, outcome};
use stiction_tests::laws::{judge, worst};
use stiction_tests::obstacles::survey::{Kind, look};
use stiction_tests::obstacles::worlds::FRAMES;
use stiction_tests::random::scenarios;
use stiction_tests::run::run;

use crate::markdown::{Destination, Table};

/// Random scenes among obstacles.
const WORLDS: u64 = 1000;

fn survey<R: Number>(evolution: Evolution, table: &mut Table) {
    let (mut frames, mut limited, mut broken) = (0, 0, 0);
    let mut residual = 0.0_f64;
    for scenario in scenarios(1000, 4) {
        for frame in run::<R>(&scenario.setup, evolution, &scenario.hands(50)) {
            frames += 1;
            limited += u32::from(frame.status != Status::Ok);
            let findings = judge::<R>(&scenario.setup, &frame);
            broken += u32::from(!worst(findings.iter().copied()).holds());
            let balance = findings.iter().filter(|f| f.law.ends_with("balance"));
            residual = balance.fold(residual, |most, f| most.max(f.residual));
        }
    }
    let words = [R::NAME, evolution.name()].map(str::to_owned);
    let counts = [frames, broken, limited].map(|count: u32| count.to_string());
    let residual = format!("{residual:.1e}");
    table.row(words.into_iter().chain(counts).chain([residual]));
}

/// Adds a row: the frames among obstacles of a number type that break a law, and the statuses that occur.
fn among_obstacles<R: Number>(evolution: Evolution, table: &mut Table) {
    let (mut unlawful, mut statuses) = (0, BTreeMap::new());
    for number in 0..WORLDS {
        let report = look::<R>((Kind::Worlds, number), evolution);
        unlawful += report.unlawful.len();
        for (name, count) in report.statuses {
            *statuses.entry(name).or_insert(0) += count;
        }
    }
    let statuses: Vec<String> = (statuses.iter())
        .map(|(name, count)| format!("{name} {count}"))
        .collect();
    let words = [R::NAME, evolution.name()].map(str::to_owned);
    let frames = thousands(WORLDS * FRAMES as u64);
    table.row((words.into_iter()).chain([frames, unlawful.to_string(), statuses.join(", ")]));
}

/// A summary of how a number type handles the values of a sweep, in both evolutions: where it keeps its bound, and what
/// happens at the other values.
fn range<R: Number>(sweep: &Sweep) -> String {
    let outcomes = sweep.values.iter().map(|&value| {
        let both = Evolution::ALL.map(|evolution| outcome::<R>(sweep, value, evolution));
        let verdict = |o: &Outcome| match o {
            Outcome::Holds { .. } => (0, "holds".to_string()),
            Outcome::Refused(_) => (1, "refused".to_string()),
            Outcome::Says(status) => (2, status.name().to_string()),
            Outcome::Broken(_) => (3, "**broken**".to_string()),
        };
        let [path, frame] = both.each_ref().map(verdict);
        (value, path.max(frame).1)
    });
    let mut parts: Vec<(f64, f64, String)> = Vec::new();
    for (value, verdict) in outcomes {
        match parts.last_mut() {
            Some((_, to, last)) if *last == verdict => *to = value,
            _ => parts.push((value, value, verdict)),
        }
    }
    let said = parts
        .iter()
        .map(|(from, to, verdict)| match verdict.as_str() {
            "holds" if parts.len() == 1 => "all".to_string(),
            "holds" => format!("{from} to {to}"),
            _ if from == to => format!("{verdict} at {from}"),
            _ => format!("{verdict} from {from} to {to}"),
        });
    said.collect::<Vec<_>>().join("; ")
}

fn ranges() -> String {
    let mut table = Table::new("parameter | tried | f64 | f32 | fixed");
    let intro = "Values for which a number type keeps its error bound (worst residual f64 1e-9, f32 and fixed 1e-4) on every frame, by parameter; \
         for other\nvalues the scene is refused, or the status of the frames reports it:";
    for sweep in SWEEPS {
        let (Some(from), Some(to)) = (sweep.values.first(), sweep.values.last()) else {
            continue;
        };
        let [double, single, fixed] = [
            range::<f64>(sweep),
            range::<f32>(sweep),
            range::<Fixed>(sweep),
        ];
        let tried = format!("{from} to {to}");
        table.row([sweep.name.to_owned(), tried, double, single, fixed]);
    }
    format!("{intro}\n\n{table}")
}

/// Measures both.
///
/// # Errors
/// The document cannot be written.
pub fn measure(output: Destination) -> io::Result<()> {
    let mut table =
        Table::new("number | evolution | frames: | unlawful: | status not ok: | worst residual:");
    for evolution in Evolution::ALL {
        survey::<f32>(evolution, &mut table);
        survey::<f64>(evolution, &mut table);
        survey::<Fixed>(evolution, &mut table);
    }
    let mut obstacles = Table::new("number | evolution | frames: | unlawful: | status not ok");
    for evolution in Evolution::ALL {
        among_obstacles::<f32>(evolution, &mut obstacles);
        among_obstacles::<f64>(evolution, &mut obstacles);
        among_obstacles::<Fixed>(evolution, &mut obstacles);
    }
    let text = format!(
        "Written by `cargo run --release -p stiction-lab -- measure --write`: 1000 random scenes, 200 frames each; residual: the largest\n\
         unbalanced force / largest force, or moment / (largest force · L), of any frame:\n\n{table}\n{}\n\
         {WORLDS} random scenes among obstacles:\n\n{obstacles}",
        ranges()
    );
    output.put("tests/README.md", "measured", &text)
}
