//! Events that did not happen, or that are omitted or misreported.

use stiction_judge::{Event, Frame, State};

use super::{BESIDE, Maker, Of, by_count, is_quiet, slide};

/// All but those of the hand.
fn of_contacts() -> impl Iterator<Item = Event> {
    let of_hand = |event: &Event| matches!(event, Event::Grasp | Event::Release);
    (Event::ALL.into_iter()).filter(move |event| !of_hand(event))
}

impl Maker<'_> {
    pub(super) fn events(&mut self) {
        self.of = Of::Events;
        for state in State::ALL {
            for slides in [false, true] {
                let quiet = |frames: &[Frame], i: usize| {
                    is_quiet(frames, i) && frames[i].state == state && slide(&frames[i]) == slides
                };
                for at in self.places(quiet) {
                    self.invented(at, state, slides);
                }
            }
        }
        for event in Event::ALL {
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
                self.add(&format!("{by:+} slips of several{beside}"), at, |tail| {
                    tail[0].slips = tail[0].slips.saturating_add_signed(by);
                });
            }
        }
    }

    /// An event is reported for a frame in which nothing happens.
    fn invented(&mut self, at: usize, state: State, slides: bool) {
        let how = if slides { "sliding " } else { "" };
        for event in of_contacts() {
            self.add(
                &format!("invented {event:?} in {how}{state:?}"),
                at,
                |tail| {
                    tail[0].events.push(event);
                    tail[0].slips += u32::from(event == Event::Slip);
                },
            );
        }
        self.add(&format!("a slip counted in {how}{state:?}"), at, |tail| {
            tail[0].slips = 1;
        });
        self.add(&format!("a contact gone in {how}{state:?}"), at, |tail| {
            tail[0].contacts.pop();
            tail[0].state = by_count(&tail[0]);
        });
    }

    /// An event is reported differently.
    fn changed(&mut self, at: usize, event: Event) {
        let alone = self.truth.frames[at].events.len() == 1;
        let beside = if alone { "" } else { BESIDE };
        let name = format!("{event:?}{beside}");
        self.add(&format!("{name} not reported"), at, |tail| {
            tail[0].events.retain(|&reported| reported != event);
            if event == Event::Slip {
                tail[0].slips = 0;
            }
        });
        self.add(
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
        self.add(&format!("{name} called {other:?}"), at, |tail| {
            for reported in tail[0]
                .events
                .iter_mut()
                .filter(|reported| **reported == event)
            {
                *reported = other;
            }
        });
        if event == Event::Slip {
            self.add("slips not counted", at, |tail| tail[0].slips = 0);
        }
    }

    /// The only event of a frame is reported at another time, or counted differently.
    fn moved_event(&mut self, at: usize, event: Event) {
        self.add(&format!("{event:?} reported a frame late"), at, |tail| {
            let (events, slips) = (std::mem::take(&mut tail[0].events), tail[0].slips);
            tail[0].slips = 0;
            tail[1].events.splice(0..0, events);
            tail[1].slips += slips;
        });
        self.add(
            &format!("{event:?} reported a frame early"),
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
                self.add(&format!("1 slip counted as {count}"), at, |tail| {
                    tail[0].slips = count;
                });
            }
            self.add("slip called a slide", at, |tail| {
                (tail[0].slips, tail[0].events) = (0, vec![Event::Slide, Event::Stop]);
            });
        }
    }
}
