//! Measures the solver on emulated boards and prints tables in Markdown: instructions per frame and stack for the bundled
//! dragged boxes, and flash for scenes that need more or less of the solver.
//!
//! ```sh
//! cargo run --release -p stiction-host-sim --example boards
//! ```

use std::error::Error;

use stiction_core::{Event, Evolution, Fixed, Hand, Real, Solver, narrow_hand};
use stiction_firmware::job::Frame;
use stiction_host_sim::emulator::{Board, Counted, Counter, Profile, footprint, job};
use stiction_host_sim::number::Number;
use stiction_host_sim::scenes;
use stiction_scene::{HostSolver, Motion, NumberType, SceneFile, SceneModel, Source, rust_source};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// What is measured: a board with its number type and profile.
#[derive(Clone, Copy)]
struct Build {
    board: Board,
    number: NumberType,
    profile: Profile,
}

/// A scene that needs more or less of the solver.
struct Size {
    name: &'static str,
    /// `[body]` without its start pose.
    body: &'static str,
    /// Weight (N).
    weight: f64,
    /// mu_s; mu_d is 0.
    friction: f64,
    /// Normals of the surfaces.
    normals: &'static [[f64; 2]],
}

const DRAGGED: [&str; 2] = ["vertex-stick-slip", "box-flat"];

const BOX: &str = "rectangle = [0.10, 0.06]";
const POINT: &str = "vertices = [[0.0, 0.0]]";
const FLOOR: [f64; 2] = [0.0, 1.0];
const WALL: [f64; 2] = [-1.0, 0.0];

const fn size(
    name: &'static str,
    body: &'static str,
    [weight, friction]: [f64; 2],
    normals: &'static [[f64; 2]],
) -> Size {
    Size {
        name,
        body,
        weight,
        friction,
        normals,
    }
}

const SIZES: [Size; 6] = [
    size("V = 4, S = 2, Full", BOX, [1.0, 0.5], &[FLOOR, WALL]),
    size("V = 4, S = 1, Full", BOX, [1.0, 0.5], &[FLOOR]),
    size("V = 4, S = 1, Weightless", BOX, [0.0, 0.5], &[FLOOR]),
    size("V = 1, S = 1, Full", POINT, [1.0, 0.5], &[FLOOR]),
    size("V = 1, S = 1, Frictionless", POINT, [1.0, 0.0], &[FLOOR]),
    size("V = 1, S = 1, Bare", POINT, [0.0, 0.0], &[FLOOR]),
];

impl Build {
    /// The boards with their number types, in both profiles.
    const ALL: [Self; 4] = [
        Self::new(Board::Stm32F405, NumberType::F32, Profile::Device),
        Self::new(Board::Stm32F405, NumberType::F32, Profile::DeviceSmall),
        Self::new(Board::Nrf51822, NumberType::Fixed, Profile::Device),
        Self::new(Board::Nrf51822, NumberType::Fixed, Profile::DeviceSmall),
    ];

    const fn new(board: Board, number: NumberType, profile: Profile) -> Self {
        Self {
            board,
            number,
            profile,
        }
    }

    /// The first cells of a row.
    fn title(self) -> String {
        let [board, number] = [self.board.name(), self.number.name()];
        format!("{board} | {number} | {}", self.profile.name())
    }
}

fn main() -> Outcome<()> {
    println!(
        "| board | number | profile | scene | evolution | frames | mean | worst | worst frame | stack | state | output |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|"
    );
    for build in Build::ALL {
        for scene in DRAGGED {
            for evolution in Evolution::ALL {
                println!("{}", dragged(build, scene, evolution)?);
            }
        }
    }
    println!(
        "\n| board | number | profile | scene | flash, path | flash, frame |\n|---|---|---|---|---|---|"
    );
    for build in Build::ALL {
        for size in &SIZES {
            let [path, frame] = Evolution::ALL.map(|evolution| flash(build, size, evolution));
            let (path, frame) = (path?, frame?);
            println!("| {} | {} | {path} | {frame} |", build.title(), size.name);
        }
    }
    Ok(())
}

/// A bundled scene along its hand's path on a board.
fn dragged(build: Build, name: &str, evolution: Evolution) -> Outcome<String> {
    let source = scenes::find(name.as_ref()).ok_or("no such scene")?;
    let scene = SceneFile::parse(source, Number::F32.limit())?;
    let Some(Motion::Keyframes(path)) = &scene.hand.motion else {
        return Err("a scene without keyframes".into());
    };
    let hands: Vec<_> = path.frames(scene.hand.rate).map(|s| s.hand).collect();
    let job = job(&scene, (evolution, u32::MAX), &hands);
    let counted = Counter::new(build.board, build.number, build.profile)?.count(&job)?;
    let steps = counted.steps();
    let instructions = || steps.iter().map(|frame| u64::from(frame.instructions));
    let mean = instructions().sum::<u64>() / steps.len() as u64;
    let worst = (1..).zip(steps).max_by_key(|(_, frame)| frame.instructions);
    let (i, worst) = worst.ok_or("a path of one frame")?;
    let events = match build.number {
        NumberType::F32 => events::<f32>(&scene, evolution, &hands[..=i])?,
        NumberType::Fixed => events::<Fixed>(&scene, evolution, &hands[..=i])?,
    };
    let Counted { frames, totals } = &counted;
    Ok(format!(
        "| {} | {name} | {} | {} | {mean} | {} | {i}: {}, {} | {} | {} | {} |",
        build.title(),
        evolution.name(),
        frames.len(),
        worst.instructions,
        change(&frames[i - 1], worst),
        events,
        totals.stack,
        totals.state,
        totals.output,
    ))
}

/// The states before and after a frame, and the number of slips.
fn change(before: &Frame, after: &Frame) -> String {
    let (from, to) = (before.state.name(), after.state.name());
    format!("{from} to {to}, {} slips", after.slips)
}

/// The events of the last of these frames, computed on this computer, whose bits equal those of the board.
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

/// The flash that the solver of a scene occupies on a board (bytes).
fn flash(build: Build, size: &Size, evolution: Evolution) -> Outcome<u64> {
    let Size {
        body,
        weight,
        friction,
        normals,
        ..
    } = size;
    let surface = |(i, normal): (usize, &[f64; 2])| {
        format!("[[surface]]\nname = \"{i}\"\nnormal = {normal:?}\noffset = -1.0\n")
    };
    let surfaces: String = normals.iter().enumerate().map(surface).collect();
    let text = format!(
        "[body]\n{body}\nstart = [0.0, 0.0, 0.0]\nweight = {weight:?}\n\
         [spring]\ntranslation = 500.0\nrotation = 0.5\n\
         [friction]\nstatic = {friction:?}\ndynamic = 0.0\n{surfaces}"
    );
    let scene = SceneFile::parse(Source::new("size.toml", text), Number::F32.limit())?;
    let code = rust_source(
        &scene,
        SceneModel::smallest(&scene),
        build.number,
        evolution,
    );
    Ok(footprint(build.board, build.profile, &code)?)
}
