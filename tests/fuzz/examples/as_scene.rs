//! Converts an input of the `solver` fuzz target to files: `FOLDER/scene.toml` and `FOLDER/hand.csv`, for `stiction run`,
//! whose option `--record` records the run.
//!
//! ```sh
//! cargo run -p stiction-fuzz --example as_scene -- INPUT FOLDER
//! stiction run FOLDER/scene.toml --hand FOLDER/hand.csv --record tests/recordings/NAME.jsonl
//! ```

use std::path::Path;
use std::{env, fs, process};

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [input, folder] = arguments.as_slice() else {
        eprintln!("usage: as_scene INPUT FOLDER");
        process::exit(2);
    };
    let bytes = fs::read(input).unwrap_or_else(|error| {
        eprintln!("{input}: {error}");
        process::exit(2);
    });
    let Some((scene, hand, options)) = stiction_fuzz::as_files(&bytes) else {
        eprintln!("{input}: too short for a scene and a path");
        process::exit(2);
    };
    let folder = Path::new(folder);
    let written = fs::create_dir_all(folder)
        .and_then(|()| fs::write(folder.join("scene.toml"), scene))
        .and_then(|()| fs::write(folder.join("hand.csv"), hand));
    if let Err(error) = written {
        eprintln!("{}: {error}", folder.display());
        process::exit(2);
    }
    println!("stiction run scene.toml --hand hand.csv {options}");
}
