//! One vertex on one surface (STATICS 3): pinned it turns in balance of moments about the contact, the angle on its
//! branch; it slips along the surface with the moment balanced at every place.

use super::{Moved, Pairs, Reactions, Trigger};
use crate::coupling::{Grip, Pivot, Stance, Way};
use crate::detect::Moving;
use crate::friction::Verdict;
use crate::geometry::Vec2;
use crate::motion::{Course, Margin, Motion};
use crate::real::Real;
use crate::roots::Downhill;
use crate::scene::{Scene, Surface};

/// The memory: where the vertex is held, and the angle, which is the branch.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SingleVertex<R> {
    pub(crate) pivot: Pivot<R>,
}

/// Normal reaction and friction on a way of the hand.
struct Reaction<R> {
    normal: Margin<R>,
    friction: Margin<R>,
}

impl<R: Real> SingleVertex<R> {
    pub(crate) fn contacts(&self) -> Pairs {
        [self.pivot.contact].into_iter().collect()
    }

    fn stance<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
    ) -> Stance<R> {
        Stance::new(scene, self.pivot.placed(scene), grip)
    }

    fn reaction(stance: &Stance<R>, surface: &Surface<R>, way: &Way<R>) -> Reaction<R> {
        Reaction {
            normal: stance.reaction(surface.normal, way),
            friction: stance.reaction(surface.tangent, way),
        }
    }

    /// Sticks and turns as the hand moves, to the first of fold, touch, friction limit, lift-off.
    pub(crate) fn advance<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        let stance = self.stance(scene, from);
        let surface = self.pivot.surface(scene);
        let way = from.way_to(to);
        let drive = stance.lever.conj_mul(way.hand);
        let motion = Motion::balanced(scene.stiffness, stance.hold, drive, way.turn);
        let mut course = motion.course();
        let mut trigger = fold_or_end(&course, &motion);
        let keeps = [self.pivot.contact];
        let moving = Moving {
            motion: &motion,
            shift: Vec2::ZERO,
            keeps: &keeps,
        };
        if let Some(touch) = stance.placed.first_touch(scene, &mut course, &moving) {
            trigger = Trigger::Touch(touch);
        }
        let reaction = Self::reaction(&stance, &surface, &way);
        for sign in [R::ONE, -R::ONE] {
            let holds = surface
                .friction
                .holds(reaction.normal, reaction.friction, sign);
            if motion.stop_at(&holds, &mut course) {
                trigger = Trigger::Slide(sign);
            }
        }
        if motion.stop_at(&reaction.normal, &mut course) {
            trigger = Trigger::Clear;
        }
        self.turn(course.end.turn);
        if trigger == Trigger::Balanced {
            let correction = self.stance(scene, to).correction();
            self.turn(correction);
        }
        Moved {
            part: course.end.part(),
            unsure: course.unsure,
            ..Moved::by(trigger)
        }
    }

    fn turn(&mut self, turn: R) {
        self.pivot = self.pivot.moved(R::ZERO, turn);
    }

    /// Turns downhill about the vertex to balance, then tests friction. A vertex that already slides goes on first while
    /// it is driven.
    pub(crate) fn relax<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
        sliding: Option<R>,
    ) -> Moved<R> {
        let stance = self.stance(scene, grip);
        if let Some(sign) = sliding
            && self.is_driven(scene, &stance, sign)
        {
            return Moved::by(Trigger::Slide(sign));
        }
        self.turn_by(scene, grip, &stance.pinned().downhill())
    }

    /// True while the vertex slides on along sign·t.
    fn is_driven<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        stance: &Stance<R>,
        sign: R,
    ) -> bool {
        let surface = self.pivot.surface(scene);
        let normal = -surface.normal.dot(stance.force);
        let friction = -surface.tangent.dot(stance.force);
        let rounding = stance.rounding();
        normal > rounding && (surface.friction).is_driven(normal, friction, sign, rounding)
    }

    /// The same from a fold of the branch, on in the direction of the sign.
    pub(crate) fn snap<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
        direction: R,
    ) -> Moved<R> {
        let downhill = self.stance(scene, grip).pinned().over_fold(direction);
        self.turn_by(scene, grip, &downhill)
    }

    fn turn_by<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        let motion = Motion::turning(downhill.turn);
        let mut course = motion.course_to(R::ONE);
        let keeps = [self.pivot.contact];
        let moving = Moving {
            motion: &motion,
            shift: Vec2::ZERO,
            keeps: &keeps,
        };
        let placed = self.pivot.placed(scene);
        let touch = placed.first_touch(scene, &mut course, &moving);
        self.turn(course.end.turn);
        let trigger = match touch {
            Some(touch) => Trigger::Touch(touch),
            None => self.test(scene, grip),
        };
        Moved {
            snapped: downhill.snapped,
            unsure: downhill.unsure || course.unsure,
            ..Moved::by(trigger)
        }
    }

    /// Friction at rest.
    fn test<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
    ) -> Trigger<R> {
        let stance = self.stance(scene, grip);
        let surface = self.pivot.surface(scene);
        let normal = -surface.normal.dot(stance.force);
        let friction = -surface.tangent.dot(stance.force);
        let rounding = stance.rounding();
        match surface.friction.judge(normal, friction, rounding) {
            Verdict::Sticks => Trigger::Balanced,
            Verdict::Slides(sign) => Trigger::Slide(sign),
            Verdict::Opens => Trigger::Clear,
        }
    }

    /// Slides along sign·t, the moment as it is (balanced, but for a contact that opened in mid-slip), to the first of (E3), touch, lift-off, fold.
    pub(crate) fn slide<const V: usize, const S: usize>(
        &mut self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
        sign: R,
    ) -> Moved<R> {
        let stance = self.stance(scene, grip);
        let surface = self.pivot.surface(scene);
        // Beyond this way the hand would pull back.
        let farthest = stance.force.reach() + R::TWO * stance.lever.reach();
        let shift = surface.tangent * (sign * farthest);
        let way = Way::slide(shift);
        let drive = stance.lever.conj_mul(way.hand);
        let motion = Motion::balanced(scene.stiffness, stance.hold, drive, R::ZERO);
        let mut course = motion.course();
        let mut trigger = match fold_or_end(&course, &motion) {
            Trigger::Balanced => Trigger::Stopped,
            fold => fold,
        };
        let reaction = Self::reaction(&stance, &surface, &way);
        let drives = surface
            .friction
            .drives(reaction.normal, reaction.friction, sign);
        if motion.stop_at(&drives, &mut course) {
            trigger = Trigger::Stopped;
        }
        let keeps = [self.pivot.contact];
        let moving = Moving {
            motion: &motion,
            shift,
            keeps: &keeps,
        };
        if let Some(touch) = stance.placed.first_touch(scene, &mut course, &moving) {
            trigger = Trigger::Touch(touch);
        }
        if motion.stop_at(&reaction.normal, &mut course) {
            trigger = Trigger::Clear;
        }
        let slip = sign * farthest * course.end.part();
        self.pivot = self.pivot.moved(slip, course.end.turn);
        Moved {
            slip,
            unsure: course.unsure,
            ..Moved::by(trigger)
        }
    }

    pub(crate) fn reactions<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        stance: &Stance<R>,
    ) -> Reactions<R> {
        let surface = self.pivot.surface(scene);
        let normal = -surface.normal.dot(stance.force);
        let friction = -surface.tangent.dot(stance.force);
        [[normal.max(R::ZERO), friction]].into_iter().collect()
    }
}

/// What a course leads to before anything else is looked at.
pub(super) fn fold_or_end<R: Real>(course: &Course<R>, motion: &Motion<R>) -> Trigger<R> {
    if course.folds {
        Trigger::Fold(motion.direction())
    } else {
        Trigger::Balanced
    }
}
