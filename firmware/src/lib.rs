#![no_std]
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::indexing_slicing
    )
)]
//! `stiction-core` on microcontrollers: the loops of a haptic device; the cost of a frame there, and whether every machine computes the
//! same bits.
//!
//! ```text
//! count.rs  a scene and a hand's motion, as messages, through the solver, frame by frame: instructions and stack
//! bits.rs   a walk of the hand through the solver, to one number that depends on every bit of its answers
//! board.rs  the emulated boards: counter, stack, files of the host        (feature `board`)
//!
//! obstacles.rs   obstacles as they were given, stored so that they can be changed
//! device.rs      the servo loop: hand measured -> safety -> force; the turns of the solver at a lower priority; changes while they run
//! safety.rs      the limits of the force on the hand, and when it is zero
//! pantograph.rs  a planar haptic device: encoders -> hand, force -> motors
//! knob.rs        a haptic device of one motor and one encoder
//! devices.rs     the numbers of the devices at the boards
//! ring.rs        bytes between an interrupt and the program
//! line.rs        the two rings of a board's line, and its clock
//! speed.rs       how much work processors do per second
//! pace.rs        when ticks are due, for a board that ticks in its main loop
//! station.rs     the program of a board: bytes -> samples and commands -> solver -> demand of a force, reports
//! usb.rs         how a computer recognises a board on its USB
//! ```
//!
//! Everything except `board` is free of hardware and runs on any machine: the host uses some of it. The
//! programs are in `src/bin`: `bits` and `count` for each number type of a board, `count_scene` for a compiled-in model, `footprint` for a
//! compiled-in scene.

pub mod bits;
#[cfg(all(feature = "board", target_os = "none"))]
pub mod board;
pub mod count;
#[cfg_attr(not(test), deny(clippy::arithmetic_side_effects))]
pub mod device;
pub mod devices;
#[cfg_attr(not(test), deny(clippy::arithmetic_side_effects))]
pub mod knob;
#[cfg_attr(not(test), deny(clippy::arithmetic_side_effects))]
pub mod line;
mod obstacles;
#[cfg_attr(not(test), deny(clippy::arithmetic_side_effects))]
pub mod pace;
#[cfg_attr(not(test), deny(clippy::arithmetic_side_effects))]
pub mod pantograph;
#[cfg_attr(not(test), deny(clippy::arithmetic_side_effects))]
pub mod ring;
#[cfg_attr(not(test), deny(clippy::arithmetic_side_effects))]
pub mod safety;
pub mod speed;
#[cfg_attr(not(test), deny(clippy::arithmetic_side_effects))]
pub mod station;
pub mod usb;
