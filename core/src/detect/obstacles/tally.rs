//! The work of a search among obstacles, counted where its loops are: in gaps along axes, of which some take a unit of work. A search does
//! no more than follows from the scene; where that is done it ends at the place up to which nothing is reached.

use super::corners;
use crate::falls::MOST_FALLS;
use crate::real::Real;
use crate::world::World;
use core::cell::Cell;

/// So many gaps take a unit of work.
const GAPS: u32 = 4;
/// The looks of a search.
const SEARCH: u32 = 64;
/// To see which of the pairs that touch can be at once takes as long as so many.
const PAIRS: u32 = 80;

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

    /// The gaps along all axes: each shape's sides to the vertices of the other. An axis itself takes as long as three.
    pub(crate) const fn axes(self) -> u32 {
        let gaps = self.vertices.saturating_mul(self.corners).saturating_mul(2);
        let axes = (self.vertices.saturating_mul(self.obstacles)).saturating_add(self.corners);
        gaps.saturating_add(axes.saturating_mul(3))
    }

    /// The gaps along one of them, at both ends of a piece.
    pub(super) const fn sides(self) -> u32 {
        self.vertices.saturating_add(self.corners).saturating_mul(2)
    }

    /// What it takes to see which pairs touch.
    pub(crate) const fn touching(self) -> u32 {
        let pairs = self.vertices.saturating_mul(self.corners).saturating_mul(2);
        (self.axes().saturating_add(pairs)).saturating_add(PAIRS)
    }
}

impl Sizes {
    /// A search does so much, whatever is left to do: what a touch takes that is found at the fourth axis of an obstacle, with all others
    /// near it, and some looks.
    const fn search(self, place: u32) -> u32 {
        let look = place.saturating_mul(GAPS).saturating_add(1);
        (self.axes().saturating_mul(4))
            .saturating_add(self.touching().saturating_mul(4))
            .saturating_add(look.saturating_mul(SEARCH))
    }
}

/// What a search has done so far.
pub(crate) struct Tally {
    gaps: Cell<u32>,
    most: u32,
}

impl Tally {
    /// Of a search along a motion whose places take so many units.
    pub(super) const fn of_search(sizes: Sizes, place: u32) -> Self {
        Self {
            gaps: Cell::new(0),
            most: sizes.search(place),
        }
    }

    /// Of a certified frame, which looks at each obstacle a few times at most.
    pub(crate) const fn of_frame() -> Self {
        Self {
            gaps: Cell::new(0),
            most: u32::MAX,
        }
    }

    pub(super) fn spend(&self, gaps: u32) {
        self.gaps.set(self.gaps.get().saturating_add(gaps));
    }

    /// What is left of the most that it may do.
    pub(super) fn left(&self) -> u32 {
        self.most.saturating_sub(self.gaps.get())
    }

    pub(super) fn spend_units(&self, units: u32) {
        self.spend(units.saturating_mul(GAPS));
    }

    /// So many looks may be taken at what falls.
    pub(super) fn looks(&self) -> u8 {
        u8::try_from(self.left()).map_or(MOST_FALLS, |left| left.min(MOST_FALLS))
    }

    /// In units of work.
    pub(crate) fn units(&self) -> u32 {
        self.gaps.get().div_ceil(GAPS)
    }
}
