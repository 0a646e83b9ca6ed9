//! Contacts that slide off the ends of their sides, on a window of a search (R39).

use crate::contact::Sense;
use crate::events::{Ending, Judging, Watch, Which};
use crate::found::Found;
use crate::judge::Track;
use crate::real::Real;
use crate::search::{Ended, Run, WindowEnd};
use crate::thresholds::Thresholds;
use crate::values::Value;

impl<R: Real, const V: usize, const S: usize, const C: usize> Run<'_, R, V, S, C> {
    /// The contacts that slide with the senses in which they may reach an end. What topples may turn back on the way.
    fn sliding(&self) -> impl Iterator<Item = (Which, Sense)> + use<R, V, S, C> {
        let own = |which: Which| (which, which.of(self.watched.motion.contacts).sense);
        let [a, b] = [Which::First, Which::Second].map(own);
        let all = match self.watched.watch {
            Watch::Slip(sense) => [Some((Which::First, sense)), None],
            Watch::Topple => [Sense::Plus, Sense::Minus].map(|sense| Some((Which::First, sense))),
            Watch::Slide | Watch::Trail => [Some(a), None],
            Watch::Joint | Watch::JointSlip => [Some(a), Some(b)],
            Watch::Way | Watch::Stick | Watch::Corner | Watch::Turn => [None; 2],
        };
        all.into_iter().flatten()
    }
    /// How far the foot of a contact is from the end of its side in a sense, with its velocity; half a touch more than where a contact counts
    /// as on its side.
    fn room_to_end(&self, (which, sense): (Which, Sense), end: &WindowEnd<R>) -> Option<Value<R>> {
        let (statics, i) = (self.watched.statics, &end.instant);
        let contact = which.of(self.watched.motion.contacts);
        let [a, b] = statics.ends(contact);
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
        let mut rooms = (self.sliding()).filter_map(|slides| self.room_to_end(slides, self.hi));
        rooms.any(|room| room.v + room.d * dx < R::ZERO)
    }
    /// The ends of the sides on which contacts slide.
    pub(crate) fn judge_ends(&mut self, on: &Judging<R>, found: &mut Found<R>) -> Option<Ended<R>> {
        let turns_back = self.watched.watch == Watch::Topple;
        let [_, xi2] = on.bound.foot;
        let bend = if turns_back { xi2 } else { R::ZERO };
        for slides in self.sliding() {
            let Some(end) = self.room_to_end(slides, self.hi) else {
                continue;
            };
            if end.v > R::zero().max(bend.halved()) {
                continue;
            }
            self.know_low();
            let Some(begin) = self.room_to_end(slides, self.lo) else {
                continue;
            };
            let (which, _) = slides;
            let is_over = begin.v <= R::ZERO && self.bracket.certain == R::ZERO;
            if is_over && end.v <= begin.v {
                return Some(self.ended_low(Ending::Ends(which), R::ZERO));
            }
            let ending = Ending::Ends(which);
            let track = if turns_back {
                Track::gap(ending, [begin, end], bend)
            } else {
                Track::monotonous(ending, [begin, end])
            };
            self.judge(found, &track);
        }
        None
    }
}
