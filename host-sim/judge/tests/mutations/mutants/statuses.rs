//! A body that does not move, or is out of balance, with a status that should excuse it.

use stiction_judge::{Frame, Status};

use super::{Maker, Of, TAIL, is_quiet, size};
use crate::physics::{frozen, loaded};

impl Maker<'_> {
    pub(super) fn statuses(&mut self) {
        self.of = Of::Statuses;
        let busy = |frames: &[Frame], i: usize| {
            let ahead = &frames[i..frames.len().min(i + TAIL / 2)];
            is_quiet(frames, i)
                && !frames[i].contacts.is_empty()
                && ahead.iter().any(|frame| !frame.events.is_empty())
        };
        let statuses = [
            Status::Ambiguous,
            Status::Jammed,
            Status::Behind,
            Status::EventLimit,
            Status::IterationLimit,
            Status::Saturated,
            Status::HeldLast,
            Status::Twist,
        ];
        let mut places = self.places(busy);
        places.push(10);
        for status in statuses {
            for &at in &places {
                self.excused(at, status);
            }
            for at in self.places(|frames, i| !frames[i].events.is_empty() && frames[i].held) {
                self.add(&format!("{status:?}: nothing reported"), at, |tail| {
                    tail[0].status = status;
                    (tail[0].events, tail[0].slips) = (Vec::new(), 0);
                });
            }
        }
    }

    /// The body stops moving, or is out of balance, and a status gives the reason.
    fn excused(&mut self, at: usize, status: Status) {
        let truth = self.truth;
        let last = &truth.frames[at - 1];
        if last.contacts.is_empty() && last.wrench == [0.0; 3] {
            return;
        }
        let stays = |tail: &mut Vec<Frame>, springs: bool| {
            for frame in tail.iter_mut() {
                let still = frozen(last, frame);
                *frame = if springs {
                    loaded(truth, &still)
                } else {
                    still
                };
                (frame.status, frame.events, frame.slips) = (status, Vec::new(), 0);
            }
        };
        let moves = distance(last, &truth.frames[at..truth.frames.len().min(at + TAIL)]);
        if moves > 1e-3 * size(&truth.scene) {
            self.add(&format!("{status:?}: frozen"), at, |tail| {
                stays(tail, false)
            });
            self.add(&format!("{status:?}: frozen, with springs"), at, |tail| {
                stays(tail, true);
            });
        }
        if !truth.frames[at].contacts.is_empty() {
            self.add(&format!("{status:?}: out of balance"), at, |tail| {
                tail[0].status = status;
                let unit = size(&truth.scene) * truth.scene.stiffness_translation;
                tail[0].contacts[0].normal += 0.01 * unit;
            });
        }
    }
}

/// How far the body moves from where it was (m).
fn distance(last: &Frame, frames: &[Frame]) -> f64 {
    let ways = frames
        .iter()
        .map(|f| (f.pose[0] - last.pose[0]).hypot(f.pose[1] - last.pose[1]));
    ways.fold(0.0, f64::max)
}
