//! One step: along the hand's displacement from event to event; at a jump the body settles at the frozen hand.

use crate::calm::Calm;
use crate::cone::Borne;
use crate::contact::Sense;
use crate::errand::{Errand, Next, Stage};
use crate::event::{Event, Status};
use crate::events::{Ending, Watch};
use crate::evolution::Evolution;
use crate::log::Log;
use crate::modes::Picked;
use crate::motion::{Factor, Kind, Motion};
use crate::real::Real;
use crate::search::{Ended, Windows};
use crate::state::{Body, Displacement, Freedom, HandPose};
use crate::world::Statics;

/// After so many paths since it caught up the hand jumps.
const PATHS: u8 = 128;

/// A step: the body, what is under way, and what happens.
pub(crate) struct Step<'a, R, const V: usize, const S: usize, const C: usize> {
    pub(crate) statics: &'a Statics<'a, R, V, S, C>,
    pub(crate) body: &'a mut Body<R>,
    pub(crate) errand: &'a mut Errand<R>,
    pub(crate) log: &'a mut Log<R>,
    pub(crate) evolution: Evolution,
    /// The most pieces.
    pub(crate) budget: u32,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// Follows the hand to a pose where it is not yet, as far as `more` and the budget permit: between two pieces. What is under way goes on
    /// with the next step. Returns whether it is done.
    pub(crate) fn follow_to(&mut self, to: HandPose<R>, more: &mut impl FnMut() -> bool) -> bool {
        let mut is_done = false;
        // A new sample turns the path from where it is certain; an event or a motion under way is finished first.
        if matches!(self.errand.stage, Stage::Path) && self.errand.target != to {
            self.turn_path();
            is_done = self.is_done(&to);
        }
        while !is_done {
            // At least one piece, so that the body makes progress.
            self.piece(to, more);
            is_done = self.is_done(&to);
            if !is_done && !self.may_go_on(more) {
                return false;
            }
        }
        // A corner, whose load goes on changing while the body turns about it, is asked at the end.
        let is_corner =
            self.body.contacts.len() > 1 && self.statics.freedom(self.body) == Freedom::Turns;
        let is_wedged = is_corner && self.statics.free_of_jam(self.body, R::ZERO).is_none();
        if self.log.jammed || is_wedged {
            self.log.limit(Status::Jammed);
        }
        true
    }
    fn may_go_on(&self, more: &mut impl FnMut() -> bool) -> bool {
        self.log.work < self.budget && more()
    }
    fn is_done(&self, to: &HandPose<R>) -> bool {
        self.errand.is_still() && self.body.hand == *to
    }
    /// The path ends where it is certain, if that is beyond its beginning. Not compiled into its caller, whose stack lies under all others.
    #[inline(never)]
    fn turn_path(&mut self) {
        let search = &mut self.errand.search;
        let mut windows = Windows::NONE;
        let Some(instant) = search.certain(self.statics, self.body, &mut windows) else {
            return;
        };
        self.body.hand = search.motion.hand_at(instant.p);
        self.statics.bring(self.body, instant, R::ZERO);
        self.errand.stage = Stage::Still;
    }

    /// The smallest part of a step that leaves plain data behind.
    fn piece(&mut self, to: HandPose<R>, more: &mut impl FnMut() -> bool) {
        self.log.work = self.log.work.saturating_add(1);
        let was_still = self.errand.is_still();
        if was_still {
            self.set_out(to);
        } else {
            self.go_on(more);
        }
        let may_have_slid = !was_still || self.body.contacts.first().sense.slides();
        if self.statics.world.has_obstacles() && self.errand.is_still() && may_have_slid {
            self.statics.widen(self.body);
        }
        if self.errand.is_still() {
            self.log_slide(to);
        }
    }
    /// A path begins.
    #[inline(always)]
    fn set_out(&mut self, to: HandPose<R>) {
        self.log.jammed = false;
        self.errand.paths = self.errand.paths.saturating_add(1);
        if self.errand.paths > PATHS {
            self.log.limit(Status::EventLimit);
            self.errand.jumps = true;
        }
        if self.errand.jumps {
            self.body.hand = to;
            (self.errand.paths, self.errand.jumps) = (0, false);
            // A sliding contact sticks or slips first.
            return self.errand.settle(Next::Relax(Sense::Rests));
        }
        (self.errand.before, self.errand.target) = (self.body.hand, to);
        match self.statics.follows_calmly(self.body, &self.errand.target) {
            Calm::End => {}
            Calm::Yields(sense) => self.errand.stage = Stage::At(Ending::Yields(sense)),
            Calm::Unsure => self.follow(),
        }
    }
    /// What is under way goes on.
    fn go_on(&mut self, more: &mut impl FnMut() -> bool) {
        match self.errand.stage {
            Stage::Still => {}
            Stage::At(ending) => {
                self.errand.stage = Stage::Still;
                // In frame evolution, too, the first event happens where the hand reaches it (R40).
                self.errand.jumps = self.evolution == Evolution::Frame;
                self.happens(ending);
            }
            Stage::Borne => self.stay(),
            Stage::Settle => self.settle(),
            Stage::Yields => {
                let errand = &mut *self.errand;
                let ranking = &mut errand.settling.ranking;
                match self.statics.pick(self.body, &errand.released, ranking) {
                    Picked::More => {}
                    Picked::Mode(mode) => self.begins(Some(mode)),
                    Picked::None => self.begins(None),
                }
            }
            Stage::Path
            | Stage::Snap(_)
            | Stage::Relax(_)
            | Stage::Fly(_)
            | Stage::Slip(_)
            | Stage::Joint => match self.errand.ended.take() {
                Some(ended) => self.found(ended),
                None => self.search(more),
            },
        }
    }
    /// The windows of a search, each a piece. Between two steps only the bracket lasts: what is certain is evaluated again, to the same bits.
    #[inline(never)]
    fn search(&mut self, more: &mut impl FnMut() -> bool) {
        let (statics, mut windows) = (self.statics, Windows::NONE);
        self.errand.search.recall(statics, self.body, &mut windows);
        loop {
            let search = &mut self.errand.search;
            if let Some(ended) = search.piece(statics, self.body, &mut windows) {
                let instant = windows.instant(ended.at);
                if !instant.is_finite() {
                    self.log.limit(Status::IterationLimit);
                }
                statics.bring(self.body, instant, ended.room);
                return self.arrived(ended);
            }
            if !self.may_go_on(more) {
                return;
            }
            self.log.work = self.log.work.saturating_add(1);
        }
    }
    /// A search has ended where the body is now.
    fn arrived(&mut self, ended: Ended<R>) {
        if self.errand.stage != Stage::Path {
            self.errand.ended = Some(ended);
            return;
        }
        let motion = &self.errand.search.motion;
        self.body.hand = motion.hand_at(ended.x.min(motion.whole));
        self.errand.stage = match ended.ending {
            Ending::End | Ending::GoesOn | Ending::Stopped => Stage::Still,
            ending @ (Ending::Fold
            | Ending::Touch(_)
            | Ending::Ends(_)
            | Ending::Yields(_)
            | Ending::Clear
            | Ending::Pressed
            | Ending::Halt
            | Ending::Opens(_)
            | Ending::GivesWay) => Stage::At(ending),
        };
    }
    /// Logs where a slide begins and ends, on the way to a pose. What begins before a jump has not moved yet; what ended has.
    fn log_slide(&mut self, to: HandPose<R>) {
        let slides = self.body.contacts.iter().any(|c| c.sense.slides());
        let about_to_jump = self.errand.jumps && self.body.hand != to;
        if slides && about_to_jump {
            return;
        }
        let rests = !slides && !self.body.contacts.is_empty();
        if slides && !self.errand.slid {
            self.log.event(Event::Slide);
        } else if self.errand.slid && rests {
            self.log.event(Event::Stop);
        } else if self.errand.slid_to_rest && rests && self.log.events.is_empty() {
            self.log.event(Event::Slide);
            self.log.event(Event::Stop);
        }
        (self.errand.slid, self.errand.slid_to_rest) = (slides, false);
    }
    /// What follows from the end of a search at the frozen hand.
    #[inline(never)]
    fn found(&mut self, ended: Ended<R>) {
        match self.errand.stage {
            Stage::Snap(kind) if ended.ending == Ending::GoesOn => self.turn(Stage::Snap(kind)),
            Stage::Snap(kind) => self.snapped(kind, ended.ending),
            Stage::Relax(sense) if ended.ending == Ending::GoesOn => {
                self.turn(Stage::Relax(sense));
            }
            Stage::Relax(sense) => {
                let next = self.turned(sense, ended.ending);
                self.settled(next);
            }
            Stage::Fly(leg) => self.flown(leg, &ended),
            Stage::Slip(sense) => self.slipped(sense, ended.ending),
            Stage::Joint => {
                let m = self.errand.search.motion;
                self.slipped_together(&m, (ended.ending, ended.x));
            }
            Stage::Still
            | Stage::At(_)
            | Stage::Borne
            | Stage::Settle
            | Stage::Yields
            | Stage::Path => {}
        }
    }

    /// Along the hand's displacement, not calmly, to the first event.
    #[inline(never)]
    fn follow(&mut self) {
        let to = self.errand.target;
        let way = self.body.hand.to(&to);
        let (motion, watch) = match self.statics.freedom(self.body) {
            Freedom::Free => (self.along(Kind::Free, &way), Watch::Way),
            Freedom::Turns if self.body.contacts.len() > 1 => {
                (self.along(Kind::Pin, &way), Watch::Corner)
            }
            Freedom::Turns => (self.along(Kind::Pin, &way), Watch::Stick),
            Freedom::Slides => {
                let m = self.statics.sliding(self.body, way.per_p);
                let watch = match m.factor {
                    Factor::Normal(_) => Watch::Trail,
                    Factor::Both | Factor::Lever => Watch::Slide,
                };
                (m.to(to, way.whole), watch)
            }
            Freedom::Fixed => return self.stand_still(&way),
            Freedom::Together => {
                let m = self.statics.sliding_pair(self.body, way.per_p);
                (m.to(to, way.whole), Watch::Joint)
            }
        };
        let eager = !matches!(motion.kind, Kind::Slide | Kind::Pair);
        self.run(Stage::Path, motion, watch, way.whole, eager);
    }
    fn along(&self, kind: Kind, way: &Displacement<R>) -> Motion<R> {
        Motion::new(kind, self.body, way.per_p).to(self.errand.target, way.whole)
    }
    /// A search begins.
    pub(crate) fn run(
        &mut self,
        stage: Stage,
        motion: Motion<R>,
        watch: Watch,
        end: R,
        eager: bool,
    ) {
        self.errand.search.begin(motion, watch, end, eager);
        self.errand.search.with_room(self.body.room);
        self.errand.stage = stage;
    }

    /// The pose is fixed: the load is linear along the displacement.
    fn stand_still(&mut self, way: &Displacement<R>) {
        let to = self.errand.target;
        let change = (to.at - self.body.hand.at).length_bound()
            + self
                .statics
                .world
                .stiffness
                .of((to.angle - self.body.hand.angle).abs());
        if self.body.slack > change {
            self.body.slack = self.body.slack - change;
            self.body.hand = to;
            return;
        }
        self.body.slack = R::ZERO;
        let borne = self.statics.borne(self.body, &to);
        let (p, ending) = match (borne, self.presses(way)) {
            (Borne::Slips(part, sense), _) => (part * way.whole, Ending::Yields(sense)),
            (Borne::Until(part), Some(p)) if part * way.whole <= p => {
                (part * way.whole, Ending::GivesWay)
            }
            (Borne::Until(part), None) => (part * way.whole, Ending::GivesWay),
            (Borne::Until(_) | Borne::All(_), Some(p)) => (p, Ending::Pressed),
            (Borne::All(slack), None) => {
                (self.body.hand, self.body.slack) = (to, slack);
                self.errand.stage = Stage::Borne;
                return;
            }
        };
        self.body.hand = if p >= way.whole {
            to
        } else {
            self.body.hand.moved(&way.per_p, p)
        };
        self.errand.stage = Stage::At(ending);
    }
    /// The contacts bear the load, and any one that differs by less than the slack: unless they are jammed.
    fn stay(&mut self) {
        self.errand.stage = Stage::Still;
        let free = self.statics.free_of_jam(self.body, self.body.slack);
        self.log.jammed = free.is_none();
        let may_press = !self.body.stiction && self.statics.is_edge(&self.body.contacts);
        self.body.slack = free.filter(|_| !may_press).unwrap_or(R::ZERO);
    }
    /// Where along a displacement an edge without stiction is pressed hard enough for it.
    fn presses(&self, way: &Displacement<R>) -> Option<R> {
        if self.body.stiction || !self.statics.is_edge(&self.body.contacts) {
            return None;
        }
        let contact = self.body.contacts.first();
        let threshold = self.statics.friction(contact).threshold;
        let n = self
            .statics
            .frame(contact, self.body.rotation, self.body.holding)
            .n;
        let normal = -n.dot(self.statics.present_load(self.body).force);
        let p = (threshold - normal) / -n.dot(way.per_p.at);
        (threshold < R::HUGE && p >= R::ZERO && p <= way.whole).then_some(p)
    }
}
