//! Slides in what a run leaves: a box that is pressed too little for its memory length slides to and fro with the hand.

use std::fs;
use std::path::Path;

use crate::common::{Folder, on_the_floor, text};
use serde_json::Value;
use stiction_core::{Event, StateKind, Status};

/// Flat on the floor, pressed 10 mm deep, dragged along +x and back. It sticks and slips where the memory length is less than
/// 2 mm: 5 N = 500 N/m · 2 mm / (0.5 - 0.3).
fn dragged(memory: &str) -> String {
    let hand = "rate = 100.0\nkeyframes = [[0.0, 0.0, 0.07, 0.0], [1.0, 0.0, 0.04, 0.0], [3.0, 0.04, 0.04, 0.0], [5.0, 0.0, 0.04, 0.0]]";
    on_the_floor(hand).replace("dynamic = 0.3", &format!("dynamic = 0.3\n{memory}"))
}

/// Of all contacts of all records.
fn sliding(trace: &[Value]) -> Vec<i64> {
    let contacts = trace
        .iter()
        .flat_map(|record| record["contacts"].as_array());
    let sliding = contacts
        .flatten()
        .map(|contact| contact["sliding"].as_i64());
    sliding.map(|sign| sign.expect("a whole number")).collect()
}

fn events(trace: &[Value]) -> Vec<&str> {
    let events = trace.iter().flat_map(|record| record["events"].as_array());
    events.flatten().filter_map(Value::as_str).collect()
}

#[test]
fn a_trace_tells_what_slides_and_which_way() {
    let folder = Folder::new();
    let trace = folder.trace(&dragged("memory = 0.02"), "");
    let signs = sliding(&trace);
    for sign in [-1, 0, 1] {
        assert!(signs.contains(&sign), "{sign}");
    }
    let happened = events(&trace);
    assert!(happened.contains(&"slide") && happened.contains(&"stop"));
    assert!(trace.iter().all(|record| record["slips"] == 0));
    for contact in trace
        .iter()
        .filter_map(|record| record["contacts"].get(0))
        .filter(|contact| contact["sliding"] != 0)
    {
        let [sign, normal, friction] =
            ["sliding", "normal", "friction"].map(|key| contact[key].as_f64().expect("a number"));
        assert!((friction + 0.3 * sign * normal).abs() < 1e-4, "{contact}");
    }
}

/// A bundled scene, its surface with a memory length (m).
fn bundled(name: &str, memory: f64) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.toml"));
    let scene = fs::read_to_string(file).expect("a bundled scene");
    let friction = "[friction]\n";
    assert!(scene.contains(friction), "{name}");
    scene.replace(friction, &format!("{friction}memory = {memory:?}\n"))
}

/// How often the box of `burst` slips, by the law alone: it is flat, the hand goes as far to the side as down and up, and so T
/// grows by what N changes. Lengths in m: N / k_h and T / k_h.
fn slips_of_the_burst(memory: f64) -> usize {
    let (mu_s, mu_d, depth) = (0.5, 0.3, 0.01);
    let least = memory / (mu_s - mu_d);
    // Down: from a slip at N to the next one. Stiction comes where N is N*.
    let (mut normal, mut slips) = (least, 0);
    let further = |normal: f64| normal * (1.0 - mu_d) / (1.0 - mu_s);
    while further(normal) <= depth {
        normal = further(normal);
        slips += 1;
    }
    // Across the turn, and up, until a slip ends below N*.
    normal = (2.0 * depth - (1.0 - mu_d) * normal) / (1.0 + mu_s);
    slips += 1;
    while normal >= least {
        normal *= (1.0 + mu_d) / (1.0 + mu_s);
        slips += 1;
    }
    slips
}

/// As many as the README says.
#[test]
fn slips_of_a_burst_are_counted_by_its_memory_length() {
    let folder = Folder::new();
    let size = f64::hypot(0.1, 0.06);
    for (part, expected) in [(19, 91), (12, 43), (8, 15)] {
        let memory = size / f64::from(1 << part);
        // No memory counts as 2^-19 of the size.
        let given = if part == 19 { 0.0 } else { memory };
        assert_eq!(slips_of_the_burst(memory), expected, "2^-{part}");
        for number in ["f32", "f64", "fixed"] {
            let trace = folder.trace(&bundled("burst", given), &format!("--number {number}"));
            let slips = trace.iter().filter_map(|record| record["slips"].as_u64());
            assert_eq!(slips.sum::<u64>(), expected as u64, "{number}, 2^-{part}");
            let happened = events(&trace);
            let slides = happened.iter().filter(|event| **event == "slide");
            assert_eq!(slides.count(), 2, "{number}, 2^-{part}");
        }
    }
}

/// It sticks, slides, stays where the hand stops, sticks as the hand turns back, and slides back until it is lifted.
#[test]
fn with_one_coefficient_of_friction_it_slides_and_never_slips() {
    let folder = Folder::new();
    let trace = folder.trace(&bundled("slide", 0.0), "");
    let signs = sliding(&trace);
    let mut order: Vec<i64> = Vec::new();
    for sign in signs {
        if order.last() != Some(&sign) {
            order.push(sign);
        }
    }
    assert_eq!(order, [0, 1, 0, -1]);
    let happened = events(&trace);
    assert_eq!(happened, ["touch", "slide", "stop", "slide", "lift"]);
    // The hand rests from 2 s to 2.5 s, and so does the body.
    let pose = |i: usize| &trace[i]["pose"];
    assert!((2001..2500).all(|i| pose(i) == pose(2000)));
}

#[test]
fn pictures_and_the_summary_tell_of_slides() {
    let folder = Folder::new();
    folder.write("scene.toml", dragged("memory = 0.02"));
    let output = folder.stiction("run scene.toml --plot plots");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("\n  sliding  "));
    assert!(folder.read("plots/forces.svg").contains("slides: "));
}

/// A trace of before there were slides, and one of another program.
#[test]
fn a_trace_without_the_key_is_checked_all_the_same() {
    let folder = Folder::new();
    let scene = dragged("memory = 1e-4");
    folder.trace(&scene, "--number f64");
    let trace = folder.read("trace.jsonl");
    let old = ["-1", "0", "1"].iter().fold(trace, |trace, sign| {
        trace.replace(&format!(",\"sliding\":{sign}"), "")
    });
    assert!(!old.contains("sliding"));
    folder.write("old.jsonl", old.clone());
    let check = "check old.jsonl --scene scene.toml --number f64";
    let output = folder.stiction(check);
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{}",
        text(&output.stderr)
    );
    assert!(!text(&output.stdout).contains("a slide is at mu_d N"));
    let other = old.replace("\"friction\":", "\"sliding\":2,\"friction\":");
    folder.write("old.jsonl", other);
    folder.refused(check, &["`sliding` of contact 0 is 2, allowed: -1, 0, 1"]);
}

/// The table of columns in TRACES.md has those of a trace of a run with a budget of a peg in its hole, with the names of all states, events
/// and statuses.
#[test]
fn the_table_of_columns_is_that_of_a_trace() {
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("TRACES.md");
    let document = fs::read_to_string(document).expect("the document");
    let (_, table) = document
        .split_once("<!-- columns: begin -->")
        .expect("a table");
    let (table, _) = table.split_once("<!-- columns: end -->").expect("its end");
    let rows = table.lines().filter_map(|line| line.strip_prefix("| `"));
    let first = rows.filter_map(|row| row.split(" | ").next());
    let names = first.flat_map(|cell| cell.split("`, `").map(|name| name.trim_matches('`')));
    let listed: Vec<&str> = names.collect();
    let folder = Folder::new();
    folder.done("run peg-in-hole --rate 20 --out trace.csv --budget 1");
    let trace = folder.read("trace.csv");
    let header = trace.lines().next().expect("a header");
    let columns: Vec<&str> = header.split(',').filter(|name| !later(name)).collect();
    assert_eq!(listed, columns);
    let states = StateKind::ALL.map(StateKind::name);
    let statuses = Status::ALL.map(Status::name);
    for name in [&states[..], &Event::ALL.map(Event::name), &statuses].concat() {
        assert!(table.contains(&format!("`{name}`")), "{name}");
    }
}

/// A column of a contact after the first one.
fn later(name: &str) -> bool {
    ["c1_", "c2_", "c3_"]
        .iter()
        .any(|contact| name.starts_with(contact))
}
