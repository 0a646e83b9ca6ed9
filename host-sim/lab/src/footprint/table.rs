//! The table: the smallest model next to the full one.

use std::fmt;

use stiction_host_sim::trade::chip::Chip;
use stiction_scene::SceneModel;

use super::measure::Measured;
use crate::markdown::Table;

/// The meaning of the columns.
pub(super) const LEGEND: &str = "\
Smallest model of the scene / full model (room for at least 4 vertices and 2 surfaces). Flash: of the solver with its
scene, built for little flash (opt-level z) and for speed (opt-level 3). State: of a run. Stack: the deepest that any frame
went. Instructions, of the M0+ cycles: of a frame, counted along the scene's own path of the hand, the mean and the most;
their time at the clock of the chip, M4F 168 MHz, M33 150 MHz, M0 16 MHz, M0+ 125 MHz: an estimate but for the M0+. Stack,
instructions and time are those of the build for speed.
";

#[derive(Clone)]
pub(super) struct Row {
    pub(super) scene: String,
    pub(super) model: SceneModel,
    pub(super) chip: Chip,
    pub(super) smallest: Measured,
    pub(super) full: Measured,
}

const COLUMNS: &str = "scene | smallest model | chip | flash, small (bytes): | flash, fast (bytes): | state (bytes): | \
    stack (bytes): | instructions, mean: | instructions, worst: | µs, mean: | µs, worst:";

/// A chip with its number type.
fn label(chip: Chip) -> String {
    let name = chip.name().trim_start_matches("Cortex-");
    format!("{name}, {}", chip.number().name())
}

impl Row {
    fn cells(&self) -> [String; 11] {
        fn pair(row: &Row, figure: impl Fn(&Measured) -> String) -> String {
            format!("{} / {}", figure(&row.smallest), figure(&row.full))
        }
        let both = |figure: fn(&Measured) -> String| pair(self, figure);
        let counted = |k: usize| {
            pair(self, |measured| {
                or_none(measured.per_frame().map(|all| all[k]))
            })
        };
        let time = |k: usize| {
            pair(self, |measured| {
                let time = |all: [u64; 2]| self.chip.microseconds(all[k] as f64);
                or_none(measured.per_frame().map(|all| format!("{:.1}", time(all))))
            })
        };
        [
            self.scene.clone(),
            self.model.to_string(),
            label(self.chip),
            both(|measured| measured.flash_small.to_string()),
            both(|measured| measured.flash_fast.to_string()),
            both(|measured| measured.counted.totals.state.to_string()),
            both(|measured| measured.counted.totals.stack.to_string()),
            counted(0),
            counted(1),
            time(0),
            time(1),
        ]
    }
}

fn or_none(figure: Option<impl fmt::Display>) -> String {
    figure.map_or_else(|| "-".to_owned(), |figure| figure.to_string())
}

pub(super) fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(COLUMNS);
    rows.iter().for_each(|row| table.row(row.cells()));
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emulator::{Counted, Frame};
    use stiction_firmware::count::Totals;

    fn measured(instructions: &[u32]) -> Measured {
        let frame = |&instructions: &u32| Frame {
            instructions,
            ..Frame::default()
        };
        Measured {
            flash_small: 100,
            flash_fast: 200,
            counted: Counted {
                frames: instructions.iter().map(frame).collect(),
                totals: Totals {
                    state: 30,
                    stack: 40,
                    ..Totals::default()
                },
            },
        }
    }

    #[test]
    fn models_stand_beside_each_other() {
        let model = SceneModel {
            vertices: 1,
            surfaces: 1,
            corners: 0,
        };
        let row = Row {
            scene: "tip".to_owned(),
            model,
            chip: Chip::CortexM0,
            smallest: measured(&[900, 10, 20]),
            full: measured(&[900]),
        };
        let cells = row.cells();
        let expected = [
            "tip",
            "V = 1, S = 1",
            "M0, fixed",
            "100 / 100",
            "200 / 200",
            "30 / 30",
            "40 / 40",
            "15 / -",
            "20 / -",
            "1.5 / -",
            "2.1 / -",
        ];
        assert_eq!(cells, expected);
    }
}
