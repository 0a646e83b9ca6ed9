//! A scene file compiled into the boards: the solver is as large as the scene needs, and runs that scene, obstacles as well.

use crate::board::Board;
use crate::chip::{Chip, F405, MICROBIT, SMALL_MICROBIT, bundled};
use stiction_core::{Description, Event, Fixed, Hand, Real, StateKind};
use stiction_scene::{Motion, SceneFile, WrittenScene};
use stiction_tests::station::BOX;
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::{Said, scene};
use stiction_wire::{Command, Mode, Pose, Reason, Stepping};

/// The tip of a tool, held 40 mm above it, on a rough plate: one vertex, one surface.
const SCENE: &str = "point-stick-slip";
const SAMPLES: u16 = 400;

/// A vertex too many.
const ROD: Description<'static, f32> = Description {
    vertices: &[[0.0, 0.0], [0.01, 0.0]],
    surfaces: &[],
    ..BOX
};

/// The hand presses the tip 4 mm deep and draws it 50 mm along the plate.
fn hand(i: u16) -> Hand<f32> {
    let part = |from: u16, to: u16| {
        let done = i.clamp(from, to) - from;
        f32::from(done) / f32::from(to - from)
    };
    let (down, along) = (part(0, 100), part(100, SAMPLES));
    Hand::new(0.05 * along, 0.05 - 0.014 * down, 0.1 * along)
}

/// The pose of a board that steps at every sample, for this one.
fn stepped(board: &mut Board, hand: Hand<f32>) -> Pose {
    board.send(Command::Hand(hand));
    let sample = board.client.sequence.wrapping_sub(1);
    board.wait(|_, said| match said {
        Said::Pose(pose) if pose.sample == sample => Some(*pose),
        _ => None,
    })
}

fn runs_its_scene<R: Real<Si = f32>>(chip: &'static Chip) {
    let (Some(own), Some(image)) = (chip.image(), chip.image_of(Some(SCENE))) else {
        return;
    };
    println!(
        "{}: flash {} of {}",
        chip.name(),
        image.contents.flash,
        own.contents.flash
    );
    assert!(
        image.contents.flash < own.contents.flash
            && image.contents.variables < own.contents.variables
    );
    assert_eq!(image.contents.panics(), [""; 0]);
    let Some(mut board) = Board::start_image(chip, image) else {
        return;
    };
    let info = board.info();
    let room = [info.vertices, info.surfaces, info.corners];
    assert_eq!((room, info.actuators), ([1, 1, 0], false));
    assert_eq!(
        (info.stiffness, info.friction_now),
        ([500.0, 0.5], [0.5, 0.3])
    );
    board.send(scene(&ROD));
    let refused = board.wait(|_, said| match said {
        Said::Reply(answer) => Some((answer.reason, answer.value, answer.limit)),
        _ => None,
    });
    assert_eq!(refused, (Reason::Unsupported, 2.0, 1.0));
    board.done(Command::Mode(Mode {
        stepping: Stepping::PerSample,
        health_every: 0,
        ..info.mode
    }));
    let written = WrittenScene::read(&bundled(SCENE), f64::from(f32::MAX)).unwrap();
    let (mut beside, _) = written.described::<R, _>(|scene| Beside::<R>::of(scene, &info.mode));
    beside.solver = beside.solver.with_budget(info.budget);
    let mut slips = 0;
    for i in 0..SAMPLES {
        let pose = stepped(&mut board, hand(i));
        assert_same(
            &pose,
            &beside.step(hand(i)),
            &format!("{} {i}", chip.name()),
        );
        slips += u32::from(pose.events.contains(Event::Slip));
        if i > 100 {
            assert_eq!(pose.state, StateKind::SingleVertex, "{i}");
        }
    }
    assert!(slips > 1, "{slips}");
}

#[test]
fn the_f405_runs_the_scene_file_that_it_is_built_with() {
    runs_its_scene::<f32>(&F405);
}

#[test]
fn the_microbit_runs_the_scene_file_that_it_is_built_with() {
    runs_its_scene::<Fixed>(&MICROBIT);
}

/// A box that goes over the edge of a table: flat on it, about its corner, off it.
const OBSTACLES: &str = "table-edge";
/// Samples of a second of its hand.
const RATE: f64 = 40.0;

fn runs_its_obstacles<R: Real<Si = f32>>(chip: &'static Chip) {
    let Some(image) = chip.image_of(Some(OBSTACLES)) else {
        return;
    };
    println!("{}: flash {}", chip.name(), image.contents.flash);
    assert_eq!(image.contents.panics(), [""; 0]);
    let Some(mut board) = Board::start_image(chip, image) else {
        return;
    };
    let info = board.info();
    board.done(Command::Mode(Mode {
        stepping: Stepping::PerSample,
        // The slowest line cannot transfer the forces of each step.
        forces_every: 0,
        health_every: 0,
        ..info.mode
    }));
    let file = SceneFile::read(&bundled(OBSTACLES), f64::from(f32::MAX)).unwrap();
    let Some(Motion::Keyframes(path)) = &file.hand.motion else {
        panic!("{OBSTACLES} has no keyframes");
    };
    let (scene, _) = file.written.scene_in::<R>().unwrap();
    let mut beside = Beside::solving(scene, info.mode.evolution);
    beside.solver = beside.solver.with_budget(info.budget);
    let mut tips = 0;
    for (i, sample) in path.frames(Some(RATE)).enumerate() {
        let [x, y] = sample.hand.position.map(|x| x as f32);
        let hand = Hand::new(x, y, sample.hand.angle.radians() as f32);
        let pose = stepped(&mut board, hand);
        assert_same(&pose, &beside.step(hand), &format!("{} {i}", chip.name()));
        tips += u32::from(pose.events.contains(Event::Tip));
    }
    assert!(tips > 0);
}

#[test]
fn the_f405_runs_the_obstacles_that_it_is_built_with() {
    runs_its_obstacles::<f32>(&F405);
}

/// For so many instructions as the others have it has not the flash.
#[test]
fn the_microbit_built_for_little_flash_runs_the_obstacles_that_it_is_built_with() {
    runs_its_obstacles::<Fixed>(&SMALL_MICROBIT);
}
