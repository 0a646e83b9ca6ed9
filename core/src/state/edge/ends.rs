//! The ends of an edge among obstacles (STATICS 12.5): an end is either where the body's side ends, a vertex that moves along in a slide,
//! or where the obstacle's side ends, a corner that stays. About an end that stays the moment grows with the slide times the normal
//! reaction; so it is linear in a slip and quadratic in a slide with the hand. A foot that leaves its side ends the motion.

use super::{Edge, Segment, keep};
use crate::balance_curve::Margin;
use crate::contact::Pair;
use crate::geometry::Vec2;
use crate::grip::Displacement;
use crate::load::Load;
use crate::moment::SecondHarmonic;
use crate::motion::Instant;
use crate::pivot::Pivot;
use crate::real::{Real, along};
use crate::state::side_end::room_ahead;
use crate::thresholds::Thresholds;
use crate::verb::Trigger;
use crate::world::World;

/// A quadratic quantity that is positive while the motion is allowed: start + along·tau + p q tau².
#[derive(Clone, Copy, Debug)]
struct Bent<R> {
    start: R,
    along: R,
    /// (p, q)
    square: (R, R),
    /// The rounding of `start`.
    rounding: R,
}

impl<R: Real> Bent<R> {
    /// In the direction of a sign.
    fn times(self, sign: R) -> Self {
        Self {
            start: along(sign, self.start),
            along: along(sign, self.along),
            square: (along(sign, self.square.0), self.square.1),
            rounding: self.rounding,
        }
    }

    /// Where it first falls to zero, tau >= 0, if it does. A quantity that is at zero from the beginning, to the rounding, does so where it
    /// is exceeded, like a margin.
    fn first_zero(&self) -> Option<R> {
        let credit = if self.start <= self.rounding {
            self.rounding.doubled()
        } else {
            R::ZERO
        };
        let start = self.start + credit;
        let (p, q) = self.square;
        let size = start.abs().max(self.along.abs()).max(p.abs());
        if size == R::ZERO {
            return None;
        }
        let unit = size.unit();
        let [start, half, p] = [start, self.along.halved(), p].map(|x| x.in_units(unit));
        let square = p * q;
        if half < R::ZERO && start <= R::ZERO {
            return Some(R::ZERO);
        }
        if R::difference_of_products(half, half, start, square) < R::ZERO {
            return None;
        }
        let root = R::root_of_products(half, half, -start, square);
        if half < R::ZERO {
            Some(start / (root - half))
        } else if square < R::ZERO {
            Some((root + half) / -square)
        } else {
            None
        }
    }
}

impl<R: Real> Edge<R> {
    /// Ends a slide by `shift`·tau along t, in the direction of `sign`, where an N_i falls to zero, a foot leaves its side, or the overlap
    /// is no longer than a single contact. `relative`: the displacement of the hand less the slide.
    pub(super) fn stop_at_ends<H: SecondHarmonic<R>>(
        &self,
        scene: &impl World<R>,
        segment: &mut Segment<R, H>,
        (load, relative): (&Load<R>, &Displacement<R>),
        (shift, sign): (R, R),
    ) {
        let span = self.span(scene, &load.placed);
        let side = span.sign();
        let about = self.moments(scene, (load, relative), shift);
        // The moment about one end gives the other's reaction.
        for ((moment, pressed), lasts) in about.into_iter().zip([-side, side]).zip([0, 1]) {
            if let Some(x) = moment.times(pressed).first_zero() {
                segment.stop_at_place(x, keep(lasts, Some(sign)));
            }
        }
        let rates = self.rates();
        let overlap = Margin {
            start: span.abs() - R::MICRO,
            along: along(side, (rates[1] - rates[0]) * shift),
            turning: Vec2::ZERO,
            rounding: R::of_coordinates(),
        };
        let corner = usize::from(self.other.is_corner());
        segment.stop_at(&overlap, keep(corner, Some(sign)));
        for (contact, &pair) in self.contacts().iter().enumerate() {
            if scene.corner(pair.surface).is_none() {
                continue;
            }
            let room = room_ahead(scene, &Instant::at_rest(load.placed), (pair, sign));
            let on_side = Margin {
                start: room.value,
                along: -along(sign, shift),
                turning: Vec2::ZERO,
                rounding: room.rounding,
            };
            segment.stop_at(&on_side, Trigger::Off { contact, sign });
        }
    }

    /// x_i': 1 for an end that moves with the body, 0 for one that stays.
    fn rates(&self) -> [R; 2] {
        let goes = |pair: Pair| if pair.is_corner() { R::ZERO } else { R::ONE };
        [self.pivot.contact, self.other].map(goes)
    }

    /// M_i about each end, on a slide by `shift`·tau along t.
    fn moments(
        &self,
        scene: &impl World<R>,
        (load, relative): (&Load<R>, &Displacement<R>),
        shift: R,
    ) -> [Bent<R>; 2] {
        let normal = load.reaction(self.pivot.surface(scene).normal, relative);
        let turn = scene.stiffness() * relative.turn + load.lever.cross(relative.hand);
        let span = self.span(scene, &load.placed);
        let [first, second] = self.rates().map(|rate| (R::ONE - rate) * shift);
        let about = |arm: R, stays: R| Bent {
            start: load.moment() + arm * normal.start,
            along: turn + arm * normal.along - stays * normal.start,
            square: (-stays, normal.along),
            rounding: load.rounding() * (R::ONE + arm.abs()),
        };
        [about(R::ZERO, first), about(span, second)]
    }

    /// After a slide from another pivot in which the hand made a displacement: the most by which a moment was below the line from zero to
    /// its value at the end. `None` if an end has left its side.
    pub(super) fn bend_of_ends<W: World<R>>(
        &self,
        scene: &W,
        from: &Pivot<R>,
        displacement: Displacement<R>,
    ) -> Option<R> {
        let placed = self.pivot.placed(scene);
        let contacts = self.contacts();
        let is_off = |&pair: &Pair| placed.beyond(scene, pair) >= R::TOUCH;
        let [before, span] = [from.placed(scene), placed].map(|placed| self.span(scene, &placed));
        let overlaps = span.abs() > R::MICRO.doubled() && before.sign() == span.sign();
        if !overlaps || contacts.iter().any(is_off) {
            return None;
        }
        let pressing = self.pivot.surface(scene).normal.dot(displacement.hand);
        let stays = contacts.iter().any(|pair| pair.is_corner());
        let way = (self.pivot.foot - from.foot).abs();
        Some(if stays { way * pressing.abs() } else { R::ZERO })
    }
}

#[cfg(test)]
mod tests;
