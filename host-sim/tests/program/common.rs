//! A folder of its own for every test, and the program run in it.

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

/// [`SCENE`] with this in its section `[hand]`.
pub(crate) fn with_hand(hand: &str) -> String {
    let (before, _) = SCENE.split_once("[hand]").expect("a hand section");
    format!("{before}[hand]\n{hand}\n")
}

/// [`SCENE`] with a recorded path instead of keyframes.
pub(crate) fn scene_with_path(path: &str, rest: &str) -> String {
    with_hand(&format!("path = {path:?}\n{rest}"))
}

/// A folder with files.
pub(crate) struct Folder(TempDir);

impl Folder {
    /// An empty one.
    pub(crate) fn new() -> Self {
        Self(TempDir::new().expect("a temporary folder"))
    }

    /// The place of a file in it.
    pub(crate) fn file(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file.
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.file(name), content).expect("a file in the temporary folder");
    }

    /// Reads a file.
    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.file(name)).expect("a text file in the temporary folder")
    }

    /// The names of all files, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("the temporary folder");
        let mut names: Vec<String> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }

    /// Runs `stiction` in the folder.
    pub(crate) fn stiction(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_stiction"))
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .expect("the program starts")
    }

    /// Runs a scene of this text to the records of its trace.
    pub(crate) fn trace(&self, scene: &str, arguments: &[&str]) -> Vec<Value> {
        self.write("scene.toml", scene);
        let arguments = [&["run", "scene.toml", "--out", "trace.jsonl"], arguments].concat();
        let output = self.stiction(&arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        records(&self.read("trace.jsonl"))
    }
}

/// Sends a signal to a program that runs.
#[cfg(unix)]
pub(crate) fn send(signal: Signal, to: &Child) {
    let number = to.id().try_into().expect("the number of a process");
    nix::sys::signal::kill(nix::unistd::Pid::from_raw(number), signal).expect("a signal is sent");
}

/// The records of a trace.
pub(crate) fn records(trace: &str) -> Vec<Value> {
    let record = |line| serde_json::from_str(line).expect("a JSON object per line");
    trace.lines().map(record).collect()
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
