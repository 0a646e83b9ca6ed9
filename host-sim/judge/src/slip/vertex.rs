//! The slip of a single contact (STATICS 3.2): it sticks at its old place while the hand goes on, slides to the new one while the
//! hand is frozen, and sticks there. All the while the body turns in balance of moments, the angle on its branch.

use super::{Step, drive, static_excess};
use crate::pin::{Foot, Pin, Spot, follow};

/// Places that are looked at on the way of a slip.
pub(super) const PLACES: u32 = 64;

/// A contact that slid from a place to another one, along `sign`·t.
pub(super) struct Slide<'a> {
    pub(super) step: &'a Step<'a>,
    pub(super) foot: Foot<'a>,
    pub(super) from: Spot,
    pub(super) to: Spot,
    pub(super) sign: f64,
    /// The friction up to which it stuck.
    pub(super) onset: f64,
    /// mu_d
    pub(super) dynamic: f64,
}

impl<'a> Slide<'a> {
    /// Pinned at the old place, and at the new one, with the hand at a part of its way.
    fn before(&self, part: f64) -> Pin<'a> {
        self.foot.pinned(self.from, self.step.hand(part))
    }

    fn after(&self, part: f64) -> Pin<'a> {
        self.foot.pinned(self.to, self.step.hand(part))
    }

    /// The angle at the old place: the one of the frame before, continued.
    fn angle_before(&self, part: f64) -> Option<f64> {
        let theta = self.step.last.pose[2];
        follow(|part| self.before(part), theta, part)
    }

    /// The angle at the new place: the one of this frame, followed back.
    fn angle_after(&self, part: f64) -> Option<f64> {
        follow(
            |back| self.after(1.0 - back),
            self.step.next.pose[2],
            1.0 - part,
        )
    }

    /// By how much static friction falls short at the old place (N).
    pub(super) fn fixed(&self, part: f64) -> Option<f64> {
        let reaction = self.before(part).reaction(self.angle_before(part)?);
        Some(static_excess(reaction, self.onset))
    }

    /// What drives the slip on at the new place (N).
    pub(super) fn sliding(&self, part: f64) -> Option<f64> {
        Some(self.drive(&self.after(part), self.angle_after(part)?))
    }

    fn drive(&self, pin: &Pin<'_>, theta: f64) -> f64 {
        drive(pin.reaction(theta), self.dynamic, self.sign)
    }

    /// By how much the drive falls short somewhere on the way from the old place to the new one (N). `None` where the
    /// balance is lost on the way, or leads to another angle than the one at the new place.
    pub(super) fn undriven(&self, part: f64) -> Option<f64> {
        let hand = self.step.hand(part);
        let at = |u: f64| self.foot.pinned(self.from.towards(self.to, u), hand);
        let mut theta = self.angle_before(part)?;
        let mut least = f64::INFINITY;
        for place in 1..=PLACES {
            let [begin, end] = [place - 1, place].map(|i| f64::from(i) / f64::from(PLACES));
            theta = follow(|u| at(begin + (end - begin) * u), theta, 1.0)?;
            least = least.min(self.drive(&at(end), theta));
        }
        let after = self.angle_after(part)?;
        at(1.0).on_one_branch(theta, after).then_some(-least)
    }
}
