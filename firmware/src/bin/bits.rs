//! Prints the result of the walk of the hand, or of the one among obstacles, on this machine: `cargo run --features hosted --bin bits -- f32 100000`.

use std::process::ExitCode;
use stiction_core::Fixed;
use stiction_firmware::bits::{CORNERS, of_walk};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let hash = match arguments.as_slice() {
        [number, frames] => frames.parse().ok().and_then(|n| hash(number, n)),
        _ => None,
    };
    let Some(hash) = hash else {
        eprintln!("usage: bits f32|fixed|among_f32|among_fixed FRAMES");
        return ExitCode::from(2);
    };
    println!("{hash:016x}");
    ExitCode::SUCCESS
}

fn hash(number: &str, frames: u32) -> Option<u64> {
    match number {
        "f32" => Some(of_walk::<f32, 0>(frames)),
        "fixed" => Some(of_walk::<Fixed, 0>(frames)),
        "among_f32" => Some(of_walk::<f32, CORNERS>(frames)),
        "among_fixed" => Some(of_walk::<Fixed, CORNERS>(frames)),
        _ => None,
    }
}
