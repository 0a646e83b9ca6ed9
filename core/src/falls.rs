//! The first point at which functions of a motion fall to zero, from their values and slopes at both ends of a piece (STATICS 12.3): on a
//! piece so short that the second derivative keeps its sign, a function lies above its chord or above its tangents.

use crate::bounded::Sloped;
use crate::real::Real;
use crate::search::Found;

/// A function at a point, with the uncertainty of its value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level<R> {
    pub(crate) value: R,
    pub(crate) slope: R,
    pub(crate) rounding: R,
}

impl<R: Real> Level<R> {
    pub(crate) fn new(of: Sloped<R>, rounding: R) -> Self {
        Self {
            value: of.value,
            slope: of.slope,
            rounding,
        }
    }

    /// A function that is at zero from the beginning, to the rounding, may leave it: its zero is taken where it is exceeded by this amount.
    fn credit(&self) -> R {
        if self.value > self.rounding {
            R::ZERO
        } else {
            self.rounding.doubled() - self.value
        }
    }

    /// It falls from the beginning, at zero or beyond it.
    fn is_over(&self) -> bool {
        self.value < -self.rounding.doubled() && self.slope <= R::ZERO
            || self.value <= self.rounding && self.slope < R::ZERO
    }

    fn plus(self, credit: R) -> Self {
        Self {
            value: self.value + credit,
            ..self
        }
    }
}

/// An estimate of the earliest point on a piece where a function may fall to zero, and whether it certainly does on the piece.
fn suspect<R: Real>(from: Level<R>, to: Level<R>, width: R) -> Option<(R, bool)> {
    if to.value <= to.rounding {
        // The parabola through both ends with the slope at the first.
        let bend = ((to.value - from.value) / width - from.slope) / width;
        let root = R::root_of_products(from.slope, from.slope, bend * R::from_int(-4), from.value);
        let falls = root - from.slope;
        let at = if falls > R::ZERO {
            from.value.doubled() / falls
        } else {
            width
        };
        return Some((at, true));
    }
    if from.slope >= R::ZERO || to.slope <= R::ZERO {
        return None;
    }
    // Where the tangents at both ends meet.
    let at = (to.value - to.slope * width - from.value) / (from.slope - to.slope);
    (from.value + from.slope * at <= R::ZERO).then_some((at, false))
}

/// The functions at a point.
type Levels<R, const M: usize> = [Option<Level<R>>; M];

/// The earliest of the suspects of a piece: approximately where, whether it certainly falls, and which one.
fn earliest<R: Real, const M: usize>(
    from: &Levels<R, M>,
    to: &Levels<R, M>,
    width: R,
) -> Option<(R, bool, usize)> {
    let ends = from.iter().zip(to).enumerate();
    let mut suspects = ends.filter_map(|(which, (from, to))| {
        let (at, falls) = suspect((*from)?, (*to)?, width)?;
        Some((at, falls, which))
    });
    let first = suspects.next()?;
    Some(suspects.fold(
        first,
        |first, next| if next.0 < first.0 { next } else { first },
    ))
}

/// At most this many points are evaluated.
pub(crate) const MOST_FALLS: u8 = 64;

/// The first point in [0, end] at which one of some functions falls to zero; if several do, the first in the list. Pieces are no longer
/// than `longest`. A function that is `None` has no zero.
pub(crate) fn first_fall<R: Real, const M: usize>(
    (end, longest): (R, R),
    most_looks: u8,
    mut sample: impl FnMut(R) -> Levels<R, M>,
) -> Found<R> {
    let start = sample(R::ZERO);
    let is_over = |level: &Option<Level<R>>| level.is_some_and(|level| level.is_over());
    if let Some(which) = start.iter().position(is_over) {
        return Found::Zero { x: R::ZERO, which };
    }
    let credits = start.map(|level| level.map_or(R::ZERO, |level| level.credit()));
    let credited = |levels: Levels<R, M>| {
        let mut credits = credits.into_iter();
        levels.map(|level| {
            let credit = credits.next().unwrap_or(R::ZERO);
            level.map(|level| level.plus(credit))
        })
    };
    let (mut x, mut here) = (R::ZERO, credited(start));
    // A point on this piece at which a function has fallen.
    let mut fallen: Option<(R, Levels<R, M>)> = None;
    let mut to = longest.min(end);
    let mut narrowed = 0_u8;
    let mut nearest = 0;
    for _ in 0..most_looks {
        let there = match fallen {
            Some((at, levels)) if at == to => levels,
            _ => credited(sample(to)),
        };
        let width = to - x;
        let Some((at, falls, which)) = earliest(&here, &there, width) else {
            // Nothing falls up to here.
            (x, here) = (to, there);
            match fallen {
                Some((at, _)) if at > x => to = at,
                _ if x >= end => return Found::Nothing { x },
                _ => {
                    (fallen, narrowed) = (None, 0);
                    to = end.min(x + longest);
                }
            }
            continue;
        };
        nearest = which;
        let level = there.get(which).copied().flatten();
        let is_closed = level.is_some_and(|level| level.value.abs() <= level.rounding);
        let is_narrow = width <= R::rounding(R::ONE.max(to)).doubled();
        if falls && (is_narrow || is_closed && is_alone(&here, &there, width)) {
            return Found::Zero { x: to, which };
        }
        if is_narrow {
            // A dip of less than a rounding is not a fall.
            (x, here) = (to, there);
            if x >= end {
                return Found::Nothing { x };
            }
            to = fallen.map_or(end.min(x + longest), |(at, _)| at);
            continue;
        }
        if falls {
            fallen = Some((to, there));
        }
        narrowed = narrowed.saturating_add(1);
        let margin = width / R::from_int(16);
        to = if narrowed.is_multiple_of(3) {
            x + width.halved()
        } else {
            x + at.max(margin).min(width - margin)
        };
    }
    Found::Unsure { x, which: nearest }
}

/// Whatever falls on a piece does so at its end.
fn is_alone<R: Real, const M: usize>(here: &Levels<R, M>, there: &Levels<R, M>, width: R) -> bool {
    here.iter().zip(there).all(|ends| match ends {
        (Some(from), Some(to)) => {
            to.value.abs() <= to.rounding || suspect(*from, *to, width).is_none()
        }
        _ => true,
    })
}

#[cfg(test)]
mod tests;
