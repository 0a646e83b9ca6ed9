//! One vertex on one surface (STATICS 3): pinned it turns in balance of moments about the contact, the angle on its
//! branch; it slips along the surface with the moment balanced at every place.

use super::leg::Leg;
use super::{Moved, Pairs, Reactions, Trigger};
use crate::calm::Calm;
use crate::coupling::{Grip, Pivot, Stance, Way};
use crate::detect::Placed;
use crate::friction::Verdict;
use crate::geometry::Vec2;
use crate::list::gather;
use crate::motion::{Margin, Unbent};
use crate::real::Real;
use crate::roots::Downhill;
use crate::scene::{Surface, World};

/// The memory: where the vertex is held, and the angle, which is the branch.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SingleVertex<R> {
    pub(crate) pivot: Pivot<R>,
    /// By so much the body can turn about the pivot before another vertex can touch (rad); 0: not known.
    pub(super) room: R,
}

/// Normal reaction and friction on a way of the hand.
struct Reaction<R> {
    normal: Margin<R>,
    friction: Margin<R>,
}

impl<R: Real> SingleVertex<R> {
    pub(crate) fn new(pivot: Pivot<R>) -> Self {
        Self {
            pivot,
            room: R::ZERO,
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        gather([self.pivot.contact])
    }

    fn reaction(stance: &Stance<R>, surface: &Surface<R>, way: &Way<R>) -> Reaction<R> {
        Reaction {
            normal: stance.reaction(surface.normal, way),
            friction: stance.reaction(surface.tangent, way),
        }
    }

    /// A calm frame: it sticks and turns.
    pub(crate) fn follow(&mut self, scene: &impl World<R>, from: &Grip<R>, to: &Grip<R>) -> bool {
        let stance = self.pivot.stance(scene, to);
        let drive = stance.lever.conj_mul(from.way_to(to).hand);
        let pinned = |stance: &Stance<R>| stance.pinned::<Unbent>();
        let calm = Calm::turn(&pinned(&stance), drive, stance.placed.orientation, |o| {
            pinned(&stance.turned(scene, o, to))
        });
        let Some(calm) = calm else {
            return false;
        };
        let surface = self.pivot.surface(scene);
        let normal = -surface.normal.dot(stance.force);
        let friction = -surface.tangent.dot(stance.force);
        // The reaction strays by the turn from the straight line to where the hand alone would take it.
        let stray = stance.lever.reach() * calm.reach + stance.rounding();
        if !surface.friction.is_within(normal, friction, stray) {
            return false;
        }
        // No point of the body is farther from the pivot than one body size, so that no gap shrinks by more than the turn.
        let mut room = self.room - calm.reach;
        if room <= R::ZERO {
            let placed = Placed {
                orientation: calm.orientation,
                ..stance.placed
            };
            room = placed.room(scene, Some(self.pivot.contact.vertex));
            if room <= (calm.reach * calm.reach).halved() {
                return false;
            }
        }
        self.room = room;
        self.pivot.orientation = calm.orientation;
        true
    }

    /// Sticks and turns as the hand moves, to the first of fold, touch, friction limit, lift-off.
    pub(crate) fn advance(
        &mut self,
        scene: &impl World<R>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let stance = self.pivot.stance(scene, from);
        let surface = self.pivot.surface(scene);
        let way = from.way_to(to);
        let moment = stance.pinned::<Unbent>();
        let mut leg = Leg::balanced(&moment, (stance.lever, &way), Trigger::Balanced);
        leg.stop_at_touch(scene, &stance.placed, (Vec2::ZERO, &self.contacts()));
        let Reaction { normal, friction } = Self::reaction(&stance, &surface, &way);
        for sign in [R::ONE, -R::ONE] {
            let holds = surface.friction.holds(normal, friction, sign);
            leg.stop_at(&holds, Trigger::Slide(sign));
        }
        leg.stop_at(&normal, Trigger::Clear);
        leg.turn_with_hand(scene, &mut self.pivot, to)
    }

    /// Turns downhill about the vertex to balance, then tests friction. A vertex that already slides
    /// goes on while it is driven, at once where the turn is blocked.
    pub(crate) fn relax(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        sliding: Option<R>,
    ) -> Moved<R> {
        let begin = self.clone();
        let stance = self.pivot.stance(scene, grip);
        let mut moved = self.turn_by(scene, grip, &stance.pinned::<Unbent>().downhill());
        let Some(sign) = sliding else {
            return moved;
        };
        // By a contact that was there at the beginning.
        let blocked = matches!(moved.trigger, Trigger::Touch(pair)
            if begin.pivot.placed(scene).gap(scene, pair) <= R::TOUCH.doubled());
        if blocked {
            *self = begin;
        }
        let at_rest = matches!(moved.trigger, Trigger::Balanced | Trigger::Slide(_));
        if (blocked || at_rest) && self.is_driven(scene, &self.pivot.stance(scene, grip), sign) {
            moved.trigger = Trigger::Slide(sign);
        }
        moved
    }

    /// True while the vertex slides on along sign·t, on a stable branch.
    fn is_driven(&self, scene: &impl World<R>, stance: &Stance<R>, sign: R) -> bool {
        let surface = self.pivot.surface(scene);
        let normal = -surface.normal.dot(stance.force);
        let friction = -surface.tangent.dot(stance.force);
        let rounding = stance.rounding();
        stance.stability() > R::ZERO
            && normal > rounding
            && (surface.friction).is_driven(normal, friction, sign, rounding)
    }

    /// The same from a fold of the branch, on in the direction of the sign.
    pub(crate) fn snap(&mut self, scene: &impl World<R>, grip: &Grip<R>, direction: R) -> Moved<R> {
        let moment = self.pivot.stance(scene, grip).pinned::<Unbent>();
        self.turn_by(scene, grip, &moment.over_fold(direction))
    }

    fn turn_by(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let keeps = self.contacts();
        let mut moved = Leg::<R>::turn_downhill(scene, &mut self.pivot, &keeps, downhill);
        if moved.trigger == Trigger::Balanced {
            moved.trigger = self.test(scene, grip);
        }
        moved
    }

    /// Friction at rest.
    fn test(&self, scene: &impl World<R>, grip: &Grip<R>) -> Trigger<R> {
        let stance = self.pivot.stance(scene, grip);
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

    /// Slides along sign·t, the moment as it is (balanced, but for a contact that opened in mid-slip), to the first of
    /// (E3), touch, lift-off, fold.
    pub(crate) fn slide(&mut self, scene: &impl World<R>, grip: &Grip<R>, sign: R) -> Moved<R> {
        self.room = R::ZERO;
        let mut stance = self.pivot.stance(scene, grip);
        let surface = self.pivot.surface(scene);
        if surface.friction.is_continuous() {
            // Where it stops it must also stick.
            stance.tolerance = R::ZERO;
        }
        // Beyond this way the hand would pull back.
        let farthest = stance.force.reach() + stance.lever.reach().doubled();
        let shift = surface.tangent * (sign * farthest);
        let way = Way::slide(shift);
        let moment = stance.pinned::<Unbent>();
        let mut leg = Leg::balanced(&moment, (stance.lever, &way), Trigger::Stopped);
        let Reaction { normal, friction } = Self::reaction(&stance, &surface, &way);
        let drives = surface.friction.drives(normal, friction, sign);
        leg.stop_at(&drives, Trigger::Stopped);
        leg.stop_at_touch(scene, &stance.placed, (shift, &self.contacts()));
        leg.stop_at(&normal, Trigger::Clear);
        let slip = sign * farthest * leg.part();
        self.pivot = self.pivot.moved(slip, R::ZERO);
        Moved {
            slip,
            ..leg.turn_with_hand(scene, &mut self.pivot, grip)
        }
    }

    pub(crate) fn reactions(&self, scene: &impl World<R>, stance: &Stance<R>) -> Reactions<R> {
        let surface = self.pivot.surface(scene);
        let normal = -surface.normal.dot(stance.force);
        let friction = -surface.tangent.dot(stance.force);
        gather([[normal.max(R::ZERO), friction]])
    }
}
