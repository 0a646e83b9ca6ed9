//! `stiction footprint`: the model of the solver that a scene needs, and why, and its resources on emulated chips compared with
//! the full model. From a scene to a table:
//!
//! ```text
//! scene ─ model ─ measure (flash, state, stack, instructions or cycles) ─ table
//! ```

mod measure;
mod table;

use std::io;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::thread;

use clap::Args;
use stiction_core::{Evolution, Fixed, Hand};
use stiction_scene::{InputError, SceneFile, SceneModel};
use stiction_tools::process::EmulatorError;
use stiction_tools::readme::Section;

use crate::emulator::{Board, Chip};
use crate::input::{open_path, open_scene};
use crate::number::Number;
use crate::options::evolution_parser;
use crate::progress::{Measuring, measuring};
use crate::report;
use crate::shell::scene_completer;
use measure::measure;
use table::{Row, Table};

/// The arguments of `stiction footprint`.
#[derive(Args, Clone, Debug)]
pub struct FootprintArgs {
    /// Scene file (TOML), or the name of a bundled scene; may be left out with --readme, for a few bundled scenes
    #[arg(required_unless_present = "readme", add = scene_completer())]
    scene: Option<PathBuf>,
    /// Measure this evolution only, instead of both
    #[arg(long, value_parser = evolution_parser())]
    evolution: Option<Evolution>,
    /// Writes the table, without a scene that of a few bundled ones, between the marks <!-- footprint: begin --> and
    /// <!-- footprint: end --> of this file as well
    #[arg(long, value_name = "FILE")]
    readme: Option<PathBuf>,
}

/// The reason why there is no table.
#[derive(Debug, thiserror::Error)]
pub enum FootprintError {
    /// The scene or the hand's path cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An image cannot be built or run.
    #[error(transparent)]
    Emulator(#[from] EmulatorError),
    /// The file cannot be written.
    #[error("{}: cannot be written: {error}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// The system's message.
        error: io::Error,
    },
}

/// The scenes of the README.
const SCENES: [&str; 8] = [
    "locked",
    "corner-stick-slip",
    "ladder",
    "vertex-stick-slip",
    "box-flat",
    "rod-on-floor",
    "point-stick-slip",
    "point-frictionless",
];

/// A scene and its hand in every frame.
struct Case {
    scene: SceneFile,
    hands: Vec<Hand<f64>>,
}

impl Case {
    fn open(name: &Path) -> Result<Self, InputError> {
        let scene = open_scene(name, Number::F32)?;
        // Before any build: the numbers form a valid scene for both chips.
        scene.scene::<f32>()?;
        scene.scene::<Fixed>()?;
        let (path, rate) = open_path(&scene, None, None)?;
        let hands = path.frames(rate).map(|sample| sample.hand).collect();
        Ok(Self { scene, hands })
    }
}

/// Measures a scene, or a few bundled ones, and prints the table.
///
/// # Errors
/// [`FootprintError`]; before any build if possible.
pub fn footprint(args: &FootprintArgs) -> Result<(), FootprintError> {
    let names = match &args.scene {
        Some(name) => vec![name.as_path()],
        None => SCENES.map(Path::new).to_vec(),
    };
    let cases: Result<Vec<Case>, _> = names.into_iter().map(Case::open).collect();
    let cases = cases?;
    let cannot_write = |file: &Path| {
        let file = file.to_owned();
        |error| FootprintError::Write { file, error }
    };
    let section = args
        .readme
        .as_ref()
        .map(|file| Section::find(file, "footprint").map_err(cannot_write(file)));
    let section = section.transpose()?;
    let all = Evolution::ALL.into_iter();
    let evolutions: Vec<_> = all
        .filter(|evolution| args.evolution.is_none_or(|asked| asked == *evolution))
        .collect();
    Board::require_all(&Chip::ALL.map(Chip::board))?;
    let mut rows = Vec::new();
    for case in &cases {
        report::print(&heading(case));
        let table = Table {
            rows: measured(case, &evolutions)?,
        };
        report::print(&format!("{table}\n"));
        rows.extend(table.rows);
    }
    report::print(table::LEGEND);
    if let (Some(section), Some(file)) = (section, &args.readme) {
        let (legend, table) = (table::LEGEND, Table { rows });
        let asked = args.evolution.map(Evolution::name);
        let asked = asked.map_or(String::new(), |name| format!(" --evolution {name}"));
        let text = format!("Written by `stiction footprint{asked}`. {legend}\n{table}");
        section.write(&text).map_err(cannot_write(file))?;
    }
    Ok(())
}

/// A scene's model, and why.
fn heading(case: &Case) -> String {
    let scene = &case.scene;
    let model = SceneModel::smallest(scene);
    let mut text = format!("{}: the smallest model is {model}\n", scene.title);
    for reason in SceneModel::reasons(scene) {
        text += &format!("  {reason}\n");
    }
    text + &format!("  the full model is {}\n\n", model.full())
}

/// The rows of a scene, with a progress bar.
fn measured(case: &Case, evolutions: &[Evolution]) -> Result<Vec<Row>, FootprintError> {
    let models = Chip::ALL.len() * evolutions.len() * 2;
    let bar = &measuring(&case.scene.title, models as u64);
    // One chip computes while the image of another one is built.
    let of_chips = thread::scope(|scope| {
        let started =
            Chip::ALL.map(|chip| scope.spawn(move || of_chip(chip, (case, evolutions), bar)));
        started.map(|chip| chip.join().unwrap_or_else(|panic| resume_unwind(panic)))
    });
    let mut rows = Vec::new();
    for of_chip in of_chips {
        rows.extend(of_chip?);
    }
    bar.end();
    Ok(rows)
}

/// The rows of a scene on a chip.
fn of_chip(
    chip: Chip,
    (case, evolutions): (&Case, &[Evolution]),
    bar: &Measuring,
) -> Result<Vec<Row>, EmulatorError> {
    let Case { scene, hands } = case;
    let model = SceneModel::smallest(scene);
    let row = |&evolution| {
        let of = |model| {
            let measured = measure(chip, model, scene, evolution, hands);
            bar.advance(1, &format!("{} done: {model}", chip.name()));
            measured
        };
        Ok(Row {
            scene: scene.title.clone(),
            model,
            chip,
            evolution,
            smallest: of(model)?,
            full: of(model.full())?,
        })
    };
    evolutions.iter().map(row).collect()
}
