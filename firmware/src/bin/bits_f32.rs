//! Prints the result of the walk of the hand with `f32`.
#![no_std]
#![no_main]

use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::print_bits::<f32, 0>()
}
