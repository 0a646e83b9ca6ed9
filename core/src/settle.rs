//! At the frozen hand, to rest: each round does one word and finds the next (STATICS 11).

use crate::contact::{Contact, Sense};
use crate::errand::{Next, Stage};
use crate::event::{Event, Status};
use crate::events::Ending;
use crate::modes::{Mode, Picked, Pressing};
use crate::motion::{Kind, Motion, Spot};
use crate::real::Real;
use crate::state::{Freedom, HandPose};
use crate::step::Step;
use crate::thresholds::Thresholds;

/// After so many words no consistent motion is left.
const ROUNDS: u8 = 64;

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// The next word.
    #[inline(never)]
    pub(crate) fn settle(&mut self) {
        let settling = &mut self.errand.settling;
        settling.rounds = settling.rounds.saturating_add(1);
        if settling.rounds > ROUNDS {
            self.log.limit(Status::Ambiguous);
            self.errand.stage = Stage::Still;
            return;
        }
        (settling.holding, settling.angle) = (self.body.holding, self.body.angle);
        match settling.next {
            Next::Rest => {
                self.renew();
                self.log.jammed = self.statics.free_of_jam(self.body, R::ZERO).is_none();
                self.errand.stage = Stage::Still;
            }
            Next::Slip(sense) => self.slip(sense),
            Next::Give => self.give(),
            Next::Relax(sense) => self.relax(sense),
        }
    }
    /// A word has been done.
    pub(crate) fn settled(&mut self, next: Next) {
        let settling = &mut self.errand.settling;
        let way = (self.body.holding - settling.holding).length_bound();
        if way + (self.body.angle - settling.angle).abs() > R::MICRO {
            settling.ranking = Default::default();
        }
        settling.next = next;
        self.errand.stage = Stage::Settle;
    }
    /// A single contact or an edge that sticks has stiction if it is pressed hard enough (R24).
    fn renew(&mut self) {
        let contacts = &self.body.contacts;
        let first = contacts.first();
        let is_one = contacts.len() == 1 || self.statics.is_edge(contacts);
        if self.body.stiction || first.sense.slides() || !is_one {
            return;
        }
        let [normal, _] = self.statics.reaction(self.body);
        self.body.stiction = self.statics.friction(first).is_pressed(normal);
    }

    fn relax(&mut self, sense: Sense) {
        self.body.contacts.rest();
        self.body.slack = R::ZERO;
        let little = self.statics.rounding(self.body);
        match self.statics.freedom(self.body) {
            Freedom::Free => self.fly(sense),
            Freedom::Turns => {
                let m = Motion::frozen(Kind::Pin, self.body);
                if !self.seat(&m, little) {
                    self.errand.runs = 0;
                    return self.turn(Stage::Relax(sense));
                }
                let next = self.stood(sense);
                self.settled(next);
            }
            Freedom::Slides | Freedom::Together | Freedom::Fixed => {
                if !sense.slides() {
                    self.renew();
                }
                let next = if sense.slides() && self.is_driven_on(sense, little) {
                    Next::Slip(sense)
                } else if self.statics.bears(self.body, little) {
                    Next::Rest
                } else {
                    Next::Give
                };
                self.settled(next);
            }
        }
    }
    /// To balance, if the way there cannot be distinguished and leads into nothing. Whether the body is in balance, but for `little`.
    pub(crate) fn seat(&mut self, m: &Motion<R>, little: R) -> bool {
        let mut i = self.statics.placed_at_start(m);
        if i.e.abs() <= little {
            return true;
        }
        let (from, step) = (i.u, -i.e / i.e_u);
        if i.e_u >= R::ZERO || step.abs() > R::MICRO {
            return false;
        }
        let spot = Spot {
            u: from,
            p: R::ZERO,
        };
        self.statics.balance(m, spot, step, &mut i);
        let is_near = (i.u - from).abs() <= R::MICRO.doubled();
        let room = (self.body.room - R::MICRO.doubled()).max(R::ZERO);
        let mut there = *self.body;
        there.go_to(&i, room);
        is_near && self.moves_clear(&there)
    }
    /// A slide is in balance at its friction; the end of its slip only to the accuracy of a search.
    pub(crate) fn seat_slide(&mut self, m: &Motion<R>) {
        self.seat(m, R::ZERO);
    }
    /// Two contacts are driven on along a sense of the first (R29).
    fn is_driven_on(&self, sense: Sense, little: R) -> bool {
        let (body, statics) = (&*self.body, self.statics);
        if body.contacts.len() != 2 {
            return false;
        }
        if !statics.is_edge(&body.contacts) {
            let driven = statics.driven(body, &body.hand, [0, 1], Pressing::Always);
            return driven.is_some();
        }
        let [n, t] = statics.reaction(body);
        let cone = statics.friction(body.contacts.first()).sliding;
        let excess = -sense.along(t) * cone.cos - n * cone.sin;
        n > little && excess > little && self.bears_edge(sense)
    }
    /// Both ends of an edge that slides are pressed.
    fn bears_edge(&self, sense: Sense) -> bool {
        let m = self.statics.pair_along(self.body, HandPose::REST, sense);
        let i = self.statics.placed_at_start(&m);
        // A moment is known to its rounding; over a short edge that is more.
        let little = R::TOUCH + R::in_plane() / (i.r2 - i.r).length_bound();
        self.statics.shares(&m, &i).press_within(little)
    }
    /// A turn about the contact to balance or touch has ended.
    pub(crate) fn turned(&mut self, sense: Sense, ending: Ending) -> Next {
        if let Ending::Touch(feature) = ending {
            let mut start = *self.body;
            start.angle = self.errand.settling.angle;
            self.statics.stand(&mut start);
            start.forget();
            let contact = Contact::at(feature);
            let gap = self.statics.gap(contact, start.rotation, start.holding);
            // What comes to lie in its line does not block it.
            let is_flat = self.statics.is_in_line(contact, start.contacts.first());
            if sense.slides() && gap <= R::met_before() && !is_flat {
                *self.body = start;
                let next = self.stood(sense);
                if next != Next::Rest {
                    // It blocks the turn: the slip goes on.
                    return next;
                }
            }
            self.touch(feature);
            return Next::Relax(sense);
        }
        self.stood(sense)
    }
    /// In balance about contacts that stick.
    fn stood(&mut self, sense: Sense) -> Next {
        let little = self.statics.rounding(self.body);
        self.renew();
        if self.statics.has_wedges() && self.body.contacts.len() > 1 {
            let force = self.statics.present_load(self.body).force;
            return match self.statics.extreme_edges(self.body) {
                Some([low, high])
                    if low.cross(-force) < -little || (-force).cross(high) < -little =>
                {
                    Next::Give
                }
                Some(_) | None => Next::Rest,
            };
        }
        let [n, t] = self.statics.reaction(self.body);
        let friction = self.statics.friction(self.body.contacts.first());
        let sliding = friction.sliding;
        let excess = -sense.along(t) * sliding.cos - sliding.sin * n;
        if sense.slides() && n > little && excess > little {
            return Next::Slip(sense);
        }
        if n < -little {
            self.log.event(Event::Lift);
            self.lift();
            return Next::Relax(Sense::Rests);
        }
        let cone = friction.cone(self.body.stiction);
        if t.abs() * cone.cos - cone.sin * n > little {
            return Next::Slip(Sense::of(-t));
        }
        Next::Rest
    }

    /// The next motion that the load can begin.
    fn give(&mut self) {
        if !self.statics.has_pairs() {
            return;
        }
        let ranking = &mut self.errand.settling.ranking;
        let mode = match self.statics.pick(self.body, &self.body.hand, ranking) {
            Picked::More => {
                let settling = &mut self.errand.settling;
                settling.rounds = settling.rounds.saturating_sub(1);
                return;
            }
            Picked::Mode(mode) => mode,
            Picked::None => return self.take_back(),
        };
        ranking.strike(self.statics.begun(self.body, &mode));
        ranking.restart();
        let next = match mode {
            Mode::Lift => {
                self.log.event(Event::Lift);
                self.lift();
                Next::Relax(Sense::Rests)
            }
            Mode::Turn { .. } => Next::Relax(Sense::Rests),
            Mode::Slide { sense, .. } => Next::Relax(sense),
            Mode::Joint { senses, .. } => {
                let [sense, _] = senses;
                Next::Slip(sense)
            }
        };
        if mode != Mode::Lift {
            self.keep(&mode);
        }
        self.settled(next);
    }
    /// No motion is left: contacts that were let go are taken back, to try others.
    fn take_back(&mut self) {
        let body = *self.body;
        let statics = self.statics;
        let closed = statics.closed(&body, R::TOUCH).next();
        let closed = if C > 0 {
            closed.or_else(|| statics.closed_obstacle(&body, R::TOUCH))
        } else {
            closed
        };
        if let Some(feature) = closed {
            self.touch(feature);
            if self.body.contacts.len() > body.contacts.len() {
                self.errand.settling.ranking.restart();
                return self.settled(Next::Relax(Sense::Rests));
            }
        }
        if !statics.bears(self.body, statics.left_at_rest(self.body)) {
            self.log.limit(Status::Ambiguous);
        }
        self.settled(Next::Rest);
    }
    /// Only the contacts of a motion remain.
    pub(crate) fn keep(&mut self, mode: &Mode) {
        let before = self.statics.kind(&self.body.contacts);
        let contacts = self.body.contacts;
        let (lead, other) = match *mode {
            Mode::Lift => return,
            Mode::Turn { about, with } => (about, with),
            Mode::Slide { contact, .. } => (contact, None),
            Mode::Joint {
                contacts: [i, j], ..
            } => (i, Some(j)),
        };
        self.statics.lead(self.body, lead);
        let first = contacts.get(lead);
        match other {
            Some(other) => self.body.contacts.keep(&[first, contacts.get(other)]),
            None => self.body.contacts.keep(&[first]),
        }
        self.body.forget();
        if self.body.contacts.len() < contacts.len() {
            self.log
                .open(before, self.statics.kind(&self.body.contacts));
        }
    }
}
