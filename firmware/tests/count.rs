//! A job of the instruction bench returns the solver's own answers; bytes that are not a job are refused.

use crate::with;
use stiction_core::{
    Description, Evolution, Hand, Parameter, Real, Scene, Solver, SurfaceDescription,
};
use stiction_firmware::count::{Failure, FileError, Files, Instruments, Totals, run};
use stiction_tests::station::{BOX, FLOOR};
use stiction_wire::{Command, Decoder, EventSet, Frame, Mode, Pose, Report, SceneCommand};

const SAMPLES: u32 = 100;
const SURFACE: SurfaceDescription<f32> = SurfaceDescription {
    memory: Some(1e-3),
    ..FLOOR
};
const WALL: SurfaceDescription<f32> = SurfaceDescription {
    normal: [-1.0, 0.0],
    offset: -0.5,
    ..FLOOR
};
const SCENE: Description<'static, f32> = Description {
    start: [0.01, 0.0727, 0.5],
    weight: 0.25,
    reach: 0.01,
    surfaces: &[SURFACE, WALL],
    ..BOX
};

struct Memory {
    job: Vec<u8>,
    taken: usize,
    results: Vec<u8>,
}

/// Does a job with files in memory.
fn done<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>(
    evolution: Option<Evolution>,
    job: Vec<u8>,
) -> Result<(Totals, Vec<u8>), Failure> {
    let mut files = Memory {
        job,
        taken: 0,
        results: Vec::new(),
    };
    let totals = run::<R, V, S, C>(evolution, u32::MAX, &mut files, &mut Calls(0))?;
    Ok((totals, files.results))
}

/// Counts calls instead of instructions.
struct Calls(u32);

impl Files for Memory {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, FileError> {
        let rest = &self.job[self.taken..];
        let count = rest.len().min(bytes.len());
        bytes[..count].copy_from_slice(&rest[..count]);
        self.taken += count;
        Ok(count)
    }
    fn write(&mut self, bytes: &[u8]) -> Result<(), FileError> {
        self.results.extend_from_slice(bytes);
        Ok(())
    }
}

impl Instruments for Calls {
    fn count<T>(&mut self, work: impl FnOnce() -> T) -> (u32, T) {
        self.0 += 1;
        (self.0, work())
    }
    fn watch_stack(&mut self) {}
    fn deepest_stack(&mut self) -> u32 {
        4321
    }
}

/// Down onto the floor and along it, with some whole turns.
fn hand(i: u32) -> Hand<f32> {
    let t = i as f32 / SAMPLES as f32;
    with(Hand::new(0.05 * t, 0.09 - 0.05 * t, 0.5 - t), |hand| {
        (hand.angle.turns, hand.held) = (-3, i != 60);
    })
}

fn bytes_of(command: Command<'_>) -> Vec<u8> {
    let frame = Frame {
        sequence: 0,
        time: 0,
        message: command,
    };
    frame.encode(&mut [0; 512]).expect("room").to_vec()
}

fn job_of(scene: &Description<'_, f32>, evolution: Evolution) -> Vec<u8> {
    let mode = with(Mode::DEFAULT, |mode| mode.evolution = evolution);
    let mut bytes = bytes_of(Command::Scene(SceneCommand::from(scene)));
    bytes.extend(bytes_of(Command::Mode(mode)));
    bytes.extend((0..SAMPLES).flat_map(|i| bytes_of(Command::Hand(hand(i)))));
    bytes
}

/// The answers of a job: times and poses, times and slips.
fn answers(results: &[u8]) -> Vec<(u32, Pose, u32, u32)> {
    let mut decoder = Decoder::<256>::new();
    let (mut answers, mut last) = (Vec::new(), None);
    for &byte in results {
        let Some(received) = decoder.push::<Report>(byte) else {
            continue;
        };
        let Frame { time, message, .. } = received.expect("a report");
        match (message, last.take()) {
            (Report::Pose(pose), None) => last = Some((time, pose)),
            (Report::Events(events), Some((count, pose))) => {
                answers.push((count, pose, time, events.slips));
            }
            other => panic!("{other:?}"),
        }
    }
    answers
}

fn comes_back<R: Real<Si = f32>>(evolution: Evolution) {
    let (totals, results) = done::<R, 8, 4, 0>(None, job_of(&SCENE, evolution)).unwrap();
    assert_eq!(totals.stack, 4321);
    let answers = answers(&results);
    assert_eq!(answers.len(), SAMPLES as usize);

    let solver = Solver::new(Scene::<R, 8, 4>::new(&SCENE).unwrap(), evolution);
    let (mut state, first) = solver.start(hand(0));
    for (i, answer) in (0..).zip(answers) {
        let output = match i {
            0 => first.clone(),
            _ => solver.step(&mut state, hand(i)),
        };
        let pose = Pose::new(&output, EventSet::of(output.events()), i as u8);
        assert_eq!(
            answer,
            (i + 1, pose, output.work, output.slips),
            "frame {i}"
        );
    }
}

stiction_tests::test_on_boards!(a_job_comes_back_with_the_answers_of_the_solver: comes_back);

#[test]
fn with_a_capacity_of_its_own_it_gives_the_same_answers() {
    let large = done::<f32, 8, 4, 9>(None, job_of(&SCENE, Evolution::Frame)).unwrap();
    let small =
        done::<f32, 4, 2, 0>(Some(Evolution::Frame), job_of(&SCENE, Evolution::Path)).unwrap();
    assert_eq!(answers(&large.1), answers(&small.1));
    assert!(small.0.solver < large.0.solver);
    let too_small = done::<f32, 3, 2, 0>(None, job_of(&SCENE, Evolution::Path));
    assert!(matches!(too_small, Err(Failure::Scene(_))));
}

#[test]
fn what_is_not_a_job_is_refused() {
    let good = job_of(&SCENE, Evolution::Path);
    let mut damaged = good.clone();
    damaged[9] ^= 1;
    let hand = bytes_of(Command::Hand(hand(0)));
    let scene = bytes_of(Command::Scene(SceneCommand::from(&SCENE)));
    for other in [
        damaged,
        Vec::new(),
        hand,
        scene.clone(),
        [scene.clone(), scene].concat(),
    ] {
        let failure = done::<f32, 8, 4, 0>(None, other).err();
        assert_eq!(failure, Some(Failure::Format));
    }
    let sunk = job_of(
        &with(SCENE, |scene| scene.start = [0.0; 3]),
        Evolution::Path,
    );
    assert!(matches!(
        done::<f32, 8, 4, 0>(None, sunk),
        Err(Failure::Scene(Parameter::Penetration { surface: 0, .. }))
    ));
}
