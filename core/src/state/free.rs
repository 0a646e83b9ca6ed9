//! No contact (STATICS 2): the holding point hangs at the hand, the body turns with it.

use super::leg::Leg;
use crate::calm::Calm;
use crate::detect::Placed;
use crate::geometry::{Orientation, Pose, Vec2};
use crate::grip::{Grip, Way};
use crate::load::Stance;
use crate::moment::{Bend, Downhill};
use crate::real::Real;
use crate::verb::{Moved, Trigger};
use crate::world::World;

/// The memory: the pose itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Free<R> {
    pub(crate) pose: Pose<R>,
}

impl<R: Real> Free<R> {
    /// The body placed by its holding point.
    fn placed(&self, grip: &Grip<R>) -> Placed<R> {
        let orientation = self.pose.orientation;
        Placed {
            point: self.pose.position + orientation.rotation().apply(grip.holding_point),
            body_point: grip.holding_point,
            orientation,
            on: None,
        }
    }

    fn stance(&self, scene: &impl World<R>, grip: &Grip<R>) -> Stance<R> {
        Stance::new(scene, self.placed(grip), grip)
    }

    /// A calm frame: it hangs at the hand, clear of all surfaces.
    pub(crate) fn follow<B: Bend<R>>(
        &mut self,
        scene: &impl World<R>,
        (from, to): (&Grip<R>, &Grip<R>),
        tolerance: R,
    ) -> bool {
        let turn = to.angle.minus(from.angle);
        let (orientation, bow) = if Self::turns_with_hand(scene) {
            (Orientation::new(to.angle), turn * turn)
        } else {
            let pose = Self::hanging(scene, to, self.pose.orientation);
            let mut stance = Self { pose }.stance(scene, to);
            stance.tolerance = tolerance;
            match Calm::pinned::<B>(scene, &stance, to, &Way::turn(turn)) {
                Some(calm) => (calm.orientation, calm.swing()),
                None => return false,
            }
        };
        let after = Self {
            pose: Self::hanging(scene, to, orientation),
        };
        let follows = after.placed(to).is_clear(scene, bow);
        if follows {
            *self = after;
        }
        follows
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
        let mut moment = stance.pinned::<B>();
        if Self::turns_with_hand(scene) {
            // As the hand does, however little of the moment the number type sees.
            moment.stiffness = R::ONE;
        }
        let turns = Way::turn(way.turn);
        let leg = Leg::balanced(&moment, (stance.lever, &turns), Trigger::Balanced);
        let moved = self.sweep(scene, &stance.placed, leg, way.hand);
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
        let downhill = self.downhill::<B>(scene, grip);
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

    /// The turn to balance.
    fn downhill<B: Bend<R>>(&self, scene: &impl World<R>, grip: &Grip<R>) -> Downhill<R> {
        if Self::turns_with_hand(scene) {
            Downhill {
                turn: grip.angle.minus(self.pose.orientation.angle()),
                snapped: false,
                unsure: false,
            }
        } else {
            self.stance(scene, grip).pinned::<B>().downhill()
        }
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
        let placed = self.placed(grip);
        let way = grip.hand + scene.weight() - placed.point;
        let leg: Leg<R, B> = Leg::turning(turn, Trigger::Balanced);
        self.sweep(scene, &placed, leg, way * shift)
    }

    /// Goes a leg on which the holding point moves by `shift` at tau = 1, to its end or to the first touch.
    fn sweep(
        &mut self,
        scene: &impl World<R>,
        placed: &Placed<R>,
        mut leg: Leg<R, impl Bend<R>>,
        shift: Vec2<R>,
    ) -> Moved<R> {
        leg.stop_at_touch(scene, placed, (shift, &[]));
        let end = Placed {
            point: placed.point + shift * leg.part(),
            orientation: placed.orientation.plus(leg.turn()),
            ..*placed
        };
        self.pose = end.pose();
        leg.moved()
    }
}
