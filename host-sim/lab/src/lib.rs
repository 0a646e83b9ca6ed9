//! What measures stiction, and writes the tables of its documents: instructions, cycles and sizes on emulated chips ([`emulator`]), the
//! cost of settings, budgets and obstacles, accuracy over scenes, the laws over suites. The program `lab` has a command for each table;
//! the benchmarks in `benches` compare with a physics engine.
//!
//! [`pico`] is a Raspberry Pi Pico, emulated cycle by cycle; the program `emulated-pico` runs it for `stiction view --emulate pico`.

pub mod pico;

#[cfg(feature = "figures")]
pub mod budget;
#[cfg(feature = "figures")]
pub mod emulator;
#[cfg(feature = "figures")]
pub mod footprint;
#[cfg(feature = "figures")]
pub mod lawful;
#[cfg(feature = "figures")]
pub mod markdown;
#[cfg(feature = "figures")]
pub mod measure;
#[cfg(feature = "figures")]
pub mod obstacles;
#[cfg(feature = "figures")]
pub mod rates;
#[cfg(feature = "figures")]
pub mod trade;
#[cfg(feature = "figures")]
pub mod worst;
