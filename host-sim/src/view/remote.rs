//! The board that the engine follows: the pending request, and its health.

use std::collections::VecDeque;

use stiction_scene::Sample;

use super::change::{Reply, Wanted};
use super::orders::DeferrableOrder;
use crate::board::{Identity, LiveBoard, Word};
use stiction_live::outbound::Fares;

/// Periods of the engine per second.
const PERIODS: u32 = 1000;

/// Maximum number of requests that wait for the answer to a change.
const MOST_WAITING: usize = 64;

#[derive(Debug)]
pub(super) struct Remote {
    board: LiveBoard,
    /// A change that was requested from the board.
    asked: Option<(Wanted, Reply)>,
    /// Messages of clients meanwhile: they apply to the body after the change.
    waiting: VecDeque<(DeferrableOrder, Reply)>,
    pub(super) fares: Fares,
    /// Periods until the next sample: a board slower than the engine receives one with each of its ticks.
    left: u32,
}

impl Remote {
    /// Creates it for a board that has its scene.
    pub(super) const fn new(board: LiveBoard) -> Self {
        Self {
            board,
            asked: None,
            waiting: VecDeque::new(),
            fares: Fares {
                connected: true,
                ..Fares::NONE
            },
            left: 0,
        }
    }

    pub(super) const fn identity(&self) -> &Identity {
        &self.board.identity
    }

    pub(super) const fn is_busy(&self) -> bool {
        self.asked.is_some()
    }

    /// Returns whether another run is about to begin, which must not receive the hand of this one.
    pub(super) fn is_ending(&self) -> bool {
        self.asked
            .as_ref()
            .is_some_and(|(wanted, _)| wanted.change.is_run())
    }

    /// Requests a change; one at a time.
    pub(super) fn ask(&mut self, wanted: Wanted, reply: Reply) {
        let (change, setting) = (&wanted.change, wanted.change.setting());
        self.board
            .request(&setting.scene, setting.evolution, change.is_run());
        self.asked = Some((wanted, reply));
    }

    /// Takes the pending request, which is answered now.
    pub(super) fn answered(&mut self) -> Option<(Wanted, Reply)> {
        self.asked.take()
    }

    /// Keeps a request until the change is complete.
    pub(super) fn keep(&mut self, request: DeferrableOrder, reply: Reply) {
        if self.waiting.len() < MOST_WAITING {
            self.waiting.push_back((request, reply));
        } else {
            reply.send(Err("too much to do, allowed: to send it again".to_owned()));
        }
    }

    /// Returns a request that no longer has to wait.
    pub(super) fn waited(&mut self) -> Option<(DeferrableOrder, Reply)> {
        match self.asked {
            Some(_) => None,
            None => self.waiting.pop_front(),
        }
    }

    /// Returns the board's next message, if there is one.
    pub(super) fn hear(&self) -> Option<Word> {
        self.board.next()
    }

    /// Makes the next sample the first of a run.
    pub(super) const fn begin(&mut self) {
        self.left = 0;
    }

    /// Counts a period, and sends a sample if one is due.
    pub(super) fn send(&mut self, sample: Sample) {
        self.left = self.left.saturating_sub(1);
        if self.left == 0 && !self.is_ending() {
            self.left = PERIODS.div_ceil(u32::from(self.board.identity.tick_rate).max(1));
            self.board.send(sample);
        }
    }
}
