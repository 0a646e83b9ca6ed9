//! A gap closes: what touches, and what the contacts do then (STATICS 11).

use crate::contact::{Contact, Contacts, Feature, Sense};
use crate::errand::Next;
use crate::events::{Ending, Watch, Watched};
use crate::geometry::Rotation;
use crate::motion::{Instant, Kind, Motion, Rates};
use crate::real::Real;
use crate::search::Ended;
use crate::state::{Body, HandPose};
use crate::step::Step;
use crate::thresholds::Thresholds;
use crate::values::Value;
use crate::world::Statics;

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// Velocities along the hand's displacement of a first contact that sticks, or slides in a sense; none if that is not stable.
    pub(crate) fn rates_as(
        &self,
        body: &Body<R>,
        sense: Sense,
        hand_p: HandPose<R>,
    ) -> Option<Rates<R>> {
        let mut body = *body;
        body.contacts.slide(sense);
        let m = if sense.slides() {
            self.sliding(&body, hand_p)
        } else {
            Motion::new(Kind::Pin, &body, hand_p)
        };
        let i = self.placed_at_start(&m);
        (i.e_u < R::ZERO).then(|| self.rates(&m, &i))
    }
    /// At zero reaction rates decide (R21): in which sense the first contact slides along the hand's displacement, if it does not stick.
    fn sense_by_rates(&self, body: &Body<R>, hand_p: HandPose<R>) -> Sense {
        let frame = self.frame(body.contacts.first(), body.rotation, body.holding);
        let is_edge = body.contacts.len() > 1;
        let force = if is_edge {
            hand_p.at
        } else {
            match self.rates_as(body, Sense::Rests, hand_p) {
                Some(rates) => rates.force,
                None => return Sense::Rests,
            }
        };
        let (n, pull) = (-frame.n.dot(force), frame.t.dot(force));
        let cone = self.friction(body.contacts.first()).sliding;
        if n > R::ZERO && pull.abs() * cone.cos <= n * cone.sin {
            return Sense::Rests;
        }
        let sense = Sense::of(pull);
        let rates = self.rates_as(body, sense, hand_p);
        let goes = rates.is_some_and(|rates| sense.along(rates.xi) > R::ZERO);
        if is_edge || goes { sense } else { Sense::Rests }
    }
    /// At zero reaction: that of the first contact rises along the hand's displacement.
    pub(crate) fn presses_by_rates(&self, body: &Body<R>, hand_p: HandPose<R>) -> bool {
        let frame = self.frame(body.contacts.first(), body.rotation, body.holding);
        let rates = self.rates_as(body, self.sense_by_rates(body, hand_p), hand_p);
        rates.is_some_and(|rates| frame.n.dot(rates.force) < R::ZERO)
    }
    /// Reactions of a pair that are zero at its beginning do not fall.
    pub(crate) fn press_on(&self, body: &Body<R>, m: &Motion<R>, i: &Instant<R>) -> bool {
        let ahead = self.shares_ahead(body, m, i);
        let shares = self.shares(m, i);
        let (zero, steady) = (R::TOUCH + shares.known, R::of_displacement(m.hand_p.size()));
        let mut normal = shares.normal.into_iter().zip(ahead);
        normal.all(|(n, ahead)| n > zero || ahead.d >= -steady)
    }
    /// Multiples of N_1, N_2 of a pair on its way, with their rates.
    pub(crate) fn shares_ahead(
        &self,
        body: &Body<R>,
        m: &Motion<R>,
        i: &Instant<R>,
    ) -> [Value<R>; 2] {
        let watched = Watched {
            statics: self,
            body,
            motion: m,
            watch: Watch::Joint,
            direction: R::ONE,
        };
        let [u, p] = if m.frozen {
            [R::ONE, R::ZERO]
        } else {
            [-i.e_p / i.e_u, R::ONE]
        };
        watched.shares(i, &self.rates_of(m, i, u, p))
    }
    /// Vertices on half-planes whose gaps are closed, but for those of the body's contacts. A convex body meets a half-plane along the one of
    /// its sides that faces it: what is beyond the ends of that side is near because the body is thin, and does not touch.
    pub(crate) fn closed(&self, body: &Body<R>, tolerance: R) -> impl Iterator<Item = Feature> {
        let (rotation, holding, contacts) = (body.rotation, body.holding, body.contacts);
        let sides = u8::try_from(self.world.sides.len()).unwrap_or(u8::MAX);
        let vertices = u8::try_from(self.world.vertices.len()).unwrap_or(u8::MAX);
        let features = (0..vertices)
            .flat_map(move |vertex| (0..sides).map(move |side| Feature::Vertex { vertex, side }));
        features.filter(move |&feature| {
            let gap = self.gap(Contact::at(feature), rotation, holding);
            gap <= tolerance && self.faces(feature, rotation) && !self.holds(&contacts, feature)
        })
    }
    /// The body is inside of what it does not touch, by more than a touch.
    pub(crate) fn is_inside(&self, body: &Body<R>) -> bool {
        let of_obstacles = || {
            let mut all = self.obstacles();
            all.any(|(_, o)| {
                let widest = self.widest(&o, body.at());
                widest.is_some_and(|widest| widest.gap < -R::TOUCH)
            })
        };
        self.closed(body, -R::TOUCH).next().is_some() || C > 0 && of_obstacles()
    }
    /// A vertex is an end of the body's side that faces the half-plane, by their normals.
    fn faces(&self, feature: Feature, rotation: Rotation<R>) -> bool {
        let Feature::Vertex { vertex, side } = feature else {
            return true;
        };
        let n = rotation.undo(self.side(side).normal);
        let along = |j: u8| n.dot(self.inward(j));
        let facing = self
            .body_sides()
            .reduce(|best, j| if along(j) > along(best) { j } else { best });
        facing.is_none_or(|j| vertex == j || vertex == self.next_vertex(j))
    }
    /// One contact more, in the pose that the body has.
    pub(crate) fn join(&self, body: &mut Body<R>, feature: Feature, within: R) {
        let first = body.contacts.first().feature;
        body.forget();
        if C == 0 {
            body.contacts.add(feature);
        } else if let Some(contacts) = self.joined_by(body, feature, within) {
            body.contacts = contacts;
        }
        if body.contacts.first().feature != first {
            self.find_foot(body);
        }
    }
    /// All that is closed within a distance joins the contacts; the pose exactly on them.
    pub(crate) fn join_closed(&self, body: &mut Body<R>, within: R) {
        let others = *body;
        for feature in self.closed(&others, within) {
            if C == 0 || !self.holds(&body.contacts, feature) {
                self.join(body, feature, within);
            }
        }
        if C > 0 {
            self.join_obstacles(body, within);
        }
        self.seat(body);
    }
    /// The foot of the first contact where the body is.
    pub(crate) fn find_foot(&self, body: &mut Body<R>) {
        let first = body.contacts.first();
        body.foot = self.foot_of(first, body.rotation, body.holding);
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// A contact and all that close together with it; the pose exactly on them.
    pub(crate) fn touch(&mut self, feature: Feature) {
        let before = self.body.contacts;
        self.statics.join(self.body, feature, R::TOUCH);
        self.statics.join_closed(self.body, R::TOUCH);
        let [was, is] = [&before, &self.body.contacts].map(|contacts| self.statics.kind(contacts));
        if self.body.contacts.len() > before.len() {
            self.log.touch(was, is);
        } else {
            self.log.replace(was, is);
        }
    }
    /// Without contact, blocked by the contact that it leaves: that was closed where the motion began, and has not opened.
    pub(crate) fn is_blocked(&self, ended: &Ended<R>) -> bool {
        let Ending::Touch(feature) = ended.ending else {
            return false;
        };
        let is_closed = |x: R| {
            let HandPose { at, angle } = self.errand.search.motion.on_line(x);
            let gap = (self.statics).gap(Contact::at(feature), Rotation::by(angle), at);
            gap <= R::met_before()
        };
        is_closed(R::ZERO) && is_closed(ended.x.halved())
    }
    /// The body is at a pose close by, unless it is inside of something there. Returns whether it has moved.
    pub(crate) fn moves_clear(&mut self, there: &Body<R>) -> bool {
        let is_clear = !self.statics.is_inside(there);
        if is_clear {
            *self.body = *there;
        }
        is_clear
    }
    /// The foot of a slide follows the hand to where the body is inside of what it does not touch.
    pub(crate) fn is_led_inside(&self) -> bool {
        let m = Motion::frozen(Kind::Slide, self.body);
        let mut there = *self.body;
        there.go_to(&self.statics.placed_at_start(&m), R::ZERO);
        self.statics.is_inside(&there)
    }
    /// On the hand's path.
    pub(crate) fn touches(&mut self, feature: Feature) {
        let hand_p = self.path();
        let before = *self.body;
        self.touch(feature);
        let sense = before.contacts.first().sense;
        let is_edge = self.statics.is_edge(&self.body.contacts);
        let (count, now) = (before.contacts.len(), self.body.contacts.len());
        let friction = |contacts: &Contacts| self.statics.friction(contacts.first());
        if count == now && friction(&before.contacts) != friction(&self.body.contacts) {
            // On ground of another friction the load is not in balance.
            return self.errand.settle(Next::Relax(sense));
        }
        if count == 0 {
            self.body.loosen();
            if now == 1 || is_edge {
                let sense = self.statics.sense_by_rates(self.body, hand_p);
                self.body.contacts.slide(sense);
            }
        } else if before.contacts.iter().all(|c| !c.sense.slides()) {
            self.body.contacts.rest();
        } else if count == 1 && is_edge {
            self.body.contacts.slide(sense);
        } else {
            self.body.loosen();
            let [first, second] = self.body.contacts.pair();
            if count == 1 && now == 2 && !first.shares_vertex(second) {
                let senses = self.joined(sense);
                self.body.contacts.slide_pair(senses);
            }
        }
    }
    /// A contact that slides has met a second one elsewhere: both slide on if a pair keeps its sense, is stable, moves, and presses the new
    /// one, along what is left of the displacement.
    fn joined(&self, sense: Sense) -> [Sense; 2] {
        let hand_p = self.body.hand.to(&self.errand.target).per_p;
        let mut senses = [Sense::Rests; 2];
        for direction in [R::ONE, -R::ONE] {
            let m = self.statics.pair(self.body, hand_p, direction);
            let [first, second] = m.contacts;
            if first.sense != sense {
                continue;
            }
            let i = self.statics.placed_at_start(&m);
            let rates = self.statics.rates(&m, &i);
            if i.e_u >= R::ZERO || rates.u <= R::ZERO {
                continue;
            }
            let [_, pressing] = self.statics.shares_ahead(self.body, &m, &i);
            if pressing.d > R::ZERO {
                senses = [first.sense, second.sense];
            }
        }
        senses
    }
    /// At zero reaction of a stick rates decide.
    pub(crate) fn begin_by_rates(&mut self) {
        let hand_p = self.path();
        self.body.forget();
        self.body.loosen();
        let sense = self.statics.sense_by_rates(self.body, hand_p);
        self.body.contacts.slide(sense);
    }
}
