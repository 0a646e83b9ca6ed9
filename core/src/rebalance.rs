//! At the frozen hand, to a balance nearby.

use crate::contact::Sense;
use crate::errand::{Next, Stage};
use crate::motion::{Kind, Motion, Spot};
use crate::real::Real;
use crate::state::{Freedom, HandPose};
use crate::step::Step;

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// The body comes to the balance of another stiffness: by a Newton step if that moves it by less than can be distinguished, otherwise as
    /// after any change at the frozen hand.
    pub(crate) fn rebalance(&mut self) {
        let kind = match self.body.freedom() {
            Freedom::Free => return,
            Freedom::Turns => Kind::Pin,
            Freedom::Slides => Kind::Slide,
            Freedom::Together => Kind::Pair,
            Freedom::Fixed => return self.errand.settle(Next::Relax(Sense::Rests)),
        };
        let m = if kind == Kind::Pair {
            let pair = self.statics.sliding_pair(self.body, HandPose::REST);
            Motion {
                frozen: true,
                ..pair
            }
        } else {
            Motion::frozen(kind, self.body)
        };
        if self.is_near_balance(&m) {
            return;
        }
        self.errand.runs = 0;
        match kind {
            Kind::Slide => self.turn(Stage::Snap(kind)),
            Kind::Line | Kind::Free | Kind::Pin | Kind::Pair => {
                self.errand.settle(Next::Relax(Sense::Rests));
            }
        }
    }
    /// In balance, or so near that a Newton step leads there: a pair always, others if they move by less than can be distinguished.
    pub(crate) fn is_near_balance(&mut self, m: &Motion<R>) -> bool {
        let mut i = self.statics.placed_at_start(m);
        if i.e.abs() <= self.statics.rounding(self.body) {
            return true;
        }
        let step = -i.e / i.e_u;
        let is_near = i.e_u < R::ZERO && step.abs() <= R::MICRO || m.kind == Kind::Pair;
        if is_near {
            let spot = Spot { u: i.u, p: R::ZERO };
            self.statics.balance(m, spot, step, &mut i);
            let room = (self.body.room - R::MICRO.doubled()).max(R::ZERO);
            self.body.go_to(&i, room);
        }
        is_near
    }
}
