//! In the place of the Pico 2: random drags with a sample for each of 5 000 ticks a second.

use crate::board::Board;
use crate::budgets::{Budget, follow};
use crate::chip::AN505;
use crate::drags;
use stiction_core::narrow_hand;
use stiction_tests::station::client::hand_path;
use stiction_wire::{Command, Mode, SceneCommand, Stepping};

/// Ticks and samples of a second: the most that the board takes.
const RATE: u16 = 5_000;
/// A path is left after so many frames, for another scene: 1 s.
const LONGEST: usize = RATE as usize;

/// What random drags come to.
struct Drags {
    frames: u32,
    missed: u32,
    late: u32,
    /// The longest tick (instructions).
    tick: u32,
    /// The longest step (instructions).
    step: u32,
    /// The longest turn, those with the command of a scene among them (instructions).
    turn: u32,
}

/// The board from power-up, with its fastest tick; nothing where something is missing.
fn at_its_fastest() -> Option<Board> {
    let mut board = Board::start(&AN505)?;
    let own = board.info().mode;
    board.done(Command::Mode(Mode {
        tick_rate: RATE,
        stepping: Stepping::PerSample,
        events: false,
        health_every: 100,
        ..own
    }));
    board.settle();
    Some(board)
}

#[test]
fn the_hand_path_at_the_fastest_tick_is_within_the_budget() {
    const SAMPLES: u32 = 3_000;
    let Some(mut board) = at_its_fastest() else {
        return;
    };
    let before = board.health();
    follow(&mut board, hand_path(SAMPLES));
    board.settle();
    let after = board.health();
    assert_eq!((after.samples, after.lost_frames), (SAMPLES, 0));
    println!("before: {}", board.instructions(before.worst_tick));
    let turn = board.instructions(after.worst_tick);
    let budget = Budget::of(&AN505);
    budget.holds("fastest_turn", turn.into());
    let missed = after.missed_ticks - before.missed_ticks;
    budget.holds("missed", missed.into());
    println!("the longest step: {}", board.instructions(after.worst_step));
}

/// Random drags, so many frames at least; nothing where something is missing.
fn random_drags(frames: u32) -> Option<Drags> {
    let mut board = at_its_fastest()?;
    let mut drags = Drags {
        frames: 0,
        missed: 0,
        late: 0,
        tick: 0,
        step: 0,
        turn: 0,
    };
    for case in drags::random() {
        case.scene
            .described::<f32, _>(|scene| board.done(Command::Scene(SceneCommand::from(scene))));
        board.settle();
        let before = board.health();
        let path = case.path.frames(Some(RATE.into())).take(LONGEST);
        let hands: Vec<_> = path.map(|sample| narrow_hand(&sample.hand)).collect();
        drags.frames += hands.len() as u32;
        follow(&mut board, hands);
        board.settle();
        let after = board.health();
        assert_eq!((after.samples, after.lost_frames), (drags.frames, 0));
        drags.missed += after.missed_ticks - before.missed_ticks;
        drags.late += after.late_samples - before.late_samples;
        drags.step = board.instructions(after.worst_step);
        drags.turn = board.instructions(after.worst_tick);
        if drags.frames >= frames {
            break;
        }
    }
    drags.tick = board.longest_tick();
    println!(
        "{} frames: {} ticks missed, {} samples late; the longest tick {} instructions, the longest step {}, the longest turn {}",
        drags.frames, drags.missed, drags.late, drags.tick, drags.step, drags.turn
    );
    Some(drags)
}

#[test]
fn random_drags_in_the_place_of_the_pico_2_are_within_the_budget() {
    let Some(drags) = random_drags(10_000) else {
        return;
    };
    let budget = Budget::of(&AN505);
    budget.holds("drags_missed", drags.missed.into());
    budget.holds("drags_late", drags.late.into());
    budget.holds("drags_tick", drags.tick.into());
    budget.holds("drags_step", drags.step.into());
}

#[test]
#[ignore = "takes minutes"]
fn no_tick_is_missed_in_100_000_frames_of_random_drags() {
    let missed = random_drags(100_000).map(|drags| drags.missed);
    assert!(matches!(missed, None | Some(0)), "{missed:?}");
}
