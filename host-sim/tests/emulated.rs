//! The bench on emulated boards against the solver on this machine. Ignored unless asked for: it needs QEMU, Node and the
//! targets of the boards.
//!
//! ```sh
//! cargo test --release -p stiction-host-sim --test emulated -- --ignored --nocapture
//! ```

use stiction_core::{Evolution, Hand, Solver};
use stiction_firmware::bits::{Walk, of_walk};
use stiction_firmware::job::Frame;
use stiction_host_sim::emulator::{
    Board, Level, bits, bits_by_wasm, count, footprint, job, rust_source,
};
use stiction_host_sim::number::{Number, narrow_hand};
use stiction_host_sim::scene_file::{HostSolver, SceneFile};
use stiction_host_sim::scenes;

fn scene() -> SceneFile {
    let source = scenes::find(scenes::DEFAULT.as_ref()).unwrap();
    SceneFile::parse(source, Number::F32).unwrap()
}

#[test]
#[ignore = "needs QEMU and the targets of the boards"]
fn a_board_gives_the_bits_of_this_machine_and_its_count() {
    let scene = scene();
    let mut walk = Walk::new();
    let hands: Vec<Hand<f64>> = (0..500).map(|_| walk.sample()).collect();
    for evolution in [Evolution::Path, Evolution::Frame] {
        let job = job(&scene, evolution, &hands);
        let solver: HostSolver<f32> = Solver::new(scene.scene().unwrap(), evolution);
        let (mut state, first) = solver.start(narrow_hand(&hands[0]));
        let rest = hands[1..]
            .iter()
            .map(|hand| solver.step(&mut state, narrow_hand(hand)));
        let outputs: Vec<_> = std::iter::once(first).chain(rest).collect();
        for board in Board::ALL {
            let counted = count(board, Number::F32, Level::Speed, &job).unwrap();
            assert_eq!(counted.frames.len(), outputs.len());
            for (i, (frame, output)) in counted.frames.iter().zip(&outputs).enumerate() {
                assert!((50..10_000_000).contains(&frame.instructions), "{frame:?}");
                let expected = Frame::new(frame.instructions, output);
                assert_eq!(*frame, expected, "{} {evolution:?} {i}", board.name());
            }
            let mean = counted
                .frames
                .iter()
                .map(|f| u64::from(f.instructions))
                .sum::<u64>()
                / 500;
            println!(
                "{} {evolution:?}: {mean}, {:?}",
                board.name(),
                counted.totals
            );
        }
    }
}

#[test]
#[ignore = "needs QEMU, Node and the targets of the boards"]
fn every_machine_gives_the_same_bits() {
    const FRAMES: u32 = 1000;
    for (number, expected) in [
        (Number::F32, of_walk::<f32>(FRAMES)),
        (Number::F64, of_walk::<f64>(FRAMES)),
    ] {
        for board in Board::ALL {
            assert_eq!(
                bits(board, number, FRAMES).unwrap(),
                expected,
                "{}",
                board.name()
            );
        }
        assert_eq!(bits_by_wasm(number, FRAMES).unwrap(), expected);
    }
}

#[test]
#[ignore = "needs the targets of the boards"]
fn the_solver_fits_into_the_flash() {
    let code = rust_source(&scene(), Number::F32, Evolution::Path);
    for board in Board::ALL {
        let small = footprint(board, Level::Size, &code).unwrap();
        let fast = footprint(board, Level::Speed, &code).unwrap();
        println!("{}: {small}, {fast} bytes", board.name());
        assert!(10_000 < small && small < fast && fast < 200_000);
    }
}
