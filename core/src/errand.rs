//! What a step leaves to the next one when it ends early: plain data.

use crate::contact::Sense;
use crate::events::Ending;
use crate::geometry::Vec2;
use crate::modes::Ranking;
use crate::motion::{Kind, Motion};
use crate::real::Real;
use crate::search::{Ended, Search};
use crate::state::{Body, HandPose};

/// What a body that comes to rest at a frozen hand does next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Next {
    /// It rests.
    #[default]
    Rest,
    /// Comes to balance; with a sense, while it slips or, without contact, turns away from a balance that is not stable.
    Relax(Sense),
    /// Slips in this sense of the first contact.
    Slip(Sense),
    /// The contacts do not bear the load: the next motion of the list.
    Give,
}

/// The parts of the way to balance without contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Leg {
    Straight,
    /// The contact that was left blocks the turn: first the holding point moves.
    Holding,
    /// Then the body turns.
    Turning,
}

/// What is under way between two pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Stage {
    /// Nothing: the body is in balance with the hand where it has followed it.
    #[default]
    Still,
    /// A motion has ended there.
    At(Ending),
    /// Contacts that fix the pose bear the load where the hand is; whether they are jammed is asked.
    Borne,
    /// The hand stands still; the next word of coming to rest.
    Settle,
    /// The motion that begins at contacts that give way is looked for.
    Yields,
    /// Searches, by what they are for.
    Path,
    Snap(Kind),
    Relax(Sense),
    Fly(Leg),
    Slip(Sense),
    Joint,
}

/// A body that comes to rest.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Settling<R> {
    pub(crate) next: Next,
    pub(crate) ranking: Ranking<R>,
    pub(crate) rounds: u8,
    /// Where the last word began.
    pub(crate) holding: Vec2<R>,
    pub(crate) angle: R,
}

/// A step that is under way.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Errand<R> {
    pub(crate) stage: Stage,
    /// Contacts slid when the body was last still.
    pub(crate) slid: bool,
    /// Contacts without stiction slid to where they may be at rest.
    pub(crate) slid_to_rest: bool,
    /// The displacement under way.
    pub(crate) before: HandPose<R>,
    pub(crate) target: HandPose<R>,
    /// While anything is left to do, the size of the displacement to the present sample of the hand from where it came, and the part of it
    /// that is left, more than 0 and at most 1; otherwise 0.
    pub(crate) whole: R,
    pub(crate) left: R,
    /// Paths that have begun since the body caught up with the hand.
    pub(crate) paths: u8,
    /// The hand jumps to its sample instead of following a path.
    pub(crate) jumps: bool,
    pub(crate) settling: Settling<R>,
    /// Of a chain of searches: their number, and the first contact's foot where the first began.
    pub(crate) runs: u8,
    pub(crate) foot: R,
    /// How far the hand was from its target where contacts gave way last.
    pub(crate) gave_way: R,
    /// The hand where they give way beyond doubt.
    pub(crate) released: HandPose<R>,
    pub(crate) search: Search<R>,
    /// How the search ended where the body is now, which is not acted on yet.
    pub(crate) ended: Option<Ended<R>>,
}

impl<R: Real> Errand<R> {
    /// Nothing is under way.
    pub(crate) fn none() -> Self {
        let start = Body::new(Vec2::ZERO, R::ZERO, HandPose::REST);
        Self {
            stage: Stage::Still,
            slid: false,
            slid_to_rest: false,
            before: HandPose::REST,
            target: HandPose::REST,
            whole: R::ZERO,
            left: R::ZERO,
            paths: 0,
            jumps: false,
            settling: Settling {
                next: Next::Rest,
                ranking: Ranking::default(),
                rounds: 0,
                holding: Vec2::ZERO,
                angle: R::ZERO,
            },
            runs: 0,
            foot: R::ZERO,
            gave_way: R::ZERO,
            released: HandPose::REST,
            search: Search::none(Motion::frozen(Kind::Line, &start)),
            ended: None,
        }
    }
    /// The hand has been followed to `at`, on its way to a sample.
    pub(crate) fn is_left(&mut self, at: &HandPose<R>, target: &HandPose<R>) {
        let rest = at.distance(target);
        let part = if rest < self.whole {
            rest / self.whole
        } else {
            R::ONE
        };
        self.left = part.max(R::EPSILON);
    }
    /// The hand has been followed, and the body is in balance.
    pub(crate) fn has_caught_up(&mut self) {
        (self.paths, self.jumps) = (0, false);
        (self.whole, self.left) = (R::ZERO, R::ZERO);
    }
    /// Nothing is under way.
    pub(crate) fn is_still(&self) -> bool {
        matches!(self.stage, Stage::Still)
    }
    /// The body comes to rest at the frozen hand, beginning with a word.
    pub(crate) fn settle(&mut self, next: Next) {
        self.stage = Stage::Settle;
        self.settling.next = next;
        self.settling.rounds = 0;
        self.settling.ranking = Ranking::default();
    }
}
