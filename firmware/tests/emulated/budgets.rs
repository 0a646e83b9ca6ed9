//! What the images take: flash, RAM, stack, instructions, within the budgets of `firmware/budgets.toml`.

use crate::board::Board;
use crate::chip::{Chip, F405, MICROBIT};
use crate::client::{BOX, Said, hand_path, scene};
use std::fs;
use std::path::Path;
use stiction_core::Hand;
use stiction_core::frame::{Command, Health, Mode, Parameters, Reset, Stepping};
use toml::Table;

/// Samples that are sent before the pose of the last of them is waited for.
const WINDOW: usize = 4;

/// Of a board: its part of the file.
pub(crate) struct Budget(Table);

impl Budget {
    pub(crate) fn of(chip: &Chip) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("budgets.toml");
        let text = fs::read_to_string(path).unwrap();
        let all: Table = text.parse().unwrap();
        Self(all[chip.name].as_table().unwrap().clone())
    }

    /// The figure is within its budget.
    pub(crate) fn holds(&self, what: &str, figure: u64) {
        let most = u64::try_from(self.0[what].as_integer().unwrap()).unwrap();
        println!("{what}: {figure} of {most}");
        assert!(figure <= most, "{what}: {figure} of {most}");
    }
}

/// The health after all that came before, in a mode that has it told.
fn health_in(board: &mut Board, mode: Mode) -> Health {
    board.done(Command::Mode(Mode {
        health_every: 50,
        pose_every: 0,
        ..mode
    }));
    board.health();
    board.health()
}

/// Samples of the hand, no more of them on their way than the queue of a board holds.
fn follow(board: &mut Board, hands: impl IntoIterator<Item = Hand<f32>>) {
    for (i, hand) in hands.into_iter().enumerate() {
        board.send(Command::Hand(hand));
        if i % WINDOW == WINDOW - 1 {
            let last = board.client.sequence.wrapping_sub(1);
            board.wait(|_, said| match said {
                Said::Pose(pose) if pose.sample == last => Some(()),
                _ => None,
            });
        }
    }
}

/// The hand along its path with everything told.
fn path(board: &mut Board) -> Health {
    let mode = Mode {
        stepping: Stepping::PerSample,
        health_every: 0,
        forces_every: 10,
        ..board.info().mode
    };
    board.done(Command::Mode(mode));
    follow(board, hand_path(3_000));
    let health = health_in(board, mode);
    assert_eq!((health.samples, health.lost_frames), (3_000, 0));
    health
}

/// Every command in mid-contact; the longest tick (instructions).
fn commands(board: &mut Board) -> u32 {
    board.done(Command::Reset(Reset::Everything));
    let mode = board.info().mode;
    follow(board, hand_path(3_000).into_iter().take(600));
    for (k_h, mu_s) in [(400.0, 0.8), (700.0, 0.4), (500.0, 0.5)] {
        board.done(Command::Parameters(Parameters {
            stiffness_translation: k_h,
            stiffness_rotation: 0.5,
            friction_static: mu_s,
            friction_dynamic: 0.3,
        }));
    }
    board.done(scene(&BOX));
    board.done(Command::Reset(Reset::Body));
    let health = health_in(board, mode);
    board.instructions(health.worst_tick)
}

fn within_budget(chip: &'static Chip) {
    let Some(image) = chip.image() else { return };
    let budget = Budget::of(chip);
    assert_eq!(image.panics(), [""; 0]);
    budget.holds("flash", image.flash);
    budget.holds("variables", image.variables);
    let Some(mut board) = Board::start(chip) else {
        return;
    };
    let health = path(&mut board);
    println!("step: {}", board.instructions(health.worst_step));
    budget.holds("tick", u64::from(board.instructions(health.worst_tick)));
    budget.holds("missed", u64::from(health.missed_ticks));
    let commands = commands(&mut board);
    budget.holds("command", u64::from(commands));
    board.done(Command::Reset(Reset::Everything));
    let stack = u64::try_from(board.stack()).unwrap();
    budget.holds("stack", stack);
    println!("RAM: {}", stack + image.variables);
}

#[test]
fn the_f405_is_within_its_budget() {
    within_budget(&F405);
}

#[test]
fn the_microbit_is_within_its_budget() {
    within_budget(&MICROBIT);
}
