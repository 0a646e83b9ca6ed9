//! Numbers that are off, contacts that creep, and slips that are too short, too long, early or late.

use stiction_judge::{Contact, Event, Frame, State};

use super::{Maker, Of, TAIL, by_count, is_quiet, is_still_there, largest, size};
use crate::physics::{frozen, loaded, moved};
use crate::truth::Truth;

/// A change of a frame that breaks a law.
type Fault<'a> = &'a dyn Fn(&mut Frame);

impl Maker<'_> {
    pub(super) fn laws(&mut self) {
        self.of = Of::Laws;
        let is_pressed = |frames: &[Frame], i: usize| {
            let most = |frame: &Frame| {
                let normals = frame.contacts.iter().map(|c| c.normal);
                normals.fold(0.0, f64::max)
            };
            let typical = frames.iter().map(most).fold(0.0, f64::max) / 4.0;
            is_quiet(frames, i) && !frames[i].contacts.is_empty() && most(&frames[i]) > typical
        };
        for at in self.places(is_pressed) {
            self.numbers(at);
            self.creeps(at);
        }
        let slips = |frames: &[Frame], i: usize| {
            frames[i].events == [Event::Slip]
                && frames[i].slips == 1
                && is_still_there(&frames[i - 1], &frames[i])
                && matches!(frames[i].state, State::SingleVertex | State::Edge)
        };
        for at in self.places(slips) {
            self.slips(at);
        }
    }

    /// Numbers of one frame.
    fn numbers(&mut self, at: usize) {
        let size = size(&self.truth.scene);
        let reported = 2.0 * self.truth.number.bounds().residual * largest(&self.truth.frames[at]);
        let all = |frame: &mut Frame, factor: f64| {
            frame.wrench.iter_mut().for_each(|x| *x *= factor);
            for contact in &mut frame.contacts {
                contact.normal *= factor;
                contact.friction *= factor;
            }
        };
        let faults: [(&str, Fault<'_>); 14] = [
            ("forces + 0.1 %", &|frame| all(frame, 1.001)),
            ("forces - 0.1 %", &|frame| all(frame, 0.999)),
            // Of the contact that presses most: 1 % of a small N is within the bound of single precision on balance.
            ("N + 1 %", &|frame| {
                let normals = frame.contacts.iter_mut().map(|c| &mut c.normal);
                if let Some(normal) = normals.max_by(|a, b| a.total_cmp(b)) {
                    *normal *= 1.01;
                }
            }),
            ("a wrench + 0.5 %", &|frame| {
                frame.wrench.iter_mut().for_each(|x| *x *= 1.005)
            }),
            ("inside by 10⁻⁴ L", &|frame| {
                frame.pose[1] -= 1e-4 * size
            }),
            ("aside by 10⁻⁴ L", &|frame| frame.pose[0] += 1e-4 * size),
            ("turned by 10⁻⁴", &|frame| frame.pose[2] += 1e-4),
            ("a point off by 10⁻⁵ L", &|frame| {
                frame.contacts[0].point[0] += 1e-5 * size
            }),
            ("the hand off by 10⁻³ L", &|frame| {
                frame.hand[0] += 1e-3 * size
            }),
            ("a direction of friction turned", &|frame| {
                let rubs = |c: &&mut Contact| c.friction.abs() > reported;
                frame
                    .contacts
                    .iter_mut()
                    .filter(rubs)
                    .for_each(|c| c.friction = -c.friction);
            }),
            ("a name", &|frame| {
                frame.state = match frame.state {
                    State::Edge => State::TwoVertex,
                    _ => State::Edge,
                }
            }),
            ("a contact twice", &|frame| {
                let mut again = frame.contacts[0];
                (again.normal, again.friction) = (0.0, 0.0);
                frame.contacts.push(again);
                frame.state = by_count(frame);
            }),
            ("slides reported", &|frame| {
                let rubs = |c: &&mut Contact| c.friction.abs() > reported;
                for contact in frame.contacts.iter_mut().filter(rubs) {
                    contact.sliding = contact
                        .sliding
                        .map(|sign| if sign == 0 { 1 } else { -sign });
                }
            }),
            ("a number missing", &|frame| frame.wrench[1] = f64::NAN),
        ];
        for (name, change) in faults {
            self.add(name, at, |tail| change(&mut tail[0]));
        }
        self.add("all forces + 0.1 %", at, |tail| {
            tail.iter_mut().for_each(|frame| all(frame, 1.001));
        });
        self.add("two frames changed places", at, |tail| tail.swap(0, 1));
    }

    /// A sticking contact moves with the hand, by some roundings per frame, so that its springs are deflected no more than before.
    fn creeps(&mut self, at: usize) {
        let first = &self.truth.frames[at];
        let sticks = first.contacts.iter().all(|c| c.sliding == Some(0));
        if !sticks || !matches!(first.state, State::SingleVertex | State::Edge) {
            return;
        }
        let size = size(&self.truth.scene);
        let rounding = self.truth.number.bounds().rounding;
        let reach = size + first.hand[0].hypot(first.hand[1]);
        let quiet = self.truth.frames[at..]
            .iter()
            .take(TAIL)
            .take_while(|frame| frame.events.is_empty())
            .count();
        for (name, step) in [
            ("creep by 10⁻⁶ L a frame", 1e-6),
            ("creep by 10⁻⁷ L a frame", 1e-7),
        ] {
            // Two positions that are each known to 8 roundings: a creep that is no longer in all is no fault.
            if step * size * quiet as f64 <= 16.0 * rounding * reach {
                continue;
            }
            let truth = self.truth;
            self.add(name, at, |tail| {
                tail.truncate(quiet);
                for (i, frame) in tail.iter_mut().enumerate() {
                    let by = step * size * (i + 1) as f64;
                    *frame = moved(truth, frame, by);
                }
            });
        }
    }

    fn slips(&mut self, at: usize) {
        let truth = self.truth;
        let (last, next) = (&truth.frames[at - 1], &truth.frames[at]);
        let length = slipped(truth, last, next);
        let bounds = truth.number.bounds();
        let stiffness = truth.scene.stiffness_translation;
        let reach = size(&truth.scene) + next.hand[0].hypot(next.hand[1]);
        let rounding = 64.0 * bounds.rounding * reach * stiffness;
        // As the body turns, its contact yields more than the springs alone.
        let levers = next.contacts.iter().map(|c| {
            let [x, y] = c.point;
            (x - next.hand[0]).hypot(y - next.hand[1])
        });
        let lever = levers.fold(0.0, f64::max);
        let turning = if next.state == State::SingleVertex && size(&truth.scene) > 0.0 {
            stiffness * lever * lever / truth.scene.stiffness_rotation
        } else {
            0.0
        };
        let reported =
            2.0 * (1.0 + turning) * (bounds.slip * largest(last).max(largest(next))).max(rounding);
        for (name, part) in [
            ("0.1 % short", -1e-3),
            ("0.1 % long", 1e-3),
            ("1 % short", -1e-2),
        ] {
            // A force that is no larger than rounding is no fault.
            let force = part * length * truth.scene.stiffness_translation;
            if force.abs() < reported {
                continue;
            }
            self.add(&format!("a slip {name}"), at, |tail| {
                tail[0] = moved(truth, &tail[0], part * length);
                tail.truncate(1);
            });
            self.add(&format!("a slip {name}, and all after it"), at, |tail| {
                let quiet = tail[1..]
                    .iter()
                    .take_while(|frame| frame.events.is_empty())
                    .count();
                tail.truncate(1 + quiet);
                for frame in tail.iter_mut() {
                    *frame = moved(truth, frame, part * length);
                }
            });
        }
        let is_next_quiet = truth.frames[at + 1].events.is_empty();
        if is_next_quiet {
            self.add("a slip a frame late", at, |tail| {
                let mut late = loaded(truth, &frozen(last, next));
                (late.events, late.slips) = (Vec::new(), 0);
                (tail[1].events, tail[1].slips) = (tail[0].events.clone(), 1);
                tail[0] = late;
            });
        }
        if truth.frames[at - 1].events.is_empty() && at > 2 {
            self.add("a slip a frame early", at - 1, |tail| {
                let mut early = loaded(truth, &frozen(&tail[1], &tail[0]));
                (early.events, early.slips) = (tail[1].events.clone(), 1);
                (tail[1].events, tail[1].slips) = (Vec::new(), 0);
                tail[0] = early;
            });
        }
    }
}

/// How far the first contact moved along its tangent (m).
fn slipped(truth: &Truth, last: &Frame, next: &Frame) -> f64 {
    let [a, b]: [&Contact; 2] = [&last.contacts[0], &next.contacts[0]];
    let tangent = crate::physics::tangent(truth, b);
    let by = [0, 1].map(|k| b.point[k] - a.point[k]);
    match b.touch {
        stiction_judge::Touch::Corner { .. } => 0.0,
        _ => tangent[0] * by[0] + tangent[1] * by[1],
    }
}
