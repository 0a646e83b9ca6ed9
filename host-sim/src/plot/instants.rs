//! The moments worth a snapshot: the ends of the run, the first frame of each state, frames with events, the longest slip,
//! and otherwise an even spread over time.

use stiction_core::{Event, StateKind};
use stiction_live::record::{Frame, Run};

/// The minimum interval between two snapshots, as a fraction of the run's duration.
const APART: f64 = 0.005;
/// Among obstacles events come in bunches, in which snapshots look alike.
const BUNCH: f64 = 0.05;
/// Which of the tiers has the events.
const EVENTS: usize = 2;

/// The indices of at most `count` frames, in order of time.
pub(super) fn choose(run: &Run, count: usize) -> Vec<usize> {
    let frames = &run.frames;
    let mut chosen: Vec<usize> = Vec::new();
    let ends = [0, frames.len().saturating_sub(1)];
    let indices = || 0..frames.len();
    let new_state = |&index: &usize| index > 0 && frames[index].state != frames[index - 1].state;
    let tiers: [Vec<usize>; 4] = [
        ends.to_vec(),
        StateKind::ALL
            .iter()
            .filter_map(|&state| frames.iter().position(|frame| frame.state == state))
            .collect(),
        indices()
            .filter(|index| eventful(&frames[*index]) || new_state(index))
            .collect(),
        indices()
            .max_by(|&a, &b| frames[a].longest_slip.total_cmp(&frames[b].longest_slip))
            .into_iter()
            .collect(),
    ];
    let apart = |tier: usize| match tier {
        EVENTS if !run.scene.obstacles.is_empty() => BUNCH,
        _ => APART,
    };
    for (k, tier) in tiers.into_iter().enumerate() {
        add(frames, &mut chosen, tier.into_iter(), count, apart(k));
    }
    add(frames, &mut chosen, indices(), count, APART);
    chosen.sort_unstable();
    chosen
}

fn eventful(frame: &Frame) -> bool {
    frame.events.iter().any(|&event| event != Event::Slip)
}

/// Adds candidates, the farthest in time from those chosen first, until there are `count` or none is left with this distance from
/// them.
fn add(
    frames: &[Frame],
    chosen: &mut Vec<usize>,
    candidates: impl Iterator<Item = usize> + Clone,
    count: usize,
    least: f64,
) {
    let duration = match frames {
        [first, .., last] => last.t - first.t,
        _ => 0.0,
    };
    while chosen.len() < count {
        let distance = |index: usize| {
            let apart = chosen
                .iter()
                .map(|&other: &usize| (frames[index].t - frames[other].t).abs());
            apart.fold(f64::INFINITY, f64::min)
        };
        let farthest = candidates
            .clone()
            .map(|index| (index, distance(index)))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        match farthest {
            Some((index, apart)) if apart > least * duration => chosen.push(index),
            _ => return,
        }
    }
}
