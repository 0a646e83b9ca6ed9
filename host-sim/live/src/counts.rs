//! Counters of a run since its reset: ticks, slips, transitions between states, events.

use serde::{Serialize, Serializer};
use stiction_core::{Event, StateKind};

use crate::record::Frame;

const STATES: usize = StateKind::ALL.len();
const EVENTS: usize = Event::ALL.len();

/// Counts since the reset.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Counts {
    /// Ticks.
    pub ticks: u64,
    /// Ticks that began more than a period late. A seek does not reset them.
    pub missed: u64,
    /// Slips that ended.
    pub slips: u64,
    #[serde(serialize_with = "transitions")]
    transitions: [[u64; STATES]; STATES],
    #[serde(serialize_with = "events")]
    events: [u64; EVENTS],
}

impl Counts {
    /// Adds a record; `before`: the state before it.
    pub fn add(&mut self, before: Option<StateKind>, frame: &Frame) {
        self.slips += u64::from(frame.slips);
        let place = |kind| StateKind::ALL.iter().position(|known| *known == kind);
        if let (Some(from), Some(to)) = (before.and_then(place), place(frame.state))
            && from != to
        {
            self.transitions[from][to] += 1;
        }
        for event in &frame.events {
            if let Some(k) = Event::ALL.iter().position(|known| known == event) {
                self.events[k] += 1;
            }
        }
    }
}

fn transitions<S: Serializer>(
    counts: &[[u64; STATES]; STATES],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let cells = StateKind::ALL.iter().zip(counts).flat_map(|(from, row)| {
        let cells = StateKind::ALL.iter().zip(row);
        cells.map(move |(to, count)| (format!("{}>{}", from.name(), to.name()), count))
    });
    serializer.collect_map(cells.filter(|(_, count)| **count > 0))
}

fn events<S: Serializer>(counts: &[u64; EVENTS], serializer: S) -> Result<S::Ok, S::Error> {
    let counts = Event::ALL.iter().map(|event| event.name()).zip(counts);
    serializer.collect_map(counts.filter(|(_, count)| **count > 0))
}
