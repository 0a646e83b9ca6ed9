//! Prints what the walk of the hand comes to with `f32`.
#![no_std]
#![no_main]

use stiction_core::Full;
use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::print_bits::<f32, Full>()
}
