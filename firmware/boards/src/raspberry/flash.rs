//! The last two sectors of the flash, which the linker leaves free: the numbers of a knob, see `stiction_firmware::knob`.
//!
//! While a flash is erased or programmed, no code runs from it (RP2040 datasheet, 2.8.3.1.3; RP2350 datasheet, 5.4.8): what writes is in
//! RAM and calls functions of the ROM, no interrupt comes, and then the chip is reset, so that nothing has to be resumed.
#![allow(unsafe_code)]

use core::arch::asm;

use fugit::ExtU32;
use stiction_firmware::knob::{PAGE, Stored, page};
use stiction_wire::KnobNumbers;

use super::hal::rom_data::{
    connect_internal_flash, flash_exit_xip, flash_range_erase, flash_range_program,
};
use super::hal::{self, fugit, pac};

/// Bytes of a sector, the unit in which a flash is erased.
const SECTOR: usize = 4096;
/// A block of the flash, which is erased by one command, and that command: two sectors are no block.
const BLOCK: (u32, u8) = (1 << 16, 0xD8);
/// What the watchdog waits for (ms): two sectors take up to 400 ms each (W25Q16JV, W25Q32RV: typically 45 ms), a page 3 ms.
const WRITING: u32 = 2_000;
/// The bit of the watchdog's register `CTRL` that resets the chip.
const TRIGGER: u32 = 1 << 31;

unsafe extern "C" {
    /// Where the linker leaves room for them, see `firmware/memory`.
    static _stored_numbers: [[u8; SECTOR]; 2];
}

/// The first page of each sector.
pub(super) fn pages() -> [&'static [u8; PAGE]; 2] {
    // SAFETY: the linker leaves room for two sectors, which change only shortly before a reset.
    let sectors = unsafe { &_stored_numbers };
    let first = |sector: &'static [u8; SECTOR]| sector.first_chunk().unwrap_or(&[0; PAGE]);
    sectors.each_ref().map(first)
}

/// What is written: offsets of sectors in the flash, and the functions that do it.
#[repr(C)]
struct Writing<'a> {
    new: u32,
    former: u32,
    page: &'a [u8; PAGE],
    connect: unsafe extern "C" fn(),
    leave: unsafe extern "C" fn(),
    erase: unsafe extern "C" fn(u32, usize, u32, u8),
    program: unsafe extern "C" fn(u32, *const u8, usize),
    control: *mut u32,
}

/// Stores the numbers and resets the chip.
pub(super) fn store(numbers: &KnobNumbers, watchdog: &mut hal::Watchdog) -> ! {
    /// The flash begins here, and repeats itself after 16 MB.
    const OFFSET: usize = (16 << 20) - 1;
    let (pages, page) = (pages(), page(numbers));
    let Stored { free, .. } = Stored::read(pages);
    let at = pages.map(|page| (page.as_ptr() as usize & OFFSET) as u32);
    let [new, former] = if free == 0 { at } else { [at[1], at[0]] };
    let writing = Writing {
        new,
        former,
        page: &page,
        connect: connect_internal_flash::ptr(),
        leave: flash_exit_xip::ptr(),
        erase: flash_range_erase::ptr(),
        program: flash_range_program::ptr(),
        // SAFETY: only the address is taken.
        control: unsafe { &*pac::WATCHDOG::ptr() }.ctrl().as_ptr(),
    };
    watchdog.start(WRITING.millis());
    cortex_m::interrupt::disable();
    // SAFETY: nothing else runs, from the flash or at all; both sectors are those that are left free.
    unsafe { write(&writing) }
}

/// Programs the new sector, erases the former one, and resets the chip. In RAM: it calls nothing but functions of the ROM.
#[inline(never)]
#[unsafe(link_section = ".data.flash_write")]
unsafe extern "C" fn write(writing: &Writing<'_>) -> ! {
    let (block, command) = BLOCK;
    // SAFETY: as the caller promises; the register resets the chip.
    unsafe {
        (writing.connect)();
        (writing.leave)();
        (writing.erase)(writing.new, SECTOR, block, command);
        (writing.program)(writing.new, writing.page.as_ptr(), PAGE);
        (writing.erase)(writing.former, SECTOR, block, command);
        asm!("str {trigger}, [{control}]", trigger = in(reg) TRIGGER, control = in(reg) writing.control);
    }
    loop {
        // An empty loop may be taken for one that does not exist.
        // SAFETY: it does nothing.
        unsafe { asm!("nop") };
    }
}
