//! Runs a random walk of the hand through the solver on every machine, compares all bits of all answers, and prints how
//! long each run took.
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

/// Whether every machine computes the same hash.
fn is_same(number: NumberType, place: Place, frames: u32) -> bool {
    let walked = match place {
        Place::ByWalls => "by walls",
        Place::AmongObstacles => "among obstacles",
    };
    let mut hashes = Vec::new();
    for machine in Machine::ALL {
        // A run of length zero builds the image, so that the build does not count towards the time of the walk.
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
