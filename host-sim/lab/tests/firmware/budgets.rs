//! What the images take: flash, RAM, stack, instructions, within the budgets of `firmware/budgets.toml`.

use crate::board::Board;
use crate::chip::{AN505, Chip, F405, MICROBIT, PICO};
use std::fs;
use stiction_core::Hand;
use stiction_host_sim::firmware::workspace;
use stiction_tests::station::BOX;
use stiction_tests::station::client::{Said, hand_path, scene};
use stiction_wire::{Command, Health, Info, Mode, Parameters, Reset, Stepping};
use toml::Table;

/// Samples that are sent before the pose of the last of them is waited for.
const WINDOW: usize = 4;

/// Of a board: its part of the file.
pub(crate) struct Budget(Table);

impl Budget {
    pub(crate) fn of(chip: &Chip) -> Self {
        Self::named(chip.name())
    }

    fn named(name: &str) -> Self {
        let path = workspace().join("firmware/budgets.toml");
        let text = fs::read_to_string(path).unwrap();
        let all: Table = text.parse().unwrap();
        Self(all[name].as_table().unwrap().clone())
    }

    /// The figure is within its budget.
    pub(crate) fn holds(&self, what: &str, figure: u64) {
        let most = u64::try_from(self.0[what].as_integer().unwrap()).unwrap();
        println!("{what}: {figure} of {most}");
        assert!(figure <= most, "{what}: {figure} of {most}");
    }
}

/// The health after all earlier samples, in a mode that reports it.
fn health_in(board: &mut Board, mode: Mode) -> Health {
    board.done(Command::Mode(Mode {
        health_every: 50,
        pose_every: 0,
        ..mode
    }));
    board.health();
    board.health()
}

/// Samples of the hand; no more of them are unanswered than the queue of a board holds.
pub(crate) fn follow(board: &mut Board, hands: impl IntoIterator<Item = Hand<f32>>) {
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

/// The hand along its path, with everything reported.
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

/// Every command in mid-contact; the longest turn (instructions).
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
            memory: None,
        }));
    }
    board.done(scene(&BOX));
    board.done(Command::Reset(Reset::Body));
    let health = health_in(board, mode);
    board.instructions(health.worst_tick)
}

/// What an image takes: bytes and instructions.
pub(crate) struct Taken {
    pub(crate) about: Info<'static>,
    pub(crate) flash: u64,
    pub(crate) variables: u64,
    pub(crate) stack: u64,
    /// The longest tick, the longest step, the longest turn, the longest turn with a command.
    pub(crate) tick: u32,
    pub(crate) step: u32,
    pub(crate) turn: u32,
    pub(crate) command: u32,
    /// Ticks along the path of the hand.
    pub(crate) missed: u32,
}

/// Measures an image; nothing where something is missing.
pub(crate) fn measure(chip: &'static Chip) -> Option<Taken> {
    let mut board = Board::start(chip)?;
    let about = board.info();
    let health = path(&mut board);
    let tick = board.longest_tick();
    let command = commands(&mut board);
    board.done(Command::Reset(Reset::Everything));
    Some(Taken {
        about,
        flash: board.image.contents.flash,
        variables: board.image.contents.variables,
        stack: u64::try_from(board.stack()).unwrap(),
        tick,
        step: board.instructions(health.worst_step),
        turn: board.instructions(health.worst_tick),
        command,
        missed: health.missed_ticks,
    })
}

/// Nothing panics in it, and it is within its budget.
fn within_budget(chip: &'static Chip) {
    let Some(image) = chip.image() else { return };
    assert_eq!(image.contents.panics(), [""; 0]);
    figures_within_budget(chip);
}

fn figures_within_budget(chip: &'static Chip) {
    let Some(taken) = measure(chip) else { return };
    println!("{}: step: {}", taken.about.name, taken.step);
    let budget = Budget::of(chip);
    budget.holds("flash", taken.flash);
    budget.holds("variables", taken.variables);
    budget.holds("tick", u64::from(taken.tick));
    budget.holds("turn", u64::from(taken.turn));
    budget.holds("missed", u64::from(taken.missed));
    budget.holds("command", u64::from(taken.command));
    budget.holds("stack", taken.stack);
}

#[test]
fn every_board_is_within_its_budget() {
    for chip in [&F405, &MICROBIT, &AN505] {
        within_budget(chip);
    }
    // What serves USB has places where it panics: `pico` shows what happens then.
    figures_within_budget(&PICO);
}
