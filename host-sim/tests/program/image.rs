//! `stiction image`: the file for the drive of a Pico, read back block by block, is what the linker has laid out; images of
//! other boards, and what is refused.

use object::{Object, ObjectSection, ObjectSegment, ObjectSymbol};
use std::fs;
use std::path::Path;
use std::process::{Command as Process, Output};
use std::sync::Mutex;
use stiction_host_sim::firmware::process::may_skip;

/// Who builds an image holds this until it is read: the next one takes its place.
static BUILT: Mutex<()> = Mutex::new(());

/// Where the flash of a Pico begins.
const FLASH: u64 = 0x1000_0000;

/// The program in a folder.
fn stiction(folder: &Path, arguments: &[&str]) -> Output {
    let mut program = Process::new(env!("CARGO_BIN_EXE_stiction"));
    program.current_dir(folder).args(arguments);
    program.output().unwrap()
}

/// What it prints; nothing where something is missing.
fn made(folder: &Path, arguments: &[&str]) -> Option<String> {
    let output = {
        let _building = BUILT.lock().unwrap();
        stiction(folder, arguments)
    };
    let errors = String::from_utf8(output.stderr).unwrap();
    if may_skip(&errors) {
        return None;
    }
    assert!(output.status.success(), "{errors}");
    Some(String::from_utf8(output.stdout).unwrap())
}

/// What it says of a mistake; no file is left.
fn refused(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let output = stiction(folder.path(), arguments);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    String::from_utf8(output.stderr).unwrap()
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
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let Some(said) = made(folder, &["image", "pico"]) else {
        return;
    };
    made(folder, &["image", "pico", "--out", "pico.elf"]).unwrap();
    let file = fs::read(folder.join("stiction-pico.uf2")).unwrap();
    let digits: String = said
        .lines()
        .next()
        .unwrap()
        .chars()
        .filter(char::is_ascii_digit)
        .collect();
    let (bytes, blocks) = (file.len(), file.len() / 512);
    assert_eq!(digits, format!("2{bytes}{blocks}"), "{said}");

    let flash = boot_program(&file);
    let image = fs::read(folder.join("pico.elf")).unwrap();
    let elf = object::File::parse(&*image).unwrap();
    let at = |address: u64| (address - FLASH) as usize;
    let mut seen = 0;
    // What stays in the flash lies at its address.
    let of_flash = |address: &u64| (FLASH..FLASH + (2 << 20)).contains(address);
    for segment in elf.segments() {
        let (address, data) = (segment.address(), segment.data().unwrap());
        if of_flash(&address) {
            assert!(flash[at(address)..][..data.len()] == *data, "{address:#x}");
            seen += data.len();
        }
    }
    // The first values of variables lie where the program copies them from.
    let data = elf.section_by_name(".data").unwrap().data().unwrap();
    let mut symbols = elf.symbols();
    let begin = symbols.find(|symbol| symbol.name() == Ok("__sidata"));
    let begin = at(begin.unwrap().address());
    assert!(!data.is_empty() && flash[begin..][..data.len()] == *data);
    assert!(seen > 100_000, "{seen}");
    assert_eq!(
        crc(&flash[..252]),
        word(&flash, 252),
        "the second boot stage"
    );
}

/// The sum by which the boot program of the RP2040 knows the second boot stage (datasheet 2.8.1.3.1).
fn crc(bytes: &[u8]) -> u32 {
    crc::Crc::<u32>::new(&crc::CRC_32_MPEG_2).checksum(bytes)
}

#[test]
fn an_image_for_a_probe_is_what_cargo_builds() {
    let folder = tempfile::tempdir().unwrap();
    let Some(said) = made(folder.path(), &["image", "microbit"]) else {
        return;
    };
    assert!(
        !said.contains("blocks") && !said.contains("BOOTSEL"),
        "{said}"
    );
    let image = fs::read(folder.path().join("stiction-microbit.elf")).unwrap();
    let elf = object::File::parse(&*image).unwrap();
    assert_eq!(elf.architecture(), object::Architecture::Arm);
    // No log.
    assert!(elf.section_by_name(".defmt").is_none());
}

#[test]
fn what_cannot_be_an_image_is_refused_before_anything_is_built() {
    let said = |arguments: &[&str]| refused(&[&["image"], arguments].concat());
    let has = |arguments: &[&str], expected: &str| {
        let said = said(arguments);
        assert!(said.contains(expected), "{said}");
        assert!(!said.contains("building"), "{said}");
    };
    has(&["pico3"], "olimex-stm32-h405, microbit, pico");
    has(&["pico", "--out", "a.hex"], "ends in .uf2 or .elf");
    has(&["microbit", "--out", "a.uf2"], "allowed: --out FILE.elf");
    has(&["microbit", "--obstacles"], "no room for obstacles");
    let knob = "has no pins for a knob, allowed:";
    has(
        &["olimex-stm32-h405", "--device", "knob"],
        &format!("{knob} pantograph"),
    );
    has(
        &["microbit", "--device", "knob"],
        &format!("{knob} no --device"),
    );
    has(&["pico", "no-such-scene"], "box-flat");
    has(&["pico", "ladder", "--obstacles"], "cannot be used with");
}
