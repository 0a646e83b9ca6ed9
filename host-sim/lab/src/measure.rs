//! The time of a frame and the slips of the dragged box, the worst residuals of random scenes, and the range of every number type.

use std::fmt::Write as _;
use std::io;
use std::time::Instant;
use stiction_core::{Evolution, Fixed, Status};
use stiction_host_sim::trade::machine::processor;
use stiction_tests::extremes::{Outcome, SWEEPS, Sweep, outcome};
use stiction_tests::laws::{judge, worst};
use stiction_tests::random::scenarios;
use stiction_tests::run::{Run, planar, run};
use stiction_tests::{Number, Scenario, scenes};

use crate::markdown::{Destination, Table};

/// 0.1 m at 0.02 m/s and 1 kHz.
const FRAMES: usize = 5000;
const REPEATS: usize = 20;

/// The best of several runs: mean time of one frame (ns), number of slips, and their mean length (mm).
fn drag<R: Number>(scenario: &Scenario, evolution: Evolution) -> (f64, u32, f64) {
    let hands = scenario.hands(FRAMES);
    let (pressing, dragging) = hands.split_at(FRAMES + 1);
    let mut start = Run::<R>::start(&scenario.setup, evolution, hands[0]);
    for &hand in pressing {
        start.step(hand);
    }
    let dragging: Vec<_> = dragging.iter().map(|&hand| planar::<R>(hand)).collect();
    let (mut best, mut slips, mut length) = (f64::MAX, 0, 0.0);
    for _ in 0..REPEATS {
        let mut state = start.state.clone();
        let before = Instant::now();
        let mut last = 0;
        for &hand in &dragging {
            last += start.solver.step(&mut state, hand).slips;
        }
        best = best.min(before.elapsed().as_nanos() as f64 / dragging.len() as f64);
        slips = last;
    }
    let mut state = start.state.clone();
    for &hand in &dragging {
        let output = start.solver.step(&mut state, hand);
        if output.slips > 0 {
            length += R::wide(output.longest_slip);
        }
    }
    (best, slips, 1e3 * length / f64::from(slips.max(1)))
}

fn drags(text: &mut String) {
    let box_scenes = [
        ("on a vertex, 30°", scenes::box_on_a_vertex()),
        ("flat", scenes::box_flat()),
    ];
    let mut table =
        Table::new("scene | number | evolution | ns per frame, mean: | slips: | mean slip (mm):");
    for (name, scenario) in &box_scenes {
        for evolution in Evolution::ALL {
            for (number, (time, slips, length)) in [
                ("f32", drag::<f32>(scenario, evolution)),
                ("f64", drag::<f64>(scenario, evolution)),
                ("fixed", drag::<Fixed>(scenario, evolution)),
            ] {
                let evolution = evolution.name().to_owned();
                let words = [(*name).to_owned(), number.to_owned(), evolution];
                let figures = [
                    format!("{time:.0}"),
                    slips.to_string(),
                    format!("{length:.3}"),
                ];
                table.row(words.into_iter().chain(figures));
            }
        }
    }
    let _ = write!(
        text,
        "The box 0.10 m × 0.06 m (k_h 500, k_theta 0.5, mu 0.5 / 0.3), pressed 10 mm deep, dragged 0.1 m at 0.02 m/s, 1 kHz:\n\n{table}"
    );
}

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

fn ranges(text: &mut String) {
    let mut table = Table::new("parameter | tried | f64 | f32 | fixed");
    let intro = "\nValues for which a number type keeps its error bound (worst residual f64 1e-9, f32 and fixed 1e-4) on every frame, by parameter; \
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
    let _ = write!(text, "{intro}\n\n{table}");
}

/// Measures all of it.
///
/// # Errors
/// The document cannot be written.
pub fn measure(output: Destination) -> io::Result<()> {
    let mut text = format!(
        "Written by `cargo run --profile bench -p stiction-lab -- measure --write`, on {}.\n\n",
        processor()
    );
    drags(&mut text);
    let mut table =
        Table::new("number | evolution | frames: | unlawful: | status not ok: | worst residual:");
    for evolution in Evolution::ALL {
        survey::<f32>(evolution, &mut table);
        survey::<f64>(evolution, &mut table);
        survey::<Fixed>(evolution, &mut table);
    }
    let _ = write!(
        text,
        "\n1000 random scenes, 200 frames each; residual: the largest unbalanced force / largest force, or moment / (largest\n\
         force · L), of any frame:\n\n{table}"
    );
    ranges(&mut text);
    output.put("tests/README.md", "measured", &text)
}
