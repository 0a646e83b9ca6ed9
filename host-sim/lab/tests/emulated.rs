//! The solver on emulated boards against the solver on this machine. What is not installed is skipped with the command
//! that installs it; with CI=true it must be there.

use stiction_core::{Evolution, Fixed, Hand, Output, Real, Solver, narrow_hand};
use stiction_firmware::bits::{CORNERS, Walk, of_walk};
use stiction_host_sim::firmware::process::{EmulatorError, if_installed};
use stiction_host_sim::trade::chip::Chip;
use stiction_host_sim::trade::counts::counted;
use stiction_host_sim::trade::{Memory, RATES, Suite};
use stiction_lab::emulator::{
    Board, Counted, Counter, Frame, Machine, Place, Profile, footprint, job,
};
use stiction_lab::trade::{Build, count};
use stiction_live::number::Number;
use stiction_live::scenes;
use stiction_scene::{HostSolver, Motion, NumberType, SceneFile, SceneModel, rust_source};
use stiction_wire::{EventSet, Pose};

fn scene() -> SceneFile {
    bundled(scenes::DEFAULT)
}

fn bundled(name: &str) -> SceneFile {
    let source = scenes::find(name.as_ref()).unwrap();
    SceneFile::parse(source, Number::F32.limit()).unwrap()
}

fn outputs<R: Real<Si = f32>>(
    scene: &SceneFile,
    evolution: Evolution,
    hands: &[Hand<f64>],
) -> Vec<Output<f32>> {
    let solver: HostSolver<R> = Solver::new(scene.scene().unwrap(), evolution);
    let (mut state, first) = solver.start(narrow_hand(&hands[0]));
    let rest = hands[1..].iter();
    let rest = rest.map(|hand| solver.step(&mut state, narrow_hand(hand)));
    std::iter::once(first).chain(rest).collect()
}

fn counts<R: Real<Si = f32>>(number: NumberType) {
    let scene = scene();
    let mut walk = Walk::new();
    let hands: Vec<Hand<f64>> = (0..500).map(|_| walk.sample()).collect();
    for evolution in Evolution::ALL {
        let outputs = outputs::<R>(&scene, evolution, &hands);
        let job = job(&scene, evolution, &hands);
        for board in Board::ALL {
            let counted = Counter::new(board, number, Profile::Device)
                .and_then(|counter| counter.count(&job, u32::MAX));
            let Some(counted) = if_installed(counted) else {
                continue;
            };
            let case = format!("{} {} {evolution:?}", board.name(), number.name());
            assert_eq!(counted.frames.len(), outputs.len(), "{case}");
            for (i, (frame, output)) in counted.frames.iter().zip(&outputs).enumerate() {
                let expected = Frame {
                    instructions: frame.instructions,
                    pose: Pose::new(output, EventSet::of(output.events()), i as u8),
                    slips: output.slips,
                    work: output.work,
                };
                assert_eq!(*frame, expected, "{case} {i}");
                assert!((50..10_000_000).contains(&frame.instructions), "{case} {i}");
            }
            assert!((500..10_000).contains(&counted.totals.stack), "{case}");
        }
    }
}

#[test]
fn a_board_gives_the_answers_of_this_machine_and_its_count() {
    counts::<f32>(NumberType::F32);
    counts::<Fixed>(NumberType::Fixed);
}

fn same_bits(number: NumberType) {
    let of = |place, frames| match (number, place) {
        (NumberType::F32, Place::ByWalls) => of_walk::<f32, 0>(frames),
        (NumberType::F32, Place::AmongObstacles) => of_walk::<f32, CORNERS>(frames),
        (NumberType::Fixed, Place::ByWalls) => of_walk::<Fixed, 0>(frames),
        (NumberType::Fixed, Place::AmongObstacles) => of_walk::<Fixed, CORNERS>(frames),
    };
    // Among obstacles a frame takes so much more, on a machine that is itself computed.
    for (place, frames) in [(Place::ByWalls, 5_000), (Place::AmongObstacles, 500)] {
        let here = of(place, frames);
        for machine in Machine::ALL {
            // Its emulator counts cycles: frames of seconds by walls, and of minutes among obstacles.
            let (frames, here) = match (machine, place) {
                (Machine::Board(Board::Rp2040), Place::ByWalls) => (1_000, of(place, 1_000)),
                (Machine::Board(Board::Rp2040), Place::AmongObstacles) => continue,
                _ => (frames, here),
            };
            if let Some(hash) = if_installed(machine.bits(number, place, frames)) {
                let (machine, number) = (machine.name(), number.name());
                assert_eq!(hash, here, "{machine} {number} {place:?}");
            }
        }
    }
}

#[test]
fn every_machine_gives_the_same_bits_in_f32() {
    same_bits(NumberType::F32);
}

#[test]
fn every_machine_gives_the_same_bits_in_fixed_point() {
    same_bits(NumberType::Fixed);
}

/// A scene along its own hand's path, at 100 Hz, in a model: what is counted, and the flash.
fn of_model(
    (board, number, evolution): (Board, NumberType, Evolution),
    scene: &SceneFile,
    model: SceneModel,
) -> Result<(Counted, u64), EmulatorError> {
    let Some(Motion::Keyframes(path)) = &scene.hand.motion else {
        panic!("{} has no keyframes", scene.title);
    };
    let hands: Vec<_> = path.frames(Some(100.0)).map(|s| s.hand).collect();
    let code = rust_source(scene, model, number, evolution);
    let counter = Counter::of_model(board, Profile::Device, &code)?;
    let mut counted = counter.count(&job(scene, evolution, &hands), u32::MAX)?;
    for frame in &mut counted.frames {
        assert!((50..10_000_000).contains(&frame.instructions), "{frame:?}");
        frame.instructions = 0;
    }
    Ok((counted, footprint(board, Profile::DeviceSmall, &code)?))
}

#[test]
fn the_smallest_model_gives_the_answers_of_the_full_one_in_less_flash() {
    for (board, number, evolution, name) in [
        (
            Board::Stm32F405,
            NumberType::F32,
            Evolution::Path,
            "point-frictionless",
        ),
        (
            Board::Nrf51822,
            NumberType::Fixed,
            Evolution::Frame,
            "rod-on-floor",
        ),
    ] {
        let (scene, build) = (bundled(name), (board, number, evolution));
        let model = SceneModel::smallest(&scene);
        let [smallest, full] = [model, model.full()].map(|m| of_model(build, &scene, m));
        let (Some(smallest), Some(full)) = (if_installed(smallest), if_installed(full)) else {
            continue;
        };
        assert_eq!(smallest.0.frames, full.0.frames, "{name}");
        assert!(smallest.0.totals.solver < full.0.totals.solver, "{name}");
        assert!(smallest.1 < full.1, "{name}: {} {}", smallest.1, full.1);
    }
}

/// The table that `stiction trade --emulated` reads: what it says of the chips, at the slowest rate, is what the solver takes now. Compilers
/// differ a little.
#[test]
#[ignore = "figures of a document, which the lab writes"]
fn counts_of_the_chips_are_those_of_the_document() {
    let suite = Suite::new(None, false).unwrap();
    let table = counted().unwrap();
    let builds = [
        (Chip::CortexM4F, NumberType::F32),
        (Chip::CortexM0, NumberType::Fixed),
    ];
    let builds = builds.map(|(chip, number)| Build { chip, number });
    let counts = count(&suite, &builds, |setting, rate| {
        setting.evolution == Evolution::Path
            && setting.memory == Memory::DEFAULT
            && rate == RATES[0]
    });
    let Some(counts) = if_installed(counts) else {
        return;
    };
    assert_eq!(counts.len(), builds.len());
    for now in counts {
        let same = |known: &&_| {
            let known: &stiction_host_sim::trade::counts::Count = known;
            (known.chip, known.setting, known.rate) == (now.chip, now.setting, now.rate)
        };
        let known = table.iter().find(same).expect("a line");
        let [was, is] = [known.cost, now.cost];
        let case = format!("{was:?}, now {is:?}: `lab trade --write` writes it");
        assert!((is.mean / was.mean - 1.0).abs() < 0.1, "{case}");
        assert!(
            (is.flash as f64 / was.flash as f64 - 1.0).abs() < 0.1,
            "{case}"
        );
        assert_eq!(is.state, was.state, "{case}");
    }
}

/// A million frames by walls and among obstacles.
#[test]
#[ignore = "takes an hour"]
fn a_million_frames_have_the_same_bits_on_every_machine() {
    for number in NumberType::ALL {
        for place in Place::ALL {
            let of = |machine: Machine| if_installed(machine.bits(number, place, 1_000_000));
            let hashes: Vec<_> = Machine::ALL.into_iter().filter_map(of).collect();
            assert!(hashes.iter().all(|hash| *hash == hashes[0]), "{hashes:x?}");
        }
    }
}
