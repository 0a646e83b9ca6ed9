//! The documentation of the solver matches the code: the picture has every contact state, and every equation and section that the code cites exists. Links between documents, and the paths that
//! they name, exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use stiction_core::StateKind;

/// A file of the documentation of the solver.
fn document(name: &str) -> PathBuf {
    let core = Path::new(env!("CARGO_MANIFEST_DIR")).join("../core");
    core.join(name)
}

/// Nothing writes the picture. An empty line would end it within Markdown.
#[test]
fn the_picture_has_every_state_in_one_piece() {
    let picture = fs::read_to_string(document("states.svg")).expect("core/states.svg");
    for state in StateKind::ALL {
        let name = state.name();
        assert!(picture.contains(&format!(">{name}<")), "{name}");
    }
    assert!(picture.lines().all(|line| !line.trim().is_empty()));
}

/// The text of all sources below a folder.
fn sources(folder: &Path, text: &mut String) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, text);
        } else {
            *text += &fs::read_to_string(&path).expect("a source");
        }
    }
}

/// The digits and dots that follow a mark.
fn cited(text: &str, mark: &str) -> Vec<String> {
    let numbers = text.split(mark).skip(1).map(|after| {
        let end = after.find(|c: char| !c.is_ascii_digit() && c != '.');
        after[..end.unwrap_or(after.len())]
            .trim_end_matches('.')
            .to_owned()
    });
    numbers.filter(|number| !number.is_empty()).collect()
}

#[test]
fn what_the_code_cites_is_there() {
    let mut code = String::new();
    sources(&document("src"), &mut code);
    sources(&document("../tests/tests/solver"), &mut code);
    let statics = fs::read_to_string(document("STATICS.md")).expect("core/STATICS.md");
    let (equations, sections) = (cited(&code, "(E"), cited(&code, "STATICS "));
    let rules = cited(&code, "(R");
    assert!(equations.len() > 10 && sections.len() > 10 && rules.len() > 20);
    for number in equations {
        let numbered =
            |line: &str| line.starts_with("    ") && line.ends_with(&format!(" (E{number})"));
        assert_eq!(
            statics.lines().filter(|line| numbered(line)).count(),
            1,
            "(E{number})"
        );
    }
    for number in rules {
        let rule = format!("**(R{number})");
        assert_eq!(statics.matches(&rule).count(), 1, "{rule}");
    }
    for number in sections {
        assert!(statics.contains(&format!("\n## {number}. ")), "{number}");
    }
}

/// The table of thresholds has each threshold in the code, and no other. A threshold states its unit in brackets.
#[test]
fn every_threshold_is_in_the_table() {
    let core = Path::new(env!("CARGO_MANIFEST_DIR")).join("../core");
    let read = |file: &str| fs::read_to_string(core.join(file)).expect("a file of core");
    let (code, statics) = (read("src/thresholds.rs"), read("STATICS.md"));
    let (mut stated, mut has_unit) = (BTreeSet::from(["TOUCH", "MICRO"]), false);
    for line in code.lines().map(str::trim) {
        if let Some(name) = line
            .strip_prefix("fn ")
            .and_then(|rest| rest.split('(').next())
        {
            if has_unit {
                stated.insert(name);
            }
            has_unit = false;
        }
        has_unit |= line.starts_with("///") && line.contains('(');
    }
    let table = statics.split("\n## 16. ").nth(1).expect("the numbers");
    let rows = table.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.filter_map(|line| line.split('|').nth(1));
    let names = cells.flat_map(|cell| cell.split('`').skip(1).step_by(2));
    assert_eq!(names.collect::<BTreeSet<_>>(), stated);
}

/// The Markdown files of a folder.
fn documents(folder: &str) -> Vec<PathBuf> {
    let folder = document("..").join(folder);
    let entries = fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect()
}

/// The anchor of a heading, as repository hosts generate it.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let letters = text
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    letters.collect::<String>().replace(' ', "-")
}

/// Folders with documents.
const FOLDERS: [&str; 7] = [
    ".",
    "core",
    "core/wire",
    "firmware",
    "host-sim",
    "host-sim/lab",
    "tests",
];

/// Text in code marks that starts with a top-level folder is a path from there, or from the document.
#[test]
fn paths_lead_somewhere() {
    let mut count = 0;
    for file in FOLDERS.into_iter().flat_map(documents) {
        let text = fs::read_to_string(&file).expect("a document");
        let marked = text
            .lines()
            .flat_map(|line| line.split('`').skip(1).step_by(2));
        for code in marked {
            let is_path = code.split_once('/').is_some_and(|(top, _)| {
                ["core", "firmware", "host-sim", "tests"].contains(&top) && !code.contains(' ')
            });
            if is_path {
                let beside = file.with_file_name("").join(code);
                let there = document("..").join(code).exists() || beside.exists();
                assert!(there, "{}: {code}", file.display());
                count += 1;
            }
        }
    }
    assert!(count > 10, "{count} paths");
}

#[test]
fn links_lead_somewhere() {
    let mut count = 0;
    for file in FOLDERS.into_iter().flat_map(documents) {
        let text = fs::read_to_string(&file).expect("a document");
        let targets = text.split("](").skip(1);
        for target in targets.filter_map(|rest| rest.split(')').next()) {
            // A link target contains no space; a formula may.
            if target.starts_with("http") || target.contains(' ') {
                continue;
            }
            let (path, heading) = target.split_once('#').unwrap_or((target, ""));
            let there = match path {
                "" => file.clone(),
                path => file.with_file_name("").join(path),
            };
            assert!(there.exists(), "{}: {target}", file.display());
            let headings = || fs::read_to_string(&there).expect("a document");
            assert!(
                heading.is_empty() || headings().lines().any(|line| anchor(line) == heading),
                "{}: {target}",
                file.display()
            );
            count += 1;
        }
    }
    assert!(count > 20, "{count} links");
}
