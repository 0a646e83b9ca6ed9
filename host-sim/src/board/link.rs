//! A serial port, a unix socket or a tcp connection with one interface: it is written directly and read by a thread. Bytes that
//! were read but not yet processed are bounded: the system holds back or drops what a board sends beyond that.

use std::io::{self, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
#[cfg(unix)]
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::Sender;
use std::thread;
use std::time::{Duration, Instant};

use serial2::SerialPort;
use stiction_scene::Sample;

use super::error::BoardError;
use super::request::Request;

/// Interval at which a reader checks whether it is still needed.
const BREATH: Duration = Duration::from_millis(50);
/// A line that accepts no bytes, or is missing, for this duration counts as disconnected.
const STUCK: Duration = Duration::from_secs(1);

/// Maximum number of bytes per reading.
const AT_ONCE: usize = 4096;
/// Maximum number of unprocessed readings, 256 KiB at most: a second of the fastest line, 2 Mbaud.
const MOST_WAITING: usize = 64;
/// Interval at which a reader checks whether there is room for more.
const PAUSE: Duration = Duration::from_millis(1);

/// Bytes that were read, with their time; counted until they are processed.
#[derive(Debug)]
pub(super) struct Reading {
    pub(super) at: Instant,
    pub(super) bytes: Vec<u8>,
    waiting: Arc<AtomicUsize>,
}

impl Drop for Reading {
    fn drop(&mut self) {
        self.waiting.fetch_sub(1, Ordering::Relaxed);
    }
}

#[derive(Debug)]
pub(super) enum News {
    /// Bytes that were read from a link, by its number.
    Bytes(u32, Reading),
    /// A link was disconnected, and why.
    Gone(u32, String),
    Sample(Sample),
    /// The tracker was disconnected, and why.
    NoTracker(BoardError),
    Request(Request),
    /// The board is no longer needed.
    Enough,
}

#[derive(Debug)]
pub(super) enum Link {
    Port(SerialPort),
    Tcp(TcpStream),
    #[cfg(unix)]
    Socket(UnixStream),
}

impl Link {
    /// A serial port, 8 data bits, no parity.
    pub(super) fn port(place: &Path, baud: u32) -> io::Result<Self> {
        let mut port = SerialPort::open(place, baud)?;
        port.set_read_timeout(BREATH)?;
        port.set_write_timeout(STUCK)?;
        // Earlier bytes belong to another session.
        port.discard_buffers()?;
        Ok(Self::Port(port))
    }

    pub(super) fn tcp(address: &str) -> io::Result<Self> {
        let mut places = address.to_socket_addrs()?;
        let place = places
            .next()
            .ok_or_else(|| io::Error::other("no such host"))?;
        let stream = TcpStream::connect_timeout(&place, STUCK)?;
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(BREATH))?;
        stream.set_write_timeout(Some(STUCK))?;
        Ok(Self::Tcp(stream))
    }

    #[cfg(unix)]
    pub(super) fn socket(place: &Path) -> io::Result<Self> {
        let stream = UnixStream::connect(place)?;
        stream.set_read_timeout(Some(BREATH))?;
        stream.set_write_timeout(Some(STUCK))?;
        Ok(Self::Socket(stream))
    }

    #[cfg(not(unix))]
    pub(super) fn socket(_: &Path) -> io::Result<Self> {
        Err(io::ErrorKind::Unsupported.into())
    }

    /// A unix socket if there is one, otherwise a serial port.
    pub(super) fn port_or_socket(place: &Path, baud: u32) -> io::Result<Self> {
        #[cfg(unix)]
        {
            use std::os::unix::fs::FileTypeExt;
            if std::fs::metadata(place)?.file_type().is_socket() {
                return Self::socket(place);
            }
        }
        Self::port(place, baud)
    }

    fn try_clone(&self) -> io::Result<Self> {
        match self {
            Self::Port(port) => port.try_clone().map(Self::Port),
            Self::Tcp(stream) => stream.try_clone().map(Self::Tcp),
            #[cfg(unix)]
            Self::Socket(stream) => stream.try_clone().map(Self::Socket),
        }
    }

    /// Returns the bytes that have arrived; nothing after a while. An end is an error.
    pub(super) fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let result = match self {
            Self::Port(port) => port.read(bytes),
            Self::Tcp(stream) => stream.read(bytes),
            #[cfg(unix)]
            Self::Socket(stream) => stream.read(bytes),
        };
        match result {
            Ok(0) => Err(io::ErrorKind::UnexpectedEof.into()),
            Err(error) => match error.kind() {
                io::ErrorKind::WouldBlock
                | io::ErrorKind::TimedOut
                | io::ErrorKind::Interrupted => Ok(0),
                _ => Err(error),
            },
            read => read,
        }
    }

    pub(super) fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        match self {
            Self::Port(port) => port.write_all(bytes),
            Self::Tcp(stream) => stream.write_all(bytes),
            #[cfg(unix)]
            Self::Socket(stream) => stream.write_all(bytes),
        }
    }
}

/// A link that is read by a thread, until this is dropped.
#[derive(Debug)]
pub(super) struct Open {
    link: Link,
    number: u32,
    wanted: Arc<AtomicBool>,
}

impl Open {
    /// Begins to read; the news include `number`.
    pub(super) fn new(link: Link, number: u32, news: Sender<News>) -> io::Result<Self> {
        let wanted = Arc::new(AtomicBool::new(true));
        let (reader, reading) = (link.try_clone()?, Arc::clone(&wanted));
        thread::spawn(move || read_all(reader, number, &reading, &news));
        Ok(Self {
            link,
            number,
            wanted,
        })
    }

    pub(super) const fn number(&self) -> u32 {
        self.number
    }

    pub(super) fn write(&mut self, bytes: &[u8]) -> Result<(), String> {
        self.link.write_all(bytes).map_err(|error| reason(&error))
    }
}

/// Reads a link as long as it is needed and there is room for its bytes.
fn read_all(mut link: Link, number: u32, wanted: &AtomicBool, news: &Sender<News>) {
    let mut bytes = [0; AT_ONCE];
    let waiting = Arc::new(AtomicUsize::new(0));
    while wanted.load(Ordering::Relaxed) {
        if waiting.load(Ordering::Relaxed) >= MOST_WAITING {
            thread::sleep(PAUSE);
            continue;
        }
        let message = match link.read(&mut bytes) {
            Ok(0) => continue,
            Ok(count) => {
                waiting.fetch_add(1, Ordering::Relaxed);
                let reading = Reading {
                    at: Instant::now(),
                    bytes: bytes[..count].to_vec(),
                    waiting: Arc::clone(&waiting),
                };
                News::Bytes(number, reading)
            }
            Err(error) => News::Gone(number, reason(&error)),
        };
        let last = matches!(message, News::Gone(..));
        if news.send(message).is_err() || last {
            return;
        }
    }
}

impl Drop for Open {
    fn drop(&mut self) {
        self.wanted.store(false, Ordering::Relaxed);
    }
}

pub(super) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => "it was closed at the other end".to_owned(),
        io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => "it takes no more bytes".to_owned(),
        _ => error.to_string(),
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::sync::mpsc;

    /// A board that sends more than is processed waits; nothing that it sent is lost.
    #[test]
    fn what_waits_to_be_looked_at_is_bounded() {
        let (mut board, line) = UnixStream::pair().expect("a line");
        let link = Link::Socket(line);
        let (sender, news) = mpsc::channel();
        let open = Open::new(link, 1, sender).expect("a reader");
        let flood = vec![7_u8; 4 << 20];
        let length = flood.len();
        let talker = thread::spawn(move || board.write_all(&flood));
        // Longer than reading all of it takes.
        thread::sleep(Duration::from_millis(300));
        assert!(!talker.is_finished(), "it waits");
        let mut count = 0;
        let mut most = 0;
        while count < length {
            let News::Bytes(_, reading) = news.recv().expect("news") else {
                panic!("only bytes were sent");
            };
            most = most.max(reading.waiting.load(Ordering::Relaxed));
            count += reading.bytes.len();
        }
        assert!(most <= MOST_WAITING, "{most}");
        assert!(talker.join().expect("no panic").is_ok());
        drop(open);
    }
}
