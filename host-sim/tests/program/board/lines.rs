//! Every kind of line, and lines with no board behind them.

use std::fs;
use std::io::{self, Read, Write};
use std::os::fd::AsRawFd;
use std::time::Duration;

use serial2::SerialPort;
use stiction_core::Fixed;

use super::fake::{Tricks, behind_socket, behind_tcp, on};
use super::{DRAGGED, SAMPLES, board, place};
use crate::common::{Folder, assert_all, assert_error};

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

#[test]
fn info_is_a_table_over_a_socket() {
    let (folder, socket) = place(&DRAGGED);
    let _fake = behind_socket::<Fixed>(&socket, 1, Tricks::default());
    let said = folder.done("info --socket line --timeout 20");
    let parts = [
        "a thread",
        "0.1.0",
        "solver            fixed\n",
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
    assert_all("info", &said, &parts);
}

/// The board at a place has the bits of this computer in every frame.
fn assert_verified(folder: &Folder, place: &str) {
    let said = folder.done(&format!("board scene.toml {place} --verify --timeout 20"));
    assert!(said.contains("301 of 301 frames equal"), "{said}");
}

#[test]
fn a_board_behind_tcp_is_verified() {
    let (folder, _) = place(&DRAGGED);
    let (address, fake) = behind_tcp::<f32>(Tricks::default());
    assert_verified(&folder, &format!("--tcp {address}"));
    assert_eq!(fake.join().expect("no panic").samples, SAMPLES);
}

#[test]
fn a_board_on_a_serial_port_is_verified() {
    let (folder, _) = place(&DRAGGED);
    let (line, port, _open) = terminal();
    let _fake = on::<f32>(line, Tricks::default());
    assert_verified(&folder, &format!("--port {port}"));
}

#[test]
fn a_line_without_a_board_is_said() {
    let (folder, _) = place(&DRAGGED);
    for (line, expected) in [
        ("info --socket nowhere", "nowhere: "),
        ("info --port /dev/nowhere", "/dev/nowhere at 921600 baud: "),
        ("info --socket a --tcp b:1", "cannot be used with"),
        ("info", "--port"),
        ("info", "--emulate"),
    ] {
        folder.refused(line, &[expected]);
    }
}

#[test]
fn a_board_without_room_for_obstacles_is_an_error_with_the_numbers() {
    let (folder, socket) = place(&with_obstacle("[[0.5, 0.0], [0.6, 0.0], [0.6, 0.1]]"));
    let _fake = behind_socket::<f32>(&socket, 1, Tricks::default());
    let room = "the scene has 1 obstacles with 3 corners, allowed on this board";
    let output = board(&folder, "");
    assert_error("no room", &output, &[room, "compiled in"]);
}

fn with_obstacle(vertices: &str) -> String {
    let obstacle = format!("[[obstacle]]\nname = \"post\"\nvertices = {vertices}\n[hand]");
    DRAGGED.replace("[hand]", &obstacle)
}

#[test]
fn a_scene_that_cannot_be_used_is_said_before_anything_is_opened() {
    let (folder, _) = place(&with_obstacle("[[0.5, 0.0], [0.6, 0.1], [0.6, 0.0]]"));
    let parts = ["scene.toml, line ", "`obstacle[0].vertices`"];
    assert_error("obstacle", &board(&folder, ""), &parts);
    folder.write(
        "scene.toml",
        DRAGGED.replace("offset = 0.0", "offset = 1.0"),
    );
    assert_error("start", &board(&folder, ""), &["scene.toml", "line "]);
    let boards = ["toaster", "olimex-stm32-h405, microbit"];
    folder.refused("board scene.toml --emulate toaster", &boards);
}
