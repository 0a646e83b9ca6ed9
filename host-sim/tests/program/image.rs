//! `stiction image`: the file for the drive of a Pico, read back block by block, is what the linker has laid out; images of
//! other boards, and what is refused.

use object::elf::PT_LOAD;
use object::read::elf::{ElfFile32, ProgramHeader};
use object::{Endianness, Object};
use std::fs;
use std::sync::Mutex;
use stiction_host_sim::firmware::process::may_skip;
use stiction_tests::times;

use crate::common::{Folder, said, text};

/// Who builds an image holds this until it is read: the next one takes its place.
static BUILT: Mutex<()> = Mutex::new(());

/// Where the flash of a Pico begins.
const FLASH: u64 = 0x1000_0000;

/// What it prints; nothing where something is missing.
fn made(folder: &Folder, line: &str) -> Option<String> {
    let output = {
        let _building = BUILT.lock().unwrap();
        folder.stiction(line)
    };
    if may_skip(&text(&output.stderr)) {
        return None;
    }
    assert!(output.status.success(), "{}", said(&output));
    Some(text(&output.stdout))
}

/// [`made`] in a folder of its own; only in long tests, as an image takes most of a minute to build.
fn built(line: &str) -> Option<(Folder, String)> {
    let folder = times(false, true).then(Folder::new)?;
    let said = made(&folder, line)?;
    Some((folder, said))
}

/// The number at a place of a block.
fn word(block: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(block[at..at + 4].try_into().unwrap())
}

/// What a boot program that takes the family of the RP2040 writes into a flash of 2 MB, which was erased before: as it goes through
/// the blocks it holds each against the specification of UF2 and the limits of the datasheet (2.8.4.2, erratum E14).
fn boot_program(file: &[u8]) -> Vec<u8> {
    const ERASED: u8 = 0xFF;
    let mut flash = vec![ERASED; 2 << 20];
    let (blocks, rest) = file.as_chunks::<512>();
    assert!(!blocks.is_empty() && rest.is_empty());
    let mut sector_of_row = 0;
    for (number, block) in blocks.iter().enumerate() {
        assert_eq!(&block[..8], b"UF2\n\x57\x51\x5D\x9E");
        assert_eq!(&block[508..], b"\x30\x6F\xB1\x0A");
        assert_eq!(word(block, 8), 0x2000, "the family, and no other flag");
        assert_eq!(word(block, 28), 0xE48B_FF56);
        assert_eq!(
            (word(block, 20), word(block, 24)),
            (number as u32, blocks.len() as u32)
        );
        let (at, size) = (
            (u64::from(word(block, 12)) - FLASH) as usize,
            word(block, 16) as usize,
        );
        assert_eq!((at % 256, size), (0, 256));
        if number % 16 == 0 {
            sector_of_row = at / 4096;
            flash[4096 * sector_of_row..][..4096].fill(ERASED);
        }
        assert_eq!(at / 4096, sector_of_row, "block {number}");
        let page = &mut flash[at..at + size];
        assert!(page.iter().all(|&byte| byte == ERASED), "{at:#x} twice");
        page.copy_from_slice(&block[32..32 + size]);
    }
    flash
}

#[test]
fn the_file_for_the_drive_of_a_pico_has_every_byte_of_the_image_in_its_place() {
    let Some((folder, said)) = built("image pico") else {
        return;
    };
    made(&folder, "image pico --out pico.elf").unwrap();
    let file = fs::read(folder.file("stiction-pico.uf2")).unwrap();
    let first = said.lines().next().unwrap().chars();
    let digits: String = first.filter(char::is_ascii_digit).collect();
    let (bytes, blocks) = (file.len(), file.len() / 512);
    assert_eq!(digits, format!("2{bytes}{blocks}"), "{said}");

    let flash = boot_program(&file);
    let image = fs::read(folder.file("pico.elf")).unwrap();
    let elf = ElfFile32::<Endianness>::parse(&*image).unwrap();
    let at = |address: u64| (address - FLASH) as usize;
    let mut seen = 0;
    // Code and first values that the program copies into RAM lie in the flash at the address to load them from.
    for segment in elf.elf_program_headers() {
        let data = segment.data(elf.endian(), &*image).unwrap();
        if segment.p_type(elf.endian()) == PT_LOAD && !data.is_empty() {
            let address = u64::from(segment.p_paddr(elf.endian()));
            assert!(flash[at(address)..][..data.len()] == *data, "{address:#x}");
            seen += data.len();
        }
    }
    assert!(seen > 100_000, "{seen}");
    // The sum by which the boot program of the RP2040 knows the second boot stage (datasheet 2.8.1.3.1).
    let sum = crc::Crc::<u32>::new(&crc::CRC_32_MPEG_2).checksum(&flash[..252]);
    assert_eq!(sum, word(&flash, 252), "the second boot stage");
}

#[test]
fn an_image_for_a_probe_is_what_cargo_builds() {
    let Some((folder, said)) = built("image microbit") else {
        return;
    };
    assert!(
        !said.contains("blocks") && !said.contains("BOOTSEL"),
        "{said}"
    );
    let image = fs::read(folder.file("stiction-microbit.elf")).unwrap();
    let elf = object::File::parse(&*image).unwrap();
    assert_eq!(elf.architecture(), object::Architecture::Arm);
    // No log.
    assert!(elf.section_by_name(".defmt").is_none());
}

#[test]
fn what_cannot_be_an_image_is_refused_before_anything_is_built() {
    let folder = Folder::new();
    for (arguments, expected) in [
        ("pico3", "olimex-stm32-h405, microbit, pico"),
        ("pico --out a.hex", "ends in .uf2 or .elf"),
        ("microbit --out a.uf2", "allowed: --out FILE.elf"),
        (
            "olimex-stm32-h405 --device knob",
            "has no pins for a knob, allowed: pantograph",
        ),
        (
            "microbit --device knob",
            "has no pins for a knob, allowed: no --device",
        ),
        ("pico no-such-scene", "box-flat"),
        // 0.444 N·s/m, by half a tick of 1 ms and a turn of 0.75 ms.
        (
            "pico box-flat --device knob",
            "k_h (N/m) is 500, allowed: less than 355.5",
        ),
        // 0.5 N·s/m, by half of three ticks and a turn of 2.22 ms.
        (
            "pico box-flat --device pantograph",
            "k_h (N/m) is 500, allowed: less than 134.4",
        ),
    ] {
        let message = folder.refused(&format!("image {arguments}"), &[expected]);
        assert!(!message.contains("building"), "{message}");
        assert!(folder.names().is_empty());
    }
}
