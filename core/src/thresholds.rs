//! Every bound at which a number counts as zero, a position as the same, a quotient as known: its unit, and its derivation. STATICS 10 has
//! the same as a table. ε is [`Real::EPSILON`]; the touch and the shortest slip are [`Real::TOUCH`] and [`Real::MICRO`]. The constants of
//! (E8) and (E9) are not included: they are steps of a proof.

use crate::real::Real;

pub(crate) trait Thresholds: Real {
    /// 2 ε, per size of the coordinates of a gap (L), and of a cosine or sine (1): the number is rounded, and so is what is computed from
    /// it.
    fn of_coordinates() -> Self {
        Self::EPSILON.doubled()
    }

    /// 4 ε of a size, of forces (k_h L), moments (k_h L²) and other sums of four products at most.
    fn of_sums(size: Self) -> Self {
        Self::rounding(size).doubled().doubled()
    }

    /// 8 ε of the hand's displacement (L, or rad): a foot that moves back by less rests (rule 7). The rounding of the velocity at both ends
    /// of a slide, 4 ε each.
    fn of_displacement(size: Self) -> Self {
        Self::rounding(size * Self::from_int(8))
    }

    /// 4 roundings of a load (k_h L): the residual that reactions may leave of it comes from their three components and its own rounding.
    fn of_reactions(rounding: Self) -> Self {
        rounding * Self::from_int(4)
    }

    /// 8 roundings of a margin, in its unit: it is used up beyond doubt if it is exceeded by the 4 ε to which a search knows it, at the
    /// beginning and at the end.
    fn beyond_doubt(rounding: Self) -> Self {
        rounding * Self::from_int(8)
    }

    /// 64 roundings of a load (k_h L): a search knows E·D to 4 roundings, where D, and the unit of the curve, are no less than a quarter of
    /// their largest component.
    fn of_searches(rounding: Self) -> Self {
        rounding * Self::from_int(4 * 4 * 4)
    }

    /// 16 ε (L or rad per unit of the motion): smaller velocities count as zero. Those of the unit twist are quotients of sums of two
    /// products of normals and levers, each known to 2 ε.
    fn standstill() -> Self {
        Self::from_int(16) * Self::EPSILON
    }

    /// 4 ε (1): directions are parallel if the sine of their angle does not exceed this.
    fn parallel() -> Self {
        Self::from_int(4) * Self::EPSILON
    }

    /// 64 ε (1): an edge that is not farther from the plane of two others lies in it, and a gap that opens no faster does not open. A
    /// normal of unit size is known to 16 ε if these two are at an angle of 1/4 or more, and its products with an edge to four times that.
    fn in_plane() -> Self {
        Self::from_int(64) * Self::EPSILON
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

    /// 1/8 (1): if the directions of two reactions are at an angle of a larger sine, the reactions that balance the force alone are known
    /// to 8 roundings, and nothing else is used.
    fn spread() -> Self {
        Self::HALF.halved().halved()
    }

    /// 16 (1): if the reactions that bear a load are beyond the range of the numbers, a sixteenth of it is tried, and so on, and the
    /// residual of a load is refined in steps of which it is a sixteenth: with 4 of 24 digits at a time no component leaves the range.
    fn digits() -> Self {
        Self::from_int(16)
    }

    /// 2 [`Real::TOUCH`] (L): a contact that is reached within this was there before. Its gap at the beginning and the touch are each known
    /// to one.
    fn met_before() -> Self {
        Self::TOUCH.doubled()
    }

    /// 16 [`Real::MICRO`] (1): a tilt of flat sides that is no larger may be rounding. A gap is known to 4 ε at a contact; over an overlap
    /// of 2^-6 L that results in 2^-15 with 24 digits.
    fn snapped_flat() -> Self {
        Self::from_int(16) * Self::MICRO
    }

    /// 64 (k_h L): larger reactions are not distinguished from a jam (STATICS 6). Half of what fixed point represents.
    fn limit() -> Self {
        Self::from_int(64)
    }
}

impl<R: Real> Thresholds for R {}
