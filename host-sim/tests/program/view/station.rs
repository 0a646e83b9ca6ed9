//! A board that is a thread of the test: the program of real boards behind a unix socket, with a tick every millisecond.

use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use stiction_core::{Fixed, Real};
use stiction_firmware::device::{FromLine, NoActuators, Servo};
use stiction_firmware::safety::Limits;
use stiction_firmware::station::{Link, Setup, Station};
use stiction_tests::station::BOX;
use stiction_wire::{Mode, NumberType, frame_bytes, scene_bytes};

pub(crate) const V: usize = 8;
pub(crate) const S: usize = 2;
pub(crate) const LONGEST: usize = frame_bytes(scene_bytes([V, S, 0, 0]));

/// A board, until it is dropped.
pub(crate) struct Board {
    is_wanted: Arc<AtomicBool>,
    /// It is pulled out as soon as this is set, and comes back at once.
    pub(crate) is_pulled: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

/// The description of a board that is a thread, without a device.
pub(crate) fn described(number: NumberType) -> Setup {
    Setup {
        name: "a thread",
        number,
        line_rate: 1_000_000,
        fastest_tick: 1_000,
        work_rate: u32::MAX,
        limits: Limits::DEFAULT,
        passivity: None,
        mode: Mode::DEFAULT,
        // A client sends its own.
        scene: BOX,
        knob: None,
    }
}

impl Board {
    pub(crate) fn f32(place: &Path) -> Self {
        Self::behind::<f32>(place, NumberType::F32)
    }

    pub(crate) fn fixed(place: &Path) -> Self {
        Self::behind::<Fixed>(place, NumberType::Fixed)
    }

    fn behind<R: Real<Si = f32>>(place: &Path, number: NumberType) -> Self {
        // A station has its setup for good.
        let setup: &'static Setup = Box::leak(Box::new(described(number)));
        let listener = UnixListener::bind(place).expect("a socket");
        listener.set_nonblocking(true).expect("an option");
        let (is_wanted, is_pulled) = (Arc::new(AtomicBool::new(true)), Arc::default());
        let (wanted, pulled) = (Arc::clone(&is_wanted), Arc::clone(&is_pulled));
        let thread = thread::spawn(move || {
            while wanted.load(Ordering::Relaxed) {
                match listener.accept() {
                    Ok((stream, _)) => serve::<R>(setup, stream, &wanted, &pulled),
                    Err(_) => thread::sleep(Duration::from_millis(5)),
                }
            }
        });
        Self {
            is_wanted,
            is_pulled,
            thread: Some(thread),
        }
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        self.is_wanted.store(false, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// From power-up until the line is gone.
fn serve<R: Real<Si = f32>>(
    setup: &'static Setup,
    stream: UnixStream,
    wanted: &AtomicBool,
    pulled: &AtomicBool,
) {
    let station = Station::<R, V, S, 0, LONGEST>::new(setup);
    let mut station = station.expect("a board");
    let mut line = Line::new(stream);
    let (mut due, mut servo) = (Instant::now(), Servo::new((FromLine, NoActuators)));
    while wanted.load(Ordering::Relaxed) && !pulled.swap(false, Ordering::Relaxed) {
        if !line.listen() {
            return;
        }
        station.tick(line.now_us(), &mut line, &mut servo);
        due += Duration::from_millis(1);
        thread::sleep(due.saturating_duration_since(Instant::now()));
    }
}

/// A line to a client.
pub(crate) struct Line {
    stream: UnixStream,
    came: VecDeque<u8>,
    begun: Instant,
}

impl Line {
    pub(crate) fn new(stream: UnixStream) -> Self {
        stream.set_nonblocking(true).expect("an option");
        Self {
            stream,
            came: VecDeque::new(),
            begun: Instant::now(),
        }
    }

    /// The time since it was opened (µs).
    pub(crate) fn now_us(&self) -> u32 {
        self.begun.elapsed().as_micros() as u32
    }

    /// Takes what has come; false at the end.
    pub(crate) fn listen(&mut self) -> bool {
        let mut bytes = [0; 4096];
        match self.stream.read(&mut bytes) {
            Ok(0) => false,
            Ok(count) => {
                self.came.extend(&bytes[..count]);
                true
            }
            Err(error) => error.kind() == ErrorKind::WouldBlock,
        }
    }
}

impl Link for Line {
    fn take(&mut self) -> Option<u8> {
        self.came.pop_front()
    }

    fn send(&mut self, frame: &[u8]) -> bool {
        self.stream.write_all(frame).is_ok()
    }

    fn now_ns(&mut self) -> u32 {
        self.begun.elapsed().as_nanos() as u32
    }
}
