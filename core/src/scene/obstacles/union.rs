//! One world of several obstacles, which need not be convex: sides that form one line, corners that nothing can touch (STATICS 12). In the
//! outside float, lengths / L.

use crate::body::Body;
use crate::geometry::{Vec2, normalized};
use crate::list::gather;
use crate::obstacle::Corner;
use crate::real::Real;
use crate::scene::one_in;
use crate::surface::Surface;

/// A side that begins at a corner; for a pin, which has no side, of length zero.
pub(super) struct Side<F> {
    pub(super) from: Vec2<F>,
    /// The next corner.
    to: Vec2<F>,
    /// The unit vector from end to end; for a pin 0.
    along: Vec2<F>,
    length: F,
}

impl<F: Real> Side<F> {
    /// The side between two corners, with its direction and its length; both are zero for a pin.
    pub(super) fn new(from: Vec2<F>, to: Vec2<F>) -> Self {
        let whole = to - from;
        let along = if whole == Vec2::ZERO {
            Vec2::ZERO
        } else {
            let (x, y) = normalized(whole.x, whole.y);
            Vec2::new(x, y)
        };
        Self {
            from,
            to,
            along,
            length: whole.length(),
        }
    }

    /// A bound of its coordinates.
    fn size(&self) -> F {
        self.from.length_bound().max(self.to.length_bound())
    }

    /// Returns whether it faces the same direction as another side, both are collinear, and they meet or overlap.
    fn continues<R: Real<Si = F>>(&self, other: &Self) -> bool {
        // Relative to the longer one: its direction is known to less than a rounding over the length of the other.
        let (long, short) = if self.length > other.length {
            (self, other)
        } else {
            (other, self)
        };
        let near = near::<R>(long.size().max(short.size()));
        let height = |at: Vec2<F>| long.along.cross(at - long.from);
        let foot = |at: Vec2<F>| long.along.dot(at - long.from);
        long.along.dot(short.along) > F::ZERO
            && height(short.from).abs() <= near
            && height(short.to).abs() <= near
            && foot(short.from) <= long.length + near
            && foot(short.to) >= -near
    }
}

/// Points closer than this are the same (L), for coordinates up to `size`: 1e-9; or a touch, if the number type is coarser, since gaps that
/// differ by less close together; and no less than 8 ε of the coordinates. The distance of a point from the line through two others is
/// known to 6 ε of the largest: half an ε from the point and three halves from the line, which extends beyond its ends by no more than its
/// length; then 1 from each difference, and 2 from their product.
fn near<R: Real>(size: R::Si) -> R::Si {
    let [epsilon, touch] = [R::EPSILON, R::TOUCH].map(|x| x.to_si(R::Si::ONE));
    same_place(size, epsilon.max(R::Si::EPSILON), touch)
}

fn same_place<F: Real>(size: F, epsilon: F, touch: F) -> F {
    let known = F::from_int(8) * epsilon * size;
    one_in::<F>(1_000_000_000).max(touch).max(known)
}

/// Unites all sides of equal friction that continue each other to one line, side by side; in the order of the corners.
pub(super) fn join<R: Real>(corners: &mut [Corner<R>], sides: &[Side<R::Si>]) {
    for (i, side) in sides.iter().enumerate() {
        for (k, other) in sides.iter().enumerate().take(i) {
            let (Some(a), Some(b)) = (corners.get(i), corners.get(k)) else {
                continue;
            };
            let (line, first) = (a.line.max(b.line), a.line.min(b.line));
            let may_be_one = line != first && a.obstacle != b.obstacle;
            if may_be_one && a.side.friction == b.side.friction && side.continues::<R>(other) {
                let members = corners.iter_mut().filter(|corner| corner.line == line);
                members.for_each(|corner| corner.line = first);
            }
        }
    }
    for i in 0..corners.len() {
        let whole = corners
            .get(i)
            .and_then(|c| whole_line(corners, sides, c.line));
        if let (Some(corner), Some(whole)) = (corners.get_mut(i), whole) {
            (corner.side, corner.reach) = whole;
        }
    }
}

/// The line through the longest of its sides, whose direction is known best, and where along its tangent it begins and ends.
fn whole_line<R: Real>(
    corners: &[Corner<R>],
    sides: &[Side<R::Si>],
    line: u8,
) -> Option<(Surface<R>, [R; 2])> {
    let members = || (0_usize..).zip(corners).filter(|(_, c)| c.line == line);
    let length = |k: usize| sides.get(k).map_or(R::Si::ZERO, |side| side.length);
    let (_, longest) = members().reduce(|best, next| {
        if length(next.0) > length(best.0) {
            next
        } else {
            best
        }
    })?;
    let mut reach = longest.reach;
    for (k, corner) in members() {
        let next = corners.get(k.saturating_add(1));
        let is_own = |other: &&Corner<R>| other.obstacle == corner.obstacle;
        let end = next.filter(is_own).or_else(|| corners.iter().find(is_own));
        for end in [Some(corner), end].into_iter().flatten() {
            let foot = longest.side.tangent.dot(end.place);
            reach = [reach[0].min(foot), reach[1].max(foot)];
        }
    }
    Some((longest.side, reach))
}

/// Covers the corners in which several obstacles meet and leave less than a half-plane free: a side of the body touches nothing there.
pub(super) fn cover_hollows<R: Real>(corners: &mut [Corner<R>], sides: &[Side<R::Si>]) {
    for (corner, side) in corners.iter_mut().zip(sides) {
        let at = side.from;
        let is_here = |end: Vec2<R::Si>| {
            (end - at).length() <= near::<R>(end.length_bound().max(at.length_bound()))
        };
        let leaves = || {
            sides.iter().flat_map(|side| {
                let begins = is_here(side.from).then_some((side.along, side.length));
                let ends = is_here(side.to).then_some((-side.along, side.length));
                [begins, ends].into_iter().flatten()
            })
        };
        corner.covered |= !is_tip(leaves, near::<R>(at.length_bound()));
    }
}

/// Returns whether all sides that start from a point, given by direction and length, are on one side of one of them. A direction is as
/// uncertain as the position of its end, `near`.
fn is_tip<F: Real, I: Iterator<Item = (Vec2<F>, F)>>(leaves: impl Fn() -> I, near: F) -> bool {
    leaves().any(|(one, length)| {
        let turned = |(other, of): (Vec2<F>, F)| (one.cross(other), near / length + near / of);
        leaves().map(turned).all(|(sine, off)| sine >= -off)
            || leaves().map(turned).all(|(sine, off)| sine <= off)
    })
}

/// An obstacle that may cover corners of others.
pub(super) struct Outline<F, const C: usize> {
    body: Body<F, C>,
    /// A bound of its coordinates.
    size: F,
}

impl<F: Real, const C: usize> Outline<F, C> {
    pub(super) fn new(corners: impl Iterator<Item = Vec2<F>>) -> Self {
        let body = Body::new(gather(corners));
        let sizes = body.vertices().iter().map(|at| at.length_bound());
        let size = sizes.fold(F::ZERO, F::max);
        Self { body, size }
    }

    /// Returns whether a corner of another obstacle lies in it or on it. If corners of both coincide, that of the earlier one remains.
    pub(super) fn covers<R: Real<Si = F>>(&self, corner: Vec2<F>, is_earlier: bool) -> bool {
        let near = near::<R>(self.size.max(corner.length_bound()));
        let is_there = |&at: &Vec2<F>| (at - corner).length() <= near;
        if self.body.vertices().iter().any(is_there) {
            return is_earlier;
        }
        self.body.distance(corner) <= near
    }
}

/// Covers the corners on or behind a half-plane, given by its normal and its offset.
pub(super) fn cover<R: Real>(
    corners: &mut [Corner<R>],
    sides: &[Side<R::Si>],
    normal: Vec2<R::Si>,
    offset: R::Si,
) {
    for (corner, side) in corners.iter_mut().zip(sides) {
        let near = near::<R>(side.from.length_bound().max(offset.abs()));
        // From the point of the half-plane that is nearest to the origin.
        let height = normal.dot(side.from - normal * offset);
        corner.covered |= height <= near;
    }
}
