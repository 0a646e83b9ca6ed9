//! Judges every frame of the scenes that `stiction trade` measures, in every number type and both evolutions, by the laws
//! alone: traces are written and read, as `stiction run` and `stiction check` do. Without a recorded hand, the numbers of
//! frames and of unlawful frames are written into tests/README.md.
//!
//! ```sh
//! cargo run --release -p stiction-host-sim --example lawful
//! cargo run --release -p stiction-host-sim --example lawful -- hand.txt   # with a recorded hand
//! ```

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use stiction_core::{Evolution, Fixed, Real, SiFloat, Solver};
use stiction_host_sim::check;
use stiction_host_sim::number::Number;
use stiction_host_sim::record::Run;
use stiction_host_sim::simulate::simulate;
use stiction_host_sim::trace::{Format, TraceWriter};
use stiction_host_sim::trade::{Case, FINEST, Suite};
use stiction_judge::{Scene, Survey, Trace};
use stiction_tools::readme::Section;
use stiction_tools::table::thousands;
use stiction_tools::workspace;

/// The number of worst frames that are listed for each number type and evolution.
const LISTED: usize = 5;

fn write<R: Real<Si: SiFloat>>(case: &Case, run: &Run, file: &Path) -> Result<(), Box<dyn Error>> {
    let solver = Solver::new(case.scene.scene::<R>()?, run.evolution);
    let mut trace = TraceWriter::create(file, Format::JsonLines, run)?;
    simulate(solver, case.path.frames(Some(FINEST)), |frame| {
        trace.write(&frame)
    })?;
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

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let recorded = std::env::args().nth(1);
    let suite = Suite::new(recorded.as_deref().map(Path::new), false)?;
    let (mut frames, mut unlawful) = (0, 0);
    for number in Number::ALL {
        for evolution in [Evolution::Path, Evolution::Frame] {
            let mut survey = Survey::new(LISTED);
            for case in &suite.cases {
                judge(case, number, evolution, &mut survey)?;
            }
            println!(
                "{} {evolution:?}: {}",
                number.name(),
                check::verdict(&survey, &check::Remarks::default())
            );
            frames += survey.frames;
            unlawful += survey.unlawful;
        }
    }
    if recorded.is_none() {
        let text = format!(
            "Written by `cargo run --release -p stiction-host-sim --example lawful`. It runs {suite}, in every number type and both \
             evolutions: {} frames, {} unlawful.",
            thousands(frames),
            thousands(unlawful)
        );
        Section::find(&workspace().join("tests/README.md"), "lawful")?.write(&text)?;
    }
    Ok(match unlawful {
        0 => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    })
}
