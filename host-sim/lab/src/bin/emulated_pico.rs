//! The emulated Pico as a program, for `stiction view --emulate pico` and the like: the contents of a flash run at the pace of the real clock, with
//! the serial line at the socket `line` and the monitor at the socket `monitor` of the current folder.

use std::process::ExitCode;

#[cfg(unix)]
fn main() -> ExitCode {
    use std::path::Path;

    use stiction_lab::pico::board;

    let Some(file) = std::env::args_os().nth(1) else {
        eprintln!("usage: emulated-pico FLASH");
        return ExitCode::from(2);
    };
    let flash = std::fs::read(&file);
    match flash.and_then(|flash| board::run(flash, Path::new("line"), Path::new("monitor"))) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", file.display());
            ExitCode::FAILURE
        }
    }
}

#[cfg(not(unix))]
fn main() -> ExitCode {
    eprintln!("the emulated Pico needs a system with unix sockets");
    ExitCode::FAILURE
}
