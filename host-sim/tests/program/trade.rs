//! `stiction trade` on a few scenes: a row for every combination, a reference without error, pictures, the costs on chips.

use std::collections::HashMap;

use crate::common::{Folder, assert_error, rows, text};
use serde_json::Value;
use stiction_core::{Fixed, State};
use stiction_host_sim::trade::{Memory, RATES, Setting};

/// Three number types, two evolutions, and all scenes with their three groups.
const ROWS: usize = 3 * 2 * Memory::ALL.len() * RATES.len() * 4;

#[test]
fn every_combination_is_measured_against_a_reference_without_error() {
    let folder = Folder::new();
    let printed = folder.done("trade --quick --table --out figures/trade");
    table(&folder);
    report(&folder);
    pictures(&folder);
    // First what to take, in a few lines; then the table that was asked for.
    let table = printed.find("\nMeasured on").expect("the table");
    let recommendation = &printed[..table];
    assert!(recommendation.contains("take f"), "{printed}");
    assert!(recommendation.lines().count() <= 10, "{recommendation}");
    assert!(printed[table..].contains("worst residual"), "{printed}");
    let mut files: Vec<_> = (folder.file("figures/trade").read_dir())
        .expect("the folder")
        .map(|entry| entry.expect("a file").file_name())
        .collect();
    files.sort();
    assert_eq!(files, ["host.png", "host.svg", "trade.csv", "trade.json"]);
}

fn table(folder: &Folder) {
    let rows = rows(&folder.read("figures/trade/trade.csv"));
    let key = |row: &HashMap<String, String>| {
        ["number", "evolution", "memory", "rate_hz", "scenes"].map(|name| row[name].clone())
    };
    let mut expected = Vec::new();
    for setting in Setting::all() {
        for rate in RATES {
            for scenes in ["all", "bundled", "random", "hand"] {
                let (number, evolution) = (setting.number.name(), setting.evolution.name());
                let names = [
                    number,
                    evolution,
                    setting.memory.name,
                    &format!("{rate:?}"),
                    scenes,
                ];
                expected.push(names.map(str::to_owned));
            }
        }
    }
    let mut found: Vec<_> = rows.iter().map(key).collect();
    expected.sort();
    found.sort();
    assert_eq!(found, expected);
    assert_eq!(rows.len(), ROWS);
    for row in &rows {
        let number = |name: &str| row[name].parse::<f64>().expect(name);
        let spread =
            |of: &str| ["p50", "p90", "p99", "max"].map(|part| number(&of.replace('*', part)));
        let errors = [spread("position_*_um"), spread("angle_*_mrad")];
        for error in errors {
            assert!(
                error.iter().all(|value| value.is_finite()) && error.is_sorted(),
                "{row:?}"
            );
        }
        let is_reference =
            ["number", "evolution", "rate_hz"].map(|name| &*row[name]) == ["f64", "path", "1000.0"];
        if is_reference {
            assert_eq!(errors, [[0.0; 4]; 2]);
            assert_eq!(
                ["other_state", "slips_too_many", "slips_too_few"].map(|name| &*row[name]),
                ["0"; 3]
            );
        }
        assert!(number("frames") > 0.0 && number("host_ns") > 0.0, "{row:?}");
        let bound = if row["number"] == "f64" { 1e-9 } else { 2e-3 };
        assert!(number("worst_residual") < bound, "{row:?}");
    }
}

fn report(folder: &Folder) {
    let json = folder.read("figures/trade/trade.json");
    let report: Value = serde_json::from_str(&json).expect("JSON");
    let rows = report["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), ROWS);
    assert!(rows.iter().all(|row| row["host_ns"].is_number()));
    assert!(
        report["advice"][0]
            .as_str()
            .is_some_and(|advice| advice.contains("take"))
    );
    assert!(report["machine"].is_string());
}

fn pictures(folder: &Folder) {
    let svg = folder.read("figures/trade/host.svg");
    let document = roxmltree::Document::parse(&svg).expect("XML");
    let texts: Vec<_> = (document.descendants())
        .filter(|node| node.has_tag_name("text"))
        .filter_map(|node| node.text())
        .map(str::trim)
        .collect();
    for part in ["fixed", "path", "ns per frame, mean"] {
        assert!(texts.contains(&part), "{part}: {texts:?}");
    }
    assert!(texts.iter().any(|text| text.starts_with("31 Hz, ")));
    let png = std::fs::read(folder.file("figures/trade/host.png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
}

#[test]
fn what_was_counted_on_chips_is_added() {
    let folder = Folder::new();
    let output = folder.stiction("trade --quick --emulated --table");
    let message = text(&output.stderr);
    assert!(output.status.success(), "{message}");
    let report: Value = serde_json::from_str(&folder.read("trade/trade.json")).expect("JSON");
    let rows = report["rows"].as_array().expect("rows");
    for row in rows {
        let number = row["number"].as_str().expect("a number type");
        let is_counted = ["all", "bundled"].contains(&row["scenes"].as_str().expect("scenes"));
        let chips = [
            ("cortex_m4f", "instructions", 2.0 / 168.0, &["f32"][..]),
            ("cortex_m33", "instructions", 2.0 / 150.0, &["f32"]),
            ("cortex_m0", "instructions", 1.65 / 16.0, &["f32", "fixed"]),
            ("cortex_m0plus", "cycles", 1.0 / 125.0, &["fixed"]),
        ];
        for (chip, unit, time, numbers) in chips {
            let value = |name: &str| row[format!("{chip}_{name}")].as_f64();
            let is_short = row["memory"] == "0";
            if !is_counted || is_short || !numbers.contains(&number) {
                assert_eq!(value(unit), None, "{row}");
                continue;
            }
            let value = |name| value(name).unwrap_or_else(|| panic!("no {name}: {row}"));
            let worst = format!("{unit}_worst");
            let (mean, worst) = (value(unit), value(&worst));
            assert!(300.0 < mean && mean < worst && worst < 1e7, "{row}");
            for (counted, us) in [(mean, value("us")), (worst, value("us_worst"))] {
                assert!((us / (counted * time) - 1.0).abs() < 1e-12, "{row}");
            }
            assert!(
                (5_000.0..200_000.0).contains(&value("flash_bytes")),
                "{row}"
            );
            // A state has no pointers: it is as large on this computer.
            let state = match number {
                "f32" => size_of::<State<f32>>(),
                _ => size_of::<State<Fixed>>(),
            };
            assert_eq!(value("state_bytes"), state as f64, "{row}");
            assert!((500.0..10_000.0).contains(&value("stack_bytes")), "{row}");
        }
    }
    for file in ["cortex_m4f.svg", "cortex_m0.png"] {
        assert!(folder.file("trade").join(file).exists(), "{file}");
    }
    let stdout = text(&output.stdout);
    for part in [
        "On Cortex-M4F, ",
        "On Cortex-M0, ",
        "in the worst",
        "stack (bytes)",
    ] {
        assert!(stdout.contains(part), "{part}: {stdout}");
    }
}

#[test]
fn a_recorded_hand_takes_the_place_of_the_synthetic_one() {
    let folder = Folder::new();
    let path: String = (0..200)
        .map(|k| f64::from(k) / 100.0)
        .map(|t| format!("{t},{},{},{}\n", (3.0 * t).sin(), (2.0 * t).cos(), 0.3 * t))
        .collect();
    folder.write("mine.csv", format!("t,x,y,phi\n{path}"));
    let output = folder.stiction("trade --quick --hand mine.csv");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("a recorded hand (mine.csv"));
    assert_eq!(folder.names(), ["mine.csv", "trade"]);
}

#[test]
fn what_cannot_be_used_is_refused_before_anything_is_measured() {
    let folder = Folder::new();
    folder.write("file", "a file");
    folder.write("bad.csv", "t,x,y\n0,0,0\n");
    folder.write("long.csv", "t,x,y,phi\n0,0,0,0\n1000,1,0,0\n");
    let before = folder.names();
    for (options, expected) in [
        ("--out file", &["file", "cannot be written"][..]),
        ("--out file/below", &["file/below", "cannot be written"]),
        ("--hand bad.csv", &["bad.csv", "line 1", "header"]),
        ("--hand long.csv", &["long.csv", "1000 s", "600 s"]),
        ("--hand absent.csv", &["absent.csv"]),
        ("--speed", &["--speed"]),
    ] {
        let output = folder.stiction(&format!("trade --quick {options}"));
        assert_error(options, &output, expected);
        assert!(output.stdout.is_empty());
        assert_eq!(folder.names(), before, "{options}");
    }
}
