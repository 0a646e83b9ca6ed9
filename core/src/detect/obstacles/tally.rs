//! The work of a search among obstacles, counted where its loops are: in gaps along axes, of which some take a unit of work. A search that
//! has done more than follows from the scene ends at the next place that touches no obstacle: up to there nothing is reached.

use super::corners;
use crate::real::Real;
use crate::world::World;
use core::cell::Cell;

/// So many gaps take a unit of work.
const GAPS: u32 = 12;
/// An axis itself takes as long as so many gaps; a look at how one closes; a pair that may touch; to see which of the pairs that touch can
/// be at once.
const AXIS: u32 = 6;
const LOOK: u32 = 4;
const PAIR: u32 = 4;
const TOGETHER: u32 = 200;
/// A search may look at all so often, and at so many places each time.
const ENOUGH: u32 = 8;
const PLACES: u32 = 8;

/// So many vertices of the body, and corners and obstacles: one of them, or all.
#[derive(Clone, Copy)]
pub(crate) struct Sizes {
    vertices: u32,
    corners: u32,
    obstacles: u32,
}

impl Sizes {
    pub(crate) const fn new([vertices, corners, obstacles]: [u32; 3]) -> Self {
        Self {
            vertices,
            corners,
            obstacles,
        }
    }

    /// Of all obstacles of a scene.
    pub(crate) fn of<R: Real, W: World<R>>(scene: &W) -> Self {
        let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Self::new([
            count(scene.vertices().len()),
            count(scene.corners().len()),
            count(scene.rounds().len()),
        ])
    }

    /// Of one.
    pub(super) fn of_one<R: Real, W: World<R>>(scene: &W, obstacle: usize) -> Self {
        let corners = u32::try_from(corners(scene, obstacle).len()).unwrap_or(u32::MAX);
        Self {
            corners,
            obstacles: 1,
            ..Self::of(scene)
        }
    }

    /// All axes, each with the gaps along it: the sides of one shape to the vertices of the other.
    pub(super) const fn axes(self) -> u32 {
        let gaps = self.vertices.saturating_mul(self.corners).saturating_mul(2);
        let axes = (self.vertices.saturating_mul(self.obstacles)).saturating_add(self.corners);
        gaps.saturating_add(axes.saturating_mul(AXIS))
    }

    /// One of them, at both ends of a piece.
    pub(super) const fn axis(self) -> u32 {
        let most = if self.vertices > self.corners {
            self.vertices
        } else {
            self.corners
        };
        most.saturating_add(AXIS).saturating_mul(2)
    }

    /// What it takes to see which pairs touch.
    pub(super) const fn touching(self) -> u32 {
        let pairs = self.vertices.saturating_mul(self.corners).saturating_mul(2);
        (self.axes().saturating_add(pairs.saturating_mul(PAIR))).saturating_add(TOGETHER)
    }

    /// A search begins no piece of a motion after so much: eight times what it takes to look at all obstacles, at what of them is touched,
    /// and at some places, each of so many units. Of the searches of random jumps in closed rooms, one in a hundred takes more.
    const fn enough(self, place: u32) -> u32 {
        let look = place.saturating_mul(GAPS).saturating_add(LOOK);
        (self.axes().saturating_add(self.touching()))
            .saturating_add(look.saturating_mul(PLACES))
            .saturating_mul(ENOUGH)
    }

    /// What a search takes at most, its last piece as long again as all before, in units of work.
    pub(crate) const fn most_of_search(self, place: u32) -> u32 {
        units(self.enough(place).saturating_mul(2))
    }

    /// What it takes to look at all obstacles, and to see what is touched, in units of work.
    pub(crate) const fn most_of_frame(self) -> u32 {
        units(self.axes().saturating_mul(2))
    }
    pub(crate) const fn most_of_touching(self) -> u32 {
        units(self.touching())
    }
}

/// So many units of work some gaps take.
pub(super) const fn units(gaps: u32) -> u32 {
    gaps.div_ceil(GAPS)
}

/// What a search has done so far.
pub(super) struct Tally {
    gaps: Cell<u32>,
    most: u32,
    /// What a place of the motion takes, in units.
    place: u32,
}

impl Tally {
    /// Of a search along a motion whose places take so many units.
    pub(super) const fn of_search(sizes: Sizes, place: u32) -> Self {
        Self {
            gaps: Cell::new(0),
            most: sizes.enough(place),
            place,
        }
    }

    /// Of a certified frame, which looks at each obstacle a few times at most.
    pub(super) const fn of_frame() -> Self {
        Self {
            gaps: Cell::new(0),
            most: u32::MAX,
            place: 0,
        }
    }

    pub(super) fn spend(&self, gaps: u32) {
        self.gaps.set(self.gaps.get().saturating_add(gaps));
    }

    /// It has done enough.
    pub(super) fn is_enough(&self) -> bool {
        self.gaps.get() >= self.most
    }

    /// A place of the motion.
    pub(super) fn place(&self) {
        self.spend(self.place.saturating_mul(GAPS));
    }

    /// A look at how a gap closes.
    pub(super) fn look(&self) {
        self.spend(LOOK);
    }

    /// In units of work.
    pub(super) fn units(&self) -> u32 {
        units(self.gaps.get())
    }
}
