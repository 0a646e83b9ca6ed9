//! The solver on emulated boards against the solver on this machine. What is not installed is skipped with the command
//! that installs it; with CI=true it must be there.

use std::env;
use std::io::{self, Write};

use stiction_core::{Evolution, Fixed, Hand, Output, Real, Solver};
use stiction_firmware::bits::{Walk, of_walk};
use stiction_firmware::job::{Frame, Setting};
use stiction_host_sim::emulator::{
    Board, BoardNumber, Counter, EmulatorError, Machine, Profile, footprint, job, rust_source,
};
use stiction_host_sim::number::{Number, SiFloat, narrow_hand};
use stiction_host_sim::scene_file::{HostSolver, SceneFile};
use stiction_host_sim::scenes;

fn scene() -> SceneFile {
    let source = scenes::find(scenes::DEFAULT.as_ref()).unwrap();
    SceneFile::parse(source, Number::F32).unwrap()
}

/// Nothing where something is not installed.
fn if_installed<T>(result: Result<T, EmulatorError>) -> Option<T> {
    match result {
        Err(error @ EmulatorError::Missing { .. }) if env::var("CI").as_deref() != Ok("true") => {
            // Not `println!`, which is silent in a test that passes.
            let _ = writeln!(io::stderr(), "skipped: {error}");
            None
        }
        result => Some(result.unwrap()),
    }
}

/// The answers of the solver on this machine.
fn outputs<R: Real<Si: SiFloat>>(
    scene: &SceneFile,
    setting: Setting,
    hands: &[Hand<f64>],
) -> Vec<Output<R::Si>> {
    let solver: HostSolver<R> = Solver::new(scene.scene().unwrap(), setting.evolution)
        .with_tolerance(R::Si::narrow(setting.tolerance));
    let (mut state, first) = solver.start(narrow_hand(&hands[0]));
    let rest = hands[1..].iter();
    let rest = rest.map(|hand| solver.step(&mut state, narrow_hand(hand)));
    std::iter::once(first).chain(rest).collect()
}

fn counts<R: Real<Si = f32>>(number: BoardNumber) {
    let scene = scene();
    let mut walk = Walk::new();
    let hands: Vec<Hand<f64>> = (0..500).map(|_| walk.sample()).collect();
    for (evolution, tolerance) in [
        (Evolution::Path, 0.0),
        (Evolution::Path, 1e-3),
        (Evolution::Frame, 0.0),
    ] {
        let setting = Setting {
            evolution,
            tolerance,
        };
        let outputs = outputs::<R>(&scene, setting, &hands);
        let job = job(&scene, setting, &hands);
        for board in Board::ALL {
            let counted = Counter::new(board, number, Profile::Device)
                .and_then(|counter| counter.count(&job));
            let Some(counted) = if_installed(counted) else {
                continue;
            };
            let case = format!("{} {} {setting:?}", board.name(), number.name());
            assert_eq!(counted.frames.len(), outputs.len(), "{case}");
            for (i, (frame, output)) in counted.frames.iter().zip(&outputs).enumerate() {
                assert_eq!(*frame, Frame::new(frame.instructions, output), "{case} {i}");
                assert!((50..10_000_000).contains(&frame.instructions), "{case} {i}");
            }
            assert!((500..10_000).contains(&counted.totals.stack), "{case}");
        }
    }
}

#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "boards are compared once, with a release build"
)]
fn a_board_gives_the_answers_of_this_machine_and_its_count() {
    counts::<f32>(BoardNumber::F32);
    counts::<Fixed>(BoardNumber::Fixed);
}

#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "boards are compared once, with a release build"
)]
fn every_machine_gives_the_same_bits() {
    const FRAMES: u32 = 20_000;
    for number in BoardNumber::ALL {
        let here = match number {
            BoardNumber::F32 => of_walk::<f32>(FRAMES),
            BoardNumber::Fixed => of_walk::<Fixed>(FRAMES),
        };
        for machine in Machine::ALL {
            if let Some(hash) = if_installed(machine.bits(number, FRAMES)) {
                assert_eq!(hash, here, "{} {}", machine.name(), number.name());
            }
        }
    }
}

#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "boards are compared once, with a release build"
)]
fn the_solver_fits_into_the_flash() {
    for (board, number) in [
        (Board::Stm32F405, BoardNumber::F32),
        (Board::Nrf51822, BoardNumber::Fixed),
    ] {
        let code = rust_source(&scene(), number, Evolution::Path);
        let flash = |profile| if_installed(footprint(board, profile, &code));
        if let (Some(small), Some(fast)) = (flash(Profile::DeviceSmall), flash(Profile::Device)) {
            let case = format!("{} {}: {small}, {fast}", board.name(), number.name());
            assert!(5_000 < small && small < fast && fast < 200_000, "{case}");
        }
    }
}
