//! 2: gaps between the body's vertices and the surfaces, and the first of them to close on a motion.

use crate::geometry::{Orientation, Pose, Vec2};
use crate::motion::{Course, Margin, Motion};
use crate::real::Real;
use crate::scene::Scene;
use crate::state::{Pair, Pairs};

/// The body placed by one of its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<R> {
    /// The point in the world.
    pub(crate) point: Vec2<R>,
    /// The same point in the body frame.
    pub(crate) body_point: Vec2<R>,
    pub(crate) orientation: Orientation<R>,
    /// The surface on which the point lies exactly: gaps to it are counted from the point.
    pub(crate) on: Option<u8>,
}

impl<R: Real> Placed<R> {
    /// By the origin of the body.
    pub(crate) fn at(pose: &Pose<R>) -> Self {
        Self {
            point: pose.position,
            body_point: Vec2::ZERO,
            orientation: pose.orientation,
            on: None,
        }
    }

    pub(crate) fn pose(&self) -> Pose<R> {
        Pose {
            position: self.point - self.orientation.rotation().apply(self.body_point),
            orientation: self.orientation,
        }
    }

    /// From the point to a vertex, world frame.
    pub(crate) fn arm<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        vertex: u8,
    ) -> Vec2<R> {
        self.orientation
            .rotation()
            .apply(scene.body.vertex(vertex) - self.body_point)
    }

    /// The gap between a vertex and a surface, with its rounding.
    fn gap_at<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        contact: Pair,
        arm: Vec2<R>,
    ) -> (R, R) {
        let surface = scene.surface(contact.surface);
        let unit = R::TWO * R::EPSILON;
        if self.on == Some(contact.surface) {
            return (surface.normal.dot(arm), unit);
        }
        let level = surface.normal.dot(self.point) - surface.offset;
        let size = R::ONE + self.point.reach() + surface.offset.abs();
        (level + surface.normal.dot(arm), unit * size)
    }

    /// The gap between a vertex and a surface.
    pub(crate) fn gap<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        contact: Pair,
    ) -> R {
        self.gap_at(scene, contact, self.arm(scene, contact.vertex))
            .0
    }

    /// All contacts whose gap is below `tolerance`, in the order of surfaces and vertices.
    pub(crate) fn touching<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        tolerance: R,
    ) -> Pairs {
        let mut list = Pairs::new();
        for surface in scene.surface_indices() {
            for vertex in scene.body.indices() {
                let contact = Pair { vertex, surface };
                if self.gap(scene, contact) <= tolerance {
                    // Contacts beyond the capacity are redundant in the plane.
                    let _ = list.push(contact);
                }
            }
        }
        list
    }

    /// The gap on a motion on which the point moves by `shift`·tau.
    fn margin<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        contact: Pair,
        shift: Vec2<R>,
    ) -> Margin<R> {
        let surface = scene.surface(contact.surface);
        let arm = self.arm(scene, contact.vertex);
        let (start, rounding) = self.gap_at(scene, contact, arm);
        let along = if self.on == Some(contact.surface) {
            R::ZERO
        } else {
            surface.normal.dot(shift)
        };
        Margin {
            start,
            along,
            turning: Vec2::new(surface.normal.dot(arm), surface.normal.dot(arm.turned())),
            rounding,
        }
    }

    /// The first vertex to reach a surface on a motion, other than the contacts that it keeps. The course is
    /// shortened to there.
    pub(crate) fn first_touch<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        course: &mut Course<R>,
        moving: &Moving<'_, R>,
    ) -> Option<Pair> {
        let mut first = None;
        let mut visit = |contact: Pair| {
            if moving.keeps.contains(&contact) {
                return;
            }
            let margin = self.margin(scene, contact, moving.shift);
            if moving.motion.stop_at(&margin, course) {
                first = Some(contact);
            }
        };
        for surface in scene.surface_indices() {
            if self.on == Some(surface) {
                let Some(pivot) = moving.keeps.first() else {
                    continue;
                };
                if moving.keeps.iter().filter(|c| c.surface == surface).count() == 1 {
                    for vertex in scene.body.neighbours(pivot.vertex) {
                        visit(Pair { vertex, surface });
                    }
                }
            } else if self.is_near(scene, surface, moving) {
                for vertex in scene.body.indices() {
                    visit(Pair { vertex, surface });
                }
            }
        }
        first
    }

    /// False where the whole body stays clear of a surface: no vertex is farther from the point than one body size,
    /// or than the point is from vertex 0 and one body size more.
    fn is_near<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        surface: u8,
        moving: &Moving<'_, R>,
    ) -> bool {
        let surface = scene.surface(surface);
        let level = surface.normal.dot(self.point) - surface.offset;
        let arm = (scene.body.vertex(0) - self.body_point).reach();
        level <= R::TWO + arm + surface.normal.dot(moving.shift).abs()
    }
}

/// A motion of the placed point and the body about it.
pub(crate) struct Moving<'a, R> {
    pub(crate) motion: &'a Motion<R>,
    /// How far the point moves at tau = 1.
    pub(crate) shift: Vec2<R>,
    /// The contacts that last; the first one is at the point.
    pub(crate) keeps: &'a [Pair],
}
