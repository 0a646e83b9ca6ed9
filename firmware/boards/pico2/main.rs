//! stiction on the Raspberry Pi Pico 2, on the Arm cores of its RP2350: in this folder `cargo load` flashes it. Its pins are defined in
//! `src/raspberry`.
#![no_std]
#![no_main]
// For the section that the ROM looks for.
#![allow(unsafe_code)]

use rp235x_hal::block::ImageDef;
use rp235x_hal::rom_data::sys_info_api::chip_info;
use stiction_boards::raspberry::Pico;
use stiction_boards::raspberry::usb::NUMBER;
use stiction_boards::speed;

stiction_boards::app! {
    board: Pico2,
    chip: rp235x_hal::pac,
    serial: UART0_IRQ at 4,
    tick: TIMER0_IRQ_0 at 3,
    turn: SW0_IRQ at 2,
    usb: USBCTRL_IRQ at 1,
}

/// The type of the image: the ROM of the chip runs no other (RP2350 datasheet, 5.9).
#[unsafe(link_section = ".start_block")]
#[used]
static IMAGE: ImageDef = ImageDef::secure_exe();

/// This board.
pub struct Pico2;

impl Pico for Pico2 {
    const NAME: &str = "pico2";
    const FASTEST_TICK: u16 = speed::FASTEST_TICK;
    const WORK_RATE: u32 = speed::WORK_RATE;

    /// The number of the chip as its maker prints it: first its wafer. Zeros if the ROM does not return it.
    fn number() -> [u8; NUMBER] {
        let Ok(Some(chip)) = chip_info() else {
            return [0; NUMBER];
        };
        let number = u64::from(chip.wafer_id) << 32 | u64::from(chip.device_id);
        number.to_be_bytes()
    }
}
