//! No contact (STATICS 2): the holding point hangs at the hand, the body turns with it.

use super::leg::Leg;
use super::{Moved, Trigger};
use crate::calm::Calm;
use crate::coupling::{Grip, Stance, Way};
use crate::detect::Placed;
use crate::geometry::{Orientation, Pose, Vec2};
use crate::motion::{Bend, Motion};
use crate::real::Real;
use crate::scene::World;

/// The memory: the pose itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Free<R> {
    pub(crate) pose: Pose<R>,
}

impl<R: Real> Free<R> {
    fn stance(&self, scene: &impl World<R>, grip: &Grip<R>) -> Stance<R> {
        let orientation = self.pose.orientation;
        let placed = Placed {
            point: self.pose.position + orientation.rotation().apply(grip.holding_point),
            body_point: grip.holding_point,
            orientation,
            on: None,
        };
        Stance::new(scene, placed, grip)
    }

    /// A calm frame: it hangs at the hand, clear of all surfaces.
    pub(crate) fn follow<B: Bend<R>>(
        &mut self,
        scene: &impl World<R>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> bool {
        let way = Way::turn(from.way_to(to).turn);
        let pose = Self::hanging(scene, to, self.pose.orientation);
        let stance = Self { pose }.stance(scene, to);
        let (orientation, reach) = if Self::turns_with_hand(scene) {
            (Orientation::new(to.angle), way.turn.abs())
        } else if let Some(calm) = Self::calm::<B>(scene, &stance, to, &way) {
            (calm.orientation, calm.reach)
        } else {
            return false;
        };
        let pose = Self::hanging(scene, to, orientation);
        let follows = Self { pose }
            .stance(scene, to)
            .placed
            .is_clear(scene, None, reach);
        if follows {
            self.pose = pose;
        }
        follows
    }

    /// The weight turns it a little.
    fn calm<B: Bend<R>>(
        scene: &impl World<R>,
        stance: &Stance<R>,
        to: &Grip<R>,
        way: &Way<R>,
    ) -> Option<Calm<R>> {
        let pinned = |stance: &Stance<R>| stance.pinned::<B>();
        let drive = stance.lever.conj_mul(way.hand);
        Calm::turn(&pinned(stance), drive, stance.placed.orientation, |o| {
            pinned(&stance.turned(scene, o, to))
        })
    }

    /// The body without weight has the angle of the hand.
    fn turns_with_hand(scene: &impl World<R>) -> bool {
        scene.weight() == Vec2::ZERO && scene.stiffness() > R::ZERO
    }

    /// The holding point hangs at the hand.
    fn hanging(scene: &impl World<R>, grip: &Grip<R>, orientation: Orientation<R>) -> Pose<R> {
        let held = grip.hand + scene.weight();
        Pose {
            position: held - orientation.rotation().apply(grip.holding_point),
            orientation,
        }
    }

    /// Along the hand's way, turning in balance with the weight.
    pub(crate) fn advance<B: Bend<R>>(
        &mut self,
        scene: &impl World<R>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        let stance = self.stance(scene, from);
        let way = from.way_to(to);
        let moment = stance.pinned::<B>();
        let turns = Way::turn(way.turn);
        let leg = Leg::balanced(&moment, (stance.lever, &turns), Trigger::Balanced);
        let moved = self.sweep(scene, &stance, leg, way.hand);
        if moved.trigger == Trigger::Balanced && !moved.unsure {
            // The end itself, free of the rounding of the way.
            *self = Self::balance::<B>(scene, to, self.pose.orientation);
        }
        moved
    }

    /// The pose in balance at a grip, the angle corrected from near it.
    fn balance<B: Bend<R>>(scene: &impl World<R>, grip: &Grip<R>, near: Orientation<R>) -> Self {
        let orientation = if Self::turns_with_hand(scene) {
            Orientation::new(grip.angle)
        } else {
            let pose = Self::hanging(scene, grip, near);
            let stance = Self { pose }.stance(scene, grip);
            near.plus(stance.pinned::<B>().polish())
        };
        Self {
            pose: Self::hanging(scene, grip, orientation),
        }
    }

    /// In a straight line, holding point and angle, to the balance at the frozen hand, or to the first touch. Where that
    /// is blocked for a body that has just opened, the holding point goes first and the turn follows: both fall in energy
    /// by themselves, and the pull that opened the contact leads away from it.
    pub(crate) fn relax<B: Bend<R>>(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        let downhill = self.stance(scene, grip).pinned::<B>().downhill();
        let near = self.pose.orientation.plus(downhill.turn);
        let begin = self.clone();
        let mut moved = self.straight::<B>(scene, grip, downhill.turn, R::ONE);
        if moved.trigger != Trigger::Balanced && begin.has_just_opened(scene) {
            *self = begin;
            moved = self.straight::<B>(scene, grip, R::ZERO, R::ONE);
            if moved.trigger == Trigger::Balanced {
                moved = self.straight::<B>(scene, grip, downhill.turn, R::ZERO);
            }
        }
        if moved.trigger == Trigger::Balanced {
            *self = Self::balance::<B>(scene, grip, near);
        }
        moved.snapped = downhill.snapped;
        moved.unsure |= downhill.unsure;
        moved
    }

    /// A vertex is still at a surface.
    fn has_just_opened(&self, scene: &impl World<R>) -> bool {
        !Placed::at(&self.pose).touching(scene, R::TOUCH).is_empty()
    }

    /// Turns by `turn` while the holding point goes the part `shift` of its way to balance.
    fn straight<B: Bend<R>>(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        turn: R,
        shift: R,
    ) -> Moved<R> {
        let stance = self.stance(scene, grip);
        let leg: Leg<R, B> = Leg::whole(Motion::turning(turn), Trigger::Balanced);
        self.sweep(scene, &stance, leg, stance.force * shift)
    }

    /// Goes a leg on which the holding point moves by `shift` at tau = 1, to its end or to the first touch.
    fn sweep(
        &mut self,
        scene: &impl World<R>,
        stance: &Stance<R>,
        mut leg: Leg<R, impl Bend<R>>,
        shift: Vec2<R>,
    ) -> Moved<R> {
        leg.stop_at_touch(scene, &stance.placed, (shift, &[]));
        let placed = Placed {
            point: stance.placed.point + shift * leg.part(),
            orientation: self.pose.orientation.plus(leg.turn()),
            ..stance.placed
        };
        self.pose = placed.pose();
        leg.moved()
    }
}
