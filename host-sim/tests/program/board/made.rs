//! What the board of a test says about itself, and frames of another version.

use stiction_core::Real;
use stiction_wire::{Info, Mode, NumberType, Text};

use super::fake::{FASTEST, LONGEST, SURFACES, VERTICES};

/// The info of a board with a solver of this number type that has this budget.
pub(crate) fn info<R: Real>(mode: Mode, budget: u32) -> Info<'static> {
    let fixed = std::any::type_name::<R>().ends_with("Fixed");
    Info {
        version: [0, 1, 0],
        number: match fixed {
            true => NumberType::Fixed,
            false => NumberType::F32,
        },
        vertices: VERTICES as u8,
        surfaces: SURFACES as u8,
        corners: 0,
        actuators: false,
        longest_frame: LONGEST as u16,
        fastest_tick: FASTEST,
        budget,
        stiffest: [f32::INFINITY; 2],
        stiffness: [500.0, 0.5],
        friction_now: [0.5, 0.3],
        memory_now: None,
        mode,
        name: Text::new("a thread"),
    }
}

/// A frame of version 1, undamaged.
pub(crate) const OF_VERSION_1: [u8; 13] = [
    0x03, 0x01, 0x86, 0x01, 0x01, 0x01, 0x01, 0x05, 0x0f, 0x23, 0xf2, 0xf3, 0x00,
];
