//! The addresses of `stiction view`: where clients connect, where poses are sent, where the hand is received.

use std::io;
use std::net::{SocketAddr, TcpListener, UdpSocket};

use super::inward;
use super::outward::{self, PoseFormat};
use super::{ViewArgs, ViewError};
use crate::report;

/// Number of ports to try after one that is taken.
const PORTS: u16 = 100;

/// Listens at an address, or at the next free port.
pub(super) fn listen(address: SocketAddr) -> Result<TcpListener, ViewError> {
    let mut tried = address;
    loop {
        match TcpListener::bind(tried) {
            Ok(listener) => {
                if tried != address {
                    report::tell(format_args!(
                        "port {} is taken, the next free one is {}",
                        address.port(),
                        tried.port()
                    ));
                }
                if !address.ip().is_loopback() {
                    report::tell(format_args!(
                        "warning: everyone who reaches {} can hold the hand",
                        address.ip()
                    ));
                }
                listener.set_nonblocking(true)?;
                return Ok(listener);
            }
            Err(error)
                if error.kind() == io::ErrorKind::AddrInUse
                    && tried.port() < u16::MAX
                    && tried.port() - address.port() < PORTS =>
            {
                tried.set_port(tried.port() + 1);
            }
            Err(error) => {
                let address = address.to_string();
                return Err(ViewError::Address { address, error });
            }
        }
    }
}

pub(super) struct Endpoints {
    /// With their rates (Hz).
    pub(super) out: Vec<(UdpSocket, PoseFormat, f64)>,
    pub(super) inward: Vec<(UdpSocket, PoseFormat)>,
}

impl Endpoints {
    /// Opens the sockets requested by the arguments.
    pub(super) fn open(args: &ViewArgs, place: SocketAddr) -> Result<Self, ViewError> {
        let mut ends = Self {
            out: Vec::new(),
            inward: Vec::new(),
        };
        let outward = [
            ("--osc", &args.osc, (PoseFormat::Osc, args.osc_rate)),
            (
                "--opentrack",
                &args.opentrack,
                (PoseFormat::OpenTrack, args.opentrack_rate),
            ),
        ];
        for (option, address, (format, rate)) in outward {
            let Some(address) = address else { continue };
            let socket = outward::to(address).map_err(|error| ViewError::Renderer {
                option,
                address: address.clone(),
                error,
            })?;
            ends.out.push((socket, format, rate));
        }
        let inward = [
            ("--osc-in", args.osc_in, PoseFormat::Osc),
            ("--opentrack-in", args.opentrack_in, PoseFormat::OpenTrack),
        ];
        for (option, port, format) in inward {
            let Some(port) = port else { continue };
            let socket = inward::at(place.ip(), port).map_err(|error| ViewError::Address {
                address: format!("{option} {port}: UDP port {port}"),
                error,
            })?;
            ends.inward.push((socket, format));
        }
        Ok(ends)
    }
}
