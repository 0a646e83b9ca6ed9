//! True traces with a fault: of laws, of events, and faults that a status is to excuse.

use stiction_judge::{Contact, Event, Frame, Scene, State, Status};

use crate::physics::{frozen, loaded, moved};
use crate::truth::Truth;

/// What a fault is one of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Of {
    Laws,
    Events,
    Statuses,
}

/// A fault in a trace.
#[derive(Clone, Debug)]
pub(crate) struct Mutant {
    pub(crate) of: Of,
    /// What was done, and to what.
    pub(crate) kind: String,
    /// The first frame that differs.
    pub(crate) from: usize,
    /// The trace from there on, as far as it is looked at.
    pub(crate) frames: Vec<Frame>,
}

/// Of an event that is not the only one of its frame.
pub(crate) const BESIDE: &str = " beside others";

/// Frames that are looked at after a fault.
const TAIL: usize = 60;
/// Places of a trace at which a fault is made.
const PLACES: usize = 2;

const EVENTS: [Event; 9] = [
    Event::Touch,
    Event::Lift,
    Event::Slip,
    Event::Tip,
    Event::Land,
    Event::Snap,
    Event::Jam,
    Event::Slide,
    Event::Stop,
];

/// All faults of a true trace.
pub(crate) fn mutants(truth: &Truth) -> Vec<Mutant> {
    let mut maker = Maker {
        truth,
        made: Vec::new(),
    };
    maker.events();
    maker.laws();
    maker.statuses();
    maker.made
}

struct Maker<'a> {
    truth: &'a Truth,
    made: Vec<Mutant>,
}

/// A change of a frame that breaks a law.
type Fault<'a> = &'a dyn Fn(&mut Frame);

impl Maker<'_> {
    /// Some frames for which something is true, spread over the trace.
    fn places(&self, is: impl Fn(&[Frame], usize) -> bool) -> Vec<usize> {
        let frames = &self.truth.frames;
        let all: Vec<usize> = (2..frames.len().saturating_sub(2))
            .filter(|&i| is(frames, i))
            .collect();
        let mut some: Vec<usize> = (0..PLACES)
            .filter_map(|k| all.get(k * all.len() / PLACES).copied())
            .collect();
        some.dedup();
        some
    }

    /// The frames from one on, with a change of that one.
    fn add(&mut self, of: Of, kind: &str, at: usize, change: impl FnOnce(&mut Vec<Frame>)) {
        let frames = &self.truth.frames;
        let mut tail = frames[at..frames.len().min(at + TAIL)].to_vec();
        change(&mut tail);
        if tail[..] != frames[at..frames.len().min(at + TAIL)] {
            self.made.push(Mutant {
                of,
                kind: kind.to_owned(),
                from: at,
                frames: tail,
            });
        }
    }

    fn events(&mut self) {
        for state in [
            State::NonContact,
            State::SingleVertex,
            State::Edge,
            State::TwoVertex,
            State::Corner,
            State::Locked,
        ] {
            for slides in [false, true] {
                let quiet = |frames: &[Frame], i: usize| {
                    is_quiet(frames, i) && frames[i].state == state && slide(&frames[i]) == slides
                };
                for at in self.places(quiet) {
                    self.invented(at, state, slides);
                }
            }
        }
        for event in EVENTS.into_iter().chain([Event::Grasp, Event::Release]) {
            for at in self.places(|frames, i| frames[i].events.contains(&event)) {
                self.changed(at, event);
            }
            for at in self.places(|frames, i| frames[i].events == [event]) {
                self.moved_event(at, event);
            }
        }
        for at in self.places(|frames, i| frames[i].slips > 1) {
            let alone = self.truth.frames[at].events.len() == 1;
            let beside = if alone { "" } else { BESIDE };
            for by in [-1_i32, 1] {
                self.add(
                    Of::Events,
                    &format!("{by:+} slips of several{beside}"),
                    at,
                    |tail| {
                        tail[0].slips = tail[0].slips.saturating_add_signed(by);
                    },
                );
            }
        }
    }

    /// Something is told of a frame in which nothing happens.
    fn invented(&mut self, at: usize, state: State, slides: bool) {
        let how = if slides { "sliding " } else { "" };
        for event in EVENTS {
            self.add(
                Of::Events,
                &format!("invented {event:?} in {how}{state:?}"),
                at,
                |tail| {
                    tail[0].events.push(event);
                    tail[0].slips += u32::from(event == Event::Slip);
                },
            );
        }
        self.add(
            Of::Events,
            &format!("a slip counted in {how}{state:?}"),
            at,
            |tail| {
                tail[0].slips = 1;
            },
        );
        self.add(
            Of::Events,
            &format!("a contact gone in {how}{state:?}"),
            at,
            |tail| {
                tail[0].contacts.pop();
                tail[0].state = by_count(&tail[0]);
            },
        );
    }

    /// What is told of an event differs.
    fn changed(&mut self, at: usize, event: Event) {
        let alone = self.truth.frames[at].events.len() == 1;
        let beside = if alone { "" } else { BESIDE };
        let name = format!("{event:?}{beside}");
        self.add(Of::Events, &format!("{name} not told"), at, |tail| {
            tail[0].events.retain(|&told| told != event);
            if event == Event::Slip {
                tail[0].slips = 0;
            }
        });
        self.add(
            Of::Events,
            &format!("frame of {name} repeated 1 ns later"),
            at,
            |tail| {
                let mut again = tail[0].clone();
                again.t += 1e-9;
                tail.insert(1, again);
            },
        );
        let other = match event {
            Event::Touch => Event::Land,
            Event::Land => Event::Touch,
            Event::Lift => Event::Tip,
            Event::Tip => Event::Lift,
            Event::Jam => Event::Touch,
            Event::Slide => Event::Stop,
            Event::Stop => Event::Slide,
            Event::Snap => Event::Tip,
            _ => return,
        };
        self.add(
            Of::Events,
            &format!("{name} called {other:?}"),
            at,
            |tail| {
                for told in tail[0].events.iter_mut().filter(|told| **told == event) {
                    *told = other;
                }
            },
        );
        if event == Event::Slip {
            self.add(Of::Events, "slips not counted", at, |tail| {
                tail[0].slips = 0
            });
        }
    }

    /// The one event of a frame is told at another time, or differently counted.
    fn moved_event(&mut self, at: usize, event: Event) {
        self.add(
            Of::Events,
            &format!("{event:?} told a frame late"),
            at,
            |tail| {
                let (events, slips) = (std::mem::take(&mut tail[0].events), tail[0].slips);
                tail[0].slips = 0;
                tail[1].events.splice(0..0, events);
                tail[1].slips += slips;
            },
        );
        self.add(
            Of::Events,
            &format!("{event:?} told a frame early"),
            at - 1,
            |tail| {
                let (events, slips) = (std::mem::take(&mut tail[1].events), tail[1].slips);
                tail[1].slips = 0;
                tail[0].events.extend(events);
                tail[0].slips += slips;
            },
        );
        if event == Event::Slip && self.truth.frames[at].slips == 1 {
            for count in [2, 3] {
                self.add(
                    Of::Events,
                    &format!("1 slip counted as {count}"),
                    at,
                    |tail| {
                        tail[0].slips = count;
                    },
                );
            }
            self.add(Of::Events, "slip called a slide", at, |tail| {
                (tail[0].slips, tail[0].events) = (0, vec![Event::Slide, Event::Stop]);
            });
        }
    }

    fn laws(&mut self) {
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
        let told = 2.0 * self.truth.number.bounds().residual * largest(&self.truth.frames[at]);
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
            ("N + 1 %", &|frame| frame.contacts[0].normal *= 1.01),
            ("a wrench + 0.5 %", &|frame| {
                frame.wrench.iter_mut().for_each(|x| *x *= 1.005)
            }),
            ("inside by 10⁻⁴ L", &|frame| {
                frame.pose[1] -= 1e-4 * size
            }),
            ("beside by 10⁻⁴ L", &|frame| {
                frame.pose[0] += 1e-4 * size
            }),
            ("turned by 10⁻⁴", &|frame| frame.pose[2] += 1e-4),
            ("a point off by 10⁻⁵ L", &|frame| {
                frame.contacts[0].point[0] += 1e-5 * size
            }),
            ("the hand off by 10⁻³ L", &|frame| {
                frame.hand[0] += 1e-3 * size
            }),
            ("a direction of friction turned", &|frame| {
                let rubs = |c: &&mut Contact| c.friction.abs() > told;
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
            ("slides told", &|frame| {
                let rubs = |c: &&mut Contact| c.friction.abs() > told;
                for contact in frame.contacts.iter_mut().filter(rubs) {
                    contact.sliding = contact
                        .sliding
                        .map(|sign| if sign == 0 { 1 } else { -sign });
                }
            }),
            ("a number missing", &|frame| frame.wrench[1] = f64::NAN),
        ];
        for (name, change) in faults {
            self.add(Of::Laws, name, at, |tail| change(&mut tail[0]));
        }
        self.add(Of::Laws, "all forces + 0.1 %", at, |tail| {
            tail.iter_mut().for_each(|frame| all(frame, 1.001));
        });
        self.add(Of::Laws, "two frames changed places", at, |tail| {
            tail.swap(0, 1)
        });
    }

    /// A contact that sticks goes with the hand, by some roundings in a frame, and its springs are wound no more than before.
    fn creeps(&mut self, at: usize) {
        let first = &self.truth.frames[at];
        let sticks = first.contacts.iter().all(|c| c.sliding == Some(0));
        if !sticks || !matches!(first.state, State::SingleVertex | State::Edge) {
            return;
        }
        let size = size(&self.truth.scene);
        for (name, step) in [
            ("creep by 10⁻⁶ L a frame", 1e-6),
            ("creep by 10⁻⁷ L a frame", 1e-7),
        ] {
            let truth = self.truth;
            self.add(Of::Laws, name, at, |tail| {
                let quiet = tail
                    .iter()
                    .take_while(|frame| frame.events.is_empty())
                    .count();
                tail.truncate(quiet.max(1));
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
        // As the body turns, its contact gives way more than the springs alone.
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
        let told =
            2.0 * (1.0 + turning) * (bounds.slip * largest(last).max(largest(next))).max(rounding);
        for (name, part) in [
            ("0.1 % short", -1e-3),
            ("0.1 % long", 1e-3),
            ("1 % short", -1e-2),
        ] {
            // What forces do not tell from rounding is none.
            let force = part * length * truth.scene.stiffness_translation;
            if force.abs() < told {
                continue;
            }
            self.add(Of::Laws, &format!("a slip {name}"), at, |tail| {
                tail[0] = moved(truth, &tail[0], part * length);
                tail.truncate(1);
            });
            self.add(
                Of::Laws,
                &format!("a slip {name}, and all after it"),
                at,
                |tail| {
                    let quiet = tail[1..]
                        .iter()
                        .take_while(|frame| frame.events.is_empty())
                        .count();
                    tail.truncate(1 + quiet);
                    for frame in tail.iter_mut() {
                        *frame = moved(truth, frame, part * length);
                    }
                },
            );
        }
        let is_next_quiet = truth.frames[at + 1].events.is_empty();
        if is_next_quiet {
            self.add(Of::Laws, "a slip a frame late", at, |tail| {
                let mut late = loaded(truth, &frozen(last, next));
                (late.events, late.slips) = (Vec::new(), 0);
                (tail[1].events, tail[1].slips) = (tail[0].events.clone(), 1);
                tail[0] = late;
            });
        }
        if truth.frames[at - 1].events.is_empty() && at > 2 {
            self.add(Of::Laws, "a slip a frame early", at - 1, |tail| {
                let mut early = loaded(truth, &frozen(&tail[1], &tail[0]));
                (early.events, early.slips) = (tail[1].events.clone(), 1);
                (tail[1].events, tail[1].slips) = (Vec::new(), 0);
                tail[0] = early;
            });
        }
    }

    fn statuses(&mut self) {
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
                self.add(
                    Of::Statuses,
                    &format!("{status:?}: nothing told"),
                    at,
                    |tail| {
                        tail[0].status = status;
                        (tail[0].events, tail[0].slips) = (Vec::new(), 0);
                    },
                );
            }
        }
    }

    /// The body does not move any more, or is out of balance, and a status says why.
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
            self.add(Of::Statuses, &format!("{status:?}: frozen"), at, |tail| {
                stays(tail, false)
            });
            self.add(
                Of::Statuses,
                &format!("{status:?}: frozen, with springs"),
                at,
                |tail| {
                    stays(tail, true);
                },
            );
        }
        if !truth.frames[at].contacts.is_empty() {
            self.add(
                Of::Statuses,
                &format!("{status:?}: out of balance"),
                at,
                |tail| {
                    tail[0].status = status;
                    let unit = size(&truth.scene) * truth.scene.stiffness_translation;
                    tail[0].contacts[0].normal += 0.01 * unit;
                },
            );
        }
    }
}

/// How far the body gets from where it was (m).
fn distance(last: &Frame, frames: &[Frame]) -> f64 {
    let ways = frames
        .iter()
        .map(|f| (f.pose[0] - last.pose[0]).hypot(f.pose[1] - last.pose[1]));
    ways.fold(0.0, f64::max)
}

/// The largest force of a frame (N).
fn largest(frame: &Frame) -> f64 {
    let forces = frame.contacts.iter().map(|c| c.normal.hypot(c.friction));
    forces.fold(frame.wrench[0].hypot(frame.wrench[1]), f64::max)
}

/// Nothing happens, as before and after.
fn is_quiet(frames: &[Frame], i: usize) -> bool {
    let quiet = |frame: &Frame| frame.events.is_empty() && frame.held && frame.status == Status::Ok;
    quiet(&frames[i - 1])
        && quiet(&frames[i])
        && quiet(&frames[i + 1])
        && is_still_there(&frames[i - 1], &frames[i])
}

fn is_still_there(last: &Frame, next: &Frame) -> bool {
    let touches = |frame: &Frame| frame.contacts.iter().map(|c| c.touch).collect::<Vec<_>>();
    touches(last) == touches(next)
}

fn slide(frame: &Frame) -> bool {
    frame.contacts.iter().any(|c| c.sliding != Some(0))
}

fn by_count(frame: &Frame) -> State {
    match frame.contacts.as_slice() {
        [] => State::NonContact,
        [_] => State::SingleVertex,
        [a, b] if a.touch == b.touch => State::Edge,
        [_, _] => State::TwoVertex,
        _ => State::Locked,
    }
}

pub(crate) fn size(scene: &Scene) -> f64 {
    stiction_judge::size(&scene.vertices)
}

/// How far the first contact went along its tangent (m).
fn slipped(truth: &Truth, last: &Frame, next: &Frame) -> f64 {
    let [a, b]: [&Contact; 2] = [&last.contacts[0], &next.contacts[0]];
    let tangent = crate::physics::tangent(truth, b);
    let by = [0, 1].map(|k| b.point[k] - a.point[k]);
    match b.touch {
        stiction_judge::Touch::Corner { .. } => 0.0,
        _ => tangent[0] * by[0] + tangent[1] * by[1],
    }
}
