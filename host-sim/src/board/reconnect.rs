//! Searches for a disconnected board, and begins again with it.

use std::thread;
use std::time::{Duration, Instant};

use super::audience::Audience;
use super::error::BoardError;
use super::link::News;
use super::session::Session;
use super::steps::Steps;
use super::stream::Stream;
use crate::stop;

/// Interval of the search for a disconnected board.
const RETRY: Duration = Duration::from_secs(1);
/// Interval of the checks for Ctrl-C meanwhile.
const BREATH: Duration = Duration::from_millis(50);

impl<A: Audience> Stream<'_, A> {
    /// Searches for a disconnected board; samples due meanwhile are lost.
    pub(super) fn come_back(&mut self, error: BoardError) -> Result<Session, BoardError> {
        self.audience
            .note(&format!("{error}; looking for the board once a second"));
        self.audience.gone();
        let lost = self.pending.give_up();
        self.lose(lost)?;
        loop {
            let next = Instant::now() + RETRY;
            match self.begin_again() {
                Ok(session) => {
                    self.skip_missed();
                    self.audience.note("the board is back");
                    self.audience.back();
                    return Ok(session);
                }
                Err(error) if error.may_pass() => {}
                Err(error) => return Err(error),
            }
            while Instant::now() < next && !stop::asked() {
                thread::sleep(BREATH);
            }
            self.skip_missed();
            if stop::asked() || self.feed.is_over() {
                self.counts.end();
                return Err(error);
            }
        }
    }

    fn begin_again(&mut self) -> Result<Session, BoardError> {
        let Self {
            address,
            inbox,
            begun,
            timeout,
            setup,
            ..
        } = self;
        let (mut session, mut about) = Session::begin(address, inbox, *timeout, *begun)?;
        setup.apply(&mut session, &mut about, inbox)?;
        self.steps = Steps::of(&about.mode);
        self.about = about;
        Ok(session)
    }

    /// Skips the samples that were due while there was no board.
    fn skip_missed(&mut self) {
        let now = Instant::now();
        let mut of_lines = Vec::new();
        while let Some(news) = self.inbox.next(now) {
            match news {
                News::Sample(sample) => self.push(sample),
                News::NoTracker(error) => self.end_tracker(error),
                News::Enough => self.feed.end(),
                News::Request(_) => {
                    let refusal = "the board is not connected, allowed: when it is back";
                    // Not a reason to end.
                    let _ = self
                        .audience
                        .answer(Err(BoardError::Refused(refusal.to_owned())));
                }
                news => of_lines.push(news),
            }
        }
        self.inbox.keep(of_lines);
        while self.feed.take(now).is_some() {
            self.counts.samples += 1;
            self.counts.unanswered += 1;
        }
    }
}
