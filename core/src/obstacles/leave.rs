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
    /// The ends of the sides on which contacts slide.
    pub(crate) fn judge_ends(&mut self, found: &mut Found<R>) -> Option<Ended<R>> {
        let motion = self.watched.motion;
        let watch = self.watched.watch;
        let sliding: &[Which] = match watch {
            Watch::Slip(_) | Watch::Slide | Watch::Trail | Watch::Topple => &[Which::First],
            Watch::Joint | Watch::JointSlip => &[Which::First, Which::Second],
            Watch::Way | Watch::Stick | Watch::Corner | Watch::Turn => &[],
        };
        for &which in sliding {
            let contact = which.of(motion.contacts);
            let [a, b] = self.watched.statics.ends(contact);
            let sense = match watch {
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
                continue;
            }
            let statics = self.watched.statics;
            // Half a touch more than where a contact counts as on its side.
            let room = |end: &WindowEnd<R>| {
                let i = &end.instant;
                let xi = if which == Which::First {
                    i.foot
                } else {
                    statics.foot_of(contact, i.rotation, i.g)
                };
                let left = if sense == Sense::Plus { b - xi } else { xi - a };
                Value {
                    v: left + R::TOUCH,
                    d: R::ZERO,
                }
            };
            let end = room(self.hi);
            if end.v > R::zero() {
                continue;
            }
            self.know_low();
            let begin = room(self.lo);
            let is_over = begin.v <= R::ZERO && self.bracket.certain == R::ZERO;
            if is_over && end.v <= begin.v {
                return Some(self.ended_low(Ending::Ends(which), R::ZERO));
            }
            self.judge(found, &Track::monotonous(Ending::Ends(which), [begin, end]));
        }
        None
    }
}
