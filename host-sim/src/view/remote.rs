//! The board that the engine follows: what was asked of it and has no answer yet, and how it fares.

use std::collections::VecDeque;

use super::change::{Change, Reply};
use crate::board::{Fares, Identity, LiveBoard, Word};
use crate::hand_path::Sample;

/// Periods of the engine in a second.
const PERIODS: u32 = 1000;

/// A board, with what it owes.
#[derive(Debug)]
pub(super) struct Remote {
    board: LiveBoard,
    asked: VecDeque<(Change, Reply)>,
    pub(super) fares: Fares,
    /// Periods until the next sample: a board slower than the engine gets one with each of its ticks.
    left: u32,
}

impl Remote {
    /// A board that has its scene.
    pub(super) const fn new(board: LiveBoard) -> Self {
        Self {
            board,
            asked: VecDeque::new(),
            fares: Fares {
                connected: true,
                ..Fares::NONE
            },
            left: 0,
        }
    }

    /// Who it is.
    pub(super) const fn identity(&self) -> &Identity {
        &self.board.identity
    }

    /// Asks for a change.
    pub(super) fn ask(&mut self, change: Change, reply: Reply) {
        let setting = change.setting();
        self.board
            .wish(&setting.scene, setting.evolution, change.is_run());
        self.asked.push_back((change, reply));
    }

    /// What it was asked first.
    pub(super) fn answered(&mut self) -> Option<(Change, Reply)> {
        self.asked.pop_front()
    }

    /// What it said, if it said something.
    pub(super) fn hear(&self) -> Option<Word> {
        self.board.hear()
    }

    /// A period passes: a sample, where one is due. None while another run is to begin, which must not see this one's hand.
    pub(super) fn send(&mut self, sample: Sample) {
        self.left = self.left.saturating_sub(1);
        let is_ending = self.asked.iter().any(|(change, _)| change.is_run());
        if self.left == 0 && !is_ending {
            self.left = PERIODS / u32::from(self.board.identity.tick_rate).max(1);
            self.board.send(sample);
        }
    }
}
