//! The contacts with their reactions, for a device or a display. SI units, world frame.

use crate::contact::MAX_CONTACTS;
use core::ops::Deref;
use heapless::Vec;
use stiction_core::Touch;

/// One contact. SI units, world frame; forces are those on the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<F> {
    /// What touches what.
    pub touch: Touch,
    /// Where they touch (m).
    pub point: [F; 2],
    /// The unit normal n towards the body; for a corner of an obstacle it turns with the body.
    pub direction: [F; 2],
    /// Reaction N >= 0 along n (N); 0 while the body is not held.
    pub normal: F,
    /// Friction T along the tangent t = (n_y, -n_x), which is +x on a floor (N); |T| <= mu_s N, unless the status reports that the pose is
    /// out of balance. Of contacts in one line, where only the sum counts, in proportion to N (E20).
    pub friction: F,
    /// 0 if it sticks, 1 or -1 if it slides along t or against it with the hand, |T| = mu_d N.
    pub sliding: i8,
}

/// The contacts of a state, in an order that is fixed as long as the state lasts, at most [`MAX_CONTACTS`](crate::MAX_CONTACTS). The list
/// can be read like a slice.
#[derive(Clone, Debug, PartialEq)]
pub struct Contacts<F> {
    pub(crate) list: Vec<Contact<F>, MAX_CONTACTS>,
}

impl<F> Deref for Contacts<F> {
    type Target = [Contact<F>];
    fn deref(&self) -> &[Contact<F>] {
        &self.list
    }
}
