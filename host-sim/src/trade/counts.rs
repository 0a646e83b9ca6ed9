//! The cost of the settings on emulated chips, as the program `lab` of the package `stiction-lab` has counted it: read from the table
//! `trade/chips.csv`, and written there.

use std::error::Error;

use stiction_core::Evolution;

use super::chip::Chip;
use super::cost::Emulated;
use super::measure::Row;
use super::setting::{Memory, Setting};
use super::suite::Group;
use stiction_live::number::{Number, named};

/// The table as it was when the program was built.
const TABLE: &str = include_str!("../../trade/chips.csv");

const HEADER: [&str; 10] = [
    "chip",
    "number",
    "evolution",
    "memory",
    "rate_hz",
    "mean",
    "worst",
    "flash_bytes",
    "state_bytes",
    "stack_bytes",
];

/// The cost of a setting on a chip, at a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Count {
    /// The chip.
    pub chip: Chip,
    /// The setting.
    pub setting: Setting,
    /// Frames per second (Hz).
    pub rate: f64,
    /// Its cost, over the bundled scenes without obstacles.
    pub cost: Emulated,
}

impl Count {
    /// Copies the cost to its rows: that of all scenes, and that of the bundled ones.
    pub(super) fn enter(&self, rows: &mut [Row]) {
        let groups = [None, Some(Group::Bundled)];
        let its_own = rows.iter_mut().filter(|row| {
            (row.setting, row.rate) == (self.setting, self.rate) && groups.contains(&row.group)
        });
        for row in its_own {
            row.cost.emulated[self.chip as usize] = Some(self.cost);
        }
    }

    fn of(record: &csv::StringRecord) -> Result<Self, Box<dyn Error>> {
        let cell = |k: usize| record.get(k).unwrap_or_default();
        let setting = Setting {
            number: named(Number::ALL, Number::name, cell(1))?,
            evolution: named(Evolution::ALL, Evolution::name, cell(2))?,
            memory: named(Memory::ALL, |memory| memory.name, cell(3))?,
        };
        Ok(Self {
            chip: named(Chip::ALL, Chip::key, cell(0))?,
            setting,
            rate: cell(4).parse()?,
            cost: Emulated {
                mean: cell(5).parse()?,
                worst: cell(6).parse()?,
                flash: cell(7).parse()?,
                state: cell(8).parse()?,
                stack: cell(9).parse()?,
            },
        })
    }

    fn record(&self) -> [String; HEADER.len()] {
        let Self {
            chip,
            setting,
            rate,
            cost,
        } = self;
        [
            chip.key().to_owned(),
            setting.number.name().to_owned(),
            setting.evolution.name().to_owned(),
            setting.memory.name.to_owned(),
            rate.to_string(),
            format!("{:.1}", cost.mean),
            cost.worst.to_string(),
            cost.flash.to_string(),
            cost.state.to_string(),
            cost.stack.to_string(),
        ]
    }
}

/// The counts of the table.
///
/// # Errors
/// A line is no count.
pub fn counted() -> Result<Vec<Count>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_reader(TABLE.as_bytes());
    reader.records().map(|record| Count::of(&record?)).collect()
}

/// The table of these counts.
pub fn table(counts: &[Count]) -> String {
    let lines = counts.iter().map(Count::record);
    let lines: Vec<String> = lines.map(|cells| cells.join(",")).collect();
    format!("{}\n{}\n", HEADER.join(","), lines.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_read_as_it_is_written() {
        let counts = counted().expect("counts");
        assert!(counts.len() > 100);
        assert_eq!(table(&counts), TABLE);
    }
}
