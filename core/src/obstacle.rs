//! Obstacles with corners: fixed closed convex polygons, a thin wall of two corners, a pin of one (STATICS 12). The type determines what a
//! scene stores of them: a scene without obstacles stores nothing. World frame, lengths / L.

use crate::geometry::Vec2;
use crate::list::gather;
use crate::real::Real;
use crate::surface::Surface;
use core::fmt::Debug;
use core::ops::Range;
use heapless::Vec;

/// A corner w_k of an obstacle, and the side from it to the next one. As a surface of a contact it has an index of its own: its index among
/// all corners, numbered after the half-planes. World frame, lengths / L.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner<R> {
    /// w_k
    pub(crate) place: Vec2<R>,
    /// The side from w_k to the next corner, its normal outwards; for a pin, which has no side, its friction alone. Coplanar sides of equal
    /// friction that meet are one line, namely that of the longest of them.
    pub(crate) side: Surface<R>,
    /// Where that line begins and ends along its tangent; meaningless for a pin.
    pub(crate) reach: [R; 2],
    /// The index, as a surface, of the first side of that line: the one that is touched.
    pub(crate) line: u8,
    /// The obstacle that it belongs to.
    pub(crate) obstacle: u8,
    /// Nothing can touch it: it lies in or on another obstacle or behind a half-plane, or an earlier obstacle has a corner there.
    pub(crate) covered: bool,
}

/// What a scene stores of its obstacles, for a body of at most V vertices.
pub trait Obstacles<R: Real>: Clone + Debug + PartialEq {
    /// Whether there can be any.
    const CORNERS: bool;
    /// The maximum number of obstacles, and of their corners together.
    #[doc(hidden)]
    const CAPACITY: [usize; 2];
    /// None yet, around a body with these outward normals of its sides, body frame; a point has no sides.
    #[doc(hidden)]
    fn of_body(normals: impl Iterator<Item = [R; 2]>) -> Self;
    /// All corners, obstacle by obstacle, counter-clockwise.
    #[doc(hidden)]
    fn corners(&self) -> &[Corner<R>];
    /// For each obstacle the index of its first corner.
    #[doc(hidden)]
    fn firsts(&self) -> &[u8];
    /// For each obstacle a circle that contains it.
    #[doc(hidden)]
    fn rounds(&self) -> &[Round<R>];
    /// m_j, the outward normal of the body's side that begins at vertex j, body frame.
    #[doc(hidden)]
    fn body_normal(&self, side: u8) -> [R; 2];
}

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round<R> {
    pub(crate) center: Vec2<R>,
    pub(crate) radius: R,
}

impl<R: Real> Round<R> {
    /// Around some points: about the middle of their ranges.
    pub(crate) fn about(places: impl Iterator<Item = Vec2<R>> + Clone) -> Self {
        let range = |along: fn(Vec2<R>) -> R| {
            let (least, most) = (places.clone()).fold((R::HUGE, R::LEAST), |(least, most), at| {
                (least.min(along(at)), most.max(along(at)))
            });
            least + (most - least).halved()
        };
        let center = Vec2::new(range(|at| at.x), range(|at| at.y));
        let distances = places.map(|at| (at - center).length_bound());
        Self {
            center,
            radius: distances.fold(R::ZERO, R::max),
        }
    }
}

/// No obstacles: nothing is stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoObstacles;

impl<R: Real> Obstacles<R> for NoObstacles {
    const CORNERS: bool = false;
    const CAPACITY: [usize; 2] = [0; 2];
    fn of_body(_: impl Iterator<Item = [R; 2]>) -> Self {
        Self
    }
    fn corners(&self) -> &[Corner<R>] {
        &[]
    }
    fn firsts(&self) -> &[u8] {
        &[]
    }
    fn rounds(&self) -> &[Round<R>] {
        &[]
    }
    fn body_normal(&self, _: u8) -> [R; 2] {
        [R::ZERO; 2]
    }
}

/// At most O obstacles with at most C corners together.
#[derive(Clone, Debug, PartialEq)]
pub struct SomeObstacles<R: Real, const V: usize, const O: usize, const C: usize> {
    pub(crate) corners: Vec<Corner<R>, C>,
    pub(crate) firsts: Vec<u8, O>,
    pub(crate) rounds: Vec<Round<R>, O>,
    pub(crate) body_normals: Vec<Vec2<R>, V>,
}

impl<R: Real, const V: usize, const O: usize, const C: usize> Obstacles<R>
    for SomeObstacles<R, V, O, C>
{
    const CORNERS: bool = true;
    const CAPACITY: [usize; 2] = [O, C];
    fn of_body(normals: impl Iterator<Item = [R; 2]>) -> Self {
        Self {
            corners: Vec::new(),
            firsts: Vec::new(),
            rounds: Vec::new(),
            body_normals: gather(normals.map(|[x, y]| Vec2::new(x, y))),
        }
    }
    fn corners(&self) -> &[Corner<R>] {
        &self.corners
    }
    fn firsts(&self) -> &[u8] {
        &self.firsts
    }
    fn rounds(&self) -> &[Round<R>] {
        &self.rounds
    }
    fn body_normal(&self, side: u8) -> [R; 2] {
        let normal = self.body_normals.get(usize::from(side));
        normal.map_or([R::ZERO; 2], |normal| [normal.x, normal.y])
    }
}

/// The indices of the corners of an obstacle among all corners.
pub(crate) fn corners_of(firsts: &[u8], count: usize, obstacle: usize) -> Range<u8> {
    let all = u8::try_from(count).unwrap_or(u8::MAX);
    let from = firsts.get(obstacle).copied().unwrap_or(all);
    let to = firsts
        .get(obstacle.saturating_add(1))
        .copied()
        .unwrap_or(all);
    from..to
}
