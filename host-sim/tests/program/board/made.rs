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
        friction: true,
        weight: true,
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

/// A frame, undamaged, with another version in its first byte.
pub(crate) fn of_version(wire: &[u8], version: u8) -> Vec<u8> {
    let mut frame = wire[..wire.len() - 1].to_vec();
    let length = cobs::decode_in_place(&mut frame).expect("COBS");
    frame.truncate(length - 4);
    frame[0] = version;
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(&frame);
    frame.extend(crc.to_le_bytes());
    let mut wire = vec![0; cobs::max_encoding_length(frame.len())];
    let length = cobs::encode(&frame, &mut wire);
    wire.truncate(length);
    wire.push(0);
    wire
}
