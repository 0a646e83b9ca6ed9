//! The work of a search among obstacles, counted in its loops: in gaps along axes, several of which make up a unit of work. A search that
//! has done more than a limit that follows from the scene ends at the next point that touches no obstacle: nothing is reached up to there.

use super::corners;
use crate::real::Real;
use crate::world::World;
use core::cell::Cell;

/// This many gaps make up a unit of work.
const GAPS: u32 = 12;
/// The cost, in gaps, of an axis itself; of testing how one closes; of a pair that may touch; of finding which of the touching pairs can be
/// in contact simultaneously.
const AXIS: u32 = 6;
const LOOK: u32 = 4;
const PAIR: u32 = 4;
const TOGETHER: u32 = 200;
/// How many times a search may examine everything, and at how many points each time.
const ENOUGH: u32 = 8;
const PLACES: u32 = 8;

/// Numbers of vertices of the body, and of corners and obstacles: of one obstacle, or of all.
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

    /// The numbers for all obstacles of a scene.
    pub(crate) fn of<R: Real, W: World<R>>(scene: &W) -> Self {
        let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Self::new([
            count(scene.vertices().len()),
            count(scene.corners().len()),
            count(scene.rounds().len()),
        ])
    }

    /// The numbers for one obstacle.
    pub(super) fn of_one<R: Real, W: World<R>>(scene: &W, obstacle: usize) -> Self {
        let corners = u32::try_from(corners(scene, obstacle).len()).unwrap_or(u32::MAX);
        Self {
            corners,
            obstacles: 1,
            ..Self::of(scene)
        }
    }

    /// All axes, each with its gaps: the sides of one shape against the vertices of the other.
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

    /// The cost of finding which pairs touch.
    pub(super) const fn touching(self) -> u32 {
        let pairs = self.vertices.saturating_mul(self.corners).saturating_mul(2);
        (self.axes().saturating_add(pairs.saturating_mul(PAIR))).saturating_add(TOGETHER)
    }

    /// A search begins no further piece of a motion after this much work: eight times the cost of examining all obstacles, of those that
    /// are touched, and of some points of `place` units each. Of the searches for random jumps in closed rooms, one in a hundred needs
    /// more.
    const fn enough(self, place: u32) -> u32 {
        let look = place.saturating_mul(GAPS).saturating_add(LOOK);
        (self.axes().saturating_add(self.touching()))
            .saturating_add(look.saturating_mul(PLACES))
            .saturating_mul(ENOUGH)
    }

    /// The most work of a search, in units of work: its last piece may take as long as all before.
    pub(crate) const fn most_of_search(self, place: u32) -> u32 {
        units(self.enough(place).saturating_mul(2))
    }

    /// The cost of examining all obstacles and of finding what is touched, in units of work.
    pub(crate) const fn most_of_frame(self) -> u32 {
        units(self.axes().saturating_mul(2))
    }
    pub(crate) const fn most_of_touching(self) -> u32 {
        units(self.touching())
    }
}

/// The units of work of some gaps.
pub(super) const fn units(gaps: u32) -> u32 {
    gaps.div_ceil(GAPS)
}

/// The work of a search so far.
pub(super) struct Tally {
    gaps: Cell<u32>,
    most: u32,
    /// The cost of a point of the motion, in units.
    place: u32,
}

impl Tally {
    /// For a search along a motion whose points cost `place` units each.
    pub(super) const fn of_search(sizes: Sizes, place: u32) -> Self {
        Self {
            gaps: Cell::new(0),
            most: sizes.enough(place),
            place,
        }
    }

    /// For a certified frame, which examines each obstacle a few times at most.
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

    /// Returns whether the search has reached its limit.
    pub(super) fn is_enough(&self) -> bool {
        self.gaps.get() >= self.most
    }

    /// Counts a point of the motion.
    pub(super) fn place(&self) {
        self.spend(self.place.saturating_mul(GAPS));
    }

    /// Counts a test of how a gap closes.
    pub(super) fn look(&self) {
        self.spend(LOOK);
    }

    /// The work so far, in units of work.
    pub(super) fn units(&self) -> u32 {
        units(self.gaps.get())
    }
}
