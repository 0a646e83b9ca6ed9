//! The slip of a single contact (STATICS 3.2): it sticks at its old position while the hand moves on, slides to the new one while
//! the hand is frozen, and sticks there. Throughout, the body turns in balance of moments, with the angle on its branch.

use super::{Step, drive, static_excess};
use crate::pin::{Foot, Pin, Spot, follow};

/// Points on the path of a slip at which the balance is evaluated.
pub(super) const PLACES: u32 = 64;

/// A contact that slid from one position to another, along `sign`·t.
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
    /// The contact pinned at its old position, with the hand at a fraction of its path; `after`: at its new one.
    fn before(&self, part: f64) -> Pin<'a> {
        self.foot.pinned(self.from, self.step.hand(part))
    }

    fn after(&self, part: f64) -> Pin<'a> {
        self.foot.pinned(self.to, self.step.hand(part))
    }

    /// The angle at the old position: that of the previous frame, continued.
    fn angle_before(&self, part: f64) -> Option<f64> {
        let theta = self.step.last.pose[2];
        follow(|part| self.before(part), theta, part)
    }

    /// The angle at the new position: that of this frame, followed backwards.
    fn angle_after(&self, part: f64) -> Option<f64> {
        follow(
            |back| self.after(1.0 - back),
            self.step.next.pose[2],
            1.0 - part,
        )
    }

    /// The amount by which static friction falls short at the old position (N).
    pub(super) fn fixed(&self, part: f64) -> Option<f64> {
        let reaction = self.before(part).reaction(self.angle_before(part)?);
        Some(static_excess(reaction, self.onset))
    }

    /// The drive of the slip at the new position (N).
    pub(super) fn sliding(&self, part: f64) -> Option<f64> {
        Some(self.drive(&self.after(part), self.angle_after(part)?))
    }

    fn drive(&self, pin: &Pin<'_>, theta: f64) -> f64 {
        drive(pin.reaction(theta), self.dynamic, self.sign)
    }

    /// The amount by which the drive falls short somewhere on the path from the old position to the new one (N). `None`
    /// if the balance is lost on the path, or leads to a different angle from that at the new position.
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
