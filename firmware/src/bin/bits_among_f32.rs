//! Prints the result of the walk of the hand among obstacles with `f32`.
#![no_std]
#![no_main]

use stiction_firmware::bits::CORNERS;
use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::print_bits::<f32, CORNERS>()
}
