//! The hand on the body: samples that can be used, taking hold, letting go; whole turns.

use crate::contact::Sense;
use crate::errand::{Errand, Next};
use crate::event::{Event, Status};
use crate::geometry::Angle;
use crate::geometry::{Rotation, Vec2};
use crate::hand::Hand;
use crate::hold::Hold;
use crate::log::Log;
use crate::real::Real;
use crate::solver::{Solver, State};
use crate::state::{Body, HandPose};
use crate::thresholds::Thresholds;
use crate::world::{Statics, World};

/// A sample of the hand that can be used: h / L and phi, unwrapped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample<R> {
    at: Vec2<R>,
    angle: Angle<R>,
}

impl<R: Real> State<R> {
    /// A sample as the other end of the springs: less the rest offset and the whole turns of body and hand.
    pub(crate) fn relative(&self, sample: &Sample<R>) -> HandPose<R> {
        let whole = Angle {
            turns: self.turns,
            rest: R::ZERO,
        };
        HandPose {
            at: sample.at,
            angle: sample.angle.offset_from(self.rest_offset).minus(whole),
        }
    }
    /// The hand lets go: the body stays where it is (R45).
    pub(crate) fn let_go(&mut self, log: &mut Log<R>) {
        self.held = false;
        self.limited = Status::Ok;
        self.errand = Errand::none();
        log.event(Event::Release);
    }
    /// A body that is not held now was held in this way.
    pub(crate) fn keep_hold(&mut self, hold: Hold) {
        if self.hold == Hold::Never {
            self.hold = hold;
        }
    }
    /// Whole turns of the body are counted apart, so that its angle keeps its digits; they are those of the hand, too. Returns whether there
    /// were any.
    pub(crate) fn unwind(&mut self) -> bool {
        if self.body.angle.abs() <= R::TAU {
            return false;
        }
        let (turns, rest) = self.body.angle.turns();
        self.turns = self.turns.saturating_add(turns);
        self.body.angle = rest;
        self.body.rotation = Rotation::by(rest);
        self.body.hand.angle = self.body.hand.angle - R::from_int(turns) * R::TAU;
        true
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Solver<R, V, S, C> {
    /// A sample that can be used; the log records why it cannot, and that its twist is not known (R44).
    pub(crate) fn usable(&self, hand: &Hand<R::Si>, log: &mut Log<R>) -> Option<Sample<R>> {
        if !hand.is_finite() {
            log.limit(Status::HeldLast);
            return None;
        }
        let at: Vec2<R> = self.scene.units.point(hand.position);
        let (turns, rest) = hand.angle.rest.turns();
        // A remainder of more than a turn means more turns than can be counted.
        if !is_near(at) || rest.abs() > R::Si::TAU {
            log.limit(Status::Saturated);
            return None;
        }
        if hand.tilted {
            log.limit(Status::Twist);
        }
        let angle = Angle {
            turns: hand.angle.turns.saturating_add(turns),
            rest: R::from_si(rest, R::Si::ONE),
        };
        Some(Sample { at, angle })
    }

    /// Takes hold where the hand is, if it is within reach; the first time at the scene's holding point, if it has one (R45). The body is
    /// about to come to rest at the pose of
    /// the hand that is returned.
    pub(crate) fn take_hold(
        &self,
        state: &mut State<R>,
        sample: &Sample<R>,
        log: &mut Log<R>,
    ) -> Option<HandPose<R>> {
        let scene = &self.scene;
        let body = &state.body;
        let origin = body.holding - body.rotation.apply(state.grip.point);
        let angle = Angle {
            turns: state.turns,
            rest: body.angle,
        };
        let given = scene.holding_point.filter(|_| state.hold == Hold::Never);
        let (holding_point, rest_offset) = match given {
            Some(point) => (point, Angle::default()),
            None => {
                let at = body.rotation.undo(sample.at - origin);
                if scene.world.distance(at) > scene.reach {
                    return None;
                }
                (at, sample.angle.offset_from(angle))
            }
        };
        let before = (state.grip, state.rest_offset, state.body.holding);
        (state.grip, state.rest_offset) = (scene.world.grip(holding_point), rest_offset);
        state.body.holding = origin + state.body.rotation.apply(holding_point);
        let target = state.relative(sample);
        let statics = scene.world.held(&state.grip);
        if !is_representable(&statics, &state.body, &target) {
            (state.grip, state.rest_offset, state.body.holding) = before;
            log.limit(Status::Saturated);
            return None;
        }
        state.hold = if given.is_some() {
            Hold::Given
        } else {
            log.event(Event::Grasp);
            Hold::Taken
        };
        state.held = true;
        state.body.loosen();
        state.body.forget();
        if !state.body.contacts.is_empty() {
            let first = state.body.contacts.first();
            let body = &mut state.body;
            body.foot = statics.foot_of(first, body.rotation, body.holding);
        }
        state.body.hand = target;
        statics.press(&mut state.body);
        state.errand = Errand::none();
        state.errand.target = target;
        state.errand.settle(Next::Relax(Sense::Rests));
        Some(target)
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> World<R, V, S, C> {
    /// The distance of a point of the body frame from the body (L); 0 inside.
    fn distance(&self, point: Vec2<R>) -> R {
        let mut nearest = R::HUGE;
        let mut inside = self.vertices.len() > 2;
        let mut from = self.vertices.last().copied().unwrap_or(Vec2::ZERO);
        for &to in &self.vertices {
            let (side, along) = (to - from, point - from);
            inside &= side.cross(along) >= R::ZERO;
            // 0 for a side of length zero.
            let part = R::ZERO.max(side.dot(along) / side.dot(side));
            nearest = nearest.min((along - side * part.min(R::ONE)).length());
            from = to;
        }
        if inside { R::ZERO } else { nearest }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// Contacts that fix the pose when a hand takes hold: they have stiction if one of them is pressed hard enough by a load that they bear
    /// with it (R24).
    fn press(&self, body: &mut Body<R>) {
        if body.contacts.len() < 2 || self.is_edge(&body.contacts) {
            return;
        }
        body.stiction = true;
        let reactions = self.reactions(body);
        let mut all = body.contacts.iter().zip(&reactions);
        body.stiction = all.any(|(contact, &[n, _])| self.friction(contact).is_pressed(n));
    }
}

fn is_near<R: Real>(at: Vec2<R>) -> bool {
    at.x.abs() <= R::far() && at.y.abs() <= R::far()
}

/// The number type can represent the pull, the turn, and the moments of both (R44).
pub(crate) fn is_representable<R: Real, const V: usize, const S: usize, const C: usize>(
    statics: &Statics<'_, R, V, S, C>,
    body: &Body<R>,
    target: &HandPose<R>,
) -> bool {
    let turn = (target.angle - body.angle).abs();
    let pull = (target.at - body.holding).length_bound();
    let arm = statics.grip.size;
    let moment = arm * pull + statics.world.stiffness.of(turn);
    // r·P of (E3), which is not bounded by the moment.
    // Half of it: the whole saturates.
    let slope = arm.halved() * (pull + arm);
    turn <= R::TURN && pull <= R::RANGE && moment <= R::LOAD && slope <= R::LOAD
}
