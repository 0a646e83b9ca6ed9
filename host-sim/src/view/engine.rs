//! The solver in real time: a tick every millisecond at absolute times, orders in between, what is new to the feed. Where a
//! board has the solver, it gets the hand, and what it answers is shown. The engine waits for the clock and, while it records, until the
//! system has taken a line of the file; for nothing else.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::SyncSender;
use std::thread;
use std::time::{Duration, Instant};

use stiction_scene::Sample;
use tokio::sync::mpsc::Receiver;

use super::change::Reply;
use super::echo::Echoes;
use super::feed::{Feed, Pending};
use super::guide::{Guide, HandPose};
use super::holder::Holder;
use super::orders::Order;
use super::pair::Pair;
use super::recording::{self, Recording};
use super::remote::Remote;
use super::replay::{Replay, Way};
use super::shelf::Shelf;
use super::stage::Stage;
use super::step_times::StepTimes;
use crate::body::Setting;

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
/// A board is given so many ticks to take hold, before the hand goes on.
const LONGEST_GRASP: u64 = 100;
/// While it records, the state tells so every so many ticks.
const RECORDING_EVERY: usize = 100;

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
    /// The tick in which the hand closed or opened last.
    switched: u64,
    pub(super) holder: Holder,
    pub(super) replay: Option<Replay>,
    pub(super) recording: Option<Recording>,
    pub(super) recorded: Option<Arc<Recording>>,
    /// Where recordings go.
    pub(super) shelf: Shelf,
    /// What the terminal is told.
    pub(super) notes: SyncSender<String>,
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
    pub(super) echoes: Echoes,
    /// A recording of a board that waits for the answer to its last sample, not longer than this.
    pub(super) closing: Option<(Recording, Instant)>,
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
    pub(super) fn new(
        stage: Stage,
        setting: &Setting,
        feed: Arc<Feed>,
        (shelf, notes): (Shelf, SyncSender<String>),
    ) -> Result<Self, String> {
        let pair = Pair::start(setting, 0.0, &stage.home)?;
        let mut engine = Self {
            feed,
            pending: Pending::default(),
            guide: Guide::at(HandPose::of(&stage.home)),
            switched: 0,
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
            shelf,
            notes,
            upload: None,
            own: None,
            tick: 0,
            paused: false,
            steps: 0,
            speed: 1.0,
            phase: 0.0,
            clients: 0,
            echoes: Echoes::default(),
            closing: None,
            changed: true,
            answers: Vec::new(),
        };
        engine.pending.record(&engine.pair.frame);
        engine.publish();
        Ok(engine)
    }

    /// Until `stop`; what is being recorded then is whole.
    ///
    /// # Errors
    /// The board will not come back.
    pub(super) fn run(mut self, orders: Receiver<Order>, stop: &AtomicBool) -> Result<(), String> {
        let result = self.go(orders, stop);
        self.end_recording();
        result
    }

    fn go(&mut self, mut orders: Receiver<Order>, stop: &AtomicBool) -> Result<(), String> {
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
        let skips = late > PATIENCE;
        if self.moves() && late > PERIOD {
            self.pair.counts.missed += if skips { late.as_millis() as u64 } else { 1 };
        }
        if skips { now } else { due }
    }

    /// Ticks are made.
    fn moves(&self) -> bool {
        let ended = self.replay.as_ref().is_some_and(Replay::is_over);
        !self.paused && !ended
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
                self.changed |= replay.takes_change();
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
            self.changed |= replay.takes_change();
            let Some(sample) = sample else { return };
            (self.sample, self.tick) = (sample, replay.at as u64);
            if !is_board {
                self.pending.record(&self.pair.frame);
            }
            return;
        }
        let before = self.guide.now();
        let mut hand = match self.is_grasping() {
            true => before,
            false => self.guide.next(),
        };
        if self.recording.is_some() {
            // The file of a planar hand has no depth.
            hand.depth = 0.0;
        }
        self.tick += 1;
        if hand.held != before.held {
            self.switched = self.tick;
        }
        self.sample = Sample {
            t: self.tick as f64 / 1000.0,
            hand: hand.hand(),
        };
        let Sample { t, hand: now } = self.sample;
        if self.board.is_some() {
            self.echoes.move_at(t);
        } else {
            self.echoes.move_now();
            self.pair.step(t, &now, &mut self.times);
            self.pending.record(&self.pair.frame);
        }
        if let Some(recording) = &mut self.recording {
            recording.add(hand, &self.pair.frame);
            let count = recording.len();
            self.changed |= count.is_multiple_of(RECORDING_EVERY);
            if count > recording::LONGEST || recording.problem.is_some() {
                self.close_recording(Instant::now());
            }
        }
    }

    /// A board is to take hold with the first hand of a run, before that goes on.
    pub(super) const fn wait_for_hold(&mut self) {
        self.switched = self.tick + 1;
    }

    /// A board has not yet answered the hand that closed or opened: it takes the newest sample, and must not miss this one.
    fn is_grasping(&self) -> bool {
        let answered = self.pair.frame.t * 1000.0;
        self.board.is_some()
            && answered < self.switched as f64
            && self.tick < self.switched + LONGEST_GRASP
    }

    /// What is shown from now on is of another run, which the hand begins at `home`.
    pub(super) fn begin_run(&mut self, home: HandPose) {
        self.tick = self.replay.as_ref().map_or(0, |replay| replay.at as u64);
        let first = self.replay.as_ref().and_then(Replay::sample);
        self.sample = first.unwrap_or(Sample {
            t: 0.0,
            hand: home.hand(),
        });
        self.phase = 0.0;
        self.steps = 0;
        self.switched = 0;
        self.echoes = Echoes::default();
        if let Some(board) = &mut self.board {
            board.begin();
        }
        self.pending.clear();
        self.pending.record(&self.pair.frame);
        self.changed = true;
    }
}
