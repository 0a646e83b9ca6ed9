//! Every kind of line, and lines with no board behind them.

use std::fs;
use std::io::{self, Read, Write};
use std::os::fd::AsRawFd;
use std::time::Duration;

use serial2::SerialPort;
use stiction_core::Fixed;

use super::fake::{Tricks, behind_socket, behind_tcp, on};
use super::{DRAGGED, SAMPLES, assert_error, board, place, said};
use crate::common::{Folder, text};

/// A pseudo-terminal as a line.
struct Terminal(SerialPort);

impl Read for Terminal {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.0.read(bytes)
    }
}

impl Write for Terminal {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// A terminal, the name of its other end, and that end, which must stay open.
pub(crate) fn terminal() -> (impl Read + Write + Send + 'static, String, SerialPort) {
    let (mut here, there) = SerialPort::pair().expect("a pseudo-terminal");
    here.set_read_timeout(Duration::from_millis(5))
        .expect("a time");
    let name = fs::read_link(format!("/proc/self/fd/{}", there.as_raw_fd()));
    let name = name.expect("its name").to_string_lossy().into_owned();
    (Terminal(here), name, there)
}

fn assert_tells(said: &str, parts: &[&str]) {
    for part in parts {
        assert!(said.contains(part), "{part:?} in {said}");
    }
}

#[test]
fn info_is_a_table_over_a_socket() {
    let (folder, socket) = place(&DRAGGED);
    let _fake = behind_socket::<Fixed>(&socket, 1, Tricks::default());
    let output = folder.stiction(&["info", "--socket", "line", "--timeout", "20"]);
    assert!(output.status.success(), "{}", said(&output));
    let parts = [
        "a thread",
        "0.1.0",
        "fixed, friction and weight",
        "16 vertices, 8 surfaces",
        "1000 Hz, at most 5000 Hz",
        "none",
        "budget            none",
        "mu_s 0.5, mu_d 0.3, memory length L / 4096",
        "timed",
        "xy",
        "every 50 ms",
        "force to the hand on",
        "0 missed",
    ];
    assert_tells(&text(&output.stdout), &parts);
}

/// The board at a place has the bits of this computer in every frame.
fn assert_verified(folder: &Folder, place: [&str; 2]) {
    let rest = ["--verify", "--timeout", "20"];
    let output = folder.stiction(&[&["board", "scene.toml"], &place[..], &rest].concat());
    assert!(output.status.success(), "{}", said(&output));
    assert_tells(&said(&output), &["301 of 301 frames equal"]);
}

#[test]
fn a_board_behind_tcp_is_verified() {
    let (folder, _) = place(&DRAGGED);
    let (address, fake) = behind_tcp::<f32>(Tricks::default());
    assert_verified(&folder, ["--tcp", &address]);
    assert_eq!(fake.join().expect("no panic").samples, SAMPLES);
}

#[test]
fn a_board_on_a_serial_port_is_verified() {
    let (folder, _) = place(&DRAGGED);
    let (line, port, _open) = terminal();
    let _fake = on::<f32>(line, Tricks::default());
    assert_verified(&folder, ["--port", &port]);
}

#[test]
fn a_line_without_a_board_is_said() {
    let (folder, _) = place(&DRAGGED);
    let missing = folder.stiction(&["info", "--socket", "nowhere"]);
    assert_error(&missing, &["nowhere: "]);
    let missing = folder.stiction(&["info", "--port", "/dev/nowhere"]);
    assert_error(&missing, &["/dev/nowhere at 921600 baud: "]);
    let both = folder.stiction(&["info", "--socket", "a", "--tcp", "b:1"]);
    assert_error(&both, &["cannot be used with"]);
    assert_error(&folder.stiction(&["info"]), &["--port", "--emulate"]);
}

#[test]
fn a_silent_board_is_an_error_after_the_time_given() {
    let (folder, socket) = place(&DRAGGED);
    let tricks = Tricks {
        silent_after: Some(0),
        ..Tricks::default()
    };
    let _fake = behind_socket::<f32>(&socket, 1, tricks);
    let output = board(&folder, &["--timeout", "0.3", "--out", "trace.jsonl"]);
    assert_error(
        &output,
        &["no answer to hello within 0.3 s; not a single byte came"],
    );
    assert_eq!(folder.names(), ["line", "scene.toml"]);
}

#[test]
fn an_echo_is_distinguished_from_a_board() {
    let (folder, socket) = place(&DRAGGED);
    let tricks = Tricks {
        echo: true,
        ..Tricks::default()
    };
    let _fake = behind_socket::<f32>(&socket, 1, tricks);
    let output = board(&folder, &["--timeout", "0.3"]);
    assert_error(&output, &["no answer to hello", "an echo"]);
}

#[test]
fn another_version_is_an_error() {
    let (folder, socket) = place(&DRAGGED);
    let tricks = Tricks {
        version: Some(1),
        ..Tricks::default()
    };
    let _fake = behind_socket::<f32>(&socket, 1, tricks);
    assert_error(
        &board(&folder, &[]),
        &["another version of the wire format, allowed: 2"],
    );
}

/// A board without room for obstacles, or of version 2, says nothing of room.
#[test]
fn a_board_without_room_for_obstacles_is_an_error_with_the_numbers() {
    let obstacle =
        "[[obstacle]]\nname = \"post\"\nvertices = [[0.5, 0.0], [0.6, 0.0], [0.6, 0.1]]\n[hand]";
    let (folder, socket) = place(&DRAGGED.replace("[hand]", obstacle));
    let _fake = behind_socket::<f32>(&socket, 1, Tricks::default());
    assert_error(
        &board(&folder, &[]),
        &[
            "the scene has 1 obstacles with 3 corners, allowed on this board: none",
            "feature `obstacles`",
            "version 3",
        ],
    );
}

#[test]
fn an_obstacle_that_cannot_be_used_is_said_with_its_line() {
    let obstacle = "[[obstacle]]\nvertices = [[0.5, 0.0], [0.6, 0.1], [0.6, 0.0]]\n[hand]";
    let (folder, _) = place(&DRAGGED.replace("[hand]", obstacle));
    let parts = ["scene.toml, line ", "obstacle[0].vertices["];
    assert_error(&board(&folder, &[]), &parts);
}

#[test]
fn a_scene_that_cannot_be_used_is_said_before_anything_is_opened() {
    let (folder, _) = place(&DRAGGED.replace("offset = 0.0", "offset = 1.0"));
    assert_error(&board(&folder, &[]), &["scene.toml", "line "]);
    let emulated = folder.stiction(&["board", "scene.toml", "--emulate", "toaster"]);
    assert_error(&emulated, &["toaster", "olimex-stm32-h405, microbit"]);
}
