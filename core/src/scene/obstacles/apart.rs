//! How far the body and an obstacle are apart, or how deep one is in the other, by their axes (STATICS 12). World frame, lengths / L.

use crate::contact::Pair;
use crate::detect::Placed;
use crate::geometry::Vec2;
use crate::obstacle::corners_of;
use crate::real::Real;
use crate::world::World;

/// The largest gap along the outward normals of both, and along thin walls and rods at both ends: less than 0 where one is inside the
/// other, minus the depth; otherwise a lower bound of the distance. A point is not inside a pin: between them there is no axis.
pub(super) fn separation<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    obstacle: usize,
) -> R {
    let corners = corners_of(scene.firsts(), scene.corners().len(), obstacle);
    let first_surface = scene.surface_indices().end;
    let surfaces = || corners.clone().map(|k| first_surface.saturating_add(k));
    let vertices = || scene.vertex_indices();
    let rotation = placed.orientation.rotation();
    let place = |surface: u8| scene.corner(surface).map_or(Vec2::ZERO, |c| c.place);
    let beyond = |axis: Vec2<R>, vertex: u8, surface: u8| {
        axis.dot(placed.point + placed.arm(scene, vertex) - place(surface))
    };
    let mut largest = None;
    let mut add = |gap: R| largest = Some(largest.map_or(gap, |largest: R| largest.max(gap)));
    for surface in surfaces().filter(|_| corners.len() > 1) {
        let gap = |vertex: u8| placed.gap(scene, Pair { vertex, surface });
        add(vertices().map(gap).fold(R::HUGE, R::min));
        if corners.len() == 2 {
            // The tangent of a side points back beyond its first end.
            let axis = scene.surface(surface).tangent;
            let gap = |vertex: u8| beyond(axis, vertex, surface);
            add(vertices().map(gap).fold(R::HUGE, R::min));
        }
    }
    for side in vertices().filter(|_| vertices().len() > 1) {
        let gap = |surface: u8| placed.gap(scene, Pair::of_corner(surface, side));
        add(surfaces().map(gap).fold(R::HUGE, R::min));
        if vertices().len() == 2 {
            let normal = scene.body_normal(side);
            let axis = rotation.apply(Vec2::new(normal.y, -normal.x));
            let gap = |surface: u8| -beyond(axis, side, surface);
            add(surfaces().map(gap).fold(R::HUGE, R::min));
        }
    }
    largest.unwrap_or(R::ZERO)
}
