//! The instruction bench with `f32`, for scenes of at most 8 vertices and 4 surfaces.
#![no_std]
#![no_main]

use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::count::<f32, 8, 4, 0>()
}
