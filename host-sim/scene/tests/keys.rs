//! The table of keys in SCENES.md lists the keys that the reader of scene files knows, and its capacities.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use stiction_scene::{CORNERS, OBSTACLES, SURFACES, SceneFile, Source, VERTICES};

fn document() -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../SCENES.md");
    fs::read_to_string(file).expect("the document")
}

/// The keys in the first column of the table.
fn written() -> BTreeSet<String> {
    let text = document();
    let (_, table) = text.split_once("<!-- keys: begin -->").expect("a table");
    let (table, _) = table.split_once("<!-- keys: end -->").expect("its end");
    let rows = table.lines().filter_map(|line| line.strip_prefix("| `"));
    let keys = rows.map(|row| row.split('`').next().expect("a key").to_owned());
    let (keys, count): (BTreeSet<_>, _) = (keys.clone().collect(), keys.count());
    assert_eq!(keys.len(), count, "a key is there twice");
    keys
}

/// The keys that the reader reports as allowed if a key is unknown.
fn allowed(text: &str) -> Vec<String> {
    let error = SceneFile::parse(Source::new("scene.toml", text), f64::MAX).expect_err("no scene");
    let (_, names) = error
        .problem()
        .split_once("(allowed: ")
        .expect("what is allowed");
    let (names, _) = names.split_once(')').expect("the end of the names");
    names.split(", ").map(str::to_owned).collect()
}

/// The keys that the reader knows, in every section.
fn known() -> BTreeSet<String> {
    let keys = allowed("none = 1").into_iter().flat_map(|section| {
        let header = match section.as_str() {
            "surface" | "obstacle" => format!("[[{section}]]"),
            _ => format!("[{section}]"),
        };
        let names = allowed(&format!("{header}\nnone = 1"));
        names
            .into_iter()
            .map(move |name| format!("{section}.{name}"))
    });
    keys.collect()
}

#[test]
fn the_table_has_the_keys_that_are_read() {
    assert_eq!(written(), known());
}

#[test]
fn the_table_has_the_capacities_of_the_reader() {
    let words: Vec<String> = document().split_whitespace().map(str::to_owned).collect();
    let text = words.join(" ");
    for capacity in [
        format!("| 1 to {VERTICES} of `[x, y]`"),
        format!("0 to {SURFACES} of them"),
        format!("0 to {OBSTACLES} of them with at most {CORNERS} corners in all"),
    ] {
        assert!(text.contains(&capacity), "{capacity}");
    }
}

/// A box of 100 mm, written as 100 m.
#[test]
fn a_body_that_nobody_holds_is_doubted() {
    let scene = |unit: f64| {
        let text = format!(
            "[body]\nrectangle = [{}, {}]\nstart = [0.0, 0.0, 0.0]\n[spring]\ntranslation = 500.0\nrotation = 0.5\n[hand]\nrate = 10.0\nkeyframes = [[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]\n",
            80.0 * unit,
            60.0 * unit
        );
        SceneFile::parse(Source::new("scene.toml", text), f64::MAX).expect("a scene")
    };
    assert!(scene(1e-3).notes.is_empty());
    assert_eq!(
        scene(1.0).notes,
        ["the body is 100.0 m large: lengths are in metres"]
    );
}
