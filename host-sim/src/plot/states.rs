//! The contact state over time, as spans of one color.

use super::legend::{Entry, Mark};
use super::style::state_color;
use std::ops::Range;
use stiction_core::StateKind;
use stiction_live::record::Frame;

/// Maximum number of distinguished spans.
const COLUMNS: usize = 900;

/// The states that occur.
pub(super) fn legend(frames: &[Frame]) -> Vec<Entry> {
    StateKind::ALL
        .iter()
        .filter(|state| frames.iter().any(|frame| frame.state == **state))
        .map(|&state| Entry::new(Mark::Box(state_color(state)), state.name()))
        .collect()
}

/// Spans of time with one state. A column of many frames shows the one of its states that is rarest in the run, so that
/// none is lost.
pub(super) fn spans(frames: &[Frame], end: f64) -> Vec<(Range<f64>, StateKind)> {
    let count = |state| frames.iter().filter(|frame| frame.state == state).count();
    let counts = StateKind::ALL.map(|state| (state, count(state)));
    let rarity = |state: StateKind| {
        counts
            .iter()
            .find(|(s, _)| *s == state)
            .map_or(0, |(_, n)| *n)
    };
    let group = frames.len().div_ceil(COLUMNS).max(1);
    let mut spans: Vec<(Range<f64>, StateKind)> = Vec::new();
    for (index, chunk) in frames.chunks(group).enumerate() {
        let Some(rarest) = chunk
            .iter()
            .map(|frame| frame.state)
            .min_by_key(|&state| rarity(state))
        else {
            continue;
        };
        let end = frames.get((index + 1) * group).map_or(end, |next| next.t);
        match spans.last_mut() {
            Some((span, state)) if *state == rarest => span.end = end,
            _ => spans.push((chunk[0].t..end, rarest)),
        }
    }
    spans
}
