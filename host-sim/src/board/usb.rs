//! `--port auto`: finds the serial port of this computer that belongs to a stiction board, by the board's USB descriptors. On
//! Linux, where the system lists them in `/sys`.

use std::fmt;
use std::path::{Path, PathBuf};

use serial2::SerialPort;
use stiction_firmware::usb::{MANUFACTURER, PICO, PICO_2, VENDOR, is_board};

use super::error::BoardError;

/// The port name that requests the search.
pub(super) const AUTO: &str = "auto";

/// Where Linux shows its serial ports.
const PORTS: &str = "/sys/class/tty";

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Port {
    /// The path at which it is opened.
    pub(super) place: PathBuf,
    /// The device behind it, if it is on USB.
    usb: Option<Identity>,
}

/// The USB descriptors of a device; a missing text is empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Identity {
    vendor: u16,
    product: u16,
    manufacturer: String,
    /// Of the product.
    name: String,
    serial_number: String,
}

impl Identity {
    /// The descriptors of the device to which a port belongs, from the folder of the port in [`PORTS`]. The device is a few
    /// folders above the driver of the port.
    fn of(port: &Path) -> Option<Self> {
        let driven = port.join("device").canonicalize().ok()?;
        let mut around = driven.ancestors();
        let device = around.find(|folder| folder.join("idVendor").is_file())?;
        let read = |name: &str| {
            let text = std::fs::read_to_string(device.join(name)).unwrap_or_default();
            text.trim_end().to_owned()
        };
        let number = |name: &str| u16::from_str_radix(&read(name), 16).ok();
        Some(Self {
            vendor: number("idVendor")?,
            product: number("idProduct")?,
            manufacturer: read("manufacturer"),
            name: read("product"),
            serial_number: read("serial"),
        })
    }

    fn is_board(&self) -> bool {
        is_board(self.vendor, self.product, &self.manufacturer)
    }
}

impl Port {
    fn all() -> Result<Vec<Self>, BoardError> {
        if cfg!(not(target_os = "linux")) {
            return Err(gone(
                "looked for on Linux alone, allowed: the name of the port",
            ));
        }
        let places = SerialPort::available_ports().map_err(|error| gone(error.to_string()))?;
        let port = |place: PathBuf| {
            let name = place.file_name().unwrap_or_default();
            let usb = Identity::of(&Path::new(PORTS).join(name));
            Self { place, usb }
        };
        Ok(places.into_iter().map(port).collect())
    }

    pub(super) fn of_the_board() -> Result<Self, BoardError> {
        only_board(Self::all()?).map_err(gone)
    }

    /// The present port of the same board: one that is plugged in again may have another port.
    pub(super) fn again(&mut self) -> Result<&Path, BoardError> {
        let found = Self::all()?.into_iter().find(|port| port.usb == self.usb);
        *self = found.ok_or_else(|| gone(format!("{self} is gone")))?;
        Ok(&self.place)
    }
}

impl fmt::Display for Port {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.place.display())?;
        match &self.usb {
            Some(usb) if usb.serial_number.is_empty() => write!(f, " ({})", usb.name),
            Some(usb) => write!(f, " ({}, serial number {})", usb.name, usb.serial_number),
            None => Ok(()),
        }
    }
}

/// The only board among ports; otherwise why there is none, and what to type.
fn only_board(ports: Vec<Port>) -> Result<Port, String> {
    let is_board = |port: &Port| port.usb.as_ref().is_some_and(Identity::is_board);
    let (mut boards, others): (Vec<_>, Vec<_>) = ports.into_iter().partition(is_board);
    boards.sort_by(|one, other| one.place.cmp(&other.place));
    match boards.as_slice() {
        [] => Err(format!(
            "no board on USB: looked for {VENDOR:04x}:{PICO:04x} and {VENDOR:04x}:{PICO_2:04x} of the manufacturer {MANUFACTURER}; \
             allowed: a serial port{}",
            here(&others)
        )),
        [board] => Ok(board.clone()),
        [first, ..] => Err(format!(
            "{} boards: {}; allowed: one of them, --port {}",
            boards.len(),
            list(&boards),
            first.place.display()
        )),
    }
}

pub(super) fn allowed_ports(problem: &str) -> String {
    let ports = Port::all().unwrap_or_default();
    format!(
        "{problem}, allowed: --port {AUTO} for a board on USB, or a serial port{}",
        here(&ports)
    )
}

/// The ports of this computer, to follow "a serial port".
fn here(ports: &[Port]) -> String {
    match ports {
        [] => ", of which there is none here".to_owned(),
        ports => format!(", which here are: {}", list(ports)),
    }
}

/// Ports in the order of their names.
fn list(ports: &[Port]) -> String {
    let mut ports: Vec<String> = ports.iter().map(Port::to_string).collect();
    ports.sort();
    ports.join(", ")
}

/// The message if there is no board that `--port auto` finds.
fn gone(problem: impl Into<String>) -> BoardError {
    BoardError::Gone {
        address: format!("--port {AUTO}"),
        problem: problem.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn port(place: &str, product: u16, manufacturer: &str, serial_number: &str) -> Port {
        Port {
            place: place.into(),
            usb: Some(Identity {
                vendor: 0x2E8A,
                product,
                manufacturer: manufacturer.to_owned(),
                name: "a thing".to_owned(),
                serial_number: serial_number.to_owned(),
            }),
        }
    }

    fn plain(place: &str) -> Port {
        Port {
            place: place.into(),
            usb: None,
        }
    }

    /// A Raspberry Pi's identifiers with another program are no board, nor is a program of that name on another chip.
    #[test]
    fn the_only_board_is_found_among_others() {
        for product in [0x000A, 0x0009] {
            let board = port("/dev/ttyACM7", product, "stiction", "E6");
            let mut other = port("/dev/ttyUSB0", product, "stiction", "77");
            other.usb.as_mut().expect("it is on USB").vendor = 0x10C4;
            let others = [
                plain("/dev/ttyS0"),
                port("/dev/ttyACM0", product, "Raspberry Pi", "E5"),
                port("/dev/ttyACM1", 0x0003, "stiction", ""),
                other,
            ];
            let ports = others.into_iter().chain([board.clone()]).collect();
            assert_eq!(only_board(ports), Ok(board));
        }
    }

    #[test]
    fn where_there_is_none_or_there_are_several_the_ports_are_listed() {
        let raspberry = port("/dev/ttyACM0", 0x000A, "Raspberry Pi", "E5");
        let [first, second] = [
            ("/dev/ttyACM0", 0x0009, "E662"),
            ("/dev/ttyACM1", 0x000A, "E661"),
        ]
        .map(|(place, product, serial)| port(place, product, "stiction", serial));
        for (mut ports, expected) in [
            (
                vec![raspberry],
                &[
                    "2e8a:000a",
                    "2e8a:0009",
                    "manufacturer stiction",
                    "which here are: /dev/ttyACM0 (a thing, serial number E5), /dev/ttyS0",
                ][..],
            ),
            (
                vec![second, first],
                &[
                    "2 boards: /dev/ttyACM0 (a thing, serial number E662), /dev/ttyACM1 (a thing, serial number E661)",
                    "; allowed: one of them, --port /dev/ttyACM0",
                ],
            ),
        ] {
            ports.insert(0, plain("/dev/ttyS0"));
            let said = only_board(ports).expect_err("not one board");
            for part in expected {
                assert!(said.contains(part), "{part}: {said}");
            }
        }
        let said = only_board(Vec::new()).expect_err("no board");
        assert!(said.contains("none here"), "{said}");
    }

    /// The folders of Linux: a port of the class cdc_acm, and one of a converter, which is a folder deeper.
    #[cfg(unix)]
    #[test]
    fn the_identity_is_read_from_the_folders_of_the_system() {
        use std::fs::{create_dir_all, write};
        let root = tempfile::tempdir().expect("a folder");
        let file = |name: &str, text: &str| write(root.path().join(name), text).expect("a file");
        let link = |to: &str, at: &str| {
            let (to, at) = (root.path().join(to), root.path().join(at));
            create_dir_all(&at).expect("a folder");
            std::os::unix::fs::symlink(to, at.join("device")).expect("a link");
        };
        for folder in ["usb1/1-2/1-2:1.0/ttyUSB0", "platform/serial8250"] {
            create_dir_all(root.path().join(folder)).expect("a folder");
        }
        file("usb1/1-2/idVendor", "2e8a\n");
        file("usb1/1-2/idProduct", "000a\n");
        file("usb1/1-2/manufacturer", "stiction\n");
        file("usb1/1-2/product", "stiction on Pico\n");
        file("usb1/1-2/serial", "E6614103E7452D2F\n");
        // The hub above it has identifiers of its own.
        file("usb1/idVendor", "1d6b\n");
        link("usb1/1-2/1-2:1.0", "tty/ttyACM0");
        link("usb1/1-2/1-2:1.0/ttyUSB0", "tty/ttyUSB0");
        link("platform/serial8250", "tty/ttyS0");
        for name in ["tty/ttyACM0", "tty/ttyUSB0"] {
            let identity = Identity::of(&root.path().join(name)).expect("on USB");
            assert!(identity.is_board());
            assert_eq!(identity.name, "stiction on Pico");
            assert_eq!(identity.serial_number, "E6614103E7452D2F");
        }
        assert_eq!(Identity::of(&root.path().join("tty/ttyS0")), None);
    }
}
