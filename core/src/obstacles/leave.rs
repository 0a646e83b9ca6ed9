//! Contacts that slide off the ends of their sides, on a window of a search (R39).

use crate::contact::Sense;
use crate::events::{Ending, Watch, Which};
use crate::found::Found;
use crate::judge::Track;
use crate::real::Real;
use crate::search::{Ended, Run, WindowEnd};
use crate::thresholds::Thresholds;
use crate::values::Value;

impl<R: Real, const V: usize, const S: usize, const C: usize> Run<'_, R, V, S, C> {
    /// The contacts that slide, of which an end may be reached.
    fn sliding(&self) -> &'static [Which] {
        match self.watched.watch {
            Watch::Slip(_) | Watch::Slide | Watch::Trail | Watch::Topple => &[Which::First],
            Watch::Joint | Watch::JointSlip => &[Which::First, Which::Second],
            Watch::Way | Watch::Stick | Watch::Corner | Watch::Turn => &[],
        }
    }
    /// How far the foot of a contact that slides is from the end of its side ahead, with its velocity; half a touch more than where a contact
    /// counts as on its side.
    fn room_to_end(&self, which: Which, end: &WindowEnd<R>) -> Option<Value<R>> {
        let (statics, i) = (self.watched.statics, &end.instant);
        let contact = which.of(self.watched.motion.contacts);
        let [a, b] = statics.ends(contact);
        let sense = match self.watched.watch {
            Watch::Slip(sense) => sense,
            Watch::Topple => Sense::of(self.hi.rates.xi),
            Watch::Way
            | Watch::Stick
            | Watch::Corner
            | Watch::Turn
            | Watch::Slide
            | Watch::Trail
            | Watch::Joint
            | Watch::JointSlip => contact.sense,
        };
        if !sense.slides() || b >= R::HUGE {
            return None;
        }
        let (xi, rate) = if which == Which::First {
            (i.foot, end.rates.xi)
        } else {
            let frame = statics.frame(contact, i.rotation, i.g);
            let rate = frame.advance(end.rates.g, end.rates.theta);
            (frame.foot(i.g), rate)
        };
        let left = if sense == Sense::Plus { b - xi } else { xi - a };
        Some(Value {
            v: left + R::TOUCH,
            d: -sense.along(rate),
        })
    }
    /// A step beyond the window leads beyond the end of a side.
    pub(crate) fn leads_off(&self, dx: R) -> bool {
        let mut rooms =
            (self.sliding().iter()).filter_map(|&which| self.room_to_end(which, self.hi));
        rooms.any(|room| room.v + room.d * dx < R::ZERO)
    }
    /// The ends of the sides on which contacts slide.
    pub(crate) fn judge_ends(&mut self, found: &mut Found<R>) -> Option<Ended<R>> {
        for &which in self.sliding() {
            let Some(end) = self.room_to_end(which, self.hi) else {
                continue;
            };
            if end.v > R::zero() {
                continue;
            }
            self.know_low();
            let Some(begin) = self.room_to_end(which, self.lo) else {
                continue;
            };
            let is_over = begin.v <= R::ZERO && self.bracket.certain == R::ZERO;
            if is_over && end.v <= begin.v {
                return Some(self.ended_low(Ending::Ends(which), R::ZERO));
            }
            self.judge(found, &Track::monotonous(Ending::Ends(which), [begin, end]));
        }
        None
    }
}
