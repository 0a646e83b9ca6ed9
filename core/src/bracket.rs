//! What a search knows of its motion: up to where it is certain, the window that is next, both ends of the last one.

use crate::ending::Which;
use crate::geometry::{Rotation, Vec2};
use crate::motion::{Instant, Rates};
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::values::Values;

/// One end of a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WindowEnd<R> {
    pub(crate) instant: Instant<R>,
    pub(crate) rates: Rates<R>,
    pub(crate) values: Values<R>,
}

/// Near a fold the same curve along u: u and p where that begins, the direction of u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Branch<R> {
    pub(crate) u: R,
    pub(crate) p: R,
    pub(crate) direction: R,
}

/// A search between two windows: plain data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bracket<R> {
    /// The motion is certain up to here; the next window ends at `hi`, the search at `end`.
    pub(crate) certain: R,
    pub(crate) hi: R,
    pub(crate) end: R,
    /// Which end of the last window is the certain one, and whether it is evaluated; u where it was placed.
    pub(crate) low: Which,
    pub(crate) is_known: bool,
    pub(crate) placed: R,
    /// The least hi that was too far.
    pub(crate) bad: R,
    pub(crate) room: R,
    pub(crate) round: u8,
    pub(crate) refusals: u8,
    /// The first window is to be that of the tangents' estimate.
    pub(crate) eager: bool,
    pub(crate) shrunk: bool,
    pub(crate) branch: Option<Branch<R>>,
    /// The end of p if the search goes along u.
    pub(crate) stop: R,
}

/// Both ends of the last window of a search, while it runs.
pub(crate) struct Windows<R> {
    pub(crate) first: WindowEnd<R>,
    pub(crate) second: WindowEnd<R>,
}

impl<R: Real> Windows<R> {
    pub(crate) const NONE: Self = Self {
        first: WindowEnd::NONE,
        second: WindowEnd::NONE,
    };
    /// An end, to change it.
    pub(crate) fn instant_mut(&mut self, which: Which) -> &mut Instant<R> {
        match which {
            Which::First => &mut self.first.instant,
            Which::Second => &mut self.second.instant,
        }
    }
    /// An end.
    pub(crate) fn instant(&self, at: Which) -> &Instant<R> {
        match at {
            Which::First => &self.first.instant,
            Which::Second => &self.second.instant,
        }
    }
}

impl<R: Real> WindowEnd<R> {
    /// Nothing yet: all zeros, which are written faster than others are copied.
    const NONE: Self = Self {
        instant: Instant {
            rotation: Rotation {
                cos: R::ZERO,
                sin: R::ZERO,
            },
            theta_u: R::ZERO,
            ..Instant::ZERO
        },
        rates: Rates {
            u: R::ZERO,
            p: R::ZERO,
            g: Vec2::ZERO,
            theta: R::ZERO,
            xi: R::ZERO,
            force: Vec2::ZERO,
            moment: R::ZERO,
        },
        values: Values::ZERO,
    };
}

impl<R: Real> Bracket<R> {
    pub(crate) const fn new(end: R, eager: bool, room: R) -> Self {
        Self {
            certain: R::ZERO,
            hi: end,
            end,
            low: Which::First,
            is_known: false,
            placed: R::ZERO,
            bad: R::HUGE,
            room,
            round: 0,
            refusals: 0,
            eager,
            shrunk: false,
            branch: None,
            stop: end,
        }
    }
    pub(crate) fn width(&self) -> R {
        self.hi - self.certain
    }
    /// A shorter window is not tried.
    pub(crate) fn is_shortest(&self) -> bool {
        self.width() <= R::standstill() * (R::ONE + self.hi)
    }
}
