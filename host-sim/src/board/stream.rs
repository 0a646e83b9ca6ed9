//! Sends samples to the board in real time, and distributes its messages: frames for an audience, the counts, the comparison.

use std::time::{Duration, Instant};

use stiction_core::narrow_hand;
use stiction_scene::{Indices, Sample};
use stiction_wire::{Command, Reason};

use super::address::{Address, ConnectArgs};
use super::audience::Audience;
use super::counts::Counts;
use super::emulate::Image;
use super::error::BoardError;
use super::feed::Feed;
use super::link::News;
use super::message::{About, Received, Said};
use super::pending::{Pending, Sent};
use super::record::Recorder;
use super::refusal::explain;
use super::session::{Inbox, Session};
use super::setup::Setup;
use super::steps::{Step, Steps};
use super::verify::{Twin, Verdict};
use crate::stop;
use stiction_live::record::Names;

/// Maximum number of samples on their way to a board that makes a step with each: its queue holds them.
const WINDOW: usize = 4;
/// Maximum number of samples on their way to a board that uses the newest one: more would wait in the line, and arrive late.
const TIMED_WINDOW: usize = 32;
/// Maximum number of samples on their way if only the newest matters: a hand that waits in the line is an old one, which can be felt.
const LIVE_WINDOW: usize = 8;
/// Samples that are sent before received messages are processed: on a full line, each of them waits.
const BURST: usize = 2;
/// Messages that are processed before samples are sent: an emulator sends byte by byte.
const MOST_NEWS: usize = 256;
/// The type of a hand on the wire.
const HAND: u8 = 0x01;
/// The time in which what is on its way from a board arrives.
const PATIENCE: Duration = Duration::from_millis(400);
/// Interval of the checks of the progress line.
const BREATH: Duration = Duration::from_millis(50);

/// A stream from a feed to a board and back.
pub(super) struct Stream<'a, A> {
    pub(super) setup: Setup,
    pub(super) about: About,
    pub(super) address: Address,
    pub(super) inbox: Inbox,
    /// Zero of the client's clock.
    pub(super) begun: Instant,
    pub(super) timeout: Duration,
    pub(super) feed: Feed<'a>,
    pub(super) twin: Option<Box<dyn Twin>>,
    pub(super) audience: A,
    pub(super) counts: Counts,
    pub(super) verdict: Verdict,
    pub(super) pending: Pending,
    pub(super) steps: Steps,
    pub(super) recorder: Recorder,
    /// The indices of the board's obstacles in the scene file, if they differ.
    pub(super) indices: Option<Indices>,
    pub(super) tracker_gone: Option<BoardError>,
}

impl<'a, A: Audience> Stream<'a, A> {
    /// Connects, sends scene and mode. Returns the stream, and the session in which it begins.
    pub(super) fn connect(
        args: &ConnectArgs,
        setup: Setup,
        feed: Feed<'a>,
        mut audience: A,
    ) -> Result<(Self, Session), BoardError> {
        let (begun, timeout) = (Instant::now(), args.timeout());
        let image = match setup.scene.obstacles.is_empty() {
            true => Image::Plain,
            false => Image::Obstacles(setup.scene.source().text()),
        };
        let (mut address, mut inbox) = (args.address(image)?, Inbox::new());
        let (mut session, mut about) = Session::begin(&mut address, &mut inbox, timeout, begun)?;
        if let Some(remark) = setup.apply(&mut session, &mut about, &mut inbox)? {
            audience.note(&remark);
        }
        let indices = setup.indices(&about);
        let steps = Steps::of(&about.mode);
        let stream = Self {
            setup,
            indices,
            about,
            address,
            inbox,
            begun,
            timeout,
            feed,
            twin: None,
            audience,
            counts: Counts::default(),
            verdict: Verdict::default(),
            pending: Pending::default(),
            steps,
            recorder: Recorder::default(),
            tracker_gone: None,
        };
        Ok((stream, session))
    }

    /// Runs until the feed ends. Waits for a disconnected board, unless it is compared with the host.
    pub(super) fn run(&mut self, mut session: Session) -> Result<(), BoardError> {
        loop {
            self.counts.begin(session.health);
            match self.follow(&mut session) {
                Err(error) if error.may_pass() && self.twin.is_none() => {
                    session = self.come_back(error)?;
                }
                result => return result,
            }
        }
    }

    /// Runs as long as the board is connected.
    fn follow(&mut self, session: &mut Session) -> Result<(), BoardError> {
        self.number_anew(session)?;
        session.before_answer.clear();
        session.after_answer.clear();
        // Since when the board owes a message; if it makes a step with every sample, the answer to one.
        let mut owed: Option<Instant> = None;
        let faults = self.counts.faults;
        loop {
            if stop::asked() {
                self.feed.end();
            }
            let sent = self.send_due(session)?;
            if sent > 0 {
                owed = owed.or(Some(Instant::now()));
            }
            self.give_up_overdue()?;
            if self.feed.is_over() && self.pending.len() == 0 {
                return self.finish(session);
            }
            let mut until = self.wake();
            for _ in 0..MOST_NEWS {
                let Some(news) = self.inbox.next(until) else {
                    break;
                };
                if self.handle(session, news)? {
                    owed = None;
                }
                // Other messages that have already arrived.
                until = Instant::now();
            }
            if owed.is_some_and(|since| since.elapsed() > self.timeout) {
                return Err(session.silent(match self.setup.per_sample {
                    true => "answer to a sample",
                    false => "frame",
                }));
            }
            let dropped = std::mem::take(&mut self.inbox.dropped);
            self.counts.overtake(dropped);
            self.counts.faults = faults + u64::from(session.line.faults().total());
            self.audience.counts(&self.counts);
        }
    }

    /// An earlier pose may have the number that the first sample is about to get: a ping uses up that number.
    fn number_anew(&mut self, session: &mut Session) -> Result<(), BoardError> {
        if session.last_sample == Some(session.line.next_number()) {
            session.send(Command::Ping)?;
        }
        Ok(())
    }

    pub(super) fn push(&mut self, sample: Sample) {
        self.counts.overtake(self.feed.push(sample).into());
    }

    fn has_room(&self) -> bool {
        let window = match (self.setup.per_sample, self.feed.is_hasty()) {
            (true, _) => WINDOW,
            (false, true) => LIVE_WINDOW,
            (false, false) => TIMED_WINDOW,
        };
        self.pending.len() < window
    }

    /// The time to wake up, even if nothing arrives.
    fn wake(&mut self) -> Instant {
        let now = Instant::now();
        let mut wake = now + BREATH;
        if self.has_room()
            && let Some(due) = self.feed.next_due(now)
        {
            wake = wake.min(due);
        }
        wake
    }

    /// Sends the samples that are due. Returns their number.
    fn send_due(&mut self, session: &mut Session) -> Result<usize, BoardError> {
        let mut count = 0;
        while count < BURST && self.has_room() {
            let at = Instant::now();
            let Some(sample) = self.feed.take(at) else {
                break;
            };
            let hand = narrow_hand(&sample.hand);
            let sent = Sent {
                number: session.line.next_number(),
                index: self.counts.samples,
                sample,
                hand,
                at,
                expected: self.twin.as_mut().map(|twin| Box::new(twin.step(hand))),
            };
            self.counts.begun.get_or_insert(at);
            self.counts.samples += 1;
            let old = self.pending.add(sent);
            self.lose(old)?;
            session.send(Command::Hand(hand))?;
            count += 1;
        }
        Ok(count)
    }

    /// Processes a message; returns whether the board sent what it owes: a message, or, if it makes a step with every sample, an
    /// answer to one.
    fn handle(&mut self, session: &mut Session, news: News) -> Result<bool, BoardError> {
        match news {
            News::Sample(sample) => {
                self.push(sample);
                Ok(false)
            }
            News::NoTracker(error) => {
                self.end_tracker(error);
                Ok(false)
            }
            News::Request(request) => {
                self.grant(session, request)?;
                Ok(true)
            }
            News::Enough => {
                self.feed.end();
                Ok(false)
            }
            news => {
                let received = session.read(&mut self.inbox, news)?;
                let (any, poses) = (!received.is_empty(), self.counts.poses);
                for received in received {
                    self.take(session, received)?;
                }
                Ok(match self.setup.per_sample {
                    true => self.counts.poses > poses,
                    false => any,
                })
            }
        }
    }

    pub(super) fn take(
        &mut self,
        session: &mut Session,
        received: Received,
    ) -> Result<(), BoardError> {
        match &received.said {
            Said::Health(health) => self.counts.note(*health),
            Said::Pose(_) | Said::Forces(_) | Said::Events(_) => {
                for step in self.steps.add(received) {
                    self.answer(&step)?;
                }
                return Ok(());
            }
            // A board that measures the hand itself (FRAME 4.8).
            Said::Answer(answer)
                if answer.command.code == HAND && answer.reason != Reason::Done =>
            {
                return Err(BoardError::Refused(explain(
                    "hand",
                    answer,
                    &Names::default(),
                )));
            }
            Said::Answer(_) | Said::About(_) | Said::Pong | Said::Knob(_) => {}
        }
        session.note(&received.said);
        Ok(())
    }

    fn answer(&mut self, step: &Step) -> Result<(), BoardError> {
        let Some((sent, overtaken)) = self.pending.answer(&step.pose) else {
            // A step without a new sample: its events are reported with the next one.
            self.steps.keep(step.events.clone());
            return Ok(());
        };
        self.lose(overtaken)?;
        self.counts.poses += 1;
        let latency = step.at.saturating_duration_since(sent.at);
        self.counts.latency.add(latency);
        if let Some(expected) = &sent.expected {
            self.verdict.add(sent.index, sent.sample.t, step, expected);
        }
        let frame = self.recorder.frame(&sent, step, self.indices.as_ref());
        self.counts.incomplete += u64::from(frame.is_none());
        self.audience.frame(&sent.sample, frame, latency)
    }

    pub(super) fn lose(&mut self, lost: Vec<Sent>) -> Result<(), BoardError> {
        self.counts.unanswered += lost.len() as u64;
        for sent in lost {
            if let Some(expected) = &sent.expected {
                self.verdict.lose(sent.index, sent.sample.t, expected);
            }
            self.audience.lost(&sent.sample)?;
        }
        Ok(())
    }

    fn give_up_overdue(&mut self) -> Result<(), BoardError> {
        let now = Instant::now();
        // Forces follow their pose; after the last sample nothing comes that says that there are none.
        let is_late = |at| now.duration_since(at) > PATIENCE;
        if self.feed.is_over() && self.steps.last_pose_at().is_some_and(is_late) {
            self.answer_rest()?;
        }
        if self
            .pending
            .overdue(self.timeout)
            .is_some_and(|end| now > end)
        {
            let lost = self.pending.give_up();
            self.lose(lost)?;
        }
        Ok(())
    }

    /// Nothing more of the steps arrives.
    fn answer_rest(&mut self) -> Result<(), BoardError> {
        for step in self.steps.flush() {
            self.answer(&step)?;
        }
        Ok(())
    }

    /// Receives what is still on its way, and the last report of the board.
    fn finish(&mut self, session: &mut Session) -> Result<(), BoardError> {
        self.answer_rest()?;
        if session.health.is_some()
            && let Some(health) = session.wait_for_health(&mut self.inbox, PATIENCE)?
        {
            self.counts.note(health);
        }
        self.counts.end();
        self.tracker_gone.take().map_or(Ok(()), Err)
    }

    /// Waits for what is still on its way, then ends.
    pub(super) fn end_tracker(&mut self, error: BoardError) {
        self.feed.close();
        self.tracker_gone = Some(error);
    }
}
