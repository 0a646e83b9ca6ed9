//! Walks the hand through the solver on every machine and compares all bits of all answers; says how long each took.
//!
//! ```sh
//! cargo run --release -p stiction-host-sim --example same_bits -- 1000000
//! ```

use std::process::ExitCode;
use std::time::Instant;

use stiction_scene::NumberType;

use stiction_host_sim::emulator::{Machine, Place};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let frames = match arguments.as_slice() {
        [frames] => frames.parse().ok(),
        _ => None,
    };
    let Some(frames) = frames else {
        eprintln!("usage: same_bits FRAMES");
        return ExitCode::from(2);
    };
    println!("| number, place | machine | hash of {frames} frames | s |\n|---|---|---|---|");
    let cases = NumberType::ALL.map(|number| Place::ALL.map(|place| (number, place)));
    let same = cases.map(|cases| cases.map(|(number, place)| is_same(number, place, frames)));
    if same.iter().flatten().all(|same| *same) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// Every machine comes to the same hash.
fn is_same(number: NumberType, place: Place, frames: u32) -> bool {
    let walked = match place {
        Place::ByWalls => "by walls",
        Place::AmongObstacles => "among obstacles",
    };
    let mut hashes = Vec::new();
    for machine in Machine::ALL {
        // A run of no length: the image is built, its time is not that of the walk.
        let _ = machine.bits(number, place, 0);
        let begun = Instant::now();
        let bits = machine.bits(number, place, frames);
        let text = match &bits {
            Ok(hash) => format!("{hash:016x}"),
            Err(error) => error.to_string(),
        };
        let seconds = begun.elapsed().as_secs_f64();
        println!(
            "| {}, {walked} | {} | {text} | {seconds:.1} |",
            number.name(),
            machine.name()
        );
        hashes.push(bits.ok());
    }
    hashes
        .iter()
        .all(|hash| hash.is_some() && *hash == hashes[0])
}
