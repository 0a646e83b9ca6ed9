//! The memory of a body in contact: its contacts with their signs, where it is, where the hand is, how far nothing else is.

use crate::contact::Contacts;
use crate::frame::Frame;
use crate::geometry::{Rotation, Vec2, Wrench};
use crate::motion::Instant;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// The hand as the other end of the springs: lengths / L, angle in rad. Also a displacement of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct HandPose<R> {
    /// h
    pub(crate) at: Vec2<R>,
    /// phi
    pub(crate) angle: R,
}

/// The displacement of the hand along which p runs from 0 to `whole`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Displacement<R> {
    /// h_p, phi_p
    pub(crate) per_p: HandPose<R>,
    pub(crate) whole: R,
}

impl<R: Real> HandPose<R> {
    pub(crate) const REST: Self = Self {
        at: Vec2::ZERO,
        angle: R::ZERO,
    };

    /// The displacement to another pose: in fixed point in units of a power of two near its own size, so that rates have all their places.
    pub(crate) fn to(&self, target: &Self) -> Displacement<R> {
        let by = Self {
            at: target.at - self.at,
            angle: target.angle - self.angle,
        };
        if !R::is_fixed() {
            return Displacement {
                per_p: by,
                whole: R::ONE,
            };
        }
        let size = by.at.x.abs().max(by.at.y.abs()).max(by.angle.abs());
        let unit = size.max(R::EPSILON).min(R::ONE).unit();
        Displacement {
            per_p: Self {
                at: by.at.in_units(unit),
                angle: by.angle.in_units(unit),
            },
            whole: unit,
        }
    }
    /// The size of the displacement to another pose: way and turn at a lever of one body size. A call, as few steps ask for it.
    #[inline(never)]
    pub(crate) fn distance(&self, target: &Self) -> R {
        (target.at - self.at).length_bound() + (target.angle - self.angle).abs()
    }
    /// This pose moved along a displacement by p.
    pub(crate) fn moved(&self, per_p: &Self, p: R) -> Self {
        Self {
            at: self.at + per_p.at * p,
            angle: self.angle + per_p.angle * p,
        }
    }
    /// The most by which a displacement of this rate can move the body per p: way and turn at a lever of one body size.
    pub(crate) fn size(&self) -> R {
        self.at.length_bound() + self.angle.abs()
    }
}

/// A body in the world. With a contact it is placed by the foot of the first and its angle; the holding point follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Body<R> {
    pub(crate) contacts: Contacts,
    /// The memory bit of friction: the contacts have stiction.
    pub(crate) stiction: bool,
    /// xi: the foot of the first contact along t.
    pub(crate) foot: R,
    /// theta, and R(theta)
    pub(crate) angle: R,
    pub(crate) rotation: Rotation<R>,
    /// G: the holding point.
    pub(crate) holding: Vec2<R>,
    pub(crate) hand: HandPose<R>,
    /// Of a point or rod: from G to a place a few touches in front of all sides at which it is.
    pub(crate) front: Vec2<R>,
    /// No other contact is closer than this; 0: not known.
    pub(crate) room: R,
    /// Contacts that fix the pose bear any load that differs from the present one by less; 0: not known.
    pub(crate) slack: R,
}

/// How the contacts leave the body to move, by their number and signs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Freedom {
    /// No contact.
    Free,
    /// It turns about a contact that sticks.
    Turns,
    /// One contact slides.
    Slides,
    /// Two contacts slide.
    Together,
    /// It does not move.
    Fixed,
}

impl<R: Real> Body<R> {
    /// The body at an instant of a motion of its own; where that is no place it stays.
    pub(crate) fn go_to(&mut self, i: &Instant<R>, room: R) {
        if !i.is_finite() {
            return;
        }
        self.foot = i.foot;
        self.angle = i.angle;
        self.rotation = i.rotation;
        self.holding = i.g;
        self.room = room;
    }
    /// G and theta.
    pub(crate) fn place(&self) -> HandPose<R> {
        HandPose {
            at: self.holding,
            angle: self.angle,
        }
    }
    /// A body without contact at a pose, with the hand at its first pose.
    pub(crate) fn new(holding: Vec2<R>, angle: R, hand: HandPose<R>) -> Self {
        Self {
            contacts: Contacts::NONE,
            stiction: false,
            foot: R::ZERO,
            angle,
            rotation: Rotation::by(angle),
            holding,
            hand,
            front: Vec2::ZERO,
            room: R::ZERO,
            slack: R::ZERO,
        }
    }
    /// Nothing is known about what is near, nor about what the contacts bear.
    pub(crate) fn forget(&mut self) {
        (self.room, self.slack) = (R::ZERO, R::ZERO);
    }
    /// The contacts stick, without stiction.
    pub(crate) fn loosen(&mut self) {
        self.contacts.rest();
        self.stiction = false;
    }
    /// The body leaves all contacts.
    pub(crate) fn lift(&mut self) {
        self.contacts.clear();
        self.stiction = false;
        self.forget();
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// How the contacts let the body move.
    #[inline]
    pub(crate) fn freedom(&self, body: &Body<R>) -> Freedom {
        match body.contacts.as_slice() {
            [] => Freedom::Free,
            [only] if only.sense.slides() => Freedom::Slides,
            [_] => Freedom::Turns,
            [_, _, ..] if !self.has_pairs() => Freedom::Turns,
            [first, second, ..] if first.sense.slides() || second.sense.slides() => {
                Freedom::Together
            }
            [_, _, ..] if self.has_wedges() && body.contacts.turn_about_first() => Freedom::Turns,
            [_, _, ..] => Freedom::Fixed,
        }
    }
    /// F and M: hand and weight on the body, about the holding point, with the hand at a pose.
    pub(crate) fn load(&self, body: &Body<R>, hand: &HandPose<R>) -> Wrench<R> {
        let weight = body.rotation.apply(self.grip.centroid).x * self.world.weight;
        Wrench {
            force: hand.at - body.holding + self.weight_force(),
            moment: self.world.stiffness.of(hand.angle - body.angle) - weight,
        }
    }
    /// The load with the hand where it is.
    pub(crate) fn present_load(&self, body: &Body<R>) -> Wrench<R> {
        self.load(body, &body.hand)
    }
    /// N and T of the first contact if it alone bears the load.
    pub(crate) fn reaction(&self, body: &Body<R>) -> [R; 2] {
        let frame = self.frame(body.contacts.first(), body.rotation, body.holding);
        let force = self.present_load(body).force;
        [-frame.n.dot(force), -frame.t.dot(force)]
    }
    /// The residual of balance that is rounding.
    pub(crate) fn rounding(&self, body: &Body<R>) -> R {
        R::of_balance(self.present_load(body).size())
    }
    /// What contacts at rest may leave of a load: it is known no better where it was released, as the hand has moved by up to 64 touches.
    pub(crate) fn left_at_rest(&self, body: &Body<R>) -> R {
        R::TOUCH * R::from_int(64) + self.rounding(body)
    }
    /// Contact i becomes the first, so that the pose is held by it.
    pub(crate) fn lead(&self, body: &mut Body<R>, i: usize) {
        if i > 0 {
            body.contacts.lead(i);
            let first = body.contacts.first();
            body.foot = self.foot_of(first, body.rotation, body.holding);
        }
    }
    /// The holding point as the first contact's foot and the angle place it.
    pub(crate) fn stand(&self, body: &mut Body<R>) {
        body.rotation = Rotation::by(body.angle);
        let foot = self.foot(body.contacts.first(), body.rotation, body.foot);
        body.holding = foot.c - foot.r;
    }
    /// The pose exactly on all contacts: the least correction of foot and angle that closes each gap, three times in turn. It is none
    /// straight across a slot, and no larger than the root of the gap: over that a gap's second order, at most 1, is as large as the gap.
    pub(crate) fn seat(&self, body: &mut Body<R>) {
        if body.contacts.is_empty() {
            return;
        }
        for _ in 0..3 {
            self.stand(body);
            let first = body.contacts.first();
            let contacts = body.contacts;
            for contact in contacts.iter().skip(1) {
                let frames = [first, contact].map(|c| self.frame(c, body.rotation, body.holding));
                let slope = gap_slope(&frames);
                let square = slope.dot(slope);
                if square <= R::TOUCH {
                    // Straight across a slot neither foot nor angle closes what is left of a gap.
                    continue;
                }
                let c = self.foot(first, body.rotation, body.foot).c;
                let gap = self.gap_beside([first, contact], c, body.rotation, body.holding);
                let step = gap / square.max(gap.abs());
                if !self.is_in_line(first, contact) {
                    body.foot = body.foot - step * slope.x;
                }
                body.angle = body.angle - step * slope.y;
                self.stand(body);
            }
        }
    }
}

/// The gradient of the second contact's gap by foot and angle of the first: g = (n_2·t_1, t_2·r12).
pub(crate) fn gap_slope<R: Real>([first, second]: &[Frame<R>; 2]) -> Vec2<R> {
    Vec2::new(second.n.dot(first.t), second.t.dot(second.r - first.r))
}
