//! 2: gaps between the body's vertices and the surfaces, and the first of them to close on a motion.

use crate::balance_curve::{BalanceCurve, Extent, Margin};
use crate::contact::{Pair, Pairs};
use crate::geometry::{Orientation, Pose, Vec2};
use crate::moment::SecondHarmonic;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::work::{PLACE, SURFACE, TOUCH, VERTEX_AT_SURFACE};
use crate::world::World;

mod obstacles;

pub(crate) use obstacles::{Among, Known, Reached, Short, Sizes, Tip, Watch, first_reached};

/// The body placed by one of its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<R> {
    /// The point in the world.
    pub(crate) point: Vec2<R>,
    /// The point in the body frame.
    pub(crate) body_point: Vec2<R>,
    pub(crate) orientation: Orientation<R>,
    /// The surface on which the point lies exactly: gaps to it are measured from the point.
    pub(crate) on: Option<u8>,
}

impl<R: Real> Placed<R> {
    /// Placed by the origin of the body.
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
    pub(crate) fn arm(&self, scene: &impl World<R>, vertex: u8) -> Vec2<R> {
        self.orientation
            .rotation()
            .apply(scene.vertex(vertex) - self.body_point)
    }

    /// From the point to a contact, world frame.
    pub(crate) fn arm_to<W: World<R>>(&self, scene: &W, contact: Pair) -> Vec2<R> {
        if W::CORNERS && contact.is_corner() {
            let place = scene
                .corner(contact.surface)
                .map_or(self.point, |c| c.place);
            return place - self.point;
        }
        self.arm(scene, contact.vertex)
    }

    /// Returns whether two contacts are collinear, with the same friction: together they are an edge.
    pub(crate) fn are_in_line<W: World<R>>(&self, scene: &W, [a, b]: [Pair; 2]) -> bool {
        if !W::CORNERS {
            return a.surface == b.surface;
        }
        let [first, second] = [a, b].map(|pair| scene.surface(pair.surface).friction);
        first == second && self.lie_in_line(scene, [a, b])
    }

    /// Returns whether two contacts are collinear and face the same direction, to the least displacement: determined from the tilt, as the
    /// heights of contacts close to each other do not show it.
    pub(crate) fn lie_in_line<W: World<R>>(&self, scene: &W, [a, b]: [Pair; 2]) -> bool {
        if a.surface == b.surface && !a.is_corner() && !b.is_corner() {
            return true;
        }
        if !a.is_corner() && a.vertex == b.vertex {
            return false;
        }
        let rotation = self.orientation.rotation();
        let [first, second] = [a, b].map(|pair| scene.face(pair, rotation).normal);
        let apart = self.arm_to(scene, b) - self.arm_to(scene, a);
        first.dot(second) > R::ZERO
            && first.cross(second).abs() <= R::MICRO
            && first.dot(apart).abs() <= R::from_int(4) * R::MICRO
    }

    /// The gap between a vertex and a surface, with its rounding.
    fn gap_at(&self, scene: &impl World<R>, contact: Pair, arm: Vec2<R>) -> (R, R) {
        let surface = scene.surface(contact.surface);
        let unit = R::of_coordinates();
        if self.on == Some(contact.surface) {
            return (surface.normal.dot(arm), unit);
        }
        let level = surface.normal.dot(self.point) - surface.offset;
        let size = R::ONE + self.point.length_bound() + surface.offset.abs();
        (level + surface.normal.dot(arm), unit * size)
    }

    /// The gap of a contact: of a vertex from a surface, of a corner from a side of the body.
    pub(crate) fn gap<W: World<R>>(&self, scene: &W, contact: Pair) -> R {
        if W::CORNERS && contact.is_corner() {
            let side = contact.body_side();
            let outward = scene.body_normal(side);
            let from_corner = self.arm_to(scene, contact);
            let above = self.orientation.rotation().apply(outward).dot(from_corner);
            return above - outward.dot(scene.vertex(side) - self.body_point);
        }
        self.gap_at(scene, contact, self.arm(scene, contact.vertex))
            .0
    }

    /// The coordinate of a contact along t: of the vertex on its surface, of the body's material at a corner.
    pub(crate) fn foot<W: World<R>>(&self, scene: &W, contact: Pair) -> R {
        let tangent = scene.face(contact, self.orientation.rotation()).tangent;
        if W::CORNERS && contact.is_corner() {
            let origin = -self.orientation.rotation().apply(self.body_point);
            return tangent.dot(origin - self.arm_to(scene, contact));
        }
        tangent.dot(self.point + self.arm(scene, contact.vertex))
    }

    /// The height of the point above a surface, and the surface's normal in the body frame: the gap of a vertex is
    /// height + normal·(vertex - body point).
    fn above(&self, scene: &impl World<R>, index: u8) -> (R, Vec2<R>) {
        let surface = scene.surface(index);
        let height = if self.on == Some(index) {
            R::ZERO
        } else {
            surface.normal.dot(self.point) - surface.offset
        };
        (height, self.orientation.rotation().undo(surface.normal))
    }

    /// Returns whether the shift and the turn together are small.
    pub(crate) fn is_near(&self, other: &Self, little: R) -> bool {
        let [a, b] = [self, other].map(Self::pose);
        let moved = (a.position - b.position).length_bound();
        let turned = a.orientation.angle().minus(b.orientation.angle());
        moved + turned.abs() <= little
    }

    /// All contacts whose gap is below `tolerance`, in the order of surfaces and vertices.
    pub(crate) fn touching<W: World<R>>(&self, scene: &W, tolerance: R) -> Pairs {
        let mut list = Pairs::new();
        for surface in scene.surface_indices() {
            let (height, normal) = self.above(scene, surface);
            for vertex in scene.vertex_indices() {
                let gap = height + normal.dot(scene.vertex(vertex) - self.body_point);
                if gap <= tolerance {
                    // No more than two contacts of one surface; of more than four surfaces the first four count.
                    let _ = list.push(Pair { vertex, surface });
                }
            }
        }
        if W::CORNERS {
            self.touching_obstacles(scene, tolerance, &mut list);
        }
        list
    }

    /// The contacts of a body that is set onto the surfaces, with gaps below `tolerance`: for each surface the two lowest vertices, in the
    /// order of surfaces and vertices.
    pub(crate) fn seats<W: World<R>>(&self, scene: &W, tolerance: R) -> Pairs {
        let mut list = Pairs::new();
        for surface in scene.surface_indices() {
            let gap = |vertex: u8| self.gap(scene, Pair { vertex, surface });
            for vertex in scene.vertex_indices() {
                let is_lower = |other: &u8| (gap(*other), *other) < (gap(vertex), vertex);
                let lower = scene.vertex_indices().filter(is_lower).count();
                if gap(vertex) <= tolerance && lower < 2 {
                    // Of more than four surfaces the first four count.
                    let _ = list.push(Pair { vertex, surface });
                }
            }
        }
        if W::CORNERS {
            let mut near = Pairs::new();
            self.touching_obstacles(scene, tolerance, &mut near);
            for pair in near {
                let is_taken = |&other: &Pair| self.are_one(scene, [other, pair]);
                if !list.iter().any(is_taken) {
                    // Excess contacts are dropped.
                    let _ = list.push(pair);
                }
            }
            list = self.outermost(scene, &list);
        }
        list
    }

    /// True if no vertex can have reached a surface on a path of the point that ended here, provided that no gap was negative at its
    /// beginning: a gap lies above its chord less a sagitta. `curvature_bound`: a bound of ϑ'² + |ϑ''| in tau.
    pub(crate) fn is_clear<W: World<R>>(&self, scene: &W, curvature_bound: R) -> bool {
        self.room(scene, None) > (self.radius(scene, None) * curvature_bound).halved()
    }

    /// The least gap of all vertices except the `pivot` at the point, less the touch tolerance and the rounding; if all are far away, a
    /// lower bound.
    pub(crate) fn room(&self, scene: &impl World<R>, pivot: Option<u8>) -> R {
        let radius = self.radius(scene, pivot);
        let mut least = R::HUGE;
        for index in scene.surface_indices() {
            let surface = scene.surface(index);
            let level = if self.on == Some(index) {
                -R::TOUCH
            } else {
                let size = R::ONE + self.point.length_bound() + surface.offset.abs();
                let rounding = R::rounding(size).doubled();
                surface.normal.dot(self.point) - surface.offset - rounding - R::TOUCH
            };
            if level > radius.doubled() {
                least = least.min(level - radius);
                continue;
            }
            let normal = self.orientation.rotation().undo(surface.normal);
            let mut visit = |vertex: u8| {
                let gap = level + normal.dot(scene.vertex(vertex) - self.body_point);
                least = least.min(gap);
            };
            match pivot {
                Some(vertex) if self.on == Some(index) => {
                    let neighbours = scene.neighbours(vertex).into_iter();
                    // A point has no other vertex.
                    let others = neighbours.filter(|&i| i != vertex);
                    others.for_each(&mut visit);
                }
                _ => scene.vertex_indices().for_each(&mut visit),
            }
        }
        least
    }

    /// The least gap of some vertices and surfaces, less the touch tolerance and the rounding.
    pub(crate) fn room_of(&self, scene: &impl World<R>, counts: impl Fn(&Pair) -> bool) -> R {
        let pairs = scene.surface_indices().flat_map(|surface| {
            let vertices = scene.vertex_indices();
            vertices.map(move |vertex| Pair { vertex, surface })
        });
        let gaps = pairs.filter(counts).map(|pair| {
            let (gap, rounding) = self.gap_at(scene, pair, self.arm(scene, pair.vertex));
            gap - rounding - R::TOUCH
        });
        gaps.fold(R::HUGE, R::min)
    }

    /// The most by which any point of the body moves if it turns about the placed point by no more than an angle.
    pub(crate) fn swing(&self, scene: &impl World<R>, turn: R) -> R {
        self.radius(scene, None) * turn
    }

    /// No vertex is farther from the point than this; `pivot`: the vertex at the point, if there is one.
    fn radius(&self, scene: &impl World<R>, pivot: Option<u8>) -> R {
        match pivot {
            Some(_) => R::ONE,
            None => R::ONE + (scene.vertex(0) - self.body_point).length_bound(),
        }
    }

    /// The gap on a motion in which the point follows a path.
    fn margin(&self, scene: &impl World<R>, contact: Pair, path: &PointPath<R>) -> Margin<R> {
        let surface = scene.surface(contact.surface);
        let arm = self.arm(scene, contact.vertex);
        let (start, rounding) = self.gap_at(scene, contact, arm);
        let mut turning = Vec2::new(surface.normal.dot(arm), surface.normal.dot(arm.turned()));
        let mut along = R::ZERO;
        if self.on != Some(contact.surface) {
            along = surface.normal.dot(path.shift);
            turning = turning + path.turning * surface.normal.dot(path.tangent);
        }
        Margin {
            start,
            along,
            turning,
            rounding,
        }
    }

    /// The first vertex to reach a surface on a motion, other than the contacts that last. The extent is shortened to that point.
    pub(crate) fn first_touch<W: World<R>, H: SecondHarmonic<R>>(
        &self,
        scene: &W,
        extent: &mut Extent<R>,
        moving: &Moving<'_, R, H>,
    ) -> Option<Pair> {
        let mut first = None;
        extent.looks.add(TOUCH);
        let radius = self.radius(scene, None);
        let lasting = || moving.lasting.iter();
        for index in scene.surface_indices() {
            let surface = scene.surface(index);
            let (height, normal) = self.above(scene, index);
            let mut along = surface.normal.dot(moving.path.shift).abs() * extent.part_bound;
            along = along + moving.path.turning.length_bound() * extent.end.turn.abs();
            if height - along > radius.doubled() {
                continue;
            }
            extent.looks.add(SURFACE);
            let mut visit = |vertex: u8| {
                let contact = Pair {
                    vertex,
                    surface: index,
                };
                let arm = scene.vertex(vertex) - self.body_point;
                let swing = arm.length_bound() * extent.end.turn.abs();
                let clear = height + normal.dot(arm) - along - swing;
                if clear > R::TOUCH || moving.lasting.contains(&contact) {
                    return;
                }
                extent.looks.add(VERTEX_AT_SURFACE);
                let margin = self.margin(scene, contact, moving.path);
                if moving.curve.stop_at(&margin, extent) {
                    first = Some(contact);
                }
            };
            if self.on != Some(index) {
                scene.vertex_indices().for_each(&mut visit);
            } else if lasting().skip(1).all(|other| other.surface != index) {
                // On its own surface no vertex arrives before a neighbour.
                let pivot = lasting().take(1);
                let neighbours = pivot.flat_map(|pivot| scene.neighbours(pivot.vertex));
                neighbours.for_each(&mut visit);
            }
        }
        if W::CORNERS {
            let (reached, work) = self.first_obstacle(scene, extent, moving);
            extent.looks.add_among(work);
            if let Some(reached) = reached {
                extent.end = moving.curve.at(reached.x);
                (extent.folds, extent.unsure) = (false, reached.unsure);
                first = Some(reached.contact);
            }
        }
        first
    }

    /// The first obstacle to be reached on the extent of a motion, and the work of the search, in units of work.
    #[inline(never)]
    fn first_obstacle<W: World<R>, H: SecondHarmonic<R>>(
        &self,
        scene: &W,
        extent: &Extent<R>,
        moving: &Moving<'_, R, H>,
    ) -> (Option<Reached<R>>, u32) {
        let end = extent.end.x;
        let known = Known {
            lasting: moving.lasting,
            left: moving.left,
            watch: Watch::NONE,
        };
        let at = |x: R| {
            let place = if x == end {
                extent.end
            } else {
                moving.curve.at(x)
            };
            moving.curve.instant(&place, self, moving.path)
        };
        first_reached(scene, (known, Among::Obstacles), end, (&at, PLACE))
    }
}

/// The path of the placed point: it moves by shift·tau + tangent·(-u (1 - cos ϑ) + v sin ϑ).
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointPath<R> {
    pub(crate) shift: Vec2<R>,
    pub(crate) tangent: Vec2<R>,
    /// (u, v)
    pub(crate) turning: Vec2<R>,
}

impl<R: Real> PointPath<R> {
    /// The point moves by `shift` at tau = 1, however the body turns.
    pub(crate) fn straight(shift: Vec2<R>) -> Self {
        Self {
            shift,
            tangent: Vec2::ZERO,
            turning: Vec2::ZERO,
        }
    }

    /// The point moves along a tangent, by the displacement of a foot divided by `per`.
    pub(crate) fn of_foot(tangent: Vec2<R>, foot: &Margin<R>, per: R) -> Self {
        Self {
            shift: tangent * (foot.along / per),
            tangent,
            turning: foot.turning.over(per),
        }
    }
}

/// A motion of the placed point and the body about it.
pub(crate) struct Moving<'a, R, H> {
    pub(crate) curve: &'a BalanceCurve<R, H>,
    pub(crate) path: &'a PointPath<R>,
    /// The contacts that last; the first one is at the point.
    pub(crate) lasting: &'a [Pair],
    /// Contacts with obstacles that have just opened.
    pub(crate) left: &'a [Pair],
}

#[cfg(test)]
mod tests;
