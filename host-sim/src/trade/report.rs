//! The results as files and text: CSV, JSON, the terminal's table, and the parts of the section of a README.

use std::io;

use serde_json::{Map, Value, json};

use super::chip::Chip;
use super::cost::REPEATS;
use super::measure::Row;
use super::place::Place;
use super::setting::FINEST;
use super::table::Table;

/// The reference of the errors.
fn reference() -> String {
    format!("f64 with path evolution at {FINEST} Hz")
}

/// The measurements and their conditions.
#[derive(Clone, Debug)]
pub struct Report {
    /// The processor of this computer.
    pub machine: String,
    /// The scenes in words.
    pub(super) scenes: String,
    /// For every combination, the row over all scenes and one for each group.
    pub(super) rows: Vec<Row>,
    /// Recommendations.
    pub advice: Vec<String>,
}

impl Report {
    pub(super) fn overall(&self) -> Vec<Row> {
        let rows = self.rows.iter().filter(|row| row.group.is_none());
        rows.copied().collect()
    }

    pub(super) fn csv(&self) -> io::Result<Vec<u8>> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let columns: Vec<_> = self.rows.iter().map(Row::columns).collect();
        if let Some(first) = columns.first() {
            writer.write_record(first.iter().map(|(name, _)| name))?;
        }
        for row in &columns {
            writer.write_record(row.iter().map(|(_, value)| match value {
                Value::Null => String::new(),
                Value::String(text) => text.clone(),
                other => other.to_string(),
            }))?;
        }
        writer.into_inner().map_err(|error| error.into_error())
    }

    pub(super) fn json(&self) -> Vec<u8> {
        let row = |row: &Row| Value::Object(row.columns().into_iter().collect::<Map<_, _>>());
        let report = json!({
            "machine": self.machine,
            "scenes": self.scenes,
            "rows": self.rows.iter().map(row).collect::<Vec<_>>(),
            "advice": self.advice,
        });
        format!("{report:#}\n").into_bytes()
    }

    /// The text above the table.
    pub fn caption(&self) -> String {
        let emulated = match Place::of(&self.rows).len() {
            ..2 => "",
            _ => {
                " Emulated: the bundled scenes only; one solver for all of them, with the room and the parts that they need, \
                 built for speed, of which all figures of a row are. Instructions, of the M0+ cycles: of a frame, mean and worst of \
                 all frames, the start not counted; their time from the clock of the chip and the cycles of an instruction, which \
                 are an estimate but for the M0+; flash: what the solver adds to an image; stack: the deepest below the caller."
            }
        };
        format!(
            "Measured on {}. Scenes: {}. Memory: the memory length of every surface, in parts of the body's largest vertex \
             distance L; 2^-12 is the one of a scene that gives none, 0 the shortest that the solver takes; a point keeps its own. \
             Errors: 50 / 90 / 99 % of all frames of whole runs are within this distance of the body's origin, and this angle, from \
             {} and the same memory length, in SI units as the scenes are; a frame that falls \
             between two of the reference is compared with one step more of it. Worst residual: the largest unbalanced force of a \
             scene / its largest force, or moment / (that force · L); the force is taken as at least 1e-3 k_h L. Other state: \
             frames in another contact state than the reference. Slips: of the reference; +/−: sum over the scenes that slip more \
             often than it / less often. Time: mean of a frame on this computer, best of {REPEATS} runs.{emulated}",
            self.machine,
            self.scenes,
            reference()
        )
    }

    /// For the terminal: the recommendation.
    pub(super) fn recommendation(&self) -> String {
        format!(
            "Which setting to take, measured on {}. Scenes: {}. Error: the distance from where {} has the body.\n\n{}\n\n",
            self.machine,
            self.scenes,
            reference(),
            self.advice.join("\n"),
        )
    }

    /// For the terminal: all measurements.
    pub(super) fn table(&self) -> String {
        let mut text = format!("{}\n\n", self.caption());
        for (heading, table) in self.tables() {
            if let Some(heading) = heading {
                text += &format!("\n{heading}:\n");
            }
            text += &table.text();
        }
        text + "\n"
    }

    /// The tables: that of this computer, and one for each chip with counts, with its heading.
    pub fn tables(&self) -> Vec<(Option<String>, Table)> {
        let rows = self.overall();
        let chips = Chip::ALL.iter().enumerate();
        let chips =
            chips.filter_map(|(k, chip)| Some((Some(chip.timing()), Table::of_chip(&rows, k)?)));
        std::iter::once((None, Table::of(&rows)))
            .chain(chips)
            .collect()
    }

    /// The cost of each number type and evolution, in a few rows.
    pub fn short(&self) -> Table {
        Table::short(&self.overall())
    }

    /// The places with a cost: the name of each, and the name of its picture.
    pub fn pictures(&self) -> Vec<(&'static str, String)> {
        let places = Place::of(&self.rows).into_iter();
        places
            .map(|place| {
                let [svg, _] = place.pictures();
                (place.name(), svg)
            })
            .collect()
    }
}
