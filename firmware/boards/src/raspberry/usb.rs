//! The serial line of a Raspberry Pi chip over USB.

use core::sync::atomic::{AtomicBool, Ordering};

use stiction_firmware::line::Line;
use stiction_firmware::usb::{MANUFACTURER, VENDOR};
use usb_device::bus::UsbBusAllocator;
use usb_device::device::{
    StringDescriptors, UsbDevice, UsbDeviceBuilder, UsbDeviceState, UsbVidPid,
};
use usbd_serial::SerialPort;

use super::chip::{PRODUCT, PRODUCT_ID};
use super::hal::usb::UsbBus;
use crate::{Port, stop};

/// Bytes of the unique number of a board.
pub const NUMBER: usize = 8;
const PACKET: usize = 64;

/// The line, with room for 11 ms of that of the UART in each direction.
pub static LINE: Line<1_024> = Line::new();

static IS_OPEN: AtomicBool = AtomicBool::new(false);

/// Whether a program has the line over USB open.
pub fn is_open() -> bool {
    IS_OPEN.load(Ordering::Relaxed)
}

/// The memory that must stay in place as long as the line over USB exists: empty until
/// [`Usb::start`].
pub struct Memory {
    allocator: Option<UsbBusAllocator<UsbBus>>,
    /// The serial number of the board, as text.
    serial_number: [u8; 2 * NUMBER],
}

impl Memory {
    /// Empty.
    pub const EMPTY: Self = Self {
        allocator: None,
        serial_number: [b'0'; 2 * NUMBER],
    };
}

/// The serial line over USB.
pub struct Usb {
    device: UsbDevice<'static, UsbBus>,
    port: SerialPort<'static, UsbBus>,
}

impl Usb {
    pub(super) fn start(place: &'static mut Memory, bus: UsbBus, number: [u8; NUMBER]) -> Self {
        write_hex(number, &mut place.serial_number);
        let serial_number = core::str::from_utf8(&place.serial_number).unwrap_or_default();
        let bus = place.allocator.insert(UsbBusAllocator::new(bus));
        let port = SerialPort::new(bus);
        let device = UsbDeviceBuilder::new(bus, UsbVidPid(VENDOR, PRODUCT_ID));
        let names = StringDescriptors::default()
            .manufacturer(MANUFACTURER)
            .product(PRODUCT)
            .serial_number(serial_number);
        let Ok(device) = device
            .strings(&[names])
            .and_then(|device| device.max_packet_size_0(64))
        else {
            stop()
        };
        let device = device.device_class(usbd_serial::USB_CLASS_CDC).build();
        Self { device, port }
    }
}

impl Port for Usb {
    /// As many bytes in and out as there is room for.
    fn serve<const N: usize>(&mut self, line: &Line<N>) {
        self.device.poll(&mut [&mut self.port]);
        // A pulled plug closes nothing: the bus falls silent.
        let is_there = self.device.state() == UsbDeviceState::Configured;
        IS_OPEN.store(is_there && self.port.dtr(), Ordering::Relaxed);
        let mut bytes = [0; PACKET];
        // Bytes that are not read stay with the computer.
        while line.room() >= PACKET
            && let Ok(count @ 1..) = self.port.read(&mut bytes)
        {
            line.receive_all(bytes.iter().take(count));
        }
        while let Some(byte) = line.peek() {
            if !matches!(self.port.write(&[byte]), Ok(1)) {
                break;
            }
            line.next();
        }
        let _ = self.port.flush();
    }
}

/// Bytes as text, hexadecimal.
fn write_hex(bytes: [u8; NUMBER], text: &mut [u8; 2 * NUMBER]) {
    let digit = |value: u8| value + if value < 10 { b'0' } else { b'A' - 10 };
    for (byte, place) in bytes.iter().zip(text.chunks_exact_mut(2)) {
        place.copy_from_slice(&[digit(byte >> 4), digit(byte & 15)]);
    }
}
