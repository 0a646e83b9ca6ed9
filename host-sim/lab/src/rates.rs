//! Counts the slips of the same hand at several rates of frames, in every number type: along the path they do not depend on the rate.

use std::error::Error;

use stiction_core::{Evolution, Fixed, Real, SiFloat};
use stiction_host_sim::columns::thousands;
use stiction_live::number::Number as NumberType;
use stiction_live::scenes;
use stiction_live::simulate::Running;
use stiction_scene::{Motion, SceneFile, Source};
use stiction_tests::Number;
use stiction_tests::obstacles::pegs::Insertion;

use crate::markdown::{Destination, Table};

/// Frames per second.
const RATES: [usize; 8] = [20, 50, 100, 200, 500, 1000, 2000, 3000];
/// The time of an insertion (s).
const INSERTION: usize = 1;
const PEGS: u64 = 100;

/// A scene with its hand, and how often it slips.
enum Trial {
    Bundled(Box<SceneFile>),
    Peg(Box<Insertion>),
}

impl Trial {
    fn slips<R: Number + Real<Si: SiFloat>>(&self, rate: usize) -> u32 {
        match self {
            Self::Bundled(scene) => bundled_slips::<R>(scene, rate),
            Self::Peg(insertion) => insertion.slips::<R>(INSERTION * rate),
        }
    }
}

fn bundled_slips<R: Real<Si: SiFloat>>(scene: &SceneFile, rate: usize) -> u32 {
    let Some(Motion::Keyframes(path)) = &scene.hand.motion else {
        return 0;
    };
    let mut running = Running::<R>::of(scene, Evolution::Path, u32::MAX).expect("a bundled scene");
    let frames = path.frames(Some(rate as f64));
    frames.map(|sample| running.frame(&sample).slips).sum()
}

/// The slips of every trial at every rate.
fn slips<R: Number + Real<Si: SiFloat>>(trials: &[Trial]) -> Vec<[u32; RATES.len()]> {
    let at_rates = |trial: &Trial| RATES.map(|rate| trial.slips::<R>(rate));
    trials.iter().map(at_rates).collect()
}

/// A row for each number type.
fn count(group: &str, trials: &[Trial], table: &mut Table) {
    let types = [
        ("f64", slips::<f64>(trials)),
        ("f32", slips::<f32>(trials)),
        ("fixed", slips::<Fixed>(trials)),
    ];
    for (name, slips) in types {
        let sums: [u32; RATES.len()] = std::array::from_fn(|k| slips.iter().map(|at| at[k]).sum());
        let differs = |at: &&[u32; RATES.len()]| at.iter().any(|count| count != &at[0]);
        let others = slips.iter().filter(differs).count();
        let words = [group.to_owned(), name.to_owned()];
        let sums = sums.map(|sum| thousands(sum.into()));
        table.row(words.into_iter().chain(sums).chain([others.to_string()]));
    }
}

/// Counts them.
///
/// # Errors
/// A bundled scene cannot be read, or the document cannot be written.
pub fn rates(output: Destination) -> Result<(), Box<dyn Error>> {
    let mut bundled = Vec::new();
    for (name, text) in scenes::ALL {
        let source = Source::new(format!("{name}.toml"), *text);
        let scene = SceneFile::parse(source, NumberType::F32.limit())?;
        bundled.push(Trial::Bundled(Box::new(scene)));
    }
    let pegs: Vec<_> = (0..PEGS)
        .map(|i| Trial::Peg(Box::new(Insertion::of(i))))
        .collect();
    let rates = RATES.map(|rate| format!("{rate} Hz:")).join(" | ");
    let mut table = Table::new(&format!("scenes | number | {rates} | differ:"));
    count(&format!("{} bundled", bundled.len()), &bundled, &mut table);
    count(&format!("{PEGS} pegs"), &pegs, &mut table);
    let text = format!(
        "Written by `cargo run --release -p stiction-lab -- rates --write`: slips along the path at several rates of frames; `differ`: scenes whose\n\
         number of slips is not the same at all rates.\n\n{table}"
    );
    Ok(output.put("tests/README.md", "rates", &text)?)
}
