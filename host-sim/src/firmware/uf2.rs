//! UF2, the format of a file that is flashed by copying it to the drive of a board: from the parts of an image to blocks of 512 bytes,
//! each with a page of the flash, as specified in <https://github.com/microsoft/uf2>.
//!
//! | bytes of a block | content |
//! |---|---|
//! | 0, 4 | two magic numbers that identify a block |
//! | 8 | flags: the chip family is given |
//! | 12 | the address of the page |
//! | 16 | bytes of the page |
//! | 20, 24 | number of the block from 0 on, number of blocks |
//! | 28 | the family of the chip |
//! | 32 | the page, followed by zeros |
//! | 508 | a third magic number |
//!
//! All numbers have 32 bits, little-endian.

use std::collections::BTreeMap;

use super::image::Part;
use super::process::EmulatorError;

/// Size of a block (bytes).
const BLOCK: usize = 512;
/// Size of a page: the unit in which the flash is written (bytes).
const PAGE: usize = 256;
/// Size of a sector: the unit in which the flash is erased (bytes).
const SECTOR: usize = 4096;
/// Size of the header before the page (bytes).
const HEAD: usize = 32;
/// Magic numbers at the start of a block.
const BEGIN: [u32; 2] = [0x0A32_4655, 0x9E5D_5157];
const END: u32 = 0x0AB1_6F30;
/// The flag of a block that gives the family.
const HAS_FAMILY: u32 = 0x2000;
/// The address range of the flash in chips of these families: a window of 16 MiB (RP2040 datasheet 2.2, RP2350
/// datasheet 2.2).
const WINDOW: std::ops::Range<u64> = 0x1000_0000..0x1100_0000;

/// The chips that accept a file: others ignore it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Family(u32);

impl Family {
    /// RP2040: Raspberry Pi Pico.
    pub const RP2040: Self = Self(0xE48B_FF56);
    /// RP2350 with its Arm processors, in secure mode: Raspberry Pi Pico 2.
    pub const RP2350_ARM_S: Self = Self(0xE48B_FF59);
}

/// A file that writes these parts into the flash of a chip of a family, with zeros in the rest of each touched page.
///
/// Sectors are filled up with pages of zeros, except at the end of the last one: the boot program of the RP2040 assumes that sixteen
/// consecutive blocks belong to one sector, which it erases (RP2040 datasheet, erratum E14).
///
/// # Errors
/// There are no parts, or one is not in the flash: `Output`.
pub fn uf2(parts: &[Part], family: Family) -> Result<Vec<u8>, EmulatorError> {
    let pages = pages(parts)?;
    let mut file = Vec::with_capacity(pages.len() * BLOCK);
    for (number, (at, page)) in (0..).zip(&pages) {
        let [begin, again] = BEGIN;
        let (size, count) = (PAGE as u32, pages.len() as u32);
        let head = [begin, again, HAS_FAMILY, *at, size, number, count, family.0];
        file.extend(head.iter().flat_map(|word| word.to_le_bytes()));
        file.extend(page);
        file.extend([0; BLOCK - HEAD - PAGE - size_of::<u32>()]);
        file.extend(END.to_le_bytes());
    }
    Ok(file)
}

/// The number of blocks in a file.
pub const fn blocks(file: &[u8]) -> usize {
    file.len() / BLOCK
}

/// Pages by address: whole sectors up to the last page with contents.
fn pages(parts: &[Part]) -> Result<BTreeMap<u32, [u8; PAGE]>, EmulatorError> {
    let mut pages = BTreeMap::new();
    for part in parts {
        let begin = u64::from(part.at);
        let end = begin + part.bytes.len() as u64;
        if !WINDOW.contains(&begin) || end > WINDOW.end {
            return Err(EmulatorError::Output(format!(
                "{begin:#x} to {end:#x} is not in the flash"
            )));
        }
        for (at, &byte) in (part.at..).zip(&part.bytes) {
            let place = at as usize % PAGE;
            pages.entry(at - place as u32).or_insert([0; PAGE])[place] = byte;
        }
    }
    let Some((&last, _)) = pages.last_key_value() else {
        return Err(EmulatorError::Output(
            "there is nothing to flash".to_owned(),
        ));
    };
    let touched: Vec<u32> = pages.keys().map(|at| at - at % SECTOR as u32).collect();
    for sector in touched {
        let of_sector = (sector..sector + SECTOR as u32).step_by(PAGE);
        for at in of_sector.take_while(|&at| at < last) {
            pages.entry(at).or_insert([0; PAGE]);
        }
    }
    Ok(pages)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(at: u32, bytes: &[u8]) -> Part {
        Part {
            at,
            bytes: bytes.to_owned(),
        }
    }

    fn word(block: &[u8], at: usize) -> u32 {
        let bytes = block[at..at + 4].try_into();
        u32::from_le_bytes(bytes.expect("four bytes"))
    }

    fn addresses(file: &[u8]) -> Vec<u32> {
        file.chunks(512).map(|block| word(block, 12)).collect()
    }

    #[test]
    fn a_block_has_the_fields_of_the_specification() {
        let file = uf2(&[part(0x1000_0000, &[1, 2, 3])], Family::RP2040).expect("a file");
        assert_eq!(file.len(), 512);
        // "UF2\n", as a text editor shows it.
        assert_eq!(&file[..4], b"UF2\n");
        let head = [4, 8, 12, 16, 20, 24, 28].map(|at| word(&file, at));
        let expected = [
            0x9E5D_5157,
            0x0000_2000,
            0x1000_0000,
            256,
            0,
            1,
            0xE48B_FF56,
        ];
        assert_eq!(head, expected);
        assert_eq!(&file[32..35], &[1, 2, 3]);
        assert!(file[35..508].iter().all(|&byte| byte == 0));
        assert_eq!(word(&file, 508), 0x0AB1_6F30);
    }

    #[test]
    fn another_family_differs_by_its_number_alone() {
        let parts = [part(0x1000_0000, &[7; 300])];
        let [one, other] = [Family::RP2040, Family::RP2350_ARM_S]
            .map(|family| uf2(&parts, family).expect("a file"));
        for (one, other) in one.chunks(512).zip(other.chunks(512)) {
            assert_eq!(word(other, 28), 0xE48B_FF59);
            assert_eq!((&one[..28], &one[32..]), (&other[..28], &other[32..]));
        }
    }

    #[test]
    fn parts_that_share_a_page_are_in_one_block() {
        let parts = [part(0x1000_01FE, &[1, 2, 3]), part(0x1000_0203, &[4])];
        let file = uf2(&parts, Family::RP2040).expect("a file");
        assert_eq!(addresses(&file), [0x1000_0000, 0x1000_0100, 0x1000_0200]);
        assert_eq!(&file[512 + 32 + 254..][..2], &[1, 2]);
        assert_eq!(&file[1024 + 32..][..5], &[3, 0, 0, 4, 0]);
    }

    /// Erratum E14 of the RP2040.
    #[test]
    fn sixteen_blocks_in_a_row_are_of_one_sector() {
        let parts = [
            part(0x1000_0300, &[1]),
            part(0x1000_5000, &[2]),
            part(0x1000_8800, &[3]),
        ];
        let file = uf2(&parts, Family::RP2040).expect("a file");
        let addresses = addresses(&file);
        // Two whole sectors, and the last one up to its ninth page.
        assert_eq!(addresses.len(), 16 + 16 + 9);
        for row in addresses.chunks(16) {
            assert!(row.iter().all(|at| at / 4096 == row[0] / 4096));
        }
        assert!(addresses.is_sorted_by(|one, next| one < next));
        for (number, block) in file.chunks(512).enumerate() {
            assert_eq!((word(block, 20), word(block, 24)), (number as u32, 41));
        }
    }

    #[test]
    fn what_is_not_in_the_flash_is_refused() {
        for (at, size) in [(0x2000_0000, 1), (0x0FFF_FFFF, 2), (0x10FF_FFFF, 2)] {
            let error = uf2(&[part(at, &vec![0; size])], Family::RP2040).expect_err("an error");
            assert!(error.to_string().contains(&format!("{at:#x} to")));
        }
        assert!(uf2(&[part(0x10FF_FFFF, &[1])], Family::RP2040).is_ok());
        assert!(uf2(&[], Family::RP2040).is_err());
    }
}
