//! The image for the Pico 2: what its ROM looks for before it runs an image, and how much it takes. What the program does is tested in
//! QEMU on a board with the same processor, `AN505`; the set-up of the chip by its registers is tested nowhere.

use crate::budgets::Budget;
use crate::chip::{KNOB_2, PICO2};
use stiction_host_sim::firmware::image::flashed;

/// Where the chip has its memory (RP2350 datasheet, 2.2), and how much of it the board.
const FLASH: u32 = 0x1000_0000;
const FLASH_SIZE: u32 = 4 << 20;
const RAM: u32 = 0x2000_0000;
const RAM_SIZE: u32 = 512 << 10;

/// A block begins and ends with these; its ROM looks for the first one in so many bytes (datasheet, 5.1.5).
const BEGIN: u32 = 0xFFFF_DED3;
const END: u32 = 0xAB12_3579;
const SEARCHED: usize = 4096;
/// In it: the type of the image, one word, of a program (1) for the secure state (2 << 4) of an Arm core (0 << 8) of an RP2350 (1 << 12);
/// the last item, which says that there was one word; no other block (datasheet, 5.9.3).
const PROGRAM: [u32; 3] = [0x1021_0142, 0x0000_01FF, 0];

fn words(bytes: &[u8]) -> Vec<u32> {
    let chunks = bytes.chunks_exact(4);
    chunks
        .map(|chunk| u32::from_le_bytes(chunk.try_into().unwrap()))
        .collect()
}

#[test]
fn the_rom_of_the_pico_2_finds_a_program_for_its_arm_cores() {
    let Some(image) = PICO2.image() else { return };
    let flash = flashed(&image.path, FLASH).unwrap();
    let searched = words(&flash[..SEARCHED]);
    let begins = searched.iter().position(|&word| word == BEGIN);
    let block = &searched[begins.expect("a block")..];
    assert_eq!((&block[1..4], block[4]), (&PROGRAM[..], END));
    // The vector table is where it is without a word of the block: in the beginning.
    let [stack, reset] = [searched[0], searched[1]];
    assert_eq!(u64::from(stack), image.contents.stack_top.unwrap());
    assert!(
        (RAM..=RAM + RAM_SIZE).contains(&stack) && stack % 8 == 0,
        "{stack:#x}"
    );
    // Thumb code.
    let end = FLASH + u32::try_from(flash.len()).unwrap();
    assert!(
        (FLASH..end).contains(&reset) && reset % 2 == 1,
        "{reset:#x}"
    );
    assert!(end - FLASH <= FLASH_SIZE);
}

#[test]
fn what_interrupts_the_pico_2_is_served() {
    let Some(image) = PICO2.image() else { return };
    let vectors = words(&flashed(&image.path, FLASH).unwrap()[..SEARCHED]);
    let place = |name: &str| {
        let mut symbols = image.contents.symbols.iter();
        symbols
            .find(|(symbol, _)| symbol == name)
            .map(|(_, place)| *place as u32)
    };
    // Numbers of exceptions and, behind 16 of them, of interrupts (datasheet, 3.2).
    for (number, name) in [
        (3, "HardFault"),
        (16, "TIMER0_IRQ_0"),
        (16 + 14, "USBCTRL_IRQ"),
        (16 + 33, "UART0_IRQ"),
    ] {
        assert_eq!(Some(vectors[number]), place(name), "{name}");
        assert_ne!(Some(vectors[number]), place("DefaultHandler"), "{name}");
    }
}

/// While a flash is erased or programmed, no code runs from it; the last two sectors are for the numbers of a knob.
#[test]
fn what_writes_the_flash_of_the_pico_2_is_in_its_ram_and_the_sectors_are_free() {
    let Some(image) = KNOB_2.image() else { return };
    let flash = flashed(&image.path, FLASH).unwrap();
    assert!(flash.len() + 2 * 4096 <= FLASH_SIZE as usize);
    let mut symbols = image.contents.symbols.iter();
    let write =
        symbols.find(|(name, _)| name.contains("raspberry5flash5write") && !name.contains("Thunk"));
    let (_, place) = write.expect("it writes");
    assert!(
        (RAM..RAM + RAM_SIZE).contains(&(*place as u32)),
        "{place:#x}"
    );
    let mut symbols = image.contents.symbols.iter();
    let sectors = symbols.find(|(name, _)| name == "_stored_numbers");
    assert_eq!(
        sectors.map(|(_, place)| *place as u32),
        Some(FLASH + FLASH_SIZE - 2 * 4096)
    );
}

#[test]
fn the_pico_2_is_within_its_budget() {
    let Some(image) = PICO2.image() else { return };
    let budget = Budget::of(&PICO2);
    budget.holds("flash", image.contents.flash);
    budget.holds("variables", image.contents.variables);
}
