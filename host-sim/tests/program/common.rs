//! A folder of its own for every test, and the program run in it.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output};

#[cfg(unix)]
pub(crate) use nix::sys::signal::Signal;
use serde_json::Value;
use tempfile::TempDir;

/// A small scene that runs: a box next to a floor and a wall, 11 frames.
pub(crate) const SCENE: &str = r#"
[body]
vertices = [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]]
start = [0.2, 0.12, 0.5]
weight = 0.0

[grasp]
point = [0.0, 0.02]
reach = 0.01

[spring]
translation = 500.0
rotation = 0.5

[friction]
static = 0.5
dynamic = 0.3

[[surface]]
name = "floor"
normal = [0.0, 1.0]
offset = 0.0

[[surface]]
name = "wall"
normal = [1.0, 0.0]
offset = 0.0

[hand]
rate = 10.0
keyframes = [
  [0.0, 0.2, 0.14, 0.5],
  [1.0, 0.2, 0.06, 0.5],
]
"#;

/// The line of [`SCENE`] with the corners of the box.
pub(crate) const VERTICES: &str =
    "vertices = [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]]";

/// [`SCENE`] with this in its section `[hand]`.
pub(crate) fn with_hand(hand: &str) -> String {
    let (before, _) = SCENE.split_once("[hand]").expect("a hand section");
    format!("{before}[hand]\n{hand}\n")
}

/// The box of [`SCENE`] without the wall, flat above the floor, with this in its section `[hand]`.
pub(crate) fn on_the_floor(hand: &str) -> String {
    let wall = "[[surface]]\nname = \"wall\"\nnormal = [1.0, 0.0]\noffset = 0.0\n";
    let scene = with_hand(hand)
        .replace(wall, "")
        .replace("reach = 0.01\n", "");
    scene.replace("start = [0.2, 0.12, 0.5]", "start = [0.0, 0.05, 0.0]")
}

/// [`SCENE`] with a recorded path instead of keyframes.
pub(crate) fn scene_with_path(path: &str, rest: &str) -> String {
    with_hand(&format!("path = {path:?}\n{rest}"))
}

pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(TempDir::new().expect("a temporary folder"))
    }

    /// The place of a file in it.
    pub(crate) fn file(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.file(name), content).expect("a file in the temporary folder");
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.file(name)).expect("a text file in the temporary folder")
    }

    /// The names of all files, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("the temporary folder");
        let entries = entries.map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<_> = entries
            .map(|name| name.to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Runs `stiction` with what is typed after its name.
    pub(crate) fn stiction(&self, line: &str) -> Output {
        let mut program = Command::new(env!("CARGO_BIN_EXE_stiction"));
        program
            .args(line.split_whitespace())
            .current_dir(self.0.path());
        program.output().expect("the program starts")
    }

    /// What it prints; it succeeds.
    pub(crate) fn done(&self, line: &str) -> String {
        let output = self.stiction(line);
        assert!(output.status.success(), "{line}: {}", said(&output));
        text(&output.stdout)
    }

    /// Its message, which has all of this; its status is 2.
    pub(crate) fn refused(&self, line: &str, parts: &[&str]) -> String {
        let output = self.stiction(line);
        assert_error(line, &output, parts);
        text(&output.stderr)
    }

    /// Runs a scene of this text, with these options, to the records of its trace.
    pub(crate) fn trace(&self, scene: &str, options: &str) -> Vec<Value> {
        self.write("scene.toml", scene);
        self.done(&format!("run scene.toml --out trace.jsonl {options}"));
        records(&self.read("trace.jsonl"))
    }
}

/// All that a program printed.
pub(crate) fn said(output: &Output) -> String {
    text(&output.stdout) + &text(&output.stderr)
}

/// It failed with status 2 and a message that has all of this.
pub(crate) fn assert_error(case: &str, output: &Output, parts: &[&str]) {
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{case}: {message}");
    assert_all(case, &message, parts);
}

pub(crate) fn assert_all(case: &str, text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{case}: {part:?} is not in: {text}");
    }
}

#[cfg(unix)]
pub(crate) fn send(signal: Signal, to: &Child) {
    let number = to.id().try_into().expect("the number of a process");
    nix::sys::signal::kill(nix::unistd::Pid::from_raw(number), signal).expect("a signal is sent");
}

pub(crate) fn records(trace: &str) -> Vec<Value> {
    let record = |line| serde_json::from_str(line).expect("a JSON object per line");
    trace.lines().map(record).collect()
}

/// The rows of a table, by the names of the columns.
pub(crate) fn rows(table: &str) -> Vec<HashMap<String, String>> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let rows = reader.deserialize();
    rows.map(|row| row.expect("a row")).collect()
}

/// Text that a program wrote.
pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The numbers of an array in a record.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let array = value.as_array().expect("an array");
    array
        .iter()
        .map(|number| number.as_f64().expect("a number"))
        .collect()
}
