//! Rows as text in columns.

use crate::columns::aligned;

use super::accuracy::Spread;
use super::chip::Chip;
use super::measure::Row;
use super::setting::{FINEST, Memory};

/// A table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// The names of the columns.
    pub header: Vec<String>,
    /// The cells.
    pub rows: Vec<Vec<String>>,
}

/// Number of text columns on the left.
pub const WORDS: usize = 3;

impl Table {
    /// Accuracy and time on this computer.
    pub(super) fn of(rows: &[Row]) -> Self {
        let header = [
            "number",
            "evolution",
            "memory (L)",
            "Hz",
            "error (µm)",
            "error (mrad)",
            "worst residual",
            "other state (%)",
            "slips",
            "+/−",
            "ns per frame",
        ];
        let cells = |row: &Row| {
            let accuracy = &row.accuracy;
            let percent = |count| figure(accuracy.percent(count));
            let mut cells = names(row).to_vec();
            cells.extend([
                spread(accuracy.position),
                spread(accuracy.angle),
                format!("{:.1e}", accuracy.residual),
                percent(accuracy.other_state),
                accuracy.reference_slips.to_string(),
                format!("{} / {}", accuracy.slips_too_many, accuracy.slips_too_few),
                format!("{:.0}", row.cost.host),
            ]);
            cells
        };
        Self {
            header: header.map(str::to_owned).to_vec(),
            rows: rows.iter().map(cells).collect(),
        }
    }

    /// Instructions or cycles, time and memory on an emulated chip (of [`Chip::ALL`]); `None` if nothing was counted on it.
    pub(super) fn of_chip(rows: &[Row], chip: usize) -> Option<Self> {
        let its = Chip::ALL.get(chip)?;
        let per_frame = format!("{} per frame", its.unit());
        let header = [
            "number",
            "evolution",
            "memory (L)",
            "Hz",
            &per_frame,
            "worst frame",
            "µs per frame",
            "worst (µs)",
            "flash (bytes)",
            "state (bytes)",
            "stack (bytes)",
        ];
        let cells = |row: &Row| {
            let counted = row.cost.emulated[chip]?;
            let time = |counted| figure(its.microseconds(counted));
            let mut cells = names(row).to_vec();
            cells.extend([
                format!("{:.0}", counted.mean),
                counted.worst.to_string(),
                time(counted.mean),
                time(f64::from(counted.worst)),
                counted.flash.to_string(),
                counted.state.to_string(),
                counted.stack.to_string(),
            ]);
            Some(cells)
        };
        let rows: Vec<_> = rows.iter().filter_map(cells).collect();
        (!rows.is_empty()).then(|| Self {
            header: header.map(str::to_owned).to_vec(),
            rows,
        })
    }

    /// The cost of each number type and evolution with the default memory length, at the rate of the reference.
    pub(super) fn short(rows: &[Row]) -> Self {
        let header = [
            "number",
            "evolution",
            "chip, emulated",
            "error (µm)",
            "ns per frame",
            "instructions, mean / worst",
            "its time (µs)",
            "flash, stack (bytes)",
        ];
        let cells = |row: &Row| {
            let [number, evolution, ..] = names(row);
            let counted = Chip::ALL.iter().zip(row.cost.emulated);
            let mut counted = counted.filter_map(|(chip, counted)| Some((chip, counted?)));
            let [chip, instructions, its_time, memory] = match counted.next() {
                Some((chip, counted)) => {
                    let [mean, worst] = [counted.mean, f64::from(counted.worst)]
                        .map(|counted| figure(chip.microseconds(counted)));
                    [
                        format!("{} at {} MHz", chip.name(), chip.megahertz()),
                        format!("{:.0} / {}", counted.mean, counted.worst),
                        format!("{mean} / {worst}"),
                        format!("{}, {}", counted.flash, counted.stack),
                    ]
                }
                None => Default::default(),
            };
            let error = spread(row.accuracy.position);
            let time = format!("{:.0}", row.cost.host);
            [
                number,
                evolution,
                chip,
                error,
                time,
                instructions,
                its_time,
                memory,
            ]
            .to_vec()
        };
        let usual = |row: &&Row| row.rate == FINEST && row.setting.memory == Memory::DEFAULT;
        Self {
            header: header.map(str::to_owned).to_vec(),
            rows: rows.iter().filter(usual).map(cells).collect(),
        }
    }

    pub(super) fn text(&self) -> String {
        let lines: Vec<_> = (std::iter::once(&self.header).chain(&self.rows))
            .cloned()
            .collect();
        let line = |cells: &Vec<String>| format!("  {}\n", cells.join("  ").trim_end());
        aligned(&lines, WORDS).iter().map(line).collect()
    }
}

fn names(row: &Row) -> [String; 4] {
    let setting = &row.setting;
    [
        setting.number.name().to_owned(),
        setting.evolution.name().to_owned(),
        setting.memory.name.to_owned(),
        row.rate.to_string(),
    ]
}

/// The bounds that 50, 90 and 99 % of the frames satisfy.
fn spread(spread: Spread) -> String {
    [spread.p50, spread.p90, spread.p99].map(figure).join(" / ")
}

/// A number to two significant digits.
pub(super) fn figure(value: f64) -> String {
    let digits = |value: f64| 1 - value.log10().floor() as i32;
    match value {
        0.0 => "0".to_owned(),
        value if value < 1e-3 => format!("{value:.0e}"),
        value => format!("{value:.*}", usize::try_from(digits(value)).unwrap_or(0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_two_digits() {
        let figures = [0.0, 3.2e-7, 0.0123, 0.56, 1.0, 9.96, 123.4, 12345.0].map(figure);
        let expected = ["0", "3e-7", "0.012", "0.56", "1.0", "10.0", "123", "12345"];
        assert_eq!(figures, expected);
    }
}
