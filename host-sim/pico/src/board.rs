//! The chip at the pace of the real clock, with its serial line on a unix socket.

use std::io::{self, ErrorKind, Read, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::chip::{Chip, MEGAHERTZ};

/// The time that the chip runs between two checks of its line (µs).
const SLICE: u32 = 200;
/// The largest delay behind the real clock that is caught up; a longer one slows down the chip's clock instead.
const BEHIND: Duration = Duration::from_millis(20);
/// The largest number of bytes in transit to the chip; more wait at the other end.
const ON_THE_WAY: usize = 256;

/// An action on the chip between two slices.
type Look = Box<dyn FnOnce(&mut Chip) + Send>;

/// A chip that runs in its own thread until this handle is dropped.
#[derive(Debug)]
pub struct Board {
    /// When this is dropped, the thread ends.
    looks: Option<Sender<Look>>,
    thread: Option<JoinHandle<()>>,
}

impl Board {
    /// Runs the chip with the contents of its flash, which starts at [`FLASH`](crate::FLASH). It starts when its line, a socket
    /// created here, is first opened. The line may be closed and opened again; bytes sent while it is closed are lost.
    ///
    /// # Errors
    /// The socket cannot be created, or the thread cannot be started.
    /// The socket cannot be made, or the thread not be started.
    pub fn start(flash: Vec<u8>, socket: &Path) -> io::Result<Self> {
        let listener = UnixListener::bind(socket)?;
        listener.set_nonblocking(true)?;
        let (looks, wanted) = mpsc::channel();
        let thread = thread::Builder::new().name("emulated Pico".to_owned());
        let thread = thread.spawn(move || run(Chip::new(flash), &wanted, &listener))?;
        Ok(Self {
            looks: Some(looks),
            thread: Some(thread),
        })
    }

    /// Runs an action on the chip between two of its instructions; `None` if the chip has ended.
    pub fn look<T: Send + 'static>(
        &self,
        at: impl FnOnce(&mut Chip) -> T + Send + 'static,
    ) -> Option<T> {
        let (sender, seen) = mpsc::channel();
        // The receiver may be gone.
        let look: Look = Box::new(move |chip| drop(sender.send(at(chip))));
        self.looks.as_ref()?.send(look).ok()?;
        seen.recv().ok()
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        self.looks = None;
        if let Some(thread) = self.thread.take() {
            // The thread returns nothing.
            let _ = thread.join();
        }
    }
}

/// Runs the chip slice by slice, each at the pace of the real clock.
fn run(mut chip: Chip, looks: &Receiver<Look>, listener: &UnixListener) {
    let slice = Duration::from_micros(SLICE.into());
    let mut line: Option<UnixStream> = None;
    let mut due: Option<Instant> = None;
    loop {
        match looks.try_recv() {
            Ok(look) => look(&mut chip),
            Err(TryRecvError::Empty) => {}
            Err(TryRecvError::Disconnected) => return,
        }
        if line.is_none() {
            line = opened(listener);
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
        if let Some(open) = &mut line
            && !takes(&mut chip, open)
        {
            line = None;
        }
        chip.run(u64::from(SLICE * MEGAHERTZ));
        let gone = chip.gone();
        if let Some(open) = &mut line
            && !gives(open, &gone)
        {
            line = None;
        }
    }
}

/// The line, if a client opens it.
fn opened(listener: &UnixListener) -> Option<UnixStream> {
    let (line, _) = listener.accept().ok()?;
    line.set_nonblocking(true).ok()?;
    Some(line)
}

/// Passes the bytes sent to the chip on to it. Returns whether the line is still open.
fn takes(chip: &mut Chip, line: &mut UnixStream) -> bool {
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
fn gives(line: &mut UnixStream, bytes: &[u8]) -> bool {
    match line.write_all(bytes) {
        Ok(()) => true,
        Err(error) => is_passing(&error),
    }
}

fn is_passing(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted)
}
