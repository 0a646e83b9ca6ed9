//! The Pico reads its flash over four wires, and executes the steps of the solver from RAM: what a step takes with the waits for the flash.

use crate::budgets::Budget;
use crate::chip::{Image, PICO, bundled};
use stiction_core::Evolution;
use stiction_host_sim::firmware::image::flashed;
use stiction_host_sim::firmware::process::if_installed;
use stiction_lab::emulator::{Board, Counter, Profile, job};
use stiction_lab::pico::FLASH;
use stiction_scene::{Motion, SceneFile, Source};
use stiction_wire::NumberType;

/// Cycles of a step on average, with those for which the core waits for its flash; nothing where something is missing.
fn cycles(name: &str) -> Option<f64> {
    let source = Source::read(&bundled(name)).unwrap();
    let scene = SceneFile::parse(source, f32::MAX.into()).unwrap();
    let Some(Motion::Keyframes(path)) = &scene.hand.motion else {
        panic!("{name} has a path");
    };
    let hands: Vec<_> = path
        .frames(Some(1000.0))
        .map(|sample| sample.hand)
        .collect();
    let job = job(&scene, Evolution::Path, &hands);
    let counter = Counter::new(Board::Rp2040, NumberType::Fixed, Profile::Device);
    let counted = counter.and_then(|counter| counter.count(&job, u32::MAX));
    if_installed(counted).map(|counted| counted.mean())
}

#[test]
fn a_step_hardly_waits_for_the_flash() {
    let budget = Budget::of(&PICO);
    for name in ["box-flat", "ladder"] {
        if let Some(cycles) = cycles(name) {
            budget.holds(name, cycles as u64);
        }
    }
}

/// What the boot ROM checks in the second stage, and what that sets: RP2040 datasheet, 2.8.1.3.1 and 4.10.13.
pub(crate) fn boots_with_quad_reads(image: &Image) {
    /// Of the line of the flash, SSI_SPI_CTRLR0 and CTRLR0: frames over four wires, of 32 bits, read after what is sent.
    const QUAD: u32 = (2 << 21) | (31 << 16) | (3 << 8);
    let flash = flashed(&image.path, FLASH).unwrap();
    let (stage, sum) = flash[..256].split_at(252);
    // CRC-32 of MPEG-2.
    let crc = stage.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ (u32::from(byte) << 24), |crc, _| {
            (crc << 1) ^ ((crc >> 31) * 0x04C1_1DB7)
        })
    });
    assert_eq!(sum, crc.to_le_bytes(), "the chip refuses its boot loader");
    let mut words = stage.chunks_exact(4);
    assert!(
        words.any(|word| word == QUAD.to_le_bytes()),
        "{}",
        image.path.display()
    );
}

#[test]
fn the_boot_loader_w25q080_reads_the_flash_of_the_pico_over_four_wires() {
    if let Some(image) = PICO.image() {
        boots_with_quad_reads(&image);
    }
}
