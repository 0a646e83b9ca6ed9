//! What is known of a window of a motion.

use crate::bounds::{Bound, Pace};
use crate::pair_bounds::PairSup;
use crate::real::Real;

/// What is known of a window, along x from 0 to 1 on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judging<R> {
    pub(crate) bound: Bound<R>,
    pub(crate) pace: Pace<R>,
    /// Of a pair.
    pub(crate) pair: Option<PairSup<R>>,
    /// |p''|: 0 where x = p.
    pub(crate) p_bend: R,
    /// |E''| of a frozen motion; |E_u''| along u.
    pub(crate) drive: R,
    pub(crate) stable: R,
    /// The width of the window.
    pub(crate) width: R,
}

impl<R: Real> Judging<R> {
    /// Of no window yet.
    #[inline(always)]
    pub(crate) const fn new() -> Self {
        Self {
            bound: Bound::ZERO,
            pace: Pace::linear(R::ZERO, R::ZERO),
            pair: None,
            p_bend: R::ZERO,
            drive: R::ZERO,
            stable: R::ZERO,
            width: R::ZERO,
        }
    }
}
