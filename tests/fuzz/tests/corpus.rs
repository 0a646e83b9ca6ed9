//! The inputs of fuzzing: those that reach deep into the code, and those that once revealed a fault.

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

/// Checks every seed input of a target.
fn corpus(target: &str, check: fn(&[u8])) {
    all_of("corpus", target, (10, check));
}

/// Checks all inputs of a target in a folder; there must be more than `some`.
fn all_of(folder: &str, target: &str, (some, check): (usize, fn(&[u8]))) {
    let files = inputs(folder, target);
    assert!(
        files.len() > some,
        "{folder}/{target} has {} inputs",
        files.len()
    );
    for file in files {
        println!("{}", file.display());
        check(&fs::read(&file).expect("an input"));
    }
}

/// The inputs of a target in a folder, in the order of their names.
fn inputs(folder: &str, target: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join(folder)
        .join(target);
    // Without a known fault there is no folder.
    let entries = fs::read_dir(&folder).into_iter().flatten();
    let mut files: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    files
}

/// Inputs with a fault that is known and not fixed (tests/README.md). One that no longer has it belongs in `finds`.
fn still_fail(target: &str, check: fn(&[u8])) {
    for file in inputs("known", target) {
        let input = fs::read(&file).expect("an input");
        let outcome = catch_unwind(|| check(&input));
        assert!(
            outcome.is_err(),
            "{} has no fault any more: move it to finds",
            file.display()
        );
    }
}

#[test]
fn wire() {
    corpus("wire", stiction_fuzz::wire);
}

#[test]
fn scene_file() {
    corpus("scene_file", stiction_fuzz::scene_file);
}

#[test]
fn hand_path() {
    corpus("hand_path", stiction_fuzz::hand_path);
}

#[test]
fn solver() {
    corpus("solver", stiction_fuzz::solver);
    all_of("finds", "solver", (6, stiction_fuzz::solver));
    still_fail("solver", stiction_fuzz::solver);
}

#[test]
fn obstacles() {
    corpus("obstacles", stiction_fuzz::obstacles);
    all_of("finds", "obstacles", (6, stiction_fuzz::obstacles));
    still_fail("obstacles", stiction_fuzz::obstacles);
}
