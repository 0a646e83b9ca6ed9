//! The chip at the pace of the real clock, its serial line on a unix socket.

use std::io::{self, ErrorKind, Read, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::chip::{Chip, MEGAHERTZ};

/// It is looked after so often (µs).
const SLICE: u32 = 200;
/// So far it may fall behind the real clock before its own is slow instead.
const BEHIND: Duration = Duration::from_millis(20);
/// So many bytes may be on their way to it; more wait at the other end.
const ON_THE_WAY: usize = 256;

/// What is to be done with the chip between two slices.
type Look = Box<dyn FnOnce(&mut Chip) + Send>;

/// A chip that runs in a thread of its own until this is dropped.
#[derive(Debug)]
pub struct Board {
    /// Without it the thread ends.
    looks: Option<Sender<Look>>,
    thread: Option<JoinHandle<()>>,
}

impl Board {
    /// Runs the chip with what lies in its flash, from [`FLASH`](crate::FLASH) on, from the moment on in which its line, a socket made
    /// here, is first opened. The line may be closed and opened again; what is sent to nobody is lost.
    ///
    /// # Errors
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

    /// Looks at the chip between two of its instructions; nothing where it has ended.
    pub fn look<T: Send + 'static>(
        &self,
        at: impl FnOnce(&mut Chip) -> T + Send + 'static,
    ) -> Option<T> {
        let (sender, seen) = mpsc::channel();
        // Nobody may be there any more to whom it is said.
        let look: Look = Box::new(move |chip| drop(sender.send(at(chip))));
        self.looks.as_ref()?.send(look).ok()?;
        seen.recv().ok()
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        self.looks = None;
        if let Some(thread) = self.thread.take() {
            // It has nothing to say.
            let _ = thread.join();
        }
    }
}

/// Slice by slice, each as long as it takes.
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

/// The line, if somebody opens it.
fn opened(listener: &UnixListener) -> Option<UnixStream> {
    let (line, _) = listener.accept().ok()?;
    line.set_nonblocking(true).ok()?;
    Some(line)
}

/// Brings the chip what was sent to it. Whether the line is still open.
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

/// Hands on what the chip has sent; what nobody reads is lost. Whether the line is still open.
fn gives(line: &mut UnixStream, bytes: &[u8]) -> bool {
    match line.write_all(bytes) {
        Ok(()) => true,
        Err(error) => is_passing(&error),
    }
}

fn is_passing(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted)
}
