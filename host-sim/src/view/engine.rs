//! The solver in real time: a tick every millisecond at absolute times, orders in between, what is new to the feed. Where a
//! board has the solver, it gets the hand, and what it answers is shown. The engine waits for the clock and for nothing else.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Number as JsonNumber;
use tokio::sync::mpsc::Receiver;

use super::body::Setting;
use super::change::Reply;
use super::counts::StepTimes;
use super::feed::{Feed, Latest, Pending};
use super::guide::{Guide, HandPose};
use super::holder::Holder;
use super::orders::Order;
use super::pair::Pair;
use super::recording::{self, Recording};
use super::remote::Remote;
use super::replay::{Replay, Way};
use super::say::{self, By, Recorded, Replayed, Status};
use super::stage::Stage;
use crate::board::Word;
use crate::hand_path::Sample;
use crate::record::Frame;

/// From one tick to the next.
const PERIOD: Duration = Duration::from_millis(1);
/// Whoever is later than this does not catch up.
const PATIENCE: Duration = Duration::from_millis(100);
/// Time in a tick for a seek.
const SEEKING: Duration = Duration::from_micros(500);
/// Time between two ticks for orders.
const ORDERING: Duration = Duration::from_micros(500);
/// Others get so much time, however late a tick is.
const BREATH: Duration = Duration::from_micros(50);
/// A board answers the last sample of a recording within this, or not at all.
const LAST_ANSWER: Duration = Duration::from_millis(500);
/// Samples that a board has not answered.
const MOST_MOVED: usize = 64;
/// While it records, the state tells so every so many ticks.
const RECORDING_EVERY: usize = 100;

/// A client, and what it sent with a sample.
type Echo = (u32, JsonNumber);

/// The solver with its hand.
pub(super) struct Engine {
    pub(super) feed: Arc<Feed>,
    pub(super) pending: Pending,
    pub(super) stage: Stage,
    pub(super) pair: Pair,
    /// The board, where one has the solver.
    pub(super) board: Option<Remote>,
    /// The hand of the newest tick.
    sample: Sample,
    pub(super) times: StepTimes,
    pub(super) guide: Guide,
    pub(super) holder: Holder,
    pub(super) replay: Option<Replay>,
    pub(super) recording: Option<Recording>,
    pub(super) recorded: Option<Arc<Recording>>,
    /// A path that was sent, and its name.
    pub(super) upload: Option<(String, Way)>,
    /// The scene of the command line, where it is a file.
    pub(super) own: Option<Stage>,
    pub(super) tick: u64,
    pub(super) paused: bool,
    /// Ticks that are still to be made while paused.
    pub(super) steps: u32,
    pub(super) speed: f64,
    /// Parts of a tick that have passed.
    phase: f64,
    pub(super) clients: usize,
    /// What a client sent with the newest sample, before and after the hand moved on it, with the time of that tick; a board
    /// has not answered these yet.
    pub(super) coming: Option<Echo>,
    moved: VecDeque<(Echo, f64)>,
    echo: Option<Echo>,
    /// A recording of a board that waits for the answer to its last sample, not longer than this.
    closing: Option<(Recording, Instant)>,
    /// The state is another one.
    pub(super) changed: bool,
    /// Answers that wait until what they are about is shown.
    pub(super) answers: Vec<(Reply, Result<(), String>)>,
}

impl Engine {
    /// With a scene, the body at its start.
    ///
    /// # Errors
    /// The scene cannot be used.
    pub(super) fn new(stage: Stage, setting: &Setting, feed: Arc<Feed>) -> Result<Self, String> {
        let pair = Pair::start(setting, 0.0, &stage.home)?;
        let mut engine = Self {
            feed,
            pending: Pending::default(),
            guide: Guide::at(HandPose::of(&stage.home)),
            sample: Sample {
                t: 0.0,
                hand: stage.home,
            },
            stage,
            pair,
            board: None,
            times: StepTimes::default(),
            holder: Holder::default(),
            replay: None,
            recording: None,
            recorded: None,
            upload: None,
            own: None,
            tick: 0,
            paused: false,
            steps: 0,
            speed: 1.0,
            phase: 0.0,
            clients: 0,
            coming: None,
            moved: VecDeque::new(),
            echo: None,
            closing: None,
            changed: true,
            answers: Vec::new(),
        };
        engine.pending.record(&engine.pair.frame);
        engine.publish();
        Ok(engine)
    }

    /// Until `stop`.
    ///
    /// # Errors
    /// The board will not come back.
    pub(super) fn run(
        mut self,
        mut orders: Receiver<Order>,
        stop: &AtomicBool,
    ) -> Result<(), String> {
        let mut due = Instant::now();
        while !stop.load(Ordering::Relaxed) {
            let now = Instant::now();
            due = self.late(due, now);
            while now.elapsed() < ORDERING
                && let Ok(order) = orders.try_recv()
            {
                self.obey(order, now);
            }
            self.changed |= self.holder.expire(now);
            self.listen(now)?;
            if let Some(board) = &mut self.board {
                board.send(self.sample);
            }
            self.pass();
            self.publish();
            due += PERIOD;
            thread::sleep(due.saturating_duration_since(Instant::now()).max(BREATH));
        }
        Ok(())
    }

    /// Counts a tick that begins more than a period late. When it was due; where that is too long ago, now.
    fn late(&mut self, due: Instant, now: Instant) -> Instant {
        let late = now.saturating_duration_since(due);
        let (skips, missed) = match late {
            late if late > PATIENCE => (true, late.as_millis() as u64),
            late => (false, u64::from(late > PERIOD)),
        };
        if self.moves() {
            self.pair.counts.missed += missed;
        }
        if skips { now } else { due }
    }

    /// Ticks are made.
    fn moves(&self) -> bool {
        let ended = self.replay.as_ref().is_some_and(Replay::is_over);
        !self.paused && !ended
    }

    /// What the board said.
    fn listen(&mut self, now: Instant) -> Result<(), String> {
        while let Some(word) = self.board.as_ref().and_then(Remote::hear) {
            match word {
                Word::Frame(frame) => self.answered(*frame),
                Word::Answer(result) => {
                    if let Some((change, reply)) = self.board.as_mut().and_then(Remote::answered) {
                        let result = result.and_then(|()| self.apply(change));
                        self.answers.push((reply, result));
                    }
                    while let Some((client, message, reply)) =
                        self.board.as_mut().and_then(Remote::waited)
                    {
                        self.take(client, message, reply, now);
                    }
                }
                // What it is told anew is what it was told before: there is nothing to refuse.
                Word::Back => self.apply(self.anew())?,
                Word::Fares(fares) => {
                    if let Some(board) = &mut self.board {
                        board.fares = fares;
                    }
                    self.pending.touch();
                }
                Word::End(why) => return Err(why),
            }
        }
        if self.closing.as_ref().is_some_and(|(_, until)| now > *until) {
            self.end_recording();
        }
        Ok(())
    }

    fn answered(&mut self, frame: Frame) {
        let closing = self.closing.as_mut().map(|(recording, _)| recording);
        if let Some(recording) = self.recording.as_mut().or(closing) {
            recording.hear(&frame);
        }
        if let Some((recording, _)) = &self.closing
            && frame.t >= recording.seconds()
        {
            self.end_recording();
        }
        while let Some((_, t)) = self.moved.front()
            && *t <= frame.t
        {
            self.echo = self.moved.pop_front().map(|(echo, _)| echo);
        }
        self.pair.answered(frame);
        self.pending.record(&self.pair.frame);
    }

    /// A period passes.
    fn pass(&mut self) {
        if self.board.as_ref().is_some_and(Remote::is_ending) {
            // What the hand does now, nobody follows.
        } else if self.replay.as_ref().is_some_and(Replay::is_seeking) {
            self.approach();
        } else if self.steps > 0 {
            // As many as there is time for.
            let begun = Instant::now();
            while self.steps > 0 && begun.elapsed() < SEEKING {
                self.steps -= 1;
                self.advance();
                if self.board.is_some() {
                    // It gets every sample.
                    break;
                }
            }
        } else if !self.paused {
            self.phase += self.speed;
            if self.phase >= 1.0 {
                self.phase -= 1.0;
                self.advance();
            }
        }
    }

    fn approach(&mut self) {
        let begun = Instant::now();
        if let Some(replay) = &mut self.replay {
            while replay.is_seeking() && begun.elapsed() < SEEKING {
                replay.approach(&mut self.pair, &mut self.times);
                self.pending.record(&self.pair.frame);
            }
            self.tick = replay.at as u64;
        }
    }

    /// One tick. A board hears of it.
    fn advance(&mut self) {
        if let Some(replay) = &mut self.replay {
            let is_board = self.board.is_some();
            let sample = match is_board {
                true => replay.next(),
                false => replay.advance(&mut self.pair, &mut self.times),
            };
            let Some(sample) = sample else { return };
            (self.sample, self.tick) = (sample, replay.at as u64);
            if !is_board {
                self.pending.record(&self.pair.frame);
            }
            return;
        }
        let mut hand = self.guide.next();
        if self.recording.is_some() {
            // The file of a planar hand has no depth.
            hand.depth = 0.0;
        }
        self.tick += 1;
        self.sample = Sample {
            t: self.tick as f64 / 1000.0,
            hand: hand.hand(),
        };
        self.say_moved();
        if self.board.is_none() {
            let Sample { t, hand } = self.sample;
            self.pair.step(t, &hand, &mut self.times);
            self.pending.record(&self.pair.frame);
        }
        if let Some(recording) = &mut self.recording {
            recording.add(hand);
            let count = recording.len();
            self.changed |= count.is_multiple_of(RECORDING_EVERY);
            if count > recording::LONGEST {
                self.close_recording(Instant::now());
            }
        }
    }

    /// The hand has moved on the newest sample: a frame shows it at once, or when the board has answered.
    fn say_moved(&mut self) {
        let Some(echo) = self.coming.take() else {
            return;
        };
        if self.board.is_none() {
            self.echo = Some(echo);
        } else if self.moved.len() < MOST_MOVED {
            self.moved.push_back((echo, self.sample.t));
        }
    }

    /// No more ticks are recorded; of a board, what it answers to the last one still is.
    pub(super) fn close_recording(&mut self, now: Instant) {
        match self.recording.take() {
            Some(recording) if self.board.is_some() => {
                self.closing = Some((recording, now + LAST_ANSWER));
                self.changed = true;
            }
            recording => {
                self.recording = recording;
                self.end_recording();
            }
        }
    }

    /// What was recorded can be downloaded.
    pub(super) fn end_recording(&mut self) {
        let closing = self.closing.take().map(|(recording, _)| recording);
        if let Some(mut recording) = self.recording.take().or(closing) {
            recording.finish();
            let recording = Arc::new(recording);
            self.recorded = Some(Arc::clone(&recording));
            self.pending.recorded(recording);
            self.changed = true;
        }
    }

    /// What is shown from now on is of another run.
    pub(super) fn begin_run(&mut self) {
        self.tick = self.replay.as_ref().map_or(0, |replay| replay.at as u64);
        let first = self.replay.as_ref().and_then(Replay::sample);
        self.sample = first.unwrap_or(Sample {
            t: 0.0,
            hand: self.stage.home,
        });
        self.phase = 0.0;
        self.steps = 0;
        self.coming = None;
        self.moved.clear();
        self.echo = None;
        if let Some(board) = &mut self.board {
            board.begin();
        }
        self.pending.clear();
        self.pending.record(&self.pair.frame);
        self.changed = true;
    }

    fn publish(&mut self) {
        if self.changed {
            let message = say::state(&self.stage, &self.pair.setting, &self.status());
            self.pending.state(message);
            self.changed = false;
        }
        let pair = &self.pair;
        self.feed.show(&mut self.pending, || Latest {
            tick: self.tick,
            frame: Arc::clone(&pair.frame),
            scene: Arc::clone(&pair.setting.scene),
            single: pair.setting.number.is_single(),
            echo: self.echo.clone(),
            reference: pair.comparison,
            counts: pair.counts,
            slips: Arc::clone(&pair.slips),
            step: self.board.is_none().then(|| self.times.summary()),
            board: self.board.as_ref().map(|board| board.fares),
            position: self.replay.as_ref().map(Replay::position),
        });
        if self.pending.is_shown() {
            for (reply, result) in self.answers.drain(..) {
                reply.send(result);
            }
        }
    }

    fn status(&self) -> Status {
        let hand = match (&self.replay, self.holder.source()) {
            (Some(_), _) => By {
                by: Some("replay"),
                client: None,
            },
            (None, source) => By {
                by: source.map(|source| source.name()),
                client: source.and_then(|source| source.client()),
            },
        };
        let recorded = self.recorded.as_ref().map(|recording| Recorded {
            seconds: recording.seconds(),
            frames: recording.len(),
        });
        let replay = self.replay.as_ref().map(|replay| Replayed {
            what: replay.what.clone(),
            seconds: replay.seconds(),
        });
        Status {
            paused: self.paused,
            speed: self.speed,
            recording: self.recording.as_ref().map(Recording::seconds),
            recorded,
            replay,
            hand,
            clients: self.clients,
        }
    }
}
