//! For a WebAssembly runtime: the hash of the walk of the hand, by number type. Without a main program of its own.
#![allow(unsafe_code)]

use stiction_core::Fixed;
use stiction_firmware::bits::of_walk;

/// The hash of a walk of so many frames with `f32`.
#[unsafe(no_mangle)]
pub extern "C" fn bits_f32(frames: u32) -> u64 {
    of_walk::<f32>(frames)
}

/// The hash of a walk of so many frames with `Fixed`.
#[unsafe(no_mangle)]
pub extern "C" fn bits_fixed(frames: u32) -> u64 {
    of_walk::<Fixed>(frames)
}
