//! The chip at the pace of the real clock, with its serial line and a monitor on unix sockets.

use std::fs;
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::os::unix::process::parent_id;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use super::chip::{Chip, MEGAHERTZ};

/// The time that the chip runs between two checks of its line (µs).
const SLICE: u32 = 200;
/// The largest delay behind the real clock that is caught up; a longer one slows down the chip's clock instead.
const BEHIND: Duration = Duration::from_millis(20);
/// The largest number of bytes in transit to the chip; more wait at the other end.
const ON_THE_WAY: usize = 256;

/// Runs the chip with the contents of its flash, which starts at [`FLASH`](super::FLASH), until the process that started this one ends.
/// It starts when its line, a socket created here, is first opened. The line may be closed and opened again; bytes sent while it is
/// closed are lost. On its monitor, another socket created here, each connection gives one command: `memsave FROM SIZE FILE` writes a
/// range of its memory to a file.
///
/// # Errors
/// A socket cannot be created.
pub fn run(flash: Vec<u8>, line: &Path, monitor: &Path) -> io::Result<()> {
    let [listener, monitor] = [UnixListener::bind(line)?, UnixListener::bind(monitor)?];
    listener.set_nonblocking(true)?;
    monitor.set_nonblocking(true)?;
    let mut chip = Chip::new(flash);
    let slice = Duration::from_micros(SLICE.into());
    let mut line: Option<UnixStream> = None;
    let mut due: Option<Instant> = None;
    let parent = parent_id();
    while parent_id() == parent {
        if let Ok((command, _)) = monitor.accept() {
            obey(&chip, command)?;
        }
        if line.is_none() {
            line = opened(&listener);
        }
        let now = Instant::now();
        let begins = match due {
            None if line.is_none() => {
                thread::sleep(slice);
                continue;
            }
            None => now,
            Some(due) => due.max(now.checked_sub(BEHIND).unwrap_or(now)),
        };
        thread::sleep(begins.saturating_duration_since(now));
        due = Some(begins + slice);
        line = line.filter(|open| takes(&mut chip, open));
        chip.run(u64::from(SLICE * MEGAHERTZ));
        let gone = chip.gone();
        line = line.filter(|open| gives(open, &gone));
    }
    Ok(())
}

/// Executes a command of the monitor; another one has no effect.
fn obey(chip: &Chip, command: UnixStream) -> io::Result<()> {
    let mut text = String::new();
    command.set_nonblocking(false)?;
    BufReader::new(command).read_line(&mut text)?;
    let words: Vec<&str> = text.split_whitespace().collect();
    let ["memsave", from, size, file] = words[..] else {
        return Ok(());
    };
    match (from.parse(), size.parse()) {
        (Ok(from), Ok(size)) => fs::write(file, chip.bytes(from, size)),
        _ => Ok(()),
    }
}

/// The line, if a client opens it.
fn opened(listener: &UnixListener) -> Option<UnixStream> {
    let (line, _) = listener.accept().ok()?;
    line.set_nonblocking(true).ok()?;
    Some(line)
}

/// Passes the bytes sent to the chip on to it. Returns whether the line is still open.
fn takes(chip: &mut Chip, mut line: &UnixStream) -> bool {
    let mut bytes = [0; ON_THE_WAY];
    let room = ON_THE_WAY.saturating_sub(chip.coming());
    if room == 0 {
        return true;
    }
    match line.read(&mut bytes[..room]) {
        Ok(0) => false,
        Ok(count) => {
            chip.bring(&bytes[..count]);
            true
        }
        Err(error) => is_passing(&error),
    }
}

/// Passes on the bytes that the chip has sent; bytes that nobody reads are lost. Returns whether the line is still open.
fn gives(mut line: &UnixStream, bytes: &[u8]) -> bool {
    match line.write_all(bytes) {
        Ok(()) => true,
        Err(error) => is_passing(&error),
    }
}

fn is_passing(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted)
}
