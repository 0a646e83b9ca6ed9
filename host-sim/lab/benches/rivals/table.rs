//! The table and the text below it.

use stiction_lab::markdown::Table;

use crate::measure::Findings;

/// One row: an engine in a case.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// The case.
    pub(crate) scene: &'static str,
    /// Name and version of the engine.
    pub(crate) engine: String,
    /// Whether it is the other engine, not this repository's.
    pub(crate) is_rival: bool,
    /// The coefficients of friction.
    pub(crate) friction: String,
    /// Mean time of a frame (s).
    pub(crate) time: f64,
    /// Distance of the held pose from the statics (m).
    pub(crate) error: f64,
    /// The other results.
    pub(crate) findings: Findings,
}

/// The conditions of the measurement.
pub(crate) struct Setting {
    /// The processor's name.
    pub(crate) processor: String,
    /// The number of runs, of which the best time counts.
    pub(crate) repeats: usize,
}

const COLUMNS: &str = "scene | engine | mu | ns per frame: | pose error (mm): | creep in 1 s (mm): | slips: | mean slip (mm): | \
    allocations per frame:";
/// Width of the text.
const WIDTH: usize = 118;

/// All of it.
pub(crate) fn markdown(rows: &[Row], setting: &Setting) -> String {
    let mut table = Table::new(COLUMNS);
    rows.iter().for_each(|row| table.row(row.cells()));
    let mut text = format!(
        "Written by `cargo bench -p stiction-lab --features rivals -- --write`.\n\n{table}"
    );
    for paragraph in words(rows, setting) {
        text.push('\n');
        text.push_str(&wrapped(&paragraph, WIDTH));
    }
    text
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

/// What the table shows, and what it does not show.
fn words(rows: &[Row], setting: &Setting) -> [String; 4] {
    [
        how(rows, setting),
        "rapier2d has one coefficient of friction; it gets mu_s. With one coefficient, statics has no stick-slip: the body breaks \
         away once and slides along. rapier2d is tuned, as the comments in \
         host-sim/lab/benches/rivals/rapier.rs describe; its remaining pose error is mostly due to momentum: a body with mass slides on when \
         the hand stops, as a real one does."
            .to_owned(),
        format!(
            "Strengths of rapier2d: many bodies that move, collide and stack; any shape; joints; impacts and free flight; two and \
             three dimensions; years of use. Tuned, it holds a pose: its largest creep here is {} mm in a second (stiction: {}). For \
             a world of many bodies it is the right tool, and stiction is not: it simulates one held convex body between fixed half-planes.{}",
            most_creep(rows, true),
            most_creep(rows, false),
            slower(rows),
        ),
        "Strengths of stiction over rapier2d: two coefficients of friction, so slips of the right number and length; a balance \
         that needs no choice of mass, damping, contact stiffness and iterations, in which a body at rest stays to the last bit without being \
         tuned; no heap."
            .to_owned(),
    ]
}

fn how(rows: &[Row], setting: &Setting) -> String {
    let mut engines: Vec<_> = rows.iter().map(|row| row.engine.as_str()).collect();
    engines.sort_unstable();
    engines.dedup();
    format!(
        "Measured in one run on {}, one thread: {}, both in f32. The scenes are the bundled vertex-stick-slip, ladder and box-flat: \
         the hand presses the body down, drags it at 1 kHz (this is timed: the hand's pose in, the body's pose and the contact \
         forces out; each stretch of 100 frames at its best of {} runs) and stops. Pose error: one second later, the largest distance \
         of a vertex from its position according to statics with the same friction, followed from the pressed pose by the slow reference in \
         `tests`. Creep: the largest displacement of a vertex in the following second. A slip is a motion of the foot along the floor that ends while \
         the hand still moves.",
        setting.processor,
        engines.join(" and "),
        setting.repeats,
    )
}

fn most_creep(rows: &[Row], of_rival: bool) -> String {
    let those = rows.iter().filter(|row| row.is_rival == of_rival);
    scientific(1e3 * those.map(|row| row.findings.creep).fold(0.0, f64::max))
}

/// A sentence about the cases in which the rival needs less time; empty if there are none.
fn slower(rows: &[Row]) -> String {
    let beaten = |row: &&Row| {
        let mut rivals = rows.iter().filter(|rival| rival.is_rival);
        !row.is_rival && rivals.any(|rival| rival.scene == row.scene && rival.time < row.time)
    };
    let places: Vec<_> = (rows.iter().filter(beaten))
        .map(|row| format!("{} with mu {}", row.scene, row.friction))
        .collect();
    if places.is_empty() {
        String::new()
    } else {
        format!(" It is also the faster engine for: {}.", places.join(", "))
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

/// Lines of at most `width` characters.
fn wrapped(text: &str, width: usize) -> String {
    let (mut lines, mut length) = (String::new(), 0);
    for word in text.split_whitespace() {
        if length > 0 && length + 1 + word.len() > width {
            lines.push('\n');
            length = 0;
        } else if length > 0 {
            lines.push(' ');
            length += 1;
        }
        lines.push_str(word);
        length += word.len();
    }
    lines + "\n"
}
