//! Examines the solver among obstacles with corners.
//!
//! ```sh
//! cargo run --release -p stiction-tests --example obstacles -- cases [PART-OF-A-NAME]   # every case, number type and evolution
//! cargo run --release -p stiction-tests --example obstacles -- survey 1000 f32 path     # laws on random scenes
//! cargo run --release -p stiction-tests --example obstacles -- compare 50 f64 path      # with the slow reference
//! cargo run --release -p stiction-tests --example obstacles -- scene 17 f32 path 40 41  # a scene as a file, and two of its frames
//! cargo run --release -p stiction-tests --example obstacles -- rooms 1000 f32 frame     # 100 jumps in each of 1000 closed rooms
//! cargo run --release -p stiction-tests --example obstacles -- pegs 100 path             # insertions of a peg in all number types
//! ```

mod beside;
mod pegs;
mod show;
mod survey;

use std::process::ExitCode;
use std::time::Duration;
use stiction_core::{Evolution, Fixed};
use stiction_tests::Number;
use stiction_tests::obstacles::cases::{Case, all};
use stiction_tests::obstacles::guard::{Outcome, within};
use stiction_tests::obstacles::judged::verdict;
use stiction_tests::obstacles::survey::{Kind, part};

const USAGE: &str = "usage: obstacles cases [PART-OF-A-NAME]
       obstacles survey SCENES [f64|f32|fixed] [path|frame]
       obstacles compare [FROM] TO [f64|f32|fixed] [path|frame]
       obstacles scene SCENE [f64|f32|fixed] [path|frame] FRAME...
       obstacles pegs INSERTIONS [path|frame]
       obstacles rooms ROOMS [f64|f32|fixed] [path|frame]
       obstacles room ROOM [f64|f32|fixed] [path|frame] FRAME...";

/// Runs a generic function in the number type with this name.
macro_rules! in_number {
    ($name:expr, $module:ident $(:: $more:ident)*, $($argument:expr),*) => {
        match $name {
            "f64" => $module$(::$more)*::<f64>($($argument),*),
            "f32" => $module$(::$more)*::<f32>($($argument),*),
            _ => $module$(::$more)*::<Fixed>($($argument),*),
        }
    };
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (mut number, mut evolution, mut words) = ("f64", Evolution::Path, Vec::new());
    for word in &arguments {
        match word.as_str() {
            name @ ("f64" | "f32" | "fixed") => number = name,
            "path" => evolution = Evolution::Path,
            "frame" => evolution = Evolution::Frame,
            other => words.push(other),
        }
    }
    let counts: Vec<u64> = words
        .iter()
        .skip(1)
        .filter_map(|n| n.parse().ok())
        .collect();
    match (words.as_slice(), counts.as_slice()) {
        (["cases"], _) => cases(""),
        (["cases", part], _) => cases(part),
        (["survey", _], [count]) => survey::survey("part", *count, number, evolution.name()),
        (["rooms", _], [count]) => survey::survey("part-rooms", *count, number, evolution.name()),
        (["pegs", _], [count]) => pegs::pegs(*count, evolution),
        (["scene", ..], [scene, frames @ ..]) => {
            in_number!(
                number,
                show::show,
                (Kind::Worlds, *scene),
                evolution,
                frames
            );
        }
        (["room", ..], [scene, frames @ ..]) => {
            in_number!(number, show::show, (Kind::Rooms, *scene), evolution, frames);
        }
        (["compare", ..], [to]) => {
            in_number!(number, beside::beside, (0, *to), evolution);
        }
        (["compare", ..], [from, to]) => {
            in_number!(number, beside::beside, (*from, *to), evolution);
        }
        // Commands that a survey starts.
        (["part", ..], [from, step, count]) => {
            in_number!(
                number,
                part,
                Kind::Worlds,
                (*from, *step, *count),
                evolution
            );
        }
        (["part-rooms", ..], [from, step, count]) => {
            in_number!(number, part, Kind::Rooms, (*from, *step, *count), evolution);
        }
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

/// Runs every case whose name contains `part`.
fn cases(part: &str) {
    // The line of the case contains the message of its panic.
    std::panic::set_hook(Box::new(|_| {}));
    for case in all().into_iter().filter(|case| case.name.contains(part)) {
        println!("{}", case.name);
        for evolution in Evolution::ALL {
            row::<f64>(&case, evolution);
            row::<f32>(&case, evolution);
            row::<Fixed>(&case, evolution);
        }
    }
}

fn row<R: Number>(case: &Case, evolution: Evolution) {
    let case = case.clone();
    let outcome = within(Duration::from_secs(10), move || {
        verdict::<R>(&case, evolution)
    });
    print!("  {:5} {:5}  ", R::NAME, evolution.name());
    match outcome {
        Outcome::Done(verdict) => println!("{verdict}"),
        Outcome::Panic(words) => println!("PANIC {words}"),
        Outcome::Late => println!("LATE: more than 10 s"),
    }
}
