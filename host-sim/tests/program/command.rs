//! The command line: what a run writes, and where.

use crate::common::{Folder, SCENE, VERTICES, assert_all, assert_error, numbers, records, text};
use serde_json::Value;

#[test]
fn a_run_says_what_it_wrote_and_leaves_standard_output_to_what_takes_the_trace() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.write("trace.jsonl", "the trace of before");
    let output = folder.stiction("run scene.toml --out trace.jsonl");
    let said = text(&output.stderr);
    assert!(
        output.status.success() && output.stdout.is_empty(),
        "{said}"
    );
    assert_eq!(folder.names(), ["scene.toml", "trace.jsonl"]);
    assert_eq!(records(&folder.read("trace.jsonl")).len(), 11);
    assert_all(
        "the trace in a file",
        &said,
        &["largest force", "trace.jsonl"],
    );
    let output = folder.stiction("run scene.toml --record run.jsonl --plot plots");
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    let said = text(&output.stdout).replace('\\', "/");
    assert_all(
        "no trace",
        &said,
        &["largest force", "run.jsonl", "plots/forces.svg"],
    );
}

#[test]
fn quiet_runs_print_nothing() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    let output = folder.stiction("run scene.toml --quiet --plot pictures");
    assert!(output.status.success() && output.stdout.is_empty() && output.stderr.is_empty());
    assert_eq!(folder.names(), ["pictures", "scene.toml"]);
}

#[test]
fn records_carry_every_key_in_the_order_of_the_interface() {
    let folder = Folder::new();
    folder.trace(SCENE, "");
    let trace = folder.read("trace.jsonl");
    let keys = [
        "t", "hand", "held", "pose", "depth", "state", "contacts", "wrench", "slips", "events",
        "status",
    ];
    for line in trace.lines() {
        let places = keys.map(|key| line.find(&format!("\"{key}\":")));
        assert!(
            places.iter().all(Option::is_some) && places.is_sorted(),
            "{line}"
        );
    }
    let last = records(&trace).pop().expect("a record");
    let contact = &last["contacts"][0];
    assert_eq!(last["state"], "single-vertex");
    assert_eq!(contact["surface"], "floor");
    for key in ["vertex", "normal", "friction", "sliding"] {
        assert!(contact[key].is_number(), "{contact}");
    }
    assert_eq!(numbers(&contact["point"]).len(), 2);
}

/// How far the body is behind the hand is reported if a frame has a budget, at the end of a record and of a row.
#[test]
fn a_run_with_a_budget_tells_how_far_the_body_is_behind() {
    let folder = Folder::new();
    let dragged = SCENE.replace("[1.0, 0.2, 0.06, 0.5],", "[1.0, 0.4, 0.04, 0.5],");
    let whole = folder.trace(&dragged, "--rate 2");
    let cut = folder.trace(&dragged, "--rate 2 --budget 1");
    let mut behind = 0;
    for record in &cut {
        let part = record["behind"].as_f64().expect("a part");
        assert_eq!(record["status"] == "behind", part > 0.0, "{record}");
        assert!((0.0..=1.0).contains(&part), "{record}");
        behind += usize::from(part > 0.0);
    }
    assert!(behind > 0, "the budget is never used up");
    assert!(whole.iter().all(|record| record.get("behind").is_none()));
    for (options, ends) in [("--budget 1", true), ("", false)] {
        folder.done(&format!("run scene.toml --out trace.csv {options}"));
        let table = folder.read("trace.csv");
        let header = table.lines().next().expect("a header");
        assert_eq!(header.ends_with(",behind"), ends, "{header}");
    }
}

/// Every number below a value, but for `t`, which is f64 always.
fn collect(value: &Value, into: &mut Vec<String>) {
    match value {
        Value::Number(number) => into.push(number.to_string()),
        Value::Array(values) => values.iter().for_each(|value| collect(value, into)),
        Value::Object(entries) => {
            let values = entries.iter().filter(|(key, _)| *key != "t");
            values.for_each(|(_, value)| collect(value, into));
        }
        _ => {}
    }
}

#[test]
fn numbers_are_printed_with_the_digits_of_their_type() {
    let folder = Folder::new();
    for number in ["f32", "f64", "fixed"] {
        let mut printed = Vec::new();
        for record in folder.trace(SCENE, &format!("--number {number}")) {
            collect(&record, &mut printed);
        }
        let of_single = |digits: &&String| {
            let value: f64 = digits.parse().expect("a number");
            assert!(value.is_finite());
            let shortest = serde_json::to_string(&(value as f32)).expect("a number");
            shortest.parse() == Ok(value)
        };
        let single = printed.iter().filter(of_single).count();
        assert_eq!(single == printed.len(), number != "f64", "{number}");
    }
}

/// The value of a record in a column of a table; null if it has none.
fn in_column(record: &Value, column: &str) -> Value {
    let (name, part) = column.split_once('_').unwrap_or((column, ""));
    let element = |parts: [&str; 3]| {
        let place = parts.iter().position(|known| *known == part);
        record[name][place.expect(column)].clone()
    };
    match name {
        "hand" => element(["x", "y", "phi"]),
        "pose" => element(["x", "y", "theta"]),
        "wrench" => element(["x", "y", "moment"]),
        "insertion" => record["insertion"][part].clone(),
        "contacts" => record["contacts"].as_array().map(Vec::len).into(),
        "events" => {
            let events = record["events"].as_array().expect("events").iter();
            let names: Vec<&str> = events.filter_map(Value::as_str).collect();
            names.join(" ").into()
        }
        "c0" | "c1" | "c2" | "c3" => {
            let index: usize = name[1..].parse().expect("a number");
            let contact = &record["contacts"][index];
            let place = |key: &str, axis: usize| contact[key][axis].clone();
            match part {
                "x" => place("point", 0),
                "y" => place("point", 1),
                "direction_x" => place("direction", 0),
                "direction_y" => place("direction", 1),
                key => contact[key].clone(),
            }
        }
        key => record[key].clone(),
    }
}

/// The table has the values of the trace, and is empty where that has none. Returns its header.
pub(crate) fn assert_same(table: &str, trace: &[Value]) -> Vec<String> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let header = reader.headers().expect("a header").clone();
    let rows: Vec<_> = reader.records().map(|row| row.expect("a row")).collect();
    assert_eq!(rows.len(), trace.len());
    for (row, record) in rows.iter().zip(trace) {
        for (column, cell) in header.iter().zip(row) {
            let is_same = match in_column(record, column) {
                Value::Null => cell.is_empty(),
                Value::String(word) => cell == word,
                Value::Number(number) => cell.parse().ok() == number.as_f64(),
                Value::Bool(is_true) => cell.parse() == Ok(is_true),
                Value::Array(_) | Value::Object(_) => false,
            };
            assert!(is_same, "{column}: {cell}, {record}");
        }
    }
    header.iter().map(str::to_owned).collect()
}

#[test]
fn csv_carries_the_same_as_json() {
    let folder = Folder::new();
    let json = folder.trace(SCENE, "");
    folder.done("run scene.toml --out trace.csv");
    let header = assert_same(&folder.read("trace.csv"), &json);
    let contact = |column: &&String| column.starts_with("c3_");
    assert_eq!(header.iter().filter(contact).count(), 7);
}

#[test]
fn surfaces_without_a_name_are_called_by_their_index() {
    let folder = Folder::new();
    let scene = SCENE.replacen("name = \"floor\"\n", "", 1);
    let trace = folder.trace(&scene, "");
    assert_eq!(trace[10]["contacts"][0]["surface"], "0");
}

/// A friction of every surface overrides the default, and a rectangle is its four vertices.
#[test]
fn what_is_said_in_other_words_is_the_same_run() {
    let folder = Folder::new();
    let default = "[friction]\nstatic = 0.5\ndynamic = 0.3\n";
    let everywhere = SCENE.replacen(default, "[friction]\nstatic = 0.9\ndynamic = 0.8\n", 1);
    let own = "offset = 0.0\nstatic = 0.9\ndynamic = 0.8";
    let own = SCENE.replacen("offset = 0.0", own, 1);
    let rectangle = SCENE.replacen(VERTICES, "rectangle = [0.10, 0.06]", 1);
    for (scene, words) in [(everywhere.as_str(), own), (SCENE, rectangle)] {
        assert_eq!(folder.trace(&words, ""), folder.trace(scene, ""));
    }
}

/// Each kind of mistake in the corners of the box, mended: the run of the box, and what was changed.
#[test]
fn corners_are_mended_when_the_file_asks_for_it() {
    let folder = Folder::new();
    let expected = folder.trace(SCENE, "");
    let [a, b, c, d] = [
        "[-0.05, -0.03]",
        "[0.05, -0.03]",
        "[0.05, 0.03]",
        "[-0.05, 0.03]",
    ];
    for (corners, changed) in [
        ([a, b, c, d].as_slice(), ""),
        (&[a, d, c, b], "the order, which was clockwise, is reversed"),
        (
            &[a, b, b, c, d],
            "corner 2 is left out: it is at the place of another one",
        ),
        (
            &[a, b, "[0.05, 0.0]", c, d],
            "corner 2 is left out: it is within the hull",
        ),
        (
            &[a, b, c, "[0.0, 0.02]", d],
            "corner 3 is left out: it is within the hull",
        ),
        (
            &[a, c, b, d],
            "whose sides crossed, are in the order of their hull",
        ),
    ] {
        let corners = format!("vertices = [{}]", corners.join(", "));
        let text_of = SCENE.replacen(VERTICES, &corners, 1);
        if !changed.is_empty() {
            folder.write("scene.toml", &text_of);
            folder.refused("run scene.toml", &["body.vertices", "`body.repair = true`"]);
        }
        let mended = text_of.replacen("weight", "repair = true\nweight", 1);
        folder.write("scene.toml", mended);
        let output = folder.stiction("run scene.toml --out trace.jsonl");
        let said = text(&output.stderr);
        assert!(output.status.success(), "{said}");
        assert_eq!(records(&folder.read("trace.jsonl")), expected, "{said}");
        assert_eq!(
            said.contains("note: `body.vertices`: "),
            !changed.is_empty(),
            "{said}"
        );
        assert_all(&corners, &said, &[changed]);
    }
}

#[test]
fn a_scene_is_printed_as_c_or_refused() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    for number in ["f32", "fixed"] {
        for scene in ["scene.toml", "table-edge"] {
            let code = folder.done(&format!("code {scene} --number {number} --name bench"));
            assert_all(scene, &code, &["static const stiction_scene bench = {"]);
            assert_eq!(
                code.contains(".obstacles = "),
                scene == "table-edge",
                "{code}"
            );
        }
    }
    for (arguments, message) in [
        ("scene.toml --name 2box", "with no digit first"),
        ("scene.toml --name int", "a word of C or C++"),
        ("scene.toml --name class", "a word of C or C++"),
        (
            "scene.toml --name stiction_scene",
            "as the names of the library do",
        ),
        ("scene.toml --name _Box", "reserved for the compiler"),
        ("scene.toml --number f64", "allowed: f32, fixed"),
        ("none.toml", "none.toml"),
    ] {
        let output = folder.stiction(&format!("code {arguments}"));
        assert!(output.stdout.is_empty());
        assert_error(arguments, &output, &[message]);
    }
}
