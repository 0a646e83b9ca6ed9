//! Programs that are ended, output that cannot be written, names that are no text.

use std::ffi::OsStr;
use std::fs::File;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::common::{Folder, SCENE, Signal, assert_error, send, text};

/// A run that lasts, once its trace is begun. Behind `shell`, which ends by becoming it.
fn begun(folder: &Folder, rate: &str, shell: &str) -> Child {
    folder.write("scene.toml", SCENE);
    let child = Command::new("sh")
        .args(["-c", &format!("{shell} exec \"$0\" \"$@\"")])
        .arg(env!("CARGO_BIN_EXE_stiction"))
        .args(["run", "scene.toml", "--rate", rate, "--out", "trace.jsonl"])
        .current_dir(folder.file(""))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    while parts(folder) == 0 {
        sleep(Duration::from_millis(1));
    }
    child
}

/// Files that are not whole.
fn parts(folder: &Folder) -> usize {
    let names = folder.names();
    names.iter().filter(|name| name.ends_with(".part")).count()
}

#[test]
fn a_run_that_is_ended_leaves_nothing_and_says_by_what() {
    for signal in [Signal::SIGINT, Signal::SIGTERM, Signal::SIGHUP] {
        let folder = Folder::new();
        let mut child = begun(&folder, "100000000", "");
        send(signal, &child);
        let status = child.wait().expect("it ends");
        assert_eq!(status.signal(), Some(signal as i32), "{signal}");
        assert_eq!(folder.names(), ["scene.toml"], "{signal}");
    }
}

#[test]
fn what_a_killed_run_leaves_is_removed_by_the_next_one_and_not_what_is_written() {
    let folder = Folder::new();
    let mut killed = begun(&folder, "100000000", "");
    killed.kill().expect("it is killed");
    killed.wait().expect("it ends");
    assert_eq!(parts(&folder), 1);
    let left = folder.names();
    let mut living = begun(&folder, "100000000", "");
    while parts(&folder) != 1 || folder.names() == left {
        sleep(Duration::from_millis(1));
    }
    folder.done("run scene.toml --out other.csv");
    assert_eq!(parts(&folder), 1);
    living.kill().expect("it is killed");
    living.wait().expect("it ends");
}

#[test]
fn what_is_to_be_ignored_is_ignored() {
    let folder = Folder::new();
    let mut child = begun(&folder, "50000", "trap '' HUP;");
    send(Signal::SIGHUP, &child);
    assert!(child.wait().expect("it ends").success());
    assert_eq!(folder.names(), ["scene.toml", "trace.jsonl"]);
}

/// The program with its standard output, or standard error, on a full disk.
#[cfg(target_os = "linux")]
fn on_a_full_disk(folder: &Folder, line: &str) -> [Output; 2] {
    [false, true].map(|is_error| {
        let full = File::options().write(true).open("/dev/full");
        let full = Stdio::from(full.expect("a full disk"));
        let mut program = Command::new(env!("CARGO_BIN_EXE_stiction"));
        program.args(line.split(' ')).current_dir(folder.file(""));
        match is_error {
            false => program.stdout(full).stderr(Stdio::piped()),
            true => program.stdout(Stdio::piped()).stderr(full),
        };
        let child = program.spawn().expect("the program starts");
        child.wait_with_output().expect("it ends")
    })
}

#[cfg(target_os = "linux")]
#[test]
fn what_cannot_be_printed_is_said_in_the_status() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.write("sweep.toml", "scenes = [\"scene.toml\"]\n");
    folder.done("run scene.toml --out trace.jsonl --record recording.jsonl");
    for arguments in [
        "run scene.toml",
        "run scene.toml --record other.jsonl --plot plots",
        "check trace.jsonl --scene scene.toml",
        "replay recording.jsonl",
        "sweep sweep.toml --dry-run",
        "sweep sweep.toml",
        "--help",
        "run --help",
        "--version",
    ] {
        let [printed, _] = on_a_full_disk(&folder, arguments);
        let expected = "error: standard output: No space left on device";
        assert_error(arguments, &printed, &[expected]);
    }
    for arguments in ["run absent", "run", "run scene.toml --speed"] {
        let [_, said] = on_a_full_disk(&folder, arguments);
        assert_eq!(said.status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn a_reader_that_has_gone_is_no_error() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    let mut child = Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(["run", "scene.toml", "--rate", "100000"])
        .current_dir(folder.file(""))
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    assert!(child.wait().expect("it ends").success());
}

/// A name that is no UTF-8.
fn odd(before: &str, after: &str) -> Vec<u8> {
    [before.as_bytes(), b"\xff\xfe", after.as_bytes()].concat()
}

#[test]
fn names_need_not_be_text() {
    let folder = Folder::new();
    let place = |name: &[u8]| folder.file(OsStr::from_bytes(name));
    let scene = odd("scene", ".toml");
    let [hand, trace, table] = ["hand", "trace", "table"].map(|name| odd(name, ".csv"));
    let [lines, recording, plots] =
        [("trace", ".jsonl"), ("r", ""), ("plots", "")].map(|(a, b)| odd(a, b));
    let below = odd("below", "");
    std::fs::create_dir(place(&below)).expect("a folder");
    let sweep = [&below[..], b"/", &odd("sweep", ".toml")].concat();
    std::fs::write(place(&scene), SCENE).expect("a scene");
    std::fs::write(place(&hand), "t,x,y,phi\n0,0.2,0.14,0.5\n1,0.2,0.06,0.5\n").expect("a path");
    std::fs::write(place(&[&below[..], b"/scene.toml"].concat()), SCENE).expect("a scene");
    std::fs::write(place(&sweep), "scenes = [\"scene.toml\"]\n").expect("a sweep");
    let runs: &[&[&[u8]]] = &[
        &[
            b"run", &scene, b"--hand", &hand, b"--out", &trace, b"--plot", &plots,
        ],
        &[b"run", &scene, b"--out", &lines, b"--record", &recording],
        &[b"check", &trace, b"--scene", &scene],
        &[b"check", &lines, b"--scene", &scene],
        &[b"replay", &recording, b"--out", &trace],
        &[b"sweep", &sweep],
        &[b"sweep", &sweep, b"--out", &table],
        &[b"sweep", &sweep, b"--out", &table],
    ];
    for arguments in runs {
        let output = Command::new(env!("CARGO_BIN_EXE_stiction"))
            .args(arguments.iter().map(|name| OsStr::from_bytes(name)))
            .current_dir(folder.file(""))
            .output()
            .expect("the program starts");
        let called = arguments.concat();
        let message = text(&output.stderr);
        assert!(output.status.success(), "{}: {message}", text(&called));
    }
    let strip = [&plots[..], b"/strip.png"].concat();
    for made in [
        &trace,
        &lines,
        &recording,
        &table,
        &odd("sweep", ".csv"),
        &strip,
    ] {
        assert!(place(made).exists(), "{}", text(made));
    }
}
