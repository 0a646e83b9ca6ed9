//! Obstacles with corners (STATICS 12): how far the body is from them, which pairs touch, and the first one that a motion reaches. Body and
//! obstacle are separated by the largest gap along an axis: an outward normal of either, or the direction in which a thin wall or a rod
//! ends. During a motion one axis is watched for each obstacle, as long as its gap is positive.

use crate::obstacle::corners_of;
use crate::real::Real;
use crate::world::World;
use core::ops::Range;

mod axes;
mod passing;
mod reached;
mod tally;
mod touching;
mod watched;

pub(crate) use passing::Tip;
pub(crate) use reached::{Among, Known, Reached, first_reached};
pub(crate) use tally::Sizes;
pub(crate) use watched::{Short, Watch};

/// Two contacts of one obstacle that are closer than this count as one (L). It is more than the possible distance of a contact from the end
/// of its side: a touch beyond it and a touch off its line.
pub(crate) fn together<R: Real>() -> R {
    R::MICRO.max(R::TOUCH.doubled())
}

/// The index of the first side that is collinear with the side of a corner.
fn line_of<R: Real>(scene: &impl World<R>, corner: u8) -> u8 {
    scene.corner(corner).map_or(corner, |corner| corner.line)
}

/// The indices of the corners of an obstacle, as surfaces.
fn corners<R: Real>(scene: &impl World<R>, obstacle: usize) -> Range<u8> {
    let first = scene.surface_indices().end;
    let own = corners_of(scene.firsts(), scene.corners().len(), obstacle);
    first.saturating_add(own.start)..first.saturating_add(own.end)
}

/// The next or previous index of a range, cyclically.
fn beside(range: &Range<u8>, index: u8, next: bool) -> u8 {
    let last = range.end.saturating_sub(1);
    match (next, index) {
        (true, i) if i >= last => range.start,
        (true, i) => i.saturating_add(1),
        (false, i) if i <= range.start => last,
        (false, i) => i.saturating_sub(1),
    }
}

/// The sides of a shape with these vertices: a point has none.
fn sides(vertices: Range<u8>) -> Range<u8> {
    if vertices.len() > 1 { vertices } else { 0..0 }
}

/// Both axes along which a segment ends; other shapes have none.
fn ends(vertices: Range<u8>) -> Range<u8> {
    if vertices.len() == 2 { vertices } else { 0..0 }
}

#[cfg(test)]
mod tests;
