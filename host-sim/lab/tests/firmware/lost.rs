//! When all is lost on a Cortex-M33: QEMU's debugger changes a register of the running board, and the board stops by itself.

use crate::board::connected;
use crate::chip::ENDING_AN505;
use std::io::{Read, Write};
use std::os::unix::net::UnixStream;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const STACK_POINTER: u8 = 13;
const PROGRAM_COUNTER: u8 = 15;
/// Nothing is there, and nothing there is code.
const NOWHERE: u32 = 0xE000_0000;
/// How an image with a log ends when it stops.
const STOPPED: i32 = 101;
/// It is in its ticks after so long.
const STARTED: Duration = Duration::from_secs(1);
const PATIENCE: Duration = Duration::from_secs(60);

/// A command in the protocol of gdb.
fn ask(line: &mut UnixStream, command: &str) {
    let sum = command.bytes().fold(0_u8, u8::wrapping_add);
    write!(line, "${command}#{sum:02x}").unwrap();
}

fn answer(line: &mut UnixStream, command: &str) -> String {
    ask(line, command);
    let mut text = String::new();
    let mut byte = [0];
    while !text.contains('#') {
        line.read_exact(&mut byte).unwrap();
        text.push(byte[0].into());
    }
    // Its sum.
    line.read_exact(&mut [0; 2]).unwrap();
    write!(line, "+").unwrap();
    text
}

/// How the board ends when a register has this value.
fn ends_with(register: u8, value: u32) -> Option<i32> {
    let image = ENDING_AN505.image()?;
    let folder = tempfile::tempdir().unwrap();
    let mut qemu = Command::new("qemu-system-arm")
        .args([
            "-M",
            ENDING_AN505.name(),
            "-display",
            "none",
            "-monitor",
            "none",
        ])
        .args(["-serial", "null", "-icount", "shift=3"])
        .args(["-semihosting-config", "enable=on,target=native"])
        .args(["-gdb", "unix:gdb,server=on,wait=off"])
        .arg("-kernel")
        .arg(&image.path)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    thread::sleep(STARTED);
    // It waits while it is looked at.
    let mut line = connected(&folder.path().join("gdb"));
    line.set_read_timeout(Some(PATIENCE)).unwrap();
    let value = value.swap_bytes();
    let done = answer(&mut line, &format!("P{register:x}={value:08x}"));
    assert!(done.ends_with("$OK#"), "{done}");
    ask(&mut line, "c");
    loop {
        if let Some(status) = qemu.try_wait().unwrap() {
            return status.code();
        }
        if begun.elapsed() > PATIENCE {
            qemu.kill().unwrap();
            qemu.wait().unwrap();
            panic!("it does not stop");
        }
        thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_cortex_m33_stops_at_a_fault() {
    if let Some(status) = ends_with(PROGRAM_COUNTER, NOWHERE) {
        assert_eq!(status, STOPPED);
    }
}

/// The stack pointer at the end of the stack: the next exception finds no room.
#[test]
fn a_cortex_m33_stops_when_its_stack_is_full() {
    let end = u32::try_from(ENDING_AN505.board.ram).unwrap();
    if let Some(status) = ends_with(STACK_POINTER, end + 8) {
        assert_eq!(status, STOPPED);
    }
}
