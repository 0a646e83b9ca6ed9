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

/// The board answers the sample with this number, or says so much else that the sample must be lost. One sample is on the line at a time: the
/// client of a busy machine, which finds many poses at once, would otherwise send as many samples, more than a line brings in that time.
pub(crate) fn answered(last: u8) -> impl FnMut(&Pose) -> bool {
    /// Within so many poses an answer comes.
    const LOST_AFTER: u32 = 50;
    let mut poses = 0;
    move |pose| {
        poses += 1;
        pose.sample == last || poses > LOST_AFTER
    }
}

/// The hand presses until the board gives force.
pub(crate) fn pressed(board: &mut Board) -> Pose {
    loop {
        board.send(Command::Hand(deep()));
        let mut is_answer = answered(board.last());
        let pose = board.wait(|_, said| match said {
            Said::Pose(pose) => is_answer(pose).then_some(*pose),
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

/// From the tick of the last sample to that of the first pose without force (µs), and that pose. No pose with force is from later than
/// 20 ms after the sample; the first one without may be lost where nobody reads the line for some time, so it proves nothing. Between two
/// samples before the last, the emulator's time may have gone on for long enough for silence, too.
pub(crate) fn fallen_silent(board: &mut Board, (last, came_us): (u8, u32)) -> (u32, Pose) {
    board.wait(|time, said| match said {
        Said::Pose(pose) if pose.sample == last => {
            let passed_us = time.wrapping_sub(came_us);
            assert!(pose.force_off || passed_us <= 20_000, "{passed_us} us");
            pose.force_off.then_some((passed_us, *pose))
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
