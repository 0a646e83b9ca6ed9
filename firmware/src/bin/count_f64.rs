//! The instruction bench with `f64`, for scenes of at most 8 vertices and 4 surfaces.
#![no_std]
#![no_main]

use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::count::<f64, 8, 4>()
}
