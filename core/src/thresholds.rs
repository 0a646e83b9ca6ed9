//! Every bound from which on a number counts as zero, a place as the same, a quotient as known: its unit, and what it follows from.
//! STATICS 10 has the same as a table. ε is [`Real::EPSILON`]; what counts as a touch and what is too short to be a slip are
//! [`Real::TOUCH`] and [`Real::MICRO`]. The parts of (E8) and (E9) are not among them: they are steps of a proof.

use crate::real::Real;

pub(crate) trait Thresholds: Real {
    /// 2 ε, per size of the coordinates of a gap (L), and of a cosine or sine (1): the number is rounded, and so is what it is made of.
    fn of_coordinates() -> Self {
        Self::EPSILON.doubled()
    }

    /// 4 ε of a size, of forces (k_h L), moments (k_h L²) and other sums of four products at most.
    fn of_sums(size: Self) -> Self {
        Self::rounding(size).doubled().doubled()
    }

    /// 8 ε of the hand's displacement (L, or rad): a foot that goes back by less rests (rule 7). The rounding of the velocity at both ends
    /// of a slide, 4 ε each.
    fn of_displacement(size: Self) -> Self {
        Self::rounding(size * Self::from_int(8))
    }

    /// 4 roundings of a load (k_h L): what reactions may leave of it are their three parts' and its own.
    fn of_reactions(rounding: Self) -> Self {
        rounding * Self::from_int(4)
    }

    /// 8 roundings of a margin, in its unit: it is used up beyond doubt where it is overdrawn by the 4 ε that a search knows it to, at the
    /// beginning and at the end.
    fn beyond_doubt(rounding: Self) -> Self {
        rounding * Self::from_int(8)
    }

    /// 64 roundings of a load (k_h L): a search knows E·D to 4 roundings, where D, and what the curve is counted in, are no less than a
    /// quarter of their largest part.
    fn of_searches(rounding: Self) -> Self {
        rounding * Self::from_int(4 * 4 * 4)
    }

    /// 16 ε (L or rad per unit of the motion): velocities that are smaller are none. Those of the unit twist are quotients of sums of two
    /// products of normals and levers, each known to 2 ε.
    fn standstill() -> Self {
        Self::from_int(16) * Self::EPSILON
    }

    /// 4 ε (1): directions whose sine is not above this are parallel.
    fn parallel() -> Self {
        Self::from_int(4) * Self::EPSILON
    }

    /// 64 ε (1): an edge that is not farther from the plane of two others lies in it, and a gap that opens no faster does not open. A
    /// normal of unit size is known to 16 ε where these two are at an angle of 1/4 or more, and its products with an edge to four times
    /// that.
    fn in_plane() -> Self {
        Self::from_int(64) * Self::EPSILON
    }

    /// 2^-8 (1): parts of three edges of a larger volume are known to 2^8 roundings, no worse than in fixed point a reaction of the
    /// limit to its rounding.
    fn sharp() -> Self {
        Self::ONE / Self::from_int(256)
    }

    /// 1/64 (1): what a quotient is known to that is divided by more, 64 roundings, is as good as what a search finds.
    fn divisor() -> Self {
        Self::ONE / Self::from_int(64)
    }

    /// 1/8 (1): where the directions of two reactions are at an angle of a larger sine, the reactions that balance the force alone are
    /// known to 8 roundings, and nothing else is asked.
    fn spread() -> Self {
        Self::HALF.halved().halved()
    }

    /// 16 (1): a load that reactions beyond the numbers bear is tried at a sixteenth of it, and so on, and what parts leave of one is
    /// refined in steps of which it is a sixteenth: with 4 of 24 digits at a time no part leaves the numbers.
    fn digits() -> Self {
        Self::from_int(16)
    }

    /// 2 [`Real::TOUCH`] (L): a contact that is met within this was there before. Its gap at the beginning and the touch are each known to
    /// one.
    fn met_before() -> Self {
        Self::TOUCH.doubled()
    }

    /// 16 [`Real::MICRO`] (1): a tilt of flat sides that is no larger may be rounding. A gap is known to 4 ε at a contact; over an
    /// overlap of 2^-6 L that makes 2^-15 with 24 digits.
    fn snapped_flat() -> Self {
        Self::from_int(16) * Self::MICRO
    }

    /// 64 (k_h L): larger reactions are not told from a jam (STATICS 6). Half of what fixed point represents.
    fn limit() -> Self {
        Self::from_int(64)
    }
}

impl<R: Real> Thresholds for R {}
