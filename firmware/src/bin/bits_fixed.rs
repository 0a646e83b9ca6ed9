//! Prints what the walk of the hand comes to with `Fixed`.
#![no_std]
#![no_main]

use stiction_core::{Fixed, Full};
use stiction_firmware::board::{self, entry};

#[entry]
fn main() -> ! {
    board::print_bits::<Fixed, Full>()
}
