//! What is between the solver and those who watch it: the newest record, what led to it, and the state.

use std::collections::VecDeque;
use std::sync::Arc;

use stiction_insertion::Meter;
use stiction_scene::SceneFile;

use crate::counts::Counts;
use crate::echo::Echo;
use crate::number::Number;
use crate::pair::{Comparison, SlipMark};
use crate::record::Frame;
use crate::say::{Fares, News};
use crate::stage::Stage;

/// So many records of the past are kept.
const KEPT: usize = 1024;

/// The newest there is.
#[derive(Clone, Debug)]
pub struct Latest {
    /// Its number.
    pub tick: u64,
    /// The record.
    pub frame: Arc<Frame>,
    /// The scene that it is of.
    pub scene: Arc<SceneFile>,
    /// Whitney's meter, where the scene has a peg and a hole.
    pub meter: Option<Arc<Meter>>,
    /// The scene as it is at a reset.
    pub stage: Stage,
    /// The number type.
    pub number: Number,
    /// A client, and what it sent with the newest sample that is in the record.
    pub echo: Option<Echo>,
    /// The reference beside it.
    pub reference: Comparison,
    /// What was counted so far.
    pub counts: Counts,
    /// The newest slips.
    pub slips: Arc<[SlipMark]>,
    /// Median and worst time of a step (s), on this computer.
    pub step: Option<[f32; 2]>,
    /// How the board fares that has the solver.
    pub board: Option<Fares>,
    /// Where the replay is (s).
    pub position: Option<f64>,
}

/// What is shown.
#[derive(Debug, Default)]
pub struct Shown {
    /// Of the newest publication.
    pub serial: u64,
    /// The newest there is.
    pub latest: Option<Latest>,
    /// The last records, the oldest first, of one scene and one run; the running number of the next one.
    records: VecDeque<Arc<Frame>>,
    next_record: u64,
    /// The state as a message.
    pub state: Arc<str>,
    /// The state's running number.
    pub state_serial: u64,
}

impl Shown {
    /// The records since one, and the number of the next one to come.
    pub fn since(&self, next: u64) -> (impl ExactSizeIterator<Item = &Arc<Frame>>, u64) {
        let first = self.next_record - self.records.len() as u64;
        let skip = next.saturating_sub(first).min(self.records.len() as u64) as usize;
        (self.records.range(skip..), self.next_record)
    }

    /// Shows what waits.
    pub fn show(&mut self, pending: &mut Pending, latest: Latest) {
        self.serial += 1;
        self.latest = Some(latest);
        if pending.clear {
            self.records.clear();
        }
        for frame in pending.records.drain(..) {
            if self.records.len() == KEPT {
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

/// What waits to be shown.
#[derive(Debug, Default)]
pub struct Pending {
    records: Vec<Arc<Frame>>,
    /// What was shown before is of another run.
    clear: bool,
    state: Option<Arc<str>>,
    /// There is something new.
    any: bool,
}

impl Pending {
    /// A record.
    pub fn record(&mut self, frame: &Arc<Frame>) {
        if self.records.len() == KEPT {
            // Whoever holds the lock for a second does not get them all.
            self.records.clear();
        }
        self.records.push(Arc::clone(frame));
        self.any = true;
    }

    /// Another run begins.
    pub fn clear(&mut self) {
        self.records.clear();
        self.clear = true;
        self.any = true;
    }

    /// The state, as a message.
    pub fn state(&mut self, message: String) {
        self.state = Some(message.into());
        self.any = true;
    }

    /// Nothing waits.
    pub const fn is_shown(&self) -> bool {
        !self.any
    }

    /// Something is new though no record is.
    pub fn touch(&mut self) {
        self.any = true;
    }
}

/// What a client knows.
#[derive(Clone, Copy, Debug)]
pub struct Told {
    state: u64,
    serial: u64,
    /// The next record.
    record: u64,
}

impl Told {
    /// The records of before are not for this client.
    pub fn new(shown: &Shown) -> Self {
        let (_, record) = shown.since(u64::MAX);
        Self {
            state: 0,
            serial: 0,
            record,
        }
    }

    /// What is new.
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
