//! The unique number of a board's flash, 8 bytes: it is read over the flash's own line, from which no code runs meanwhile (RP2040
//! datasheet, 2.8.3 the ROM, 4.10 the line of the flash; W25Q16JV, 8.2.25 its number).
#![allow(unsafe_code)]

use core::arch::naked_asm;

use rp2040_hal::rom_data::{connect_internal_flash, flash_exit_xip};
use stiction_boards::raspberry::usb::NUMBER;

/// Bytes that the flash sends before the number.
const DUMMY: usize = 4;

/// Functions, called one after the other: they make the flash accept commands, and let the chip run code again.
#[repr(C)]
struct Calls {
    connect: unsafe extern "C" fn(),
    leave: unsafe extern "C" fn(),
    resume: *const u8,
}

/// The second boot stage as code that may run outside of the flash.
#[repr(align(4))]
struct Stage([u8; 256]);

/// The number; zeros if the chip has no ROM, which contains the functions for the flash: in an emulator without one.
pub(crate) fn number(boot2: [u8; 256]) -> [u8; NUMBER] {
    /// "Mu", and a version.
    const ROM: (*const u16, u16) = (0x10 as *const u16, u16::from_le_bytes(*b"Mu"));
    let mut answer = [0; DUMMY + NUMBER];
    let stage = Stage(boot2);
    // SAFETY: the address is one of the ROM; nothing else runs, from the flash or at all: no interrupt comes. The second boot stage begins
    // with an instruction of Thumb code and returns to its caller.
    unsafe {
        if ROM.0.read_volatile() == ROM.1 {
            let calls = Calls {
                connect: connect_internal_flash::ptr(),
                leave: flash_exit_xip::ptr(),
                resume: stage.0.as_ptr().wrapping_add(1),
            };
            cortex_m::interrupt::free(|_| read(&calls, &mut answer));
        }
    }
    let [.., a, b, c, d, e, f, g, h] = answer;
    [a, b, c, d, e, f, g, h]
}

/// Reads the number from the flash. In RAM: the flash supplies no code meanwhile.
#[unsafe(naked)]
#[unsafe(link_section = ".data.flash_number")]
unsafe extern "C" fn read(calls: &Calls, answer: &mut [u8; DUMMY + NUMBER]) {
    naked_asm!(
        "push {{r3-r7, lr}}",
        "mov r6, r0",
        "mov r7, r1",
        "ldr r4, [r6, #0]",
        "blx r4",
        "ldr r4, [r6, #4]",
        "blx r4",
        // The line, SSI; off while it is being set up.
        "movs r4, #0x18",
        "lsls r4, r4, #24",
        "movs r5, #0",
        "str r5, [r4, #{enable}]",
        // It sends what is written, and then receives this many bytes.
        "movs r1, #3",
        "lsls r1, r1, #8",
        "ldr r0, [r4, #0]",
        "orrs r0, r1",
        "str r0, [r4, #0]",
        "movs r0, #{bytes} - 1",
        "str r0, [r4, #{count}]",
        "movs r0, #1",
        "str r0, [r4, #{enable}]",
        "movs r0, #{unique_id}",
        "str r0, [r4, #{data}]",
        "movs r2, #{bytes}",
        "movs r1, #{received}",
        "2:",
        "ldr r0, [r4, #{status}]",
        "tst r0, r1",
        "beq 2b",
        "ldr r0, [r4, #{data}]",
        "strb r0, [r7]",
        "adds r7, #1",
        "subs r2, #1",
        "bne 2b",
        // The second boot stage leaves the count unchanged.
        "str r5, [r4, #{enable}]",
        "str r5, [r4, #{count}]",
        "ldr r4, [r6, #8]",
        "blx r4",
        "pop {{r3-r7, pc}}",
        // Registers of SSI, and a bit of its status: a byte has arrived.
        count = const 0x04,
        enable = const 0x08,
        status = const 0x28,
        data = const 0x60,
        received = const 0x08,
        bytes = const DUMMY + NUMBER,
        unique_id = const 0x4B,
    )
}
