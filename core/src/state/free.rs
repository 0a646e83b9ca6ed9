//! No contact (STATICS 2): the holding point hangs at the hand, the body turns with it.

use super::ContactState;
use super::segment::Segment;
use crate::certified::CertifiedTurn;
use crate::contact::{Opened, Pair, Pairs};
use crate::detect::{Known, Placed, PointPath, Short, Watch};
use crate::geometry::{Orientation, Pose, Vec2};
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::moment::{Downhill, Pinned, SecondHarmonic};
use crate::real::Real;
use crate::search::Looks;
use crate::verb::{Moved, Trigger};
use crate::work::Work;
use crate::world::World;

/// The memory: the pose itself, and the contacts that it has just left.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Free<R> {
    pub(crate) pose: Pose<R>,
    /// Contacts with obstacles that have opened at the present pose: they determine on which side of a thin wall the body is.
    left: Opened,
    /// Obstacles that are not watched are no closer than this (L); 0: not known.
    room: R,
    watch: Watch,
}

impl<R: Real> Free<R> {
    pub(crate) fn new(pose: Pose<R>) -> Self {
        Self {
            pose,
            left: Opened::NONE,
            room: R::ZERO,
            watch: Watch::NONE,
        }
    }

    /// A body whose contacts open.
    pub(crate) fn leaving<W: World<R>>(scene: &W, state: &ContactState<R>) -> Self {
        let mut free = Self::new(state.pose(scene));
        if W::CORNERS {
            free.left = Opened::of(state.contacts().iter().copied());
        }
        free
    }

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

    fn load(&self, scene: &impl World<R>, grip: &Grip<R>) -> Load<R> {
        Load::new(scene, self.placed(grip), grip)
    }

    /// A certified frame: it hangs at the hand, clear of all surfaces.
    pub(crate) fn follow<W: World<R>, H: SecondHarmonic<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        work: &mut Work,
    ) -> bool {
        let turn = to.angle.minus(from.angle);
        let (orientation, curvature_bound) = if Self::turns_with_hand(scene) {
            (Orientation::new(to.angle), turn * turn)
        } else {
            let pose = Self::hanging(scene, to, self.pose.orientation);
            let load = Self::new(pose).load(scene, to);
            match CertifiedTurn::pinned::<H>(scene, &load, to, &Displacement::turn(turn)) {
                Some(certified) => (certified.orientation, certified.swing()),
                None => return false,
            }
        };
        let after = Self::new(Self::hanging(scene, to, orientation));
        let mut is_certified = after.placed(to).is_clear(scene, curvature_bound);
        if W::CORNERS && is_certified {
            let places = [self.placed(from), after.placed(to)];
            is_certified = self.keeps_off(scene, places, curvature_bound, work);
        }
        if is_certified {
            self.pose = after.pose;
            if W::CORNERS {
                self.left = after.left;
            }
        }
        is_certified
    }

    /// Returns whether no obstacle is reached between two poses, with the turn bent by at most the given amount.
    #[inline(never)]
    fn keeps_off<W: World<R>>(
        &mut self,
        scene: &W,
        [before, after]: [Placed<R>; 2],
        curvature_bound: R,
        work: &mut Work,
    ) -> bool {
        let turned = (after.orientation.angle()).minus(before.orientation.angle());
        let turn = turned.abs().doubled() + curvature_bound;
        let short = Short {
            before,
            after,
            lasting: &[],
            way: (after.point - before.point).length_bound() + after.swing(scene, turn),
            turn,
        };
        short.keeps_off(scene, (&mut self.room, &mut self.watch), work)
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

    /// Along the hand's path, turning in balance with the weight.
    #[inline(never)]
    pub(crate) fn advance<H: SecondHarmonic<R>>(
        &mut self,
        scene: &impl World<R>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        let load = self.load(scene, from);
        let displacement = from.displacement_to(to);
        let mut moment = load.pinned::<H>();
        let mut drive = load.drive(&Displacement::turn(displacement.turn));
        if Self::turns_with_hand(scene) {
            // As the hand does, however little of the moment the number type can represent.
            (moment.stiffness, drive.couple) = (R::ONE, displacement.turn);
        }
        let mut segment = Segment::balanced(&moment, &drive, Trigger::Balanced);
        let moved = self.sweep(scene, &load.placed, &mut segment, displacement.hand);
        if moved.trigger == Trigger::Balanced && !moved.unsure {
            // The exact end, without the rounding of the path.
            self.pose = Self::balance::<H>(scene, to, self.pose.orientation).pose;
        }
        moved
    }

    /// The pose in balance at a grip, with the angle corrected from a nearby one.
    fn balance<H: SecondHarmonic<R>>(
        scene: &impl World<R>,
        grip: &Grip<R>,
        near: Orientation<R>,
    ) -> Self {
        let orientation = if Self::turns_with_hand(scene) {
            Orientation::new(grip.angle)
        } else {
            let pose = Self::hanging(scene, grip, near);
            let load = Self::new(pose).load(scene, grip);
            near.plus(load.pinned::<H>().polish())
        };
        Self::new(Self::hanging(scene, grip, orientation))
    }

    /// Moves in a straight line, in holding point and angle, to the balance at the frozen hand, or to the first touch. If that is blocked
    /// for a body that has just opened, the holding point moves first and the turn follows: both decrease the energy on their own, and the
    /// pull that opened the contact leads away from it.
    #[inline(never)]
    pub(crate) fn relax<H: SecondHarmonic<R>>(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
    ) -> Moved<R> {
        self.relax_by::<H>(scene, grip, self.downhill::<H>(scene, grip))
    }

    /// The same from a fold of the balance of the weight, on in the direction of the sign.
    #[inline(never)]
    pub(crate) fn snap<H: SecondHarmonic<R>>(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        direction: R,
    ) -> Moved<R> {
        let moment = self.load(scene, grip).pinned::<H>();
        self.relax_by::<H>(scene, grip, moment.over_fold(direction))
    }

    /// Moves in a straight line to the result of a search downhill; if that is blocked for a body that has just opened, first the holding
    /// point moves, then the body turns.
    fn relax_by<H: SecondHarmonic<R>>(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        downhill: Downhill<R>,
    ) -> Moved<R> {
        let near = self.pose.orientation.plus(downhill.turn);
        let begin = self.clone();
        let mut looks = downhill.looks;
        let mut moved = self.straight::<H>(scene, grip, (downhill.turn, R::ONE), &mut looks);
        if moved.trigger != Trigger::Balanced && begin.has_just_opened(scene) {
            *self = begin;
            moved = self.straight::<H>(scene, grip, (R::ZERO, R::ONE), &mut looks);
            if moved.trigger == Trigger::Balanced {
                moved = self.straight::<H>(scene, grip, (downhill.turn, R::ZERO), &mut looks);
            }
        }
        if moved.trigger == Trigger::Balanced {
            self.pose = Self::balance::<H>(scene, grip, near).pose;
        }
        moved.snapped = downhill.snapped;
        moved.unsure |= downhill.unsure;
        moved
    }

    /// Returns whether the hand alone holds it where it is, to within rounding; among obstacles also to within the uncertainty of the
    /// reaction of its last contact.
    pub(crate) fn is_near_balance<W: World<R>>(&self, scene: &W, grip: &Grip<R>, off: R) -> bool {
        let load = self.load(scene, grip);
        let turn = if Self::turns_with_hand(scene) {
            load.turn
        } else {
            load.pinned::<Pinned>().polish()
        };
        let mut near = load.release();
        if W::CORNERS {
            near = near.max(off);
        }
        load.force.length_bound() + turn.abs() <= near
    }

    /// The turn to balance.
    fn downhill<H: SecondHarmonic<R>>(&self, scene: &impl World<R>, grip: &Grip<R>) -> Downhill<R> {
        if Self::turns_with_hand(scene) {
            Downhill {
                turn: grip.angle.minus(self.pose.orientation.angle()),
                snapped: false,
                unsure: false,
                looks: Looks::ALL,
            }
        } else {
            self.load(scene, grip).pinned::<H>().downhill()
        }
    }

    /// Returns whether a vertex is still at a surface.
    fn has_just_opened(&self, scene: &impl World<R>) -> bool {
        !Placed::at(&self.pose).touching(scene, R::TOUCH).is_empty()
    }

    /// Turns by `turn` while the holding point covers the fraction `shift` of its path to balance.
    fn straight<H: SecondHarmonic<R>>(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        (turn, shift): (R, R),
        looks: &mut Looks,
    ) -> Moved<R> {
        let placed = self.placed(grip);
        let to_balance = grip.hand + scene.weight() - placed.point;
        let mut segment: Segment<R, H> = Segment::turning(turn, Trigger::Balanced).with(*looks);
        let moved = self.sweep(scene, &placed, &mut segment, to_balance * shift);
        *looks = segment.looks();
        moved
    }

    /// Follows a segment on which the holding point moves by `shift` at tau = 1, to its end or to the first touch.
    fn sweep<W: World<R>>(
        &mut self,
        scene: &W,
        placed: &Placed<R>,
        segment: &mut Segment<R, impl SecondHarmonic<R>>,
        shift: Vec2<R>,
    ) -> Moved<R> {
        let left = if W::CORNERS {
            self.left.pairs()
        } else {
            Pairs::new()
        };
        let known = Known {
            lasting: &[],
            left: &left,
            watch: Watch::NONE,
        };
        segment.stop_at_touch_of(scene, placed, (&PointPath::straight(shift), known));
        let end = Placed {
            point: placed.point + shift * segment.part(),
            orientation: placed.orientation.plus(segment.turn()),
            ..*placed
        };
        self.pose = end.pose();
        if W::CORNERS {
            self.room = R::ZERO;
            let placed = Placed::at(&self.pose);
            let is_still_there = |&pair: &Pair| {
                placed.gap(scene, pair).abs() <= R::TOUCH && placed.beyond(scene, pair) <= R::TOUCH
            };
            self.left = Opened::of(left.iter().copied().filter(is_still_there));
        }
        segment.moved()
    }
}
