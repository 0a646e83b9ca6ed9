//! At the frozen hand one contact or two slide on to mu_d N (STATICS 11).

use crate::contact::{Contact, Sense};
use crate::errand::{Next, Stage};
use crate::event::{Event, Status};
use crate::events::{Ending, Watch, Which};
use crate::modes::{Mode, Pressing};
use crate::motion::{Kind, Motion, Spot};
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::step::Step;
use crate::thresholds::Thresholds;

/// At most so many searches make a slip.
const RUNS: u8 = 16;
/// At most so many make a slip of two contacts. Each goes as far as a fifth of |g|/H (E14), and leaves 7/8 or less of the angle that is left
/// to parallel normals or to one line: so many lead from 1 rad to 2^-10.
const RUNS_OF_PAIR: u8 = 64;

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// A slip begins, in a sense of the first contact.
    pub(crate) fn slip(&mut self, sense: Sense) {
        self.errand.runs = 0;
        self.errand.foot = self.body.foot;
        if self.body.contacts.len() < 2 || !self.statics.has_pairs() {
            return self.slide_on(sense);
        }
        let statics = self.statics;
        let pair = self.body.contacts.pair();
        let motion = if statics.is_edge(&self.body.contacts) {
            let hand = self.body.hand;
            if statics.slides_straight(self.body, sense, &hand) {
                let is_pressed = self.is_pressed();
                let next = self.stopped_together(pair.map(|c| c.with(sense)), true, is_pressed);
                return self.settled(next);
            }
            statics.pair_along(self.body, HandPose::REST, sense)
        } else {
            let driven = |pressing| statics.driven(self.body, &self.body.hand, [0, 1], pressing);
            let always = driven(Pressing::Always);
            let Some(by) = always.or_else(|| driven(Pressing::AtBalance)) else {
                return self.settled(Next::Relax(Sense::Rests));
            };
            let mut m = statics.pair(self.body, HandPose::REST, by.direction);
            m.pair.pressed = always.is_some();
            m
        };
        self.slide_together(Motion {
            frozen: true,
            ..motion
        });
    }

    /// One contact.
    fn slide_on(&mut self, sense: Sense) {
        self.errand.runs = self.errand.runs.saturating_add(1);
        if self.errand.runs > RUNS {
            self.log.limit(Status::IterationLimit);
            return self.settled(Next::Rest);
        }
        let mut m = Motion::slip(self.body, sense.number());
        let begin = self.statics.placed_at_start(&m);
        let load = self.statics.present_load(self.body);
        if begin.e.abs() > R::of_lasting_moment(load.size()) {
            m.lasting = begin.e;
        } else if self.statics.slips_shortly(self.body, sense, (&m, &begin)) {
            self.errand.search.motion.lasting = R::ZERO;
            return self.slipped(sense, Ending::Stopped);
        }
        let end = load.force.length_bound() + R::TWO;
        self.run(Stage::Slip(sense), m, Watch::Slip(sense), end, true);
    }
    /// A slip of one contact has ended.
    pub(crate) fn slipped(&mut self, sense: Sense, ending: Ending) {
        let next = match ending {
            Ending::Stopped => self.stopped(sense),
            Ending::Touch(feature) => {
                self.touch(feature);
                Next::Relax(sense)
            }
            Ending::Ends(_) => {
                if self.hand_on(0, sense) {
                    self.handed(sense)
                } else {
                    return self.slide_on(sense);
                }
            }
            Ending::Clear => {
                self.log.event(Event::Lift);
                self.lift();
                Next::Relax(Sense::Rests)
            }
            Ending::Fold => {
                // The foot a little further: the branch has ended.
                self.log.event(Event::Snap);
                let little = R::TOUCH * R::from_int(16);
                let mut beyond = *self.body;
                beyond.foot = beyond.foot + sense.along(little);
                self.statics.stand(&mut beyond);
                self.moves_clear(&beyond);
                Next::Relax(Sense::Rests)
            }
            Ending::End
            | Ending::GoesOn
            | Ending::Yields(_)
            | Ending::Pressed
            | Ending::Halt
            | Ending::Opens(_)
            | Ending::GivesWay => return self.slide_on(sense),
        };
        self.settled(next);
    }
    /// At mu_d N: stiction where N >= N*, otherwise the contact slides on (R30).
    fn stopped(&mut self, sense: Sense) -> Next {
        let is_pressed = self.is_pressed();
        let length = self.body.foot - self.errand.foot;
        if self.body.stiction || is_pressed && length.abs() > R::MICRO {
            self.log.slip(length);
        }
        self.body.stiction = is_pressed;
        if self.errand.search.motion.lasting != R::ZERO {
            return self.relax_after(length, sense);
        }
        if !is_pressed {
            self.body.contacts.slide(sense);
            self.seat_slide(&Motion::frozen(Kind::Slide, self.body));
        }
        Next::Rest
    }

    /// N >= N* of one contact, or of two in one line.
    fn is_pressed(&self) -> bool {
        let [normal, _] = self.statics.reaction(self.body);
        let friction = self.statics.friction(self.body.contacts.first());
        friction.is_pressed(normal)
    }

    /// Two contacts.
    fn slide_together(&mut self, motion: Motion<R>) {
        self.errand.runs = self.errand.runs.saturating_add(1);
        if self.errand.runs > RUNS_OF_PAIR {
            self.log.limit(Status::IterationLimit);
            return self.settled(Next::Relax(Sense::Rests));
        }
        let load = self.statics.present_load(self.body);
        let end = (load.force.length_bound() + R::from_int(4)).min(motion.pair.reach);
        self.run(Stage::Joint, motion, Watch::JointSlip, end, true);
    }
    /// A slip of two has ended at a place along it.
    pub(crate) fn slipped_together(&mut self, m: &Motion<R>, (ending, u): (Ending, R)) {
        if !self.statics.has_pairs() {
            return;
        }
        let senses = m.contacts.map(|c| c.sense);
        let [sense, _] = senses;
        let next = match ending {
            Ending::Stopped => {
                let is_pressed = if m.pair.even {
                    self.is_pressed()
                } else {
                    let end = Spot { u, p: R::ZERO };
                    self.statics.has_stiction(m, &self.statics.placed(m, end))
                };
                self.stopped_together(m.contacts, m.pair.pressed, is_pressed)
            }
            Ending::Touch(feature) => {
                self.touch(feature);
                Next::Relax(sense)
            }
            Ending::Ends(which) => {
                self.body.contacts.slide_pair(senses);
                let [first, second] = senses;
                self.hand_on(which.index(), which.of([first, second]));
                self.handed(self.body.contacts.first().sense)
            }
            Ending::Opens(which) => match self.opens_in_slip(m, which) {
                Some(next) => next,
                None => return,
            },
            Ending::End | Ending::GoesOn | Ending::Halt => match self.again(m) {
                Some(on) => return self.slide_together(on),
                // Nothing drives it on.
                None => {
                    let length = self.body.foot - self.errand.foot;
                    if self.body.stiction {
                        self.log.slip(length);
                    }
                    self.relax_after(length, sense)
                }
            },
            Ending::Fold
            | Ending::Yields(_)
            | Ending::Clear
            | Ending::Pressed
            | Ending::GivesWay => Next::Relax(Sense::Rests),
        };
        self.settled(next);
    }
    /// A slip of this length has ended out of balance. What has no stiction then has slid, even if it comes to rest.
    fn relax_after(&mut self, length: R, sense: Sense) -> Next {
        self.errand.slid_to_rest |= !self.body.stiction && length.abs() > R::MICRO;
        Next::Relax(sense)
    }
    /// In balance, after a slip of two with their senses: they stick if they have enough for stiction, `is_pressed`, otherwise they slide on
    /// (R31). `counted`: their reactions on the way.
    fn stopped_together(
        &mut self,
        contacts: [Contact; 2],
        counted: bool,
        is_pressed: bool,
    ) -> Next {
        let [first, second] = contacts;
        let statics = self.statics;
        let mut sliding = *self.body;
        sliding.contacts.slide_pair(contacts.map(|c| c.sense));
        let is_even = statics.is_even(first, second);
        let presses = if is_even {
            counted
        } else {
            self.press_in_balance(&sliding)
        };
        let length = self.body.foot - self.errand.foot;
        if self.body.stiction || is_pressed {
            self.log.slip(length);
        }
        self.body.stiction = is_pressed;
        if !presses {
            return self.relax_after(length, first.sense);
        }
        if !is_pressed {
            self.body.contacts = sliding.contacts;
            if !is_even {
                let m = statics.sliding_pair(self.body, HandPose::REST);
                self.seat_slide(&Motion { frozen: true, ..m });
            }
        }
        Next::Rest
    }
    /// Two contacts that slide press in the balance where they have come: on the way their reactions may not have counted, and over a short
    /// lever a pull is too small to be seen. Those in one line are not pulled in what is reported (E20).
    fn press_in_balance(&self, sliding: &Body<R>) -> bool {
        let (reactions, over) = self.statics.sliding_shares(sliding);
        let known = self.statics.rounding(sliding) / over;
        reactions.iter().all(|&[n, _]| n >= -known)
    }
    /// A reaction has vanished on the way: its contact opens if its gap does, otherwise reactions count at balance only (R31).
    fn opens_in_slip(&mut self, m: &Motion<R>, which: Which) -> Option<Next> {
        let lasts = which.other();
        let contact = lasts.index();
        let lasting = lasts.of(m.contacts);
        let turn = Mode::Turn {
            about: contact,
            with: None,
        };
        let slide = Mode::Slide {
            contact,
            sense: lasting.sense,
        };
        let modes: &[Mode] = if lasting.sense.slides() {
            &[turn, slide]
        } else {
            &[turn]
        };
        let gap_opens = modes.iter().any(|mode| {
            let rate = (self.statics).opening(self.body, &self.body.hand, mode, Pressing::Always);
            rate.is_some_and(|rate| rate > R::in_plane())
        });
        if !gap_opens || m.pair.line && self.is_shut(m, which) {
            let mut free = *m;
            free.pair.pressed = false;
            if let Some(on) = self.again(&free) {
                self.slide_together(on);
                return None;
            }
        }
        let before = self.statics.kind(&self.body.contacts);
        self.statics.lead(self.body, contact);
        self.body.contacts.keep(&[lasting.with(Sense::Rests)]);
        self.body.forget();
        self.log
            .open(before, self.statics.kind(&self.body.contacts));
        Some(Next::Relax(lasting.sense))
    }
    /// A contact in one line with another that is pulled as their slip begins, less and less: where a turn about the other is in balance its
    /// gap is still closed.
    fn is_shut(&self, m: &Motion<R>, which: Which) -> bool {
        let pair = self.statics.placed_at_start(m);
        let pull = which.of(self.statics.shares_ahead(self.body, m, &pair));
        let mut leading = *self.body;
        self.statics.lead(&mut leading, which.other().index());
        let turn = (self.statics).placed_at_start(&Motion::frozen(Kind::Pin, &leading));
        let gap = turn.e.abs() * (pair.r2 - pair.r).length_bound();
        pull.d > R::ZERO && gap <= -(turn.e_u * R::TOUCH)
    }
    /// The slip of two from here on, in the same direction, if it is driven.
    fn again(&self, m: &Motion<R>) -> Option<Motion<R>> {
        let make = |direction| self.statics.pair(self.body, m.hand_p, direction);
        let mut next = make(R::ONE);
        if next.pair.twist.dot(m.pair.twist) < R::ZERO {
            next = make(-R::ONE);
        }
        next.frozen = true;
        next.pair.pressed = m.pair.pressed;
        let i = self.statics.placed_at_start(&next);
        let drag = self.statics.shares(&next, &i).drag;
        (i.e > R::ZERO && drag > R::ZERO).then_some(next)
    }
}
