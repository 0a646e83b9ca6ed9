//! Pins, clocks and interrupts.
//!
//! | what | where |
//! |---|---|
//! | serial line, 921600 8N1 | UART0: GP0 out, GP1 in |
//! | serial line over USB | the board's USB |
//! | ticks and clock | TIMER, 1 MHz |
//! | motors | none; no pin but GP0 drives anything when it stops |
#![allow(unsafe_code)]

use core::sync::atomic::{AtomicBool, Ordering};

use rp2040_hal::clocks::{Clock as _, ClocksManager, init_clocks_and_plls};
use rp2040_hal::fugit::{ExtU32, MicrosDurationU32, RateExtU32};
use rp2040_hal::gpio::bank0::{Gpio0, Gpio1};
use rp2040_hal::gpio::{FunctionUart, Pin, Pins, PullDown};
use rp2040_hal::pac::{self, UART0};
use rp2040_hal::timer::{Alarm, Alarm0, Instant};
use rp2040_hal::uart::{DataBits, Reader, StopBits, UartConfig, UartPeripheral, Writer};
use rp2040_hal::usb::UsbBus;
use rp2040_hal::{Sio, Timer};
use stiction_firmware::line::{self, Line};
use stiction_firmware::usb;
use usb_device::bus::UsbBusAllocator;
use usb_device::device::{
    StringDescriptors, UsbDevice, UsbDeviceBuilder, UsbDeviceState, UsbVidPid,
};
use usbd_serial::SerialPort;

use crate::flash::{self, NUMBER};
use crate::stop::stop;

/// The second boot stage: it lets the chip run code from its flash.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_GENERIC_03H;

/// Of the crystal (Hz).
const CRYSTAL: u32 = 12_000_000;
/// Of the processor (Hz).
pub(crate) const CLOCK: u32 = 125_000_000;
/// Of the serial line.
pub(crate) const BAUD: u32 = 921_600;
/// A tick that does not come for so long ends in a reset (ms).
const PATIENCE: u32 = 20;
/// What the board is called on USB.
const PRODUCT: &str = "stiction on Pico";
/// Bytes of a packet.
const PACKET: usize = 64;

/// A program has the line over USB open.
static USB_IS_OPEN: AtomicBool = AtomicBool::new(false);

/// Whether a program has the line over USB open.
pub(crate) fn usb_is_open() -> bool {
    USB_IS_OPEN.load(Ordering::Relaxed)
}

/// What stays where it is as long as the line over USB is there: empty until [`Board::start`].
pub(crate) struct Bus {
    allocator: Option<UsbBusAllocator<UsbBus>>,
    /// Of the board, as text.
    serial_number: [u8; 2 * NUMBER],
}

impl Bus {
    pub(crate) const fn new() -> Self {
        Self {
            allocator: None,
            serial_number: [b'0'; 2 * NUMBER],
        }
    }
}

/// Bytes as text, hexadecimal.
fn write_hex(bytes: [u8; NUMBER], text: &mut [u8; 2 * NUMBER]) {
    let digit = |value: u8| value + if value < 10 { b'0' } else { b'A' - 10 };
    for (byte, place) in bytes.iter().zip(text.chunks_exact_mut(2)) {
        place.copy_from_slice(&[digit(byte >> 4), digit(byte & 15)]);
    }
}

/// What the tasks work with.
pub(crate) struct Board {
    pub(crate) uart: Uart,
    pub(crate) usb: Usb,
    pub(crate) clock: Clock,
    pub(crate) watchdog: Watchdog,
}

impl Board {
    /// Everything running, with so many ticks a second.
    pub(crate) fn start(mut device: pac::Peripherals, bus: &'static mut Bus, rate: u16) -> Self {
        let mut watchdog = rp2040_hal::Watchdog::new(device.WATCHDOG);
        let clocks = init_clocks_and_plls(
            CRYSTAL,
            device.XOSC,
            device.CLOCKS,
            device.PLL_SYS,
            device.PLL_USB,
            &mut device.RESETS,
            &mut watchdog,
        );
        let Ok(clocks) = clocks else { stop() };
        let sio = Sio::new(device.SIO);
        let pins = Pins::new(
            device.IO_BANK0,
            device.PADS_BANK0,
            sio.gpio_bank0,
            &mut device.RESETS,
        );
        let timer = Timer::new(device.TIMER, &mut device.RESETS, &clocks);
        let pins = (pins.gpio0.into_function(), pins.gpio1.into_function());
        let uart = UartPeripheral::new(device.UART0, pins, &mut device.RESETS);
        let uart = Uart::new(uart, &clocks);
        write_hex(flash::number(BOOT2), &mut bus.serial_number);
        let serial_number = core::str::from_utf8(&bus.serial_number).unwrap_or_default();
        let allocator = bus.allocator.insert(UsbBusAllocator::new(UsbBus::new(
            device.USBCTRL_REGS,
            device.USBCTRL_DPRAM,
            clocks.usb_clock,
            true,
            &mut device.RESETS,
        )));
        watchdog.start(PATIENCE.millis());
        Self {
            uart,
            usb: Usb::new(allocator, serial_number),
            clock: Clock::new(timer, rate),
            watchdog: Watchdog(watchdog),
        }
    }
}

/// Ticks and time, both from one counter that never stops.
pub(crate) struct Clock {
    timer: Timer,
    alarm: Alarm0,
    rate: u16,
    /// When the next tick is due.
    next: Instant,
}

impl Clock {
    fn new(mut timer: Timer, rate: u16) -> Self {
        let Some(alarm) = timer.alarm_0() else { stop() };
        let next = timer.get_counter();
        let mut clock = Self {
            timer,
            alarm,
            rate,
            next,
        };
        clock.arm();
        clock.alarm.enable_interrupt();
        clock
    }

    fn period(&self) -> MicrosDurationU32 {
        (1_000_000 / u32::from(self.rate.max(1))).micros()
    }

    /// The next tick is a whole number of periods after the one before, and not in the past.
    fn arm(&mut self) {
        let (period, now) = (self.period(), self.timer.get_counter());
        self.next += period;
        while self.next <= now {
            self.next += period;
        }
        let _ = self.alarm.schedule_at(self.next);
    }

    /// Ticks of a second from the present one on.
    pub(crate) fn set_rate(&mut self, rate: u16) {
        if rate != self.rate {
            self.next -= self.period();
            self.rate = rate;
            self.arm();
        }
    }

    /// A tick has come: what time it is (µs, wrapping).
    pub(crate) fn tick(&mut self) -> u32 {
        self.alarm.clear_interrupt();
        self.arm();
        self.timer.get_counter_low()
    }
}

impl line::Clock for Clock {
    fn now_ns(&mut self) -> u32 {
        self.timer.get_counter_low().wrapping_mul(1_000)
    }
}

type UartPins = (
    Pin<Gpio0, FunctionUart, PullDown>,
    Pin<Gpio1, FunctionUart, PullDown>,
);

/// The serial line.
pub(crate) struct Uart {
    reader: Reader<UART0, UartPins>,
    writer: Writer<UART0, UartPins>,
}

impl Uart {
    fn new(
        uart: UartPeripheral<rp2040_hal::uart::Disabled, UART0, UartPins>,
        clocks: &ClocksManager,
    ) -> Self {
        let config = UartConfig::new(BAUD.Hz(), DataBits::Eight, None, StopBits::One);
        let Ok(mut uart) = uart.enable(config, clocks.peripheral_clock.freq()) else {
            stop()
        };
        uart.set_fifos(true);
        uart.enable_rx_interrupt();
        let (reader, writer) = uart.split();
        Self { reader, writer }
    }

    /// What came in, and as much out as there is room for.
    pub(crate) fn serve<const N: usize>(&mut self, line: &Line<N>) {
        let mut bytes = [0; 32];
        match self.reader.read_raw(&mut bytes) {
            Ok(count) => bytes
                .iter()
                .take(count)
                .for_each(|&byte| line.receive(byte)),
            Err(nb::Error::WouldBlock) => {}
            Err(nb::Error::Other(error)) => {
                error.discarded.iter().for_each(|_| line.lose());
            }
        }
        self.writer.disable_tx_interrupt();
        while let Some(byte) = line.peek() {
            if self.writer.write_raw(&[byte]).is_err() {
                return self.writer.enable_tx_interrupt();
            }
            line.next();
        }
    }
}

/// The serial line over USB.
pub(crate) struct Usb {
    device: UsbDevice<'static, UsbBus>,
    port: SerialPort<'static, UsbBus>,
}

impl Usb {
    fn new(bus: &'static UsbBusAllocator<UsbBus>, serial_number: &'static str) -> Self {
        let port = SerialPort::new(bus);
        let device = UsbDeviceBuilder::new(bus, UsbVidPid(usb::VENDOR, usb::PICO));
        let names = StringDescriptors::default()
            .manufacturer(usb::MANUFACTURER)
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

    /// What came in, as much as there is room for, and out likewise.
    pub(crate) fn serve<const N: usize>(&mut self, line: &Line<N>) {
        self.device.poll(&mut [&mut self.port]);
        // A pulled plug closes nothing: the bus falls silent.
        let is_there = self.device.state() == UsbDeviceState::Configured;
        USB_IS_OPEN.store(is_there && self.port.dtr(), Ordering::Relaxed);
        let mut bytes = [0; PACKET];
        // What is not read stays with the computer.
        while line.room() >= PACKET
            && let Ok(count @ 1..) = self.port.read(&mut bytes)
        {
            bytes
                .iter()
                .take(count)
                .for_each(|&byte| line.receive(byte));
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

/// Resets the chip unless it is fed.
pub(crate) struct Watchdog(rp2040_hal::Watchdog);

impl Watchdog {
    pub(crate) fn feed(&mut self) {
        self.0.feed();
    }
}

/// No pin drives anything any more, but the serial line.
pub(crate) fn actuators_off() {
    // SAFETY: one field of each register, whatever a task was doing with it.
    let pins = unsafe { &*pac::IO_BANK0::ptr() };
    // GP0 is the line's.
    for pin in pins.gpio_iter().skip(1) {
        pin.gpio_ctrl().modify(|_, w| w.funcsel().null());
    }
}
