//! The instruction bench with `f32` among obstacles, for scenes of at most 4 vertices, one half-plane and 17 obstacles of 4 corners.
#![no_std]
#![no_main]

use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::count::<f32, 4, 1, 68>()
}
