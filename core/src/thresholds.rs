//! Every bound at which a number counts as zero, a position as the same, a quotient as known: its unit, and its derivation. ε is
//! [`Real::EPSILON`]; the touch and the shortest slip are [`Real::TOUCH`] and [`Real::MICRO`].

use crate::real::Real;

/// What the number type can tell apart.
pub(crate) trait Thresholds: Real {
    /// A number of few bits before the point: rates and slopes are taken in units near their size, sums saturate.
    fn is_fixed() -> bool {
        Self::RANGE < Self::from_int(100)
    }
    /// In units near its size if the number type has few places; otherwise as it is.
    fn scaled(self, unit: Self) -> Self {
        if Self::is_fixed() {
            self.in_units(unit)
        } else {
            self
        }
    }

    /// The farthest coordinate (L) that a hand may have, from where the body starts.
    fn far() -> Self {
        Self::RANGE
    }
    /// 4 ε (L or k_h L): what a sum of four products near 1 is known to.
    fn of_products() -> Self {
        Self::EPSILON.doubled().doubled()
    }
    /// touch/64, at least 4 ε (L or k_h L): an event function that is no farther from zero is zero, up to a last step of its search.
    fn zero() -> Self {
        (Self::TOUCH / Self::from_int(64)).max(Self::of_products())
    }
    /// Its square is rounding: after a Newton step du with du² <= ε (rad² or L²) the rest is linear.
    fn is_last(step: Self) -> bool {
        step * step <= Self::EPSILON
    }
    /// 8 touch (1, of the displacement): a shorter window is not tried; the branch ends there.
    fn shortest_window() -> Self {
        Self::TOUCH * Self::from_int(8)
    }
    /// 8 ε (1 + load) (k_h L, k_h L²): a residual of balance is a sum of four products of the load's size, known to 4 ε, and compared with
    /// another one.
    fn of_balance(load: Self) -> Self {
        Self::EPSILON * Self::from_int(8) * (Self::ONE + load)
    }
    /// zero + 64 ε (1 + load) (k_h L²): a moment with which a slip begins and that lasts until it ends; less is what a search leaves of the
    /// balance that it ends in, and the rounding of eight residuals.
    fn of_lasting_moment(load: Self) -> Self {
        Self::zero() + Self::of_balance(load) * Self::from_int(8)
    }
    /// 8 ε load (k_h L²): the normal of two edges is known to their rounding, however short it is, and its product with the load to that.
    fn of_normal(load: Self) -> Self {
        Self::EPSILON * Self::from_int(8) * load
    }
    /// 2 ε (1 + load) (k_h L²): the load drives a motion by more than the rounding of one product.
    fn of_drive(load: Self) -> Self {
        Self::EPSILON.doubled() * (Self::ONE + load)
    }
    /// 32 ε (1 + load) per size of a facet (k_h L): a load beyond it is not borne whichever way its four residuals round.
    fn of_release(load: Self) -> Self {
        Self::of_balance(load) * Self::from_int(4)
    }
    /// 64 ε (1): an edge that is not farther from the plane of two others lies in it, a gap that opens no faster does not open. A normal of
    /// unit size is known to 16 ε if these two are at an angle of 1/4 or more, its products with an edge to four times that.
    fn in_plane() -> Self {
        Self::EPSILON * Self::from_int(64)
    }
    /// 8 ε (1): a smaller volume of three edges is none. Each edge is known to 2 ε, its product with the plane of the others to that.
    fn of_volume() -> Self {
        Self::EPSILON * Self::from_int(8)
    }
    /// 16 ε (L or rad per unit of the motion): smaller velocities count as zero; they are quotients of sums of two products of normals and
    /// levers, each known to 2 ε.
    fn standstill() -> Self {
        Self::EPSILON * Self::from_int(16)
    }
    /// 8 ε of the hand's displacement (L, or rad): a foot that moves back by less rests. The rounding of its velocity at both ends, 4 ε each.
    fn of_displacement(size: Self) -> Self {
        Self::EPSILON * Self::from_int(8) * size
    }
    /// 2 touch (L): a contact that is reached within this was there before; its gap at the beginning and the touch are each known to one.
    fn met_before() -> Self {
        Self::TOUCH.doubled()
    }
    /// 8 touch (L): how far in front of a side the place is that tells on which side of it a body is. A gap of less than half of it, four times
    /// what it is known to, does not tell.
    fn in_front() -> Self {
        Self::TOUCH * Self::from_int(8)
    }
    /// 2 zero (L): a foot whose velocity, times the slope of the other gap, is less turns back here. Its zero is known to one *zero*, and found
    /// to another.
    fn of_turn() -> Self {
        Self::zero().doubled()
    }
    /// sqrt(touch) (L or rad): over this much of a motion its second order is a touch, its first order far more than rounding.
    fn ahead() -> Self {
        Self::TOUCH.sqrt()
    }
    /// 2^-8 (1): components along three edges of a larger volume are known to 2^8 roundings, no worse than in fixed point a reaction at the
    /// limit is known to its rounding.
    fn sharp() -> Self {
        Self::ONE / Self::from_int(256)
    }
    /// 1/64 (1): a quotient with a larger divisor is known to 64 roundings, as accurately as the result of a search.
    fn divisor() -> Self {
        Self::ONE / Self::from_int(64)
    }
    /// 2^-10 (1): normals at a smaller angle (its sine) are those of one line: a body that lies on a step of 2^-19 L turns by less if its
    /// contacts are 2^-9 L or more apart.
    fn one_line() -> Self {
        Self::ONE / Self::from_int(1024)
    }
    /// 2^-17 (L): four times what counts as one place; a neighbour that reaches less far through the line of a contact is on it.
    fn beside() -> Self {
        Self::MICRO.doubled().doubled()
    }
    /// 1/8 (1): reactions at an angle with a larger sine are known by their force to 8 roundings.
    fn spread() -> Self {
        Self::HALF.halved().halved()
    }
    /// 64 (k_h L): larger reactions are not distinguished from a jam. Half of what fixed point represents.
    fn limit() -> Self {
        Self::from_int(64)
    }
}

impl<R: Real> Thresholds for R {}
