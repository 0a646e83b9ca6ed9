//! stiction for C and C++: the functions that `include/stiction.h` declares. The header is generated from this crate, and its comments are
//! those of the functions and types here.
//!
//! ```text
//! stiction_scene --init--> stiction (memory of the caller: solver, state, last answer) --start, step--> stiction_output
//!                                                                                       --wrench, contacts--> forces
//!                                                                                       --snapshot, restore--> a saved run
//! ```
//!
//! There is no heap, nothing panics, and nothing is needed from a C library except `memcpy` and similar functions. A function checks every
//! pointer for null and alignment, and the memory for its size and contents; it returns a [`Result`] and writes nothing unless that is
//! `STICTION_RESULT_OK`, except the error of a scene.
#![cfg_attr(all(feature = "archive", not(test)), no_std)]

mod calls;
mod input;
mod memory;
mod output;
mod result;
mod text;

pub use calls::*;
pub use input::{Hand, Obstacle, Scene, Surface};
pub use memory::{
    ABI, CORNERS, Memory, OBSTACLES, SNAPSHOT_WORDS, SURFACES, Snapshot, VERTICES, WORDS,
};
pub use output::{CONTACTS, Contact, EVENTS, Event, Kind, Output, State, Status, Wrench};
pub use result::{Error, Parameter, Result};

/// Never reached: the tests search the archives for it.
#[cfg(all(feature = "archive", not(test)))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
