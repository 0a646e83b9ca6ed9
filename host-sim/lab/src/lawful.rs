//! Judges every frame of the scenes that `stiction trade` measures, in every number type and both evolutions, by the laws
//! alone: traces are written and read, as `stiction run` and `stiction check` do.

use std::error::Error;
use std::path::Path;

use stiction_core::{Evolution, Fixed, Real, SiFloat, Solver};
use stiction_host_sim::check;
use stiction_host_sim::columns::thousands;
use stiction_host_sim::trace::{Format, TraceWriter};
use stiction_host_sim::trade::{Case, FINEST, Suite};
use stiction_judge::{Scene, Survey, Trace};
use stiction_live::number::Number;
use stiction_live::record::Run;
use stiction_live::simulate::Running;

use crate::markdown::Destination;

/// The number of worst frames that are listed for each number type and evolution.
const LISTED: usize = 5;

fn write<R: Real<Si: SiFloat>>(case: &Case, run: &Run, file: &Path) -> Result<(), Box<dyn Error>> {
    let solver = Solver::new(case.scene.scene::<R>()?, run.evolution);
    let mut trace = TraceWriter::create(file, Format::JsonLines, run)?;
    Running::new(solver).simulate(case.path.frames(Some(FINEST)), |frame| trace.write(&frame))?;
    Ok(trace.finish()?)
}

fn judge(
    case: &Case,
    number: Number,
    evolution: Evolution,
    survey: &mut Survey,
) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("trace.jsonl");
    let run = Run::of(&case.scene, number, evolution);
    match number {
        Number::F64 => write::<f64>(case, &run, &file)?,
        Number::F32 => write::<f32>(case, &run, &file)?,
        Number::Fixed => write::<Fixed>(case, &run, &file)?,
    }
    let scene = Scene::from(&case.scene.written);
    let frames = Trace::open(&file, &scene)?;
    let mut judge = check::judge(scene, number, evolution);
    let broken = survey.unlawful;
    for frame in frames {
        let (line, frame) = frame?;
        survey.add(line, frame.t, &judge.next(frame));
    }
    if survey.unlawful > broken {
        println!(
            "{}: {} unlawful",
            case.scene.title,
            survey.unlawful - broken
        );
    }
    Ok(())
}

/// Judges all of them; `recorded` is a hand instead of the synthetic one.
///
/// # Errors
/// A frame is unlawful, the recording cannot be used, or the document cannot be written.
pub fn lawful(recorded: Option<&Path>, output: Destination) -> Result<(), Box<dyn Error>> {
    let suite = Suite::new(recorded, false)?;
    let (mut frames, mut unlawful) = (0, 0);
    for number in Number::ALL {
        for evolution in Evolution::ALL {
            let mut survey = Survey::new(LISTED);
            for case in &suite.cases {
                judge(case, number, evolution, &mut survey)?;
            }
            let verdict = check::verdict(&survey, &check::Remarks::default());
            println!("{} {evolution:?}: {verdict}", number.name());
            frames += survey.frames;
            unlawful += survey.unlawful;
        }
    }
    let text = format!(
        "Written by `cargo run --release -p stiction-lab -- lawful --write`. It runs {suite}, in every number type and both \
         evolutions: {} frames, {} unlawful.\n",
        thousands(frames),
        thousands(unlawful)
    );
    let write = output.write && recorded.is_none();
    Destination { write }.put("tests/README.md", "lawful", &text)?;
    match unlawful {
        0 => Ok(()),
        _ => Err("there are unlawful frames".into()),
    }
}
