//! The image of `footprint` without a solver.
#![no_std]
#![no_main]

use core::hint::black_box;
use stiction_core::Hand;
use stiction_firmware::board::entry;

#[entry]
fn main() -> ! {
    loop {
        black_box(Hand::<f64>::default());
    }
}
