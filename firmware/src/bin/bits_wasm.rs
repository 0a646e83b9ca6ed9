//! For a WebAssembly runtime: the hash of the walk of the hand, by number type. It has no main program of its own.
#![no_main]
#![allow(unsafe_code)]

use stiction_core::Fixed;
use stiction_firmware::bits::{CORNERS, of_walk};

/// The hash of a walk of this many frames with `f32`.
#[unsafe(no_mangle)]
pub extern "C" fn bits_f32(frames: u32) -> u64 {
    of_walk::<f32, 0>(frames)
}

/// The hash of a walk of this many frames with `Fixed`.
#[unsafe(no_mangle)]
pub extern "C" fn bits_fixed(frames: u32) -> u64 {
    of_walk::<Fixed, 0>(frames)
}

/// The hash of a walk of this many frames among obstacles with `f32`.
#[unsafe(no_mangle)]
pub extern "C" fn bits_among_f32(frames: u32) -> u64 {
    of_walk::<f32, CORNERS>(frames)
}

/// The hash of a walk of this many frames among obstacles with `Fixed`.
#[unsafe(no_mangle)]
pub extern "C" fn bits_among_fixed(frames: u32) -> u64 {
    of_walk::<Fixed, CORNERS>(frames)
}
