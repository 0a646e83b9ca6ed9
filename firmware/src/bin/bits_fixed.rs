//! Prints the result of the walk of the hand with `Fixed`.
#![no_std]
#![no_main]

use stiction_core::Fixed;
use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::print_bits::<Fixed, 0>()
}
