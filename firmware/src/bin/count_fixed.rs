//! The instruction bench with `Fixed`, for scenes of at most 8 vertices and 4 surfaces.
#![no_std]
#![no_main]

use stiction_core::Fixed;
use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::count::<Fixed, 8, 4, 0>()
}
