//! The serial line of a Raspberry Pi chip.

use stiction_firmware::line::Line;

use super::hal::clocks::{Clock as _, ClocksManager};
use super::hal::fugit::RateExtU32;
use super::hal::pac::UART0;
use super::hal::uart::{DataBits, Disabled, Reader, StopBits, UartConfig, UartPeripheral, Writer};
use super::pins::UartPins;
use crate::{Port, stop};

pub(super) const BAUD: u32 = 921_600;

/// The serial line.
pub struct Uart {
    reader: Reader<UART0, UartPins>,
    writer: Writer<UART0, UartPins>,
}

impl Uart {
    pub(super) fn new(
        uart: UartPeripheral<Disabled, UART0, UartPins>,
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
}

impl Port for Uart {
    /// All bytes in, and as many out as there is room for.
    fn serve<const N: usize>(&mut self, line: &Line<N>) {
        let mut bytes = [0; 32];
        match self.reader.read_raw(&mut bytes) {
            Ok(count) => line.receive_all(bytes.iter().take(count)),
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
