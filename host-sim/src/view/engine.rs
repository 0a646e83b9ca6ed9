//! The solver in real time: a tick every millisecond at absolute times, orders in between, new results to the feed. If a board
//! has the solver, it receives the hand, and its answers are shown. The engine waits for the clock and, during a recording, until
//! the system has accepted a line of the file; for nothing else.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::SyncSender;
use std::thread;
use std::time::{Duration, Instant};

use stiction_live::change::Ready;
use stiction_live::live::{Live, PERIOD};
use tokio::sync::mpsc::Receiver;

use super::archive::Archive;
use super::change::Reply;
use super::feed::SharedFeed;
use super::orders::Order;
use super::recording::LiveRecording;
use super::remote::Remote;
use stiction_live::body::Setting;
use stiction_live::replay::{Recorded as _, Way};
use stiction_live::stage::Stage;

/// Maximum time for orders between two ticks.
const ORDERING: Duration = Duration::from_micros(500);
/// Minimum time for other threads, however late a tick is.
const BREATH: Duration = Duration::from_micros(50);
/// Maximum number of ticks that a board has to take hold before the hand continues.
const LONGEST_GRASP: u64 = 100;
/// Number of ticks between updates of the state during a recording.
const RECORDING_EVERY: usize = 100;

/// The solver with its hand, and the other parts of a program: a board, recordings, clients.
pub(super) struct Engine {
    pub(super) surroundings: Surroundings,
    pub(super) live: Live,
    /// The board, if it has the solver.
    pub(super) board: Option<Remote>,
    /// A path or a program was given that moves the hand.
    pub(super) is_led: bool,
    /// The tick in which the hand last closed or opened.
    switched: u64,
    pub(super) recording: Option<LiveRecording>,
    pub(super) recorded: Option<Arc<LiveRecording>>,
    /// A recording that is to be offered.
    pub(super) offered: Option<Arc<LiveRecording>>,
    /// An uploaded path, and its name.
    pub(super) upload: Option<(String, Way)>,
    /// A recording of a board that waits for the answer to its last sample.
    pub(super) closing: Option<Closing>,
    /// Answers that wait until their effect is shown.
    pub(super) answers: Vec<(Reply, Result<(), String>)>,
}

/// What the engine writes to.
pub(super) struct Surroundings {
    /// Results, for clients and renderers.
    pub(super) feed: Arc<SharedFeed>,
    /// The folder of recordings.
    pub(super) archive: Archive,
    /// Messages for the terminal.
    pub(super) notes: SyncSender<String>,
}

/// A recording without further samples.
pub(super) struct Closing {
    pub(super) recording: LiveRecording,
    /// It ends at this time, with or without the answer.
    pub(super) until: Instant,
}

impl Engine {
    /// Creates an engine with a scene, the body at its start.
    pub(super) fn new(
        stage: Stage,
        setting: &Setting,
        surroundings: Surroundings,
    ) -> Result<Self, String> {
        let mut engine = Self {
            surroundings,
            live: Live::new(stage, setting)?,
            board: None,
            is_led: false,
            switched: 0,
            recording: None,
            recorded: None,
            offered: None,
            upload: None,
            closing: None,
            answers: Vec::new(),
        };
        engine.publish();
        Ok(engine)
    }

    /// Runs until `stop`, and completes a recording in progress.
    pub(super) fn run(mut self, orders: Receiver<Order>, stop: &AtomicBool) -> Result<(), String> {
        let result = self.go(orders, stop);
        self.end_recording();
        result
    }

    fn go(&mut self, mut orders: Receiver<Order>, stop: &AtomicBool) -> Result<(), String> {
        let mut due = Instant::now();
        while !stop.load(Ordering::Relaxed) {
            let now = Instant::now();
            due = self.live.late(due, now, PERIOD);
            while now.elapsed() < ORDERING
                && let Ok(order) = orders.try_recv()
            {
                self.obey(order, now);
            }
            self.live.changed |= self.live.holder.expire(now);
            self.listen(now)?;
            if let Some(board) = &mut self.board {
                board.send(self.live.sample);
            }
            self.pass();
            self.publish();
            due += PERIOD;
            thread::sleep(due.saturating_duration_since(Instant::now()).max(BREATH));
        }
        Ok(())
    }

    fn pass(&mut self) {
        if self.board.as_ref().is_some_and(Remote::is_ending) {
            // Nothing follows the hand now.
            return;
        }
        let mut tick = Tick {
            is_board: self.board.is_some(),
            switched: &mut self.switched,
            recording: &mut self.recording,
        };
        self.live.pass(&mut |live| tick.advance(live));
        let is_over =
            |recording: &LiveRecording| recording.is_full() || recording.problem.is_some();
        if self.recording.as_ref().is_some_and(is_over) {
            self.close_recording(Instant::now());
        }
    }

    /// Begins another run, and notifies the board.
    pub(super) fn begin_run(&mut self, ready: Ready) {
        self.live.begin(ready);
        self.switched = 0;
        if let Some(board) = &mut self.board {
            board.begin();
        }
    }

    /// Lets a board take hold with the first hand of a run before that continues.
    pub(super) const fn wait_for_hold(&mut self) {
        self.switched = self.live.tick + 1;
    }
}

/// The parts other than the solver that a tick affects.
struct Tick<'a> {
    /// A board has the solver, and receives the hand.
    is_board: bool,
    switched: &'a mut u64,
    recording: &'a mut Option<LiveRecording>,
}

impl Tick<'_> {
    /// Executes a tick. Returns whether another one may follow in the same period: a board receives every sample, and a recording
    /// ends.
    fn advance(&mut self, live: &mut Live) -> bool {
        if live.replay.is_some() {
            live.follow(!self.is_board);
            return !self.is_board;
        }
        let before = live.guide.now();
        let mut hand = match self.is_grasping(live) {
            true => before,
            false => live.guide.advance(),
        };
        if self.recording.is_some() {
            // The file of a planar hand has no depth.
            hand.depth = 0.0;
        }
        let sample = live.move_hand(hand);
        if hand.held != before.held {
            *self.switched = live.tick;
        }
        match self.is_board {
            true => live.echoes.move_at(sample.t),
            false => live.step(),
        }
        let Some(recording) = self.recording else {
            return !self.is_board;
        };
        recording.add(hand, &live.pair.frame);
        live.changed |= recording.count().is_multiple_of(RECORDING_EVERY);
        !self.is_board && !recording.is_full() && recording.problem.is_none()
    }

    /// Returns whether a board has not yet answered the hand that closed or opened: it uses the newest sample, and must not miss
    /// this one.
    fn is_grasping(&self, live: &Live) -> bool {
        let answered = live.pair.frame.t * 1000.0;
        self.is_board
            && answered < *self.switched as f64
            && live.tick < *self.switched + LONGEST_GRASP
    }
}
