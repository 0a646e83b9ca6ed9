//! The table.

use stiction_host_sim::trade::machine::processor;
use stiction_lab::markdown::Table;

use crate::measure::Findings;

/// One row: an engine in a case.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) scene: &'static str,
    pub(crate) engine: String,
    pub(crate) friction: String,
    /// Mean time of a frame (s).
    pub(crate) time: f64,
    /// Distance of the held pose from the statics (m).
    pub(crate) error: f64,
    pub(crate) findings: Findings,
}

const COLUMNS: &str = "scene | engine | mu | ns per frame: | pose error (mm): | creep in 1 s (mm): | slips: | mean slip (mm): | \
    allocations per frame:";

/// All of it; of so many runs, the best time counts.
pub(crate) fn markdown(rows: &[Row], repeats: usize) -> String {
    let mut table = Table::new(COLUMNS);
    rows.iter().for_each(|row| table.row(row.cells()));
    format!(
        "Written by `cargo bench -p stiction-lab --features rivals -- --write`: measured in one run on {}, one thread, both engines in f32, \
         each stretch of 100 frames at its best of {repeats} runs.\n\n{table}",
        processor()
    )
}

impl Row {
    fn cells(&self) -> [String; 9] {
        let slips = &self.findings.slips;
        let mean = 1e3 * slips.iter().sum::<f64>() / slips.len().max(1) as f64;
        [
            self.scene.to_owned(),
            self.engine.clone(),
            self.friction.clone(),
            format!("{:.0}", 1e9 * self.time),
            format!("{:.4}", 1e3 * self.error),
            scientific(1e3 * self.findings.creep),
            slips.len().to_string(),
            if slips.is_empty() {
                "-".to_owned()
            } else {
                format!("{mean:.3}")
            },
            format!("{:.1}", self.findings.allocations),
        ]
    }
}

/// One digit and a power of ten; 0 if it is exactly that.
fn scientific(value: f64) -> String {
    if value == 0.0 {
        "0".to_owned()
    } else {
        format!("{value:.0e}")
    }
}
