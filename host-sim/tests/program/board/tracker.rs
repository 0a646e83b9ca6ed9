//! The tracker of the paper as the hand.

use std::io::{ErrorKind, Read, Write};
use std::os::unix::net::UnixListener;
use std::process::{Command, Stdio};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use super::fake::{Tricks, behind_socket};
use super::lines::terminal;
use super::{DRAGGED, board, place};
use crate::common::{Folder, Signal, assert_error, numbers, records, send, text};

/// A record: thousandths of an inch, fortieths of a degree.
fn record(flags: u8, position: [i32; 3], angles: [u16; 3]) -> Vec<u8> {
    let mut bytes = vec![0x80 | flags];
    for p in position {
        bytes.extend([14, 7, 0].map(|shift| (p >> shift) as u8 & 0x7f));
    }
    for a in angles {
        bytes.extend([7, 0].map(|shift| (a >> shift) as u8 & 0x7f));
    }
    bytes
}

const LEFT: u8 = 4;
const OUT_OF_RANGE: u8 = 0x20;
const INCH: f64 = 0.0254;

/// The k-th record: along x, up and down z, turning about y (against the normal of the x-z plane), once out of range.
fn moving(k: i32) -> Vec<u8> {
    let flags = if k == 5 { OUT_OF_RANGE } else { LEFT };
    // 0.5 degrees each time, from 350 degrees on.
    let yaw = ((14_000 + 20 * k) % 14_400) as u16;
    record(flags, [8000 + 10 * k, 77, 6000 - 5 * k], [0, yaw, 0])
}

/// Answers so many requests, then goes away, or stays without a word.
fn answers(
    mut line: impl Read + Write + Send + 'static,
    count: i32,
    stays: bool,
) -> JoinHandle<()> {
    thread::spawn(move || {
        let (mut asked, mut byte) = (0, [0]);
        let mut before = 0;
        loop {
            match line.read(&mut byte) {
                Ok(1) => {}
                Err(error) if error.kind() == ErrorKind::TimedOut => continue,
                // The other end is closed.
                _ => return,
            }
            if (before, byte[0]) == (b'*', b'd') {
                if asked == count && !stays {
                    return;
                }
                // At 19200 baud a record takes 9 ms.
                thread::sleep(Duration::from_millis(9));
                if asked < count && line.write_all(&moving(asked)).is_err() {
                    return;
                }
                asked += 1;
            }
            before = byte[0];
        }
    })
}

/// The scene with the tracker's x-z plane, moved.
fn scene() -> String {
    let (start, _) = DRAGGED.split_at(DRAGGED.find("[hand]").expect("a hand"));
    format!("{start}[hand]\nplane = \"xz\"\nscale = 2.0\norigin = [-0.2, -0.15, 0.25]\n")
}

/// The hands of the trace are those of the records.
fn assert_followed(folder: &Folder, count: usize) {
    let trace = records(&folder.read("trace.jsonl"));
    assert_eq!(trace.len(), count);
    for (k, record) in trace.iter().enumerate() {
        // Out of range: the last one is held.
        let of = if k == 5 { 4.0 } else { k as f64 };
        // The normal of the x-z plane is -y: the rotation is counted against yaw; 350 degrees are -10.
        let phi = -(-10.0 + 0.5 * of).to_radians() + 0.25;
        let x = 2.0 * (8.0 + 0.01 * of) * INCH - 0.2;
        let y = 2.0 * (6.0 - 0.005 * of) * INCH - 0.15;
        for (found, expected) in numbers(&record["hand"]).into_iter().zip([x, y, phi]) {
            assert!((found - expected).abs() < 1e-5, "{k}: {record} {expected}");
        }
        let status = if k == 5 { "held-last" } else { "ok" };
        assert_eq!(record["status"], status, "{record}");
        // Depth along -y.
        let depth = record["depth"].as_f64().expect("a number");
        assert!((depth + 2.0 * 0.077 * INCH).abs() < 1e-6, "{record}");
    }
    assert!(
        trace.iter().any(|record| record["held"] == true),
        "it was never held"
    );
}

#[test]
fn records_of_a_tracker_behind_a_socket_are_the_hand() {
    let (folder, socket) = place(&scene());
    let listener = UnixListener::bind(folder.file("tracker")).expect("a socket");
    thread::spawn(move || {
        let (line, _) = listener.accept().expect("a client");
        answers(line, 40, false);
    });
    let fake = behind_socket::<f32>(&socket, 1, Tricks::default());
    let output = board(&folder, "--tracker tracker --verify --out trace.jsonl");
    let closed = "tracker tracker: it was closed at the other end";
    assert_error("it leaves", &output, &[closed]);
    assert_eq!(fake.join().expect("no panic").samples, 40);
    let said = text(&output.stdout);
    assert!(said.contains("40 of 40 frames equal"), "{said}");
    assert_followed(&folder, 40);
}

#[test]
fn a_tracker_on_a_serial_port_is_followed_until_ctrl_c() {
    let (folder, socket) = place(&scene());
    let (line, port, _open) = terminal();
    let _tracker = answers(line, 1_000_000, true);
    let fake = behind_socket::<f32>(&socket, 1, Tricks::default());
    let line = format!("board scene.toml --socket line --tracker {port} --out trace.jsonl");
    let child = Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(format!("{line} --timeout 20").split(' '))
        .current_dir(folder.file(""))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    thread::sleep(Duration::from_millis(1500));
    send(Signal::SIGINT, &child);
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let seen = fake.join().expect("no panic").samples;
    let recorded = records(&folder.read("trace.jsonl")).len();
    assert!(
        recorded as u64 <= seen && recorded > 6,
        "{recorded} of {seen}"
    );
    assert_followed(&folder, recorded);
}

#[test]
fn a_tracker_that_is_silent_is_an_error() {
    let (folder, socket) = place(&scene());
    let (line, port, _open) = terminal();
    let _tracker = answers(line, 0, true);
    let _fake = behind_socket::<f32>(&socket, 1, Tricks::default());
    let output = board(&folder, &format!("--tracker {port} --timeout 0.4"));
    let silent = "no record within 0.4 s, allowed: a Logitech";
    assert_error("silent", &output, &[silent]);
    let missing = board(&folder, "--tracker /dev/nowhere --timeout 0.4");
    assert_error("missing", &missing, &["error: "]);
}
