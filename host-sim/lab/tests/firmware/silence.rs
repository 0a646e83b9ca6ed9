//! From the last sample to zero force on the emulated boards, and the return of samples.

use crate::board::{AGAIN, Board};
use crate::chip::{AN505, Chip, F405, MICROBIT, PICO};
use std::sync::{Mutex, MutexGuard, PoisonError};
use stiction_core::{Hand, Wrench};
use stiction_tests::station::client::Said;
use stiction_wire::{Command, Drive, Mode, Pose};

/// One emulated line at a time: an emulator that another one keeps from its core loses bytes of the line.
pub(crate) fn alone() -> MutexGuard<'static, ()> {
    static LINE: Mutex<()> = Mutex::new(());
    LINE.lock().unwrap_or_else(PoisonError::into_inner)
}

pub(crate) const DEEP: [f32; 3] = [0.0, 0.045, 0.0];

pub(crate) fn deep() -> Hand<f32> {
    let [x, y, phi] = DEEP;
    Hand::new(x, y, phi)
}

/// The hand presses until the board gives force.
pub(crate) fn pressed(board: &mut Board) -> Pose {
    loop {
        board.send(Command::Hand(deep()));
        let pose = board.wait(|_, said| match said {
            Said::Pose(pose) => Some(*pose),
            _ => None,
        });
        if !pose.force_off && pose.held {
            return pose;
        }
    }
}

/// The last sample before silence, sent again where it is lost on the line: its number, and the tick in which it came (µs).
pub(crate) fn last_sample(board: &mut Board) -> (u8, u32) {
    for _ in 0..30 {
        board.send(Command::Hand(deep()));
        let last = board.last();
        let came = board.listen_for(AGAIN, |time, said| match said {
            Said::Pose(pose) if pose.sample == last => Some(time),
            _ => None,
        });
        if let Some(came_us) = came {
            return (last, came_us);
        }
    }
    panic!("no sample comes through");
}

/// From the tick of the last sample to that of the first pose without force (µs), and that pose. Between two samples before it, the
/// emulator's time may have gone on for long enough for silence, too.
pub(crate) fn fallen_silent(board: &mut Board, (last, came_us): (u8, u32)) -> (u32, Pose) {
    board.wait(|time, said| match said {
        Said::Pose(pose) if pose.sample == last && pose.force_off => {
            Some((time.wrapping_sub(came_us), *pose))
        }
        _ => None,
    })
}

/// From the last sample to zero force, on the clock of the board (µs); nothing where something is missing.
pub(crate) fn silence(chip: &'static Chip) -> Option<u32> {
    Some(silence_of(&mut Board::start(chip)?))
}

pub(crate) fn silence_of(board: &mut Board) -> u32 {
    let mode = board.info().mode;
    board.done(Command::Mode(Mode {
        forces_every: 10,
        ..mode
    }));
    for _ in 0..30 {
        pressed(board);
    }
    let last = last_sample(board);
    let (off_us, pose) = fallen_silent(board, last);
    let feedback = board.wait(|_, said| match said {
        Said::Forces { feedback, .. } => Some(*feedback),
        _ => None,
    });
    assert!(off_us <= 20_000);
    assert!(pose.held && pose.status == stiction_core::Status::HeldLast);
    assert_eq!(feedback, Wrench::default());
    assert_eq!(board.health().drive, Drive::Silent);
    // Samples return.
    assert_eq!(pressed(board).position, pose.position);
    off_us
}

#[test]
fn silence_is_zero_force_within_20_ms_on_every_board() {
    let _alone = alone();
    for chip in [&F405, &MICROBIT, &PICO, &AN505] {
        silence(chip);
    }
}
