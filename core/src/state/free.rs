//! No contact (STATICS 2): the holding point hangs at the hand, the body turns with it.

use super::{Moved, Trigger};
use crate::coupling::{Grip, Stance};
use crate::detect::{Moving, Placed};
use crate::geometry::{Orientation, Pose, Vec2};
use crate::motion::{Course, Motion};
use crate::real::Real;
use crate::scene::Scene;

/// The memory: the pose itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Free<R> {
    pub(crate) pose: Pose<R>,
}

/// Where a motion without contact leads: the way of the holding point and the turn at tau = 1.
struct Sweep<'a, R> {
    motion: &'a Motion<R>,
    shift: Vec2<R>,
}

impl<R: Real> Free<R> {
    fn stance<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
    ) -> Stance<R> {
        let orientation = self.pose.orientation;
        let placed = Placed {
            point: self.pose.position + orientation.rotation().apply(grip.holding_point),
            body_point: grip.holding_point,
            orientation,
            on: None,
        };
        Stance::new(scene, placed, grip)
    }

    /// Along the hand's way, turning in balance with the weight.
    pub(crate) fn advance<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        let stance = self.stance(scene, from);
        let way = from.way_to(to);
        let motion = Motion::balanced(scene.stiffness, stance.hold, Vec2::ZERO, way.turn);
        let course = motion.course();
        let sweep = Sweep {
            motion: &motion,
            shift: way.hand,
        };
        let mut moved = self.sweep(scene, &stance, course, &sweep);
        if moved.trigger == Trigger::Balanced && course.folds {
            moved.trigger = Trigger::Fold(motion.direction());
        }
        if moved.trigger == Trigger::Balanced {
            // The end itself, free of the rounding of the way.
            *self = Self::balance(scene, to, self.pose.orientation);
        }
        moved
    }

    /// The pose in balance at a grip, the angle corrected from near it.
    fn balance<const V: usize, const S: usize>(
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
        near: Orientation<R>,
    ) -> Self {
        let follows = scene.weight == Vec2::ZERO && scene.stiffness > R::ZERO;
        let orientation = if follows {
            Orientation::new(grip.angle)
        } else {
            let pose = Pose {
                position: grip.hand,
                orientation: near,
            };
            near.plus(Self { pose }.stance(scene, grip).correction())
        };
        let holding_point = grip.hand + scene.weight;
        let position = holding_point - orientation.rotation().apply(grip.holding_point);
        Self {
            pose: Pose {
                position,
                orientation,
            },
        }
    }

    /// In a straight line, holding point and angle, to the balance at the frozen hand, or to the first touch. Where that
    /// is blocked for a body that has just opened, the holding point goes first and the turn follows: both fall in energy
    /// by themselves, and the pull that opened the contact leads away from it.
    pub(crate) fn relax<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
    ) -> Moved<R> {
        let downhill = self.stance(scene, grip).pinned().downhill();
        let near = self.pose.orientation.plus(downhill.turn);
        let begin = self.clone();
        let mut moved = self.straight(scene, grip, downhill.turn, R::ONE);
        if moved.trigger != Trigger::Balanced && begin.has_just_opened(scene) {
            *self = begin;
            moved = self.straight(scene, grip, R::ZERO, R::ONE);
            if moved.trigger == Trigger::Balanced {
                moved = self.straight(scene, grip, downhill.turn, R::ZERO);
            }
        }
        if moved.trigger == Trigger::Balanced {
            *self = Self::balance(scene, grip, near);
        }
        moved.snapped = downhill.snapped;
        moved.unsure |= downhill.unsure;
        moved
    }

    /// A vertex is still at a surface.
    fn has_just_opened<const V: usize, const S: usize>(&self, scene: &Scene<R, V, S>) -> bool {
        !Placed::at(&self.pose).touching(scene, R::TOUCH).is_empty()
    }

    /// Turns by `turn` while the holding point goes the part `shift` of its way to balance.
    fn straight<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
        turn: R,
        shift: R,
    ) -> Moved<R> {
        let stance = self.stance(scene, grip);
        let motion = Motion::turning(turn);
        let sweep = Sweep {
            motion: &motion,
            shift: stance.force * shift,
        };
        self.sweep(scene, &stance, motion.course_to(R::ONE), &sweep)
    }

    fn sweep<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        stance: &Stance<R>,
        mut course: Course<R>,
        sweep: &Sweep<'_, R>,
    ) -> Moved<R> {
        let moving = Moving {
            motion: sweep.motion,
            shift: sweep.shift,
            keeps: &[],
        };
        let touch = stance.placed.first_touch(scene, &mut course, &moving);
        let part = course.end.part();
        let orientation = self.pose.orientation.plus(course.end.turn);
        let point = stance.placed.point + sweep.shift * part;
        let placed = Placed {
            point,
            orientation,
            ..stance.placed
        };
        self.pose = placed.pose();
        Moved {
            part,
            unsure: course.unsure,
            ..Moved::by(touch.map_or(Trigger::Balanced, Trigger::Touch))
        }
    }
}
