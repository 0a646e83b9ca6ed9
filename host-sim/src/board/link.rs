//! A serial port, a unix socket or a tcp connection as one thing that is written to, while a thread reads it.

use std::io::{self, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
#[cfg(unix)]
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;
use std::thread;
use std::time::{Duration, Instant};

use serial2::SerialPort;
use stiction_scene::Sample;

use super::error::BoardError;
use super::wish::Wish;

/// A reader looks so often whether it is still wanted.
const BREATH: Duration = Duration::from_millis(50);
/// A line that takes no bytes, or is not there, for so long is gone.
const STUCK: Duration = Duration::from_secs(1);

/// What reaches the main thread.
#[derive(Debug)]
pub(super) enum News {
    /// Bytes of a link, by its number, and when they came.
    Bytes(u32, Instant, Vec<u8>),
    /// A link is gone, and why.
    Gone(u32, String),
    /// A sample of the tracker.
    Sample(Sample),
    /// The tracker is gone, and why.
    NoTracker(BoardError),
    /// The board is to work in another way.
    Wish(Wish),
    /// No more of the board is wanted.
    Enough,
}

/// A stream of bytes in both directions.
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
        // What came before is of another session.
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

    /// A unix socket where there is one, otherwise a serial port.
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

    /// What has come; nothing after a while. An end is an error.
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
    /// Begins to read; the news carry `number`.
    pub(super) fn new(link: Link, number: u32, news: Sender<News>) -> io::Result<Self> {
        let wanted = Arc::new(AtomicBool::new(true));
        let (mut reader, reading) = (link.try_clone()?, Arc::clone(&wanted));
        thread::spawn(move || {
            let mut bytes = [0; 4096];
            while reading.load(Ordering::Relaxed) {
                let message = match reader.read(&mut bytes) {
                    Ok(0) => continue,
                    Ok(count) => News::Bytes(number, Instant::now(), bytes[..count].to_vec()),
                    Err(error) => News::Gone(number, reason(&error)),
                };
                let last = matches!(message, News::Gone(..));
                if news.send(message).is_err() || last {
                    return;
                }
            }
        });
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

impl Drop for Open {
    fn drop(&mut self) {
        self.wanted.store(false, Ordering::Relaxed);
    }
}

/// Why a link is gone.
pub(super) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => "it was closed at the other end".to_owned(),
        io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => "it takes no more bytes".to_owned(),
        _ => error.to_string(),
    }
}
