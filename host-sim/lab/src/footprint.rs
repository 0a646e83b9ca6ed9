//! The model of the solver that a scene needs, and why, and its resources on emulated chips compared with the full model. From a
//! scene to a table:
//!
//! ```text
//! scene ─ model ─ measure (flash, state, stack, instructions or cycles) ─ table
//! ```

mod measure;
mod table;

use std::error::Error;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::thread;

use clap::Args;
use stiction_core::{Evolution, Fixed, Hand};
use stiction_host_sim::firmware::process::EmulatorError;
use stiction_host_sim::input::open_scene;
use stiction_host_sim::trade::chip::Chip;
use stiction_live::input::open_path;
use stiction_live::number::{Number, parse_evolution};
use stiction_scene::{InputError, SceneFile, SceneModel};

use crate::emulator::Board;
use crate::markdown::Destination;
use measure::measure;
use table::{LEGEND, Row, table};

/// The arguments of `lab footprint`.
#[derive(Args, Clone, Debug)]
pub struct FootprintArgs {
    /// Scene file (TOML), or the name of a bundled scene; without one, a few bundled scenes, those of the README
    scene: Option<PathBuf>,
    /// How a frame is evolved: path, or frame
    #[arg(long, default_value = "path", value_parser = parse_evolution)]
    evolution: Evolution,
}

/// A point and a box on a floor, a box in a corner, a box on a table.
const SCENES: [&str; 4] = [
    "point-stick-slip",
    "box-flat",
    "corner-stick-slip",
    "table-edge",
];

/// A scene and its hand in every frame.
pub(crate) struct Case {
    pub(crate) scene: SceneFile,
    pub(crate) hands: Vec<Hand<f64>>,
}

impl Case {
    /// A scene file, or a bundled scene.
    pub(crate) fn open(name: &Path) -> Result<Self, InputError> {
        let scene = open_scene(name, Number::F32)?;
        let (path, rate) = open_path(&scene, None, None)?;
        let hands = path.frames(rate).map(|sample| sample.hand).collect();
        Ok(Self { scene, hands })
    }
}

/// Measures a scene, or a few bundled ones.
///
/// # Errors
/// A scene cannot be used, a tool is missing, or the document cannot be written.
pub fn footprint(args: &FootprintArgs, output: Destination) -> Result<(), Box<dyn Error>> {
    let names = match &args.scene {
        Some(name) => vec![name.as_path()],
        None => SCENES.map(Path::new).to_vec(),
    };
    let cases: Result<Vec<Case>, _> = names.into_iter().map(Case::open).collect();
    let cases = cases?;
    for Case { scene, .. } in &cases {
        // Before any build: the numbers form a valid scene for both chips.
        scene.scene::<f32>()?;
        scene.scene::<Fixed>()?;
    }
    Board::require_all(&Chip::ALL.map(Board::of))?;
    let mut rows = Vec::new();
    for case in &cases {
        println!("{}", heading(case));
        rows.extend(measured(case, args.evolution)?);
    }
    let table = table(&rows);
    let text = format!(
        "Written by `cargo run --release -p stiction-lab -- footprint --write`. Evolution: {}. {LEGEND}\n{table}",
        args.evolution.name()
    );
    let write = output.write && args.scene.is_none() && args.evolution == Evolution::Path;
    Ok(Destination { write }.put("host-sim/TRADE.md", "footprint", &text)?)
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

fn measured(case: &Case, evolution: Evolution) -> Result<Vec<Row>, EmulatorError> {
    // One chip computes while the image of another one is built.
    let of_chips = thread::scope(|scope| {
        let started = Chip::ALL.map(|chip| scope.spawn(move || of_chip(chip, case, evolution)));
        started.map(|chip| chip.join().unwrap_or_else(|panic| resume_unwind(panic)))
    });
    of_chips.into_iter().collect()
}

fn of_chip(chip: Chip, case: &Case, evolution: Evolution) -> Result<Row, EmulatorError> {
    let Case { scene, hands } = case;
    let model = SceneModel::smallest(scene);
    let of = |model| {
        let measured = measure(chip, model, scene, evolution, hands);
        eprintln!("{} done: {model}", chip.name());
        measured
    };
    Ok(Row {
        scene: scene.title.clone(),
        model,
        chip,
        smallest: of(model)?,
        full: of(model.full())?,
    })
}
