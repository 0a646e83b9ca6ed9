//! The connection to a board: on a serial port, a unix socket, a tcp port, or in an emulator of its own.

use std::fmt;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::emulate::{EmulatedBoard, Emulator, Image};
use super::error::BoardError;
use super::link::{Link, reason};
use super::usb::{AUTO, Port, allowed_ports};
use crate::options::parse_end;

/// The arguments that say where the board is.
#[derive(Args, Clone, Debug)]
pub struct ConnectArgs {
    #[command(flatten)]
    place: PlaceArgs,
    /// Baud rate of the serial port; 115200 for the micro:bit
    #[arg(
        long,
        value_name = "BAUD",
        default_value = "921600",
        value_parser = parse_baud,
        allow_negative_numbers = true
    )]
    baud: u32,
    /// Seconds that the board may be silent before it counts as gone
    #[arg(long, value_name = "SECONDS", default_value = "2", value_parser = parse_timeout, allow_negative_numbers = true)]
    timeout: Duration,
}

/// The group of arguments of which a program that needs a board requires one.
pub(crate) const PLACE: &str = "place";

/// One of these.
#[derive(Args, Clone, Debug, Default)]
#[group(id = PLACE, multiple = false)]
struct PlaceArgs {
    /// The board is on a serial port; auto: on USB, wherever it is found there (Linux)
    #[arg(long, value_name = "/dev/tty...")]
    port: Option<PathBuf>,
    /// The board is behind a unix socket
    #[arg(long, value_name = "PATH")]
    socket: Option<PathBuf>,
    /// The board is behind a tcp port
    #[arg(long, value_name = "HOST:PORT", value_parser = parse_end)]
    tcp: Option<String>,
    /// Build the image of a board (olimex-stm32-h405 unless BOARD is given) and emulate it; SCENE comes before this option
    #[arg(long, value_name = "BOARD", num_args = 0..=1, default_missing_value = "olimex-stm32-h405")]
    emulate: Option<EmulatedBoard>,
}

/// What Linux and macOS say of a file that has no baud rate.
const ENOTTY: i32 = 25;

fn parse_baud(text: &str) -> Result<u32, &'static str> {
    let baud = text.parse().ok().filter(|baud| *baud > 0);
    baud.ok_or(
        "allowed: a whole number, 1 or more; 115200 for the micro:bit, 921600 for the others",
    )
}

fn parse_timeout(text: &str) -> Result<Duration, String> {
    let seconds: Option<f64> = text.parse().ok();
    match seconds {
        Some(seconds) if (0.05..=3600.0).contains(&seconds) => Ok(Duration::from_secs_f64(seconds)),
        _ => Err("allowed: 0.05 to 3600".to_owned()),
    }
}

impl ConnectArgs {
    pub(crate) const fn is_wanted(&self) -> bool {
        let place = &self.place;
        place.port.is_some()
            || place.socket.is_some()
            || place.tcp.is_some()
            || place.emulate.is_some()
    }

    /// The address of the board; builds and starts the emulator if one is requested.
    pub(super) fn address(&self, image: Image<'_>) -> Result<Address, BoardError> {
        let place = self.place.clone();
        Ok(match (place.port, place.socket, place.tcp) {
            (Some(port), ..) if port.as_os_str() == AUTO => {
                Address::Usb(Port::of_the_board()?, self.baud)
            }
            (Some(port), ..) => Address::Port(port, self.baud),
            (_, Some(socket), _) => Address::Socket(socket),
            (.., Some(tcp)) => Address::Tcp(tcp),
            _ => {
                let board = place.emulate.unwrap_or_default();
                Address::Emulated(Emulator::start(board, image)?)
            }
        })
    }

    /// The board that is to be emulated.
    pub(super) const fn emulated(&self) -> Option<EmulatedBoard> {
        self.place.emulate
    }

    pub(super) const fn timeout(&self) -> Duration {
        self.timeout
    }
}

#[derive(Debug)]
pub(super) enum Address {
    Port(PathBuf, u32),
    /// Found on USB, and found again at whatever port it is plugged in.
    Usb(Port, u32),
    Socket(PathBuf),
    Tcp(String),
    Emulated(Emulator),
}

impl Address {
    pub(super) fn open(&mut self) -> Result<Link, BoardError> {
        let opened = match self {
            Self::Port(place, baud) => Link::port(place, *baud),
            Self::Usb(port, baud) => Link::port(port.again()?, *baud),
            Self::Socket(place) => Link::socket(place),
            Self::Tcp(address) => Link::tcp(address),
            Self::Emulated(emulator) => return Ok(emulator.open()?),
        };
        opened.map_err(|error| BoardError::Gone {
            address: self.to_string(),
            problem: match (&*self, error.kind(), error.raw_os_error()) {
                (Self::Port(..), ErrorKind::NotFound, _) => allowed_ports("no such port"),
                (Self::Port(..), _, Some(ENOTTY)) => allowed_ports("no serial port"),
                _ => reason(&error),
            },
        })
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Port(place, baud) => write!(f, "{} at {baud} baud", place.display()),
            Self::Usb(port, _) => write!(f, "{port}"),
            Self::Socket(place) => write!(f, "{}", place.display()),
            Self::Tcp(address) => f.write_str(address),
            Self::Emulated(emulator) => write!(f, "emulated {}", emulator.board().name()),
        }
    }
}
