//! Every pose of an emulated board has the bits that the solver computes here, each board against its own number type.

use crate::board::Board;
use crate::chip::{AN505, Chip, F405, MICROBIT, PICO};
use stiction_core::{Evolution, Fixed, Real};
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::{Said, hand_path};
use stiction_wire::{Command, Mode, NumberType, Pose, Reset, Stepping};

pub(crate) const SAMPLES: u32 = 3_000;
/// Samples sent before their answers have come.
const WINDOW: usize = 5;

/// The poses of a board along a path, a step with every sample.
fn poses(board: &mut Board, samples: u32) -> Vec<Pose> {
    let mut poses = Vec::new();
    for (sent, hand) in hand_path(samples).into_iter().enumerate() {
        board.send(Command::Hand(hand));
        while sent >= poses.len() + WINDOW {
            poses.push(next_pose(board));
        }
    }
    while poses.len() < samples as usize {
        poses.push(next_pose(board));
    }
    poses
}

fn next_pose(board: &mut Board) -> Pose {
    board.wait(|_, said| match said {
        Said::Pose(pose) if pose.status != stiction_core::Status::HeldLast => Some(*pose),
        _ => None,
    })
}

/// As it works after power-up, and in the other evolution: so many poses have the bits in each; nothing
/// where something is missing.
pub(crate) fn same_bits<R: Real<Si = f32>>(
    chip: &'static Chip,
    number: NumberType,
    samples: u32,
) -> Option<()> {
    let mut board = Board::start(chip)?;
    same_bits_of::<R>(&mut board, number, samples);
    Some(())
}

/// The poses of a board that runs, in both evolutions.
pub(crate) fn same_bits_of<R: Real<Si = f32>>(board: &mut Board, number: NumberType, samples: u32) {
    let info = board.info();
    assert_eq!(info.number, number);
    let own = Mode {
        stepping: Stepping::PerSample,
        health_every: 0,
        events: false,
        ..info.mode
    };
    let other = Mode {
        evolution: match own.evolution {
            Evolution::Path => Evolution::Frame,
            Evolution::Frame => Evolution::Path,
        },
        ..own
    };
    for mode in [own, other] {
        board.done(Command::Reset(Reset::Body));
        board.done(Command::Mode(mode));
        let mut beside = Beside::<R>::new(&mode);
        beside.solver = beside.solver.with_budget(info.budget);
        let poses = poses(board, samples);
        for (i, (pose, hand)) in poses.iter().zip(hand_path(samples)).enumerate() {
            assert_same(pose, &beside.step(hand), &format!("{} {i}", info.name));
        }
        assert_eq!(poses.len(), samples as usize);
    }
}

fn same_bits_of_all(samples: u32) {
    same_bits::<f32>(&F405, NumberType::F32, samples);
    same_bits::<Fixed>(&MICROBIT, NumberType::Fixed, samples);
    same_bits::<Fixed>(&PICO, NumberType::Fixed, samples);
    same_bits::<f32>(&AN505, NumberType::F32, samples);
}

#[test]
fn poses_of_every_board_are_those_of_its_number_type() {
    same_bits_of_all(SAMPLES);
}

#[test]
#[ignore = "takes minutes"]
fn many_poses_of_every_board_are_those_of_its_number_type() {
    same_bits_of_all(100_000);
}
