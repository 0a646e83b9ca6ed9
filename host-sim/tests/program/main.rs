//! The program as its users meet it: `stiction` is started as a process, with files in a folder of its own for every test. Each
//! module has the tests of a command, or of a property that commands share.

#[cfg(unix)]
mod board;
mod command;
mod common;
#[cfg(unix)]
mod emulated_board;
#[cfg(unix)]
mod ended;
mod figures;
mod hand_files;
mod hand_paths;
mod helped;
#[cfg(unix)]
mod image;
mod insertion;
mod judged;
#[cfg(unix)]
mod knob;
mod malformed;
mod mistakes;
mod obstacles;
mod outputs;
mod replay;
mod slides;
mod sweep;
mod trade;
mod tutorial;
mod view;
