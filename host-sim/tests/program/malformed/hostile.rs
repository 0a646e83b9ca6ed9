//! Files made to harm: without end, without sense, or larger than anything that is meant. Each is refused by name, in so much memory
//! as a small program has.

mod texts;

use std::fs::File;
use std::os::unix::fs::symlink;
use std::os::unix::net::UnixListener;
use std::process::Command;

use nix::sys::stat::Mode;

use crate::common::{Folder, SCENE, assert_all, text};

/// What a refusal may take besides code and constants (KiB).
const MEMORY: u32 = 100_000;

/// A file of zero bytes, which takes no place on the disk.
fn zeros(folder: &Folder, name: &str, length: u64) {
    let file = File::create(folder.file(name)).expect("a file");
    file.set_len(length).expect("a long file");
}

/// What stands for a name: something else than a text.
enum Odd {
    Device,
    Pipe,
    Socket,
    Directory,
    LinkToNothing,
    LinkToItself,
    Zeros(u64),
}

impl Odd {
    fn make(&self, folder: &Folder, name: &str) {
        let place = folder.file(name);
        match *self {
            Self::Device => symlink("/dev/zero", place).expect("a link"),
            Self::Pipe => nix::unistd::mkfifo(&place, Mode::S_IRWXU).expect("a pipe"),
            Self::Socket => drop(UnixListener::bind(place).expect("a socket")),
            Self::Directory => std::fs::create_dir(place).expect("a folder"),
            Self::LinkToNothing => symlink("nothing", place).expect("a link"),
            Self::LinkToItself => symlink(name, place).expect("a link"),
            Self::Zeros(length) => zeros(folder, name, length),
        }
    }
}

/// Status 2, and a message that is a few lines of text, holds all of `expected`, and nothing for the terminal to obey.
fn assert_refused(name: &str, folder: &Folder, line: &str, expected: &[&str]) {
    let output = Command::new("sh")
        .args(["-c", &format!("ulimit -d {MEMORY}; exec \"$0\" \"$@\"")])
        .arg(env!("CARGO_BIN_EXE_stiction"))
        .args(line.split(' '))
        .current_dir(folder.file(""))
        .output()
        .expect("a shell");
    let message = text(&output.stderr);
    let begin: String = message.chars().take(2000).collect();
    assert_eq!(output.status.code(), Some(2), "{name}: {begin}");
    assert!(
        message.len() < 5000 && !message.contains("panicked"),
        "{name}: {begin}"
    );
    let is_order = |c: char| c.is_control() && c != '\n';
    assert!(!message.contains(is_order), "{name}: {begin:?}");
    assert_all(name, &message, expected);
}

const NO_FILE: &str = "is a device, a pipe or a socket, allowed: a file on a disk";

/// What may stand in the place of any file that is read, and what is said of it.
const ODD: [(&str, Odd, &str); 7] = [
    ("device without end", Odd::Device, NO_FILE),
    ("pipe without writer", Odd::Pipe, NO_FILE),
    ("socket", Odd::Socket, NO_FILE),
    ("folder", Odd::Directory, "is a folder, allowed: a file"),
    ("link to nothing", Odd::LinkToNothing, "o such file"),
    ("link to itself", Odd::LinkToItself, ""),
    (
        "long line of zeros",
        Odd::Zeros(1 << 30),
        "allowed: at most",
    ),
];

#[test]
fn what_is_no_text_file_is_refused() {
    for (name, odd, expected) in &ODD {
        for (file, line) in [
            ("odd.toml", "run odd.toml"),
            ("odd.csv", "run scene.toml --hand odd.csv"),
            ("odd.tum", "run scene.toml --hand odd.tum"),
            ("odd.toml", "sweep odd.toml"),
            ("odd.jsonl", "check odd.jsonl --scene scene.toml"),
            ("odd.csv", "check odd.csv --scene scene.toml"),
            ("odd.toml", "check trace.jsonl --scene odd.toml"),
            ("odd.csv", "trade --hand odd.csv"),
            ("odd.jsonl", "replay odd.jsonl"),
        ] {
            let folder = Folder::new();
            folder.write("scene.toml", SCENE);
            folder.write("trace.jsonl", "");
            odd.make(&folder, file);
            assert_refused(
                &format!("{name} in {line}"),
                &folder,
                line,
                &[file, expected],
            );
        }
    }
}
