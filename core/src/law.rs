//! The law (STATICS 11): what follows from the event that ended a motion on the hand's path. New signs, or settling at the frozen hand.

use crate::contact::Sense;
use crate::errand::{Next, Stage};
use crate::event::{Event, Status};
use crate::events::{Ending, Watch, Which};
use crate::modes::Mode;
use crate::motion::{Kind, Motion};
use crate::real::Real;
use crate::state::{Freedom, HandPose};
use crate::step::Step;
use crate::thresholds::Thresholds;
use crate::world::Friction;

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// The table: event and contacts -> new signs, or settling.
    #[inline(never)]
    pub(crate) fn happens(&mut self, ending: Ending) {
        self.body.slack = R::ZERO;
        match ending {
            Ending::End | Ending::GoesOn | Ending::Stopped => {}
            Ending::Touch(feature) => self.touches(feature),
            Ending::Ends(which) => self.leaves_side(which.index()),
            // (R24)
            Ending::Pressed => {
                self.body.contacts.rest();
                self.body.stiction = true;
            }
            Ending::Halt => self.halts(),
            Ending::Yields(sense) => self.yields(sense),
            Ending::Clear => self.clears(),
            Ending::Opens(which) => self.opens(which),
            Ending::GivesWay => self.gives_way(),
            Ending::Fold => {
                let kind = match self.statics.freedom(self.body) {
                    Freedom::Free => Kind::Free,
                    Freedom::Slides => Kind::Slide,
                    Freedom::Together => Kind::Pair,
                    Freedom::Turns | Freedom::Fixed => Kind::Pin,
                };
                self.snap(kind);
            }
        }
    }
    /// h_p, phi_p of the displacement under way.
    pub(crate) fn path(&self) -> HandPose<R> {
        self.errand.before.to(&self.errand.target).per_p
    }
    /// Friction of a stick gives way on the side of a slide.
    fn yields(&mut self, sense: Sense) {
        if self.body.stiction {
            // With stiction: a slip.
            return self.errand.settle(Next::Slip(sense));
        }
        // Without: a slide, unless it is not stable or would run back.
        let path = self.path();
        match self.statics.rates_as(self.body, sense, path) {
            None => {
                self.body.contacts.slide(sense);
                self.snap(Kind::Slide);
            }
            Some(rates) if sense.along(rates.xi) < -R::of_displacement(path.size()) => {
                self.body.hand = self.statics.released(self.body, &self.errand.target);
                self.errand.settle(Next::Relax(Sense::Rests));
            }
            Some(_) => self.body.contacts.slide(sense),
        }
    }
    /// A foot turns back: the contacts stick, without stiction. Nothing holds a single one without dynamic friction: its sign turns, which is
    /// a stop and a slide if it could stick.
    fn halts(&mut self) {
        let sense = self.body.contacts.first().sense;
        if self.statics.freedom(self.body) == Freedom::Slides && self.is_smooth() {
            // Its motion is the same: in frame evolution, too, the hand goes on (R40).
            self.errand.jumps = false;
            self.body.contacts.slide(sense.reversed());
            if self.first_friction().fixed.sin > R::ZERO {
                self.log.event(Event::Stop);
                self.log.event(Event::Slide);
            }
        } else {
            self.body.loosen();
        }
    }
    /// No dynamic friction at the first contact: its reaction is the same in both directions.
    fn is_smooth(&self) -> bool {
        self.first_friction().sliding.sin == R::ZERO
    }
    fn first_friction(&self) -> &Friction<R> {
        self.statics.friction(self.body.contacts.first())
    }
    /// The reaction of a single contact has vanished.
    fn clears(&mut self) {
        let m = Motion::new(Kind::Free, self.body, self.path());
        let i = self.statics.placed_at_start(&m);
        let rates = self.statics.rates(&m, &i);
        let contact = self.body.contacts.first();
        let frame = self
            .statics
            .frame(contact, self.body.rotation, self.body.holding);
        let opening = frame.opening(rates.g, rates.theta);
        if i.e_u >= R::ZERO || opening >= R::ZERO {
            self.log.event(Event::Lift);
            self.lift();
            if i.e_u >= R::ZERO && opening < R::ZERO {
                // The balance is not stable, and goes beyond the contact: from where it stays in front of that the body turns away from both.
                self.log.event(Event::Snap);
                let away = Sense::of(frame.opening(i.g_u, R::ONE));
                return self.errand.settle(Next::Relax(away));
            }
            // Both are in balance here. By a weak spring the angle is known less well than the moment: what is left it turns on the way.
            let is_there = (i.g - self.body.holding).length_bound() <= R::TOUCH;
            let is_balanced = i.moment.abs() <= R::TOUCH && i.e.abs() <= R::ahead();
            if !(is_there && is_balanced) {
                self.errand.settle(Next::Relax(Sense::Rests));
            }
        } else if contact.sense.slides() {
            self.body.loosen();
        } else {
            self.begin_by_rates();
        }
    }
    /// A reaction of two that slide has vanished: the other contact slides on.
    fn opens(&mut self, which: Which) {
        let before = *self.body;
        let lost = before.contacts.get(which.index());
        let lasting = which.other().of(before.contacts.pair());
        self.statics.lead(self.body, which.other().index());
        self.body.contacts.keep(&[lasting]);
        self.body.forget();
        self.log.open(
            self.statics.kind(&before.contacts),
            self.statics.kind(&self.body.contacts),
        );
        if !lasting.sense.slides() {
            self.body.stiction = false;
            return;
        }
        let rates = self.statics.rates_as(self.body, lasting.sense, self.path());
        let frame = self
            .statics
            .frame(lost, self.body.rotation, self.body.holding);
        let is_edge = self.statics.is_in_line(lost, lasting);
        let gap_opens = rates.map(|rates| frame.opening(rates.g, rates.theta) >= R::ZERO);
        match gap_opens {
            Some(opens) if opens || is_edge => {}
            // The slide of the one is not stable: nothing holds it without friction; otherwise it sticks, and snaps if friction gives way.
            None if self.is_smooth() => return self.snap(Kind::Slide),
            None if is_edge => return self.body.loosen(),
            Some(_) | None => {
                self.body.contacts.add(lost.feature);
                return self.body.loosen();
            }
        }
        let [normal, _] = self.statics.reaction(self.body);
        if self.statics.friction(lasting).is_pressed(normal) {
            self.body.contacts.rest();
            self.body.stiction = true;
        }
    }
    /// Contacts that fix the pose, or those of one vertex, do not bear the load any more.
    fn gives_way(&mut self) {
        let target = self.errand.target;
        let (ahead, before) = (self.body.hand.distance(&target), self.errand.gave_way);
        let is_again = self.errand.paths > 1 && (before - ahead).abs() <= R::TOUCH;
        let released = self.statics.released(self.body, &target);
        (self.errand.gave_way, self.errand.released) = (ahead, released);
        if self.body.contacts.turn_about_first() {
            self.body.hand = released;
            return self.errand.settle(Next::Relax(Sense::Rests));
        }
        self.errand.settle(Next::Give);
        if is_again {
            // What began there came back; it would again, without end.
            self.body.hand = released;
        } else {
            self.errand.stage = Stage::Yields;
        }
    }
    /// The motion that the hand begins at contacts that give way is known.
    pub(crate) fn begins(&mut self, mode: Option<Mode>) {
        if !self.statics.has_pairs() {
            return;
        }
        self.errand.stage = Stage::Still;
        self.body.forget();
        let begun = match mode {
            Some(mode @ Mode::Joint { senses, .. }) if self.body.stiction => {
                self.keep(&mode);
                let [sense, _] = senses;
                return self.errand.settle(Next::Slip(sense));
            }
            Some(Mode::Joint { contacts, senses }) if self.body.contacts.len() == 2 => {
                self.slide_begins(contacts, senses)
            }
            Some(mode @ Mode::Turn { with: None, .. }) => self.turn_begins(&mode),
            Some(Mode::Joint { .. } | Mode::Turn { .. } | Mode::Slide { .. } | Mode::Lift)
            | None => false,
        };
        if !begun {
            // It is known that they do not bear it with the hand a little further.
            self.body.hand = self.errand.released;
            self.errand.settle(Next::Give);
        }
    }
    /// Without stiction a slide of two begins without a jump, if a motion has the signs of the edges that bind (R26).
    fn slide_begins(&mut self, [i, _]: [usize; 2], senses: [Sense; 2]) -> bool {
        let mut leading = *self.body;
        self.statics.lead(&mut leading, i);
        let path = self.path();
        for direction in [R::ONE, -R::ONE] {
            let m = self.statics.pair(&leading, path, direction);
            let along = m.contacts.map(|c| c.sense);
            if along.iter().zip(senses).any(|(a, b)| a.opposes(b)) {
                continue;
            }
            let i = self.statics.placed_at_start(&m);
            let shares = self.statics.shares(&m, &i);
            let presses = shares.press() && self.statics.press_on(self.body, &m, &i);
            if i.e_u < R::ZERO && i.e_p > R::ZERO && presses {
                if self.statics.has_stiction(&m, &i) {
                    self.body.stiction = true;
                } else {
                    *self.body = leading;
                    self.body.contacts.slide_pair(along);
                }
                return true;
            }
        }
        false
    }
    /// A turn in balance about a contact inside its cone drops the others.
    fn turn_begins(&mut self, mode: &Mode) -> bool {
        let before = *self.body;
        self.keep(mode);
        let residual = self
            .statics
            .placed_at_start(&Motion::frozen(Kind::Pin, self.body))
            .e;
        let [n, t] = self.statics.reaction(self.body);
        let contact = self.body.contacts.first();
        let cone = self.statics.friction(contact).cone(self.body.stiction);
        let is_inside = t.abs() * cone.cos - n * cone.sin <= R::in_plane();
        let is_balanced = residual.abs() <= R::in_plane() && is_inside;
        // At zero reaction rates decide (R21).
        let presses = || self.statics.presses_by_rates(self.body, self.path());
        let begins = is_balanced && (n > R::in_plane() || presses());
        if !begins {
            *self.body = before;
        }
        begins
    }

    /// Over a fold: the hand so much further that the drive is more than its rounding, then along u to the next balance.
    fn snap(&mut self, kind: Kind) {
        self.log.event(Event::Snap);
        let way = self.errand.before.to(&self.errand.target);
        let sense = self.body.contacts.first().sense;
        let (mut drive, mut runs_back) = (R::ONE, false);
        if self.statics.is_pair(kind) {
            let m = self.statics.sliding_pair(self.body, way.per_p);
            drive = self.statics.placed_at_start(&m).e_p;
        } else if kind != Kind::Free && !self.statics.grip.swings {
            let m = Motion::new(kind, self.body, way.per_p);
            let i = self.statics.placed_at_start(&m);
            drive = i.e_p;
            runs_back = !self.is_smooth() && sense.along(i.xi_u * drive) < R::ZERO;
        }
        let known = R::in_plane() / drive.abs().max(R::EPSILON);
        let p = (R::TOUCH * R::from_int(16) * way.whole).max(known.min(way.whole));
        self.body.hand = self.body.hand.moved(&way.per_p, p);
        if self.statics.is_pair(kind) {
            let sense = if sense.slides() { sense } else { Sense::Plus };
            return self.errand.settle(Next::Slip(sense));
        }
        if runs_back || kind == Kind::Slide && self.is_led_inside() {
            // The foot would move against its friction, or with the hand into something: it slips on at the angle that holds it in balance.
            self.body.contacts.rest();
            return self.errand.settle(Next::Relax(sense));
        }
        self.errand.runs = 0;
        self.turn(Stage::Snap(kind));
    }
    /// A turn over a fold has ended.
    pub(crate) fn snapped(&mut self, kind: Kind, ending: Ending) {
        let slides = kind == Kind::Slide;
        let sense = if slides {
            self.body.contacts.first().sense
        } else {
            Sense::Rests
        };
        if let Ending::Touch(feature) = ending {
            self.touch(feature);
            return self.errand.settle(Next::Relax(sense));
        }
        if let Ending::Ends(which) = ending {
            // Beyond the end where the foot is.
            let contact = self.body.contacts.get(which.index());
            let beyond = self.statics.beyond(contact, self.body.at());
            self.hand_on(which.index(), beyond);
            let next = self.handed(sense);
            return self.errand.settle(next);
        }
        if ending == Ending::Clear {
            self.log.event(Event::Lift);
            self.lift();
        } else if slides {
            self.errand.stage = Stage::Still;
            return;
        }
        self.errand.settle(Next::Relax(Sense::Rests));
    }
    /// At the frozen hand along the angle in the direction of the residual, to balance or touch; without contact with more than rounding, as the
    /// hand turns: until it has turned by that much it may lead the body far along.
    pub(crate) fn turn(&mut self, stage: Stage) {
        self.errand.runs = self.errand.runs.saturating_add(1);
        let kind = if let Stage::Snap(kind) = stage {
            kind
        } else {
            Kind::Pin
        };
        let mut m = Motion::frozen(kind, self.body);
        if kind == Kind::Free {
            m.lasting = -(R::in_plane() * self.path().angle.sign());
        }
        let i = self.statics.placed_at_start(&m);
        let mut e = i.e;
        if kind == Kind::Slide && e.abs() <= self.statics.rounding(self.body) {
            // Next to a balance that is not stable the foot moves in its sense.
            e = m.first().sense.along(i.xi_u);
        }
        let is_lost = self.errand.runs > 8;
        if is_lost {
            self.log.limit(Status::IterationLimit);
        }
        if e == R::ZERO || is_lost {
            if let Stage::Relax(sense) = stage {
                let next = self.turned(sense, Ending::Stopped);
                return self.settled(next);
            }
            return self.snapped(kind, Ending::Stopped);
        }
        let watch = if kind == Kind::Slide {
            Watch::Topple
        } else {
            Watch::Turn
        };
        self.run(stage, m, watch, R::from_int(100), true);
        self.errand.search.toward(e.sign());
    }
}
