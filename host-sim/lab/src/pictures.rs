//! Draws the pictures for the README's section on obstacles: the snapshots of the bundled scenes with obstacles, each next to its
//! scene file, and the insertion of a peg.

use std::error::Error;
use std::fs;

use clap::Parser;
use stiction_host_sim::firmware::workspace;
use stiction_host_sim::run::{RunArgs, run};
use stiction_live::scenes;

#[derive(Parser)]
struct Options {
    #[command(flatten)]
    run: RunArgs,
}

/// Draws them.
///
/// # Errors
/// A picture cannot be drawn or written.
pub fn pictures() -> Result<(), Box<dyn Error>> {
    let place = workspace().join("host-sim/scenes");
    let folder = tempfile::tempdir()?;
    let plots = folder.path().to_string_lossy().into_owned();
    for (name, _) in scenes::with_obstacles() {
        let arguments = ["run", name, "--quiet", "--plot", &plots];
        run(&Options::try_parse_from(arguments)?.run)?;
        let picture = place.join(name).with_extension("png");
        fs::copy(folder.path().join("strip.png"), &picture)?;
        println!("{}", picture.display());
        let insertion = folder.path().join("insertion.png");
        if insertion.exists() {
            let picture = place.join(format!("{name}-insertion.png"));
            fs::rename(insertion, &picture)?;
            println!("{}", picture.display());
        }
    }
    Ok(())
}
