//! Measures the solver on emulated boards, as tables in Markdown: instructions of a frame and stack for the bundled dragged
//! boxes, flash for scenes that need more or less of the solver.
//!
//! ```sh
//! cargo run --release -p stiction-host-sim --example boards
//! ```

use std::error::Error;

use stiction_core::{Event, Evolution, Fixed, Hand, Real, Solver};
use stiction_firmware::job::Frame;
use stiction_host_sim::emulator::{
    Board, BoardNumber, Counted, Profile, count, footprint, job, rust_source,
};
use stiction_host_sim::number::{Number, narrow_hand};
use stiction_host_sim::scene_file::{HostSolver, Motion, SceneFile};
use stiction_host_sim::scenes;
use stiction_host_sim::source::Source;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// What is measured: the boards with what they compute with, in both profiles.
const IMAGES: [(Board, BoardNumber, Profile); 4] = [
    (Board::Stm32F405, BoardNumber::F32, Profile::Device),
    (Board::Stm32F405, BoardNumber::F32, Profile::DeviceSmall),
    (Board::Nrf51822, BoardNumber::Fixed, Profile::Device),
    (Board::Nrf51822, BoardNumber::Fixed, Profile::DeviceSmall),
];
const EVOLUTIONS: [Evolution; 2] = [Evolution::Path, Evolution::Frame];
const DRAGGED: [&str; 2] = ["vertex-stick-slip", "box-flat"];

const BOX: &str = "rectangle = [0.10, 0.06]";
const POINT: &str = "vertices = [[0.0, 0.0]]";
const FLOOR: [f64; 2] = [0.0, 1.0];
const WALL: [f64; 2] = [-1.0, 0.0];
/// Scenes for the flash: body, weight, mu_s, normals of the surfaces.
const SIZES: [(&str, &str, f64, f64, &[[f64; 2]]); 6] = [
    ("V = 4, S = 2, Full", BOX, 1.0, 0.5, &[FLOOR, WALL]),
    ("V = 4, S = 1, Full", BOX, 1.0, 0.5, &[FLOOR]),
    ("V = 4, S = 1, Weightless", BOX, 0.0, 0.5, &[FLOOR]),
    ("V = 1, S = 1, Full", POINT, 1.0, 0.5, &[FLOOR]),
    ("V = 1, S = 1, Frictionless", POINT, 1.0, 0.0, &[FLOOR]),
    ("V = 1, S = 1, Bare", POINT, 0.0, 0.0, &[FLOOR]),
];

fn main() -> Outcome<()> {
    println!(
        "| board | number | profile | scene | evolution | frames | mean | worst | worst frame | stack | state | output |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|"
    );
    for image in IMAGES {
        for scene in DRAGGED {
            for evolution in EVOLUTIONS {
                println!("{}", dragged(image, scene, evolution)?);
            }
        }
    }
    println!(
        "\n| board | number | profile | scene | flash, path | flash, frame |\n|---|---|---|---|---|---|"
    );
    for image in IMAGES {
        for size in SIZES {
            let [path, frame] = EVOLUTIONS.map(|evolution| flash(image, size, evolution));
            let (path, frame) = (path?, frame?);
            println!("| {} | {} | {path} | {frame} |", title(image), size.0);
        }
    }
    Ok(())
}

fn title((board, number, profile): (Board, BoardNumber, Profile)) -> String {
    format!("{} | {} | {}", board.name(), number.name(), profile.name())
}

/// A bundled scene along its hand's path on a board.
fn dragged(
    image: (Board, BoardNumber, Profile),
    name: &str,
    evolution: Evolution,
) -> Outcome<String> {
    let source = scenes::find(name.as_ref()).ok_or("no such scene")?;
    let scene = SceneFile::parse(source, Number::F32)?;
    let Some(Motion::Keyframes(path)) = &scene.hand.motion else {
        return Err("a scene without keyframes".into());
    };
    let hands: Vec<_> = path.frames(scene.hand.rate).map(|s| s.hand).collect();
    let (board, number, profile) = image;
    let counted = count(board, number, profile, &job(&scene, evolution, &hands))?;
    // The first frame is the start.
    let steps = &counted.frames[1..];
    let instructions = || steps.iter().map(|frame| u64::from(frame.instructions));
    let mean = instructions().sum::<u64>() / steps.len() as u64;
    let worst = (1..).zip(steps).max_by_key(|(_, frame)| frame.instructions);
    let (i, worst) = worst.ok_or("a path of one frame")?;
    let events = match number {
        BoardNumber::F32 => events::<f32>(&scene, evolution, &hands[..=i])?,
        BoardNumber::Fixed => events::<Fixed>(&scene, evolution, &hands[..=i])?,
    };
    let Counted { frames, totals } = &counted;
    Ok(format!(
        "| {} | {name} | {} | {} | {mean} | {} | {i}: {}, {} | {} | {} | {} |",
        title(image),
        format!("{evolution:?}").to_lowercase(),
        frames.len(),
        worst.instructions,
        change(&frames[i - 1], worst),
        events,
        totals.stack,
        totals.state,
        totals.output,
    ))
}

/// The states before and after a frame, and its slips.
fn change(before: &Frame, after: &Frame) -> String {
    let (from, to) = (before.state.name(), after.state.name());
    format!("{from} to {to}, {} slips", after.slips)
}

/// What happens in the last of these frames: on this computer, whose bits are those of the board.
fn events<R: Real<Si = f32>>(
    scene: &SceneFile,
    evolution: Evolution,
    hands: &[Hand<f64>],
) -> Outcome<String> {
    let solver: HostSolver<R> = Solver::new(scene.scene()?, evolution);
    let (mut state, mut output) = solver.start(narrow_hand(&hands[0]));
    for hand in &hands[1..] {
        output = solver.step(&mut state, narrow_hand(hand));
    }
    let names: Vec<_> = output.events().iter().copied().map(Event::name).collect();
    Ok(names.join(" "))
}

/// The flash that the solver of a scene takes on a board (bytes).
fn flash(
    (board, number, profile): (Board, BoardNumber, Profile),
    (_, body, weight, friction, normals): (&str, &str, f64, f64, &[[f64; 2]]),
    evolution: Evolution,
) -> Outcome<u64> {
    let surface = |(i, normal): (usize, &[f64; 2])| {
        format!("[[surface]]\nname = \"{i}\"\nnormal = {normal:?}\noffset = -1.0\n")
    };
    let surfaces: String = normals.iter().enumerate().map(surface).collect();
    let text = format!(
        "[body]\n{body}\nstart = [0.0, 0.0, 0.0]\nweight = {weight:?}\n\
         [spring]\ntranslation = 500.0\nrotation = 0.5\n\
         [friction]\nstatic = {friction:?}\ndynamic = 0.0\n{surfaces}"
    );
    let scene = SceneFile::parse(Source::new("size.toml", text), Number::F32)?;
    let code = rust_source(&scene, number, evolution);
    Ok(footprint(board, profile, &code)?)
}
