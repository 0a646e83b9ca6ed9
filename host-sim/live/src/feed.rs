//! Data passed from the solver to its viewers: the newest record, the records before it, and the state.

use std::collections::VecDeque;
use std::sync::Arc;

use stiction_judge::insertion::Meter;
use stiction_scene::SceneFile;

use crate::counts::Counts;
use crate::echo::Echo;
use crate::number::Number;
use crate::outbound::{Fares, News};
use crate::pair::{Comparison, SlipMark};
use crate::record::Frame;
use crate::stage::Stage;

/// Number of past records that a viewer can still get.
const HISTORY: usize = 1024;

/// The newest data.
#[derive(Clone, Debug)]
pub struct Latest {
    /// Number of the tick.
    pub tick: u64,
    /// The record.
    pub frame: Arc<Frame>,
    /// The scene of the record.
    pub scene: Arc<SceneFile>,
    /// Whitney's meter, if the scene has a peg and a hole.
    pub meter: Option<Arc<Meter>>,
    /// The scene as it is after a reset.
    pub stage: Stage,
    /// Scenes other than the bundled ones, the newest last.
    pub own: Arc<Vec<Stage>>,
    /// The number type.
    pub number: Number,
    /// A client, and the value it sent with the newest sample in the record.
    pub echo: Option<Echo>,
    /// The comparison with the reference.
    pub reference: Comparison,
    /// The counters so far.
    pub counts: Counts,
    /// The newest slips.
    pub slips: Arc<[SlipMark]>,
    /// Median and worst time of a step (s), on this computer.
    pub step: Option<[f32; 2]>,
    /// Statistics of the board that runs the solver.
    pub board: Option<Fares>,
    /// Position in the replay (s).
    pub position: Option<f64>,
}

/// The data that viewers see.
#[derive(Debug, Default)]
pub struct Shown {
    /// Number of the newest publication.
    pub serial: u64,
    /// The newest data.
    pub latest: Option<Latest>,
    /// The last records, the oldest first, of one scene and one run; and the running number of the next one.
    records: VecDeque<Arc<Frame>>,
    next_record: u64,
    /// The state as a message.
    pub state: Arc<str>,
    /// The state's running number.
    pub state_serial: u64,
}

impl Shown {
    /// Returns the records from number `next` on, and the number of the next one to come.
    pub fn since(&self, next: u64) -> (impl ExactSizeIterator<Item = &Arc<Frame>>, u64) {
        let first = self.next_record - self.records.len() as u64;
        let skip = next.saturating_sub(first).min(self.records.len() as u64) as usize;
        (self.records.range(skip..), self.next_record)
    }

    /// Publishes the pending data.
    pub fn show(&mut self, pending: &mut Pending, latest: Latest) {
        self.serial += 1;
        self.latest = Some(latest);
        if pending.clear {
            self.records.clear();
        }
        for frame in pending.records.drain(..) {
            if self.records.len() == HISTORY {
                self.records.pop_front();
            }
            self.records.push_back(frame);
            self.next_record += 1;
        }
        if let Some(state) = pending.state.take() {
            self.state = state;
            self.state_serial += 1;
        }
        pending.clear = false;
        pending.any = false;
    }
}

/// Data that waits to be published.
#[derive(Debug, Default)]
pub struct Pending {
    records: Vec<Arc<Frame>>,
    /// The records published before belong to another run.
    clear: bool,
    state: Option<Arc<str>>,
    /// Whether there is anything new.
    any: bool,
}

impl Pending {
    /// Adds a record.
    pub fn record(&mut self, frame: &Arc<Frame>) {
        if self.records.len() == HISTORY {
            // A viewer that holds the lock for a second does not get them all.
            self.records.clear();
        }
        self.records.push(Arc::clone(frame));
        self.any = true;
    }

    /// Notes that another run begins.
    pub fn clear(&mut self) {
        self.records.clear();
        self.clear = true;
        self.any = true;
    }

    /// Sets the state, as a message.
    pub fn state(&mut self, message: String) {
        self.state = Some(message.into());
        self.any = true;
    }

    /// Returns whether nothing is pending.
    pub const fn is_shown(&self) -> bool {
        !self.any
    }

    /// Marks data as new although there is no new record.
    pub fn touch(&mut self) {
        self.any = true;
    }
}

/// What a client has received.
#[derive(Clone, Copy, Debug)]
pub struct Cursor {
    state: u64,
    serial: u64,
    record: u64,
}

impl Cursor {
    /// Starts a client without earlier records.
    pub fn new(shown: &Shown) -> Self {
        let (_, record) = shown.since(u64::MAX);
        Self {
            state: 0,
            serial: 0,
            record,
        }
    }

    /// Returns what is new.
    pub fn look(&mut self, shown: &Shown, with_frame: bool) -> (Option<Arc<str>>, Option<News>) {
        let state = (shown.state_serial != self.state).then(|| Arc::clone(&shown.state));
        self.state = shown.state_serial;
        let mut news = None;
        if with_frame && shown.serial != self.serial {
            self.serial = shown.serial;
            news = News::since(shown, &mut self.record);
        }
        (state, news)
    }
}
