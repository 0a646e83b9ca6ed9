//! The motions: each a curve of the pose with one internal unknown u and one parameter p. On a path x = p, and u follows from balance, E(u,
//! p) = 0; at a frozen hand x = u, and E drives it.

use crate::contact::{Contact, Sense};
use crate::geometry::{Rotation, Vec2};
use crate::real::Real;
use crate::state::{Body, HandPose};

/// How a motion places the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Straight to a pose: u is the part of the way.
    Line,
    /// No contact: u is the angle.
    Free,
    /// The first contact sticks, or its foot moves with p: u is the angle.
    Pin,
    /// The first contact slides, its foot in balance: u is the angle.
    Slide,
    /// Two contacts slide: u is the way along the unit twist at the beginning.
    Pair,
}

/// What a slide of one contact keeps at zero: E, or, of a body whose angle nothing holds, one of the two factors of E = N (e·r) (R34).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Factor {
    Both,
    /// e·r: the lever bears, along the edge of the cone.
    Lever,
    /// N: the contact bears nothing; with the sign of e·r.
    Normal(Sense),
}

/// A motion: hand(p) = start + p hand_p = hand + (p - whole) hand_p, foot(p) = foot + p foot_p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Motion<R> {
    pub(crate) kind: Kind,
    /// The hand is frozen, x = u; otherwise x = p.
    pub(crate) frozen: bool,
    pub(crate) contacts: [Contact; 2],
    /// The hand where p is 0; of a line G and theta where u is 0. A way counts from its nearer end: both are exact, however long it is.
    pub(crate) start: HandPose<R>,
    /// G and theta where u of a line is 1.
    pub(crate) end: HandPose<R>,
    /// The hand where p is `whole`.
    pub(crate) hand: HandPose<R>,
    pub(crate) whole: R,
    pub(crate) hand_p: HandPose<R>,
    pub(crate) foot: R,
    pub(crate) foot_p: R,
    pub(crate) angle: R,
    /// e0: the moment that lasts on a slip that begins out of balance.
    pub(crate) lasting: R,
    pub(crate) factor: Factor,
    pub(crate) pair: Pair<R>,
}

/// What two contacts that slide need in addition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair<R> {
    /// tau: the unit twist (foot, angle) at the beginning.
    pub(crate) twist: Vec2<R>,
    /// The sign of E such that E > 0 drives: 1 or -1.
    pub(crate) flip: R,
    /// |g|: how fast the second gap changes with foot and angle at the beginning.
    pub(crate) slope: R,
    /// |u| up to which the bounds of the position hold.
    pub(crate) reach: R,
    /// They are in one line: the motion is straight, the angle stays.
    pub(crate) line: bool,
    /// In one line, with one friction: they bear any couple.
    pub(crate) even: bool,
    /// Their force tells the reactions, not only their moments.
    pub(crate) spread: bool,
    /// The reactions count on the way, not only at its end.
    pub(crate) pressed: bool,
}

impl<R: Real> Motion<R> {
    /// Of a body along a path of the hand, or with the hand frozen and p to the foot.
    #[inline(always)]
    pub(crate) fn new(kind: Kind, body: &Body<R>, hand_p: HandPose<R>) -> Self {
        Self {
            kind,
            frozen: false,
            contacts: body.contacts.pair(),
            start: body.hand,
            hand: body.hand,
            whole: R::ZERO,
            hand_p,
            foot: body.foot,
            foot_p: R::ZERO,
            angle: body.angle,
            lasting: R::ZERO,
            factor: Factor::Both,
            end: body.hand,
            pair: Pair {
                twist: Vec2::ZERO,
                flip: R::ONE,
                slope: R::ONE,
                reach: R::HUGE,
                line: false,
                even: false,
                spread: false,
                pressed: true,
            },
        }
    }
    /// At the frozen hand, along u.
    pub(crate) fn frozen(kind: Kind, body: &Body<R>) -> Self {
        Self {
            frozen: true,
            ..Self::new(kind, body, HandPose::REST)
        }
    }
    /// At the frozen hand the first contact's foot moves by p along foot_p.
    pub(crate) fn slip(body: &Body<R>, foot_p: R) -> Self {
        Self {
            foot_p,
            ..Self::new(Kind::Pin, body, HandPose::REST)
        }
    }
    /// Along a path of the hand on which it is at `hand` where p is `whole`.
    pub(crate) fn to(self, hand: HandPose<R>, whole: R) -> Self {
        Self {
            hand,
            whole,
            ..self
        }
    }
    /// The hand at p, from the nearer end of its path.
    pub(crate) fn hand_at(&self, p: R) -> HandPose<R> {
        if p < self.whole.halved() {
            self.start.moved(&self.hand_p, p)
        } else {
            self.hand.moved(&self.hand_p, p - self.whole)
        }
    }
    /// G and theta on a line.
    pub(crate) fn on_line(&self, u: R) -> HandPose<R> {
        let way = self.line();
        if u < R::HALF {
            self.start.moved(&way, u)
        } else {
            self.end.moved(&way, u - R::ONE)
        }
    }
    /// G_u, theta_u of a line.
    pub(crate) fn line(&self) -> HandPose<R> {
        HandPose {
            at: self.end.at - self.start.at,
            angle: self.end.angle - self.start.angle,
        }
    }
    pub(crate) fn first(&self) -> Contact {
        let [first, _] = self.contacts;
        first
    }
}

/// A point of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spot<R> {
    pub(crate) u: R,
    pub(crate) p: R,
}

/// The body at a point of a motion, its load about the holding point, and their partial derivatives by u and p. Symbols of STATICS 2 and 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Instant<R> {
    pub(crate) u: R,
    /// u without a last step of first order.
    pub(crate) placed: R,
    pub(crate) p: R,
    pub(crate) rotation: Rotation<R>,
    pub(crate) angle: R,
    pub(crate) foot: R,
    /// G
    pub(crate) g: Vec2<R>,
    /// The lever of the first contact, and of the second of a pair.
    pub(crate) r: Vec2<R>,
    pub(crate) r2: Vec2<R>,
    /// F, M
    pub(crate) force: Vec2<R>,
    pub(crate) moment: R,
    pub(crate) e: R,
    pub(crate) e_u: R,
    pub(crate) e_p: R,
    pub(crate) g_u: Vec2<R>,
    pub(crate) g_p: Vec2<R>,
    pub(crate) theta_u: R,
    pub(crate) xi_u: R,
    pub(crate) xi_p: R,
}

/// Velocities along x.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Rates<R> {
    pub(crate) u: R,
    pub(crate) p: R,
    pub(crate) g: Vec2<R>,
    pub(crate) theta: R,
    pub(crate) xi: R,
    pub(crate) force: Vec2<R>,
    pub(crate) moment: R,
}

impl<R: Real> Instant<R> {
    pub(crate) const ZERO: Self = Self {
        u: R::ZERO,
        placed: R::ZERO,
        p: R::ZERO,
        rotation: Rotation {
            cos: R::ONE,
            sin: R::ZERO,
        },
        angle: R::ZERO,
        foot: R::ZERO,
        g: Vec2::ZERO,
        r: Vec2::ZERO,
        r2: Vec2::ZERO,
        force: Vec2::ZERO,
        moment: R::ZERO,
        e: R::ZERO,
        e_u: R::ZERO,
        e_p: R::ZERO,
        g_u: Vec2::ZERO,
        g_p: Vec2::ZERO,
        theta_u: R::ONE,
        xi_u: R::ZERO,
        xi_p: R::ZERO,
    };
    /// It is a place: nothing was divided by zero on the way.
    pub(crate) fn is_finite(&self) -> bool {
        let all = [self.angle, self.foot, self.g.x, self.g.y];
        all.iter().all(|x| x.abs() <= R::HUGE)
    }
}
