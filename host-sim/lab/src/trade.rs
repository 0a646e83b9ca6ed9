//! Every setting of the solver: counted on emulated chips into the table that `stiction trade --emulated` reads, and measured on this
//! computer into the folder `host-sim/trade` and two documents.

mod count;

use std::error::Error;
use std::fs;

use stiction_host_sim::firmware::workspace;
use stiction_host_sim::trade::chip::Chip;
use stiction_host_sim::trade::table::WORDS;
use stiction_host_sim::trade::{Report, Suite, counts, table};

use crate::emulator::Board;
use crate::markdown::{Destination, Table};
pub use count::{Build, count};

/// The folder of the results, and the document beside it that shows them.
const FOLDER: &str = "host-sim/trade";
const DOCUMENT: &str = "host-sim/TRADE.md";

/// Counts and measures everything.
///
/// # Errors
/// A tool is missing, or a file cannot be written.
pub fn trade(output: Destination) -> Result<(), Box<dyn Error>> {
    Board::require_all(&Chip::ALL.map(Board::of))?;
    let suite = Suite::new(None, false)?;
    let builds: Vec<Build> = Build::all().collect();
    let counted = count(&suite, &builds, |_, _| true)?;
    let report = Report::of(&suite, &counted)?;
    if output.write {
        let folder = workspace().join(FOLDER);
        fs::write(folder.join("chips.csv"), counts::table(&counted))?;
        for (name, content) in report.files()? {
            fs::write(folder.join(name), content)?;
        }
    }
    output.put(DOCUMENT, "trade", &whole(&report))?;
    output.put("core/README.md", "settings", &short(&report))?;
    Ok(output.put("README.md", "settings", &short(&report))?)
}

fn markdown(table: table::Table) -> Table {
    Table::of(table.header, table.rows, WORDS)
}

/// All tables, the pictures and the advice.
pub fn whole(report: &Report) -> String {
    let caption = report.caption();
    let mut text =
        format!("Written by `cargo run --release -p stiction-lab -- trade --write`. {caption}\n");
    for (heading, table) in report.tables() {
        if let Some(heading) = heading {
            text += &format!("\n{heading}:\n");
        }
        text += &format!("\n{}", markdown(table));
    }
    for (place, picture) in report.pictures() {
        text += &format!("\n![Error and cost on {place}](trade/{picture})\n");
    }
    let advice = report.advice.iter().map(|line| format!("* {line}\n"));
    format!("{text}\n{}", advice.collect::<String>())
}

/// A few rows.
pub fn short(report: &Report) -> String {
    format!(
        "Written by `cargo run --release -p stiction-lab -- trade --write`, on {}; chips in QEMU, which counts instructions; their time is an \
         estimate. Error: 50 / 90 / 99 % of all frames of whole runs are within this distance of where the reference (f64, path) has the \
         body.\n\n{}",
        report.machine,
        markdown(report.short())
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_documents_have_every_setting_and_every_chip() {
        let suite = Suite::new(None, true).expect("a suite");
        let counted = counts::counted().expect("counts");
        let report = Report::of(&suite, &counted).expect("a report");
        let whole = whole(&report);
        for part in [
            "| f64 | path | 2^-12 | 1000 |",
            "| f32 | path | 2^-8 | 1000 |",
            "| fixed | frame | 0 | 31 |",
            "\nCortex-M0+ at 125 MHz, cycles counted:\n",
            "(trade/host.svg)",
            "(trade/cortex_m4f.svg)",
            "take ",
        ] {
            assert!(whole.contains(part), "{part}: {whole}");
        }
        let short = short(&report);
        let is_row = |row: &&str| row.starts_with("| f") && row.contains("| path |");
        assert_eq!(short.lines().filter(is_row).count(), 3, "{short}");
        assert!(
            short.contains("\n| fixed | frame | Cortex-M0 at 16 MHz |"),
            "{short}"
        );
    }
}
