//! Looks at the solver among obstacles with corners.
//!
//! ```sh
//! cargo run --release -p stiction-tests --bin obstacles -- cases [PART-OF-A-NAME]   # every case, number type and evolution
//! ```

use std::process::ExitCode;
use std::time::Duration;
use stiction_core::{Evolution, Fixed};
use stiction_tests::Number;
use stiction_tests::obstacles::cases::{Case, all};
use stiction_tests::obstacles::guard::{Outcome, within};
use stiction_tests::obstacles::judged::verdict;

const USAGE: &str = "usage: obstacles cases [PART-OF-A-NAME]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["cases"] => cases(""),
        ["cases", part] => cases(part),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

/// Every case whose name has this part.
fn cases(part: &str) {
    // What a case says of its panic is said in its line.
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
