//! One vertex on a surface without friction (STATICS 3.5): it glides. Its foot is where the tangential forces balance, so
//! that the angle alone moves as if free, with a second harmonic in its moment; there is no stick, no slip and no test of
//! friction.

use super::leg::Leg;
use super::{Moved, SingleVertex, Trigger};
use crate::calm::Calm;
use crate::coupling::{Grip, Stance, Way};
use crate::geometry::Vec2;
use crate::motion::Motion;
use crate::real::Real;
use crate::roots::Downhill;
use crate::scene::World;

/// How a foot that is out of balance and a turn go together at a frozen hand.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Order {
    /// In proportion.
    Together,
    /// The body turns; the foot is out of balance as before.
    Turn,
    /// The foot comes to balance; the body does not turn.
    Slide,
}

impl<R: Real> SingleVertex<R> {
    /// A calm frame: it glides and turns.
    pub(crate) fn glide_on<W: World<R>>(
        &mut self,
        scene: &W,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> bool {
        let stance = self.pivot.stance(scene, to);
        let surface = self.pivot.surface(scene);
        let way = from.way_to(to);
        let gliding = |stance: &Stance<R>| stance.gliding::<W::Bend>(scene, &surface);
        let drive = stance.lever.conj_mul(way.pressing(&surface).hand);
        let calm = Calm::turn(&gliding(&stance), drive, stance.placed.orientation, |o| {
            gliding(&stance.turned(scene, o, to))
        });
        let Some(calm) = calm else {
            return false;
        };
        // The reaction strays by the turn from the straight line to where the hand alone would take it.
        let normal = -surface.normal.dot(stance.force);
        let stray = stance.lever.reach() * calm.reach + stance.rounding();
        if normal <= stray {
            return false;
        }
        let mut pivot = self.pivot;
        pivot.orientation = calm.orientation;
        pivot.glide(scene, to);
        // No point of the body is farther from the foot than one body size. To its own surface no gap shrinks by more than
        // the turn; to another one by the way of the foot as well.
        let (mut shrinks, mut sagitta) = (calm.reach, (calm.reach * calm.reach).halved());
        if W::SURFACES {
            let along = surface.tangent.dot(way.hand).abs();
            shrinks = shrinks + along + stance.lever.reach() * calm.reach;
            sagitta = shrinks;
        }
        let mut room = self.room - shrinks;
        if room <= R::ZERO {
            room = (pivot.placed(scene)).room(scene, Some(pivot.contact.vertex));
            if room <= sagitta {
                return false;
            }
        }
        *self = Self { pivot, room };
        true
    }

    /// Glides as the hand moves, to the first of fold, touch, lift-off.
    pub(crate) fn glide_along<W: World<R>>(
        &mut self,
        scene: &W,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let stance = self.pivot.stance(scene, from);
        let surface = self.pivot.surface(scene);
        let way = from.way_to(to);
        let moment = stance.gliding::<W::Bend>(scene, &surface);
        let pressing = way.pressing(&surface);
        let mut leg = Leg::balanced(&moment, (stance.lever, &pressing), Trigger::Balanced);
        let shift = surface.tangent * surface.tangent.dot(way.hand);
        leg.stop_at_touch(scene, &stance.placed, (shift, &self.contacts()));
        leg.stop_at(&stance.reaction(surface.normal, &way), Trigger::Clear);
        let moved = leg.moved();
        self.pivot = self.pivot.moved(R::ZERO, leg.turn());
        if moved.trigger == Trigger::Balanced && !moved.unsure {
            self.rest(scene, to);
        } else {
            self.pivot.glide(scene, &from.lerp(to, moved.part));
        }
        moved
    }

    /// Glides downhill at a frozen hand, to the first of balance, touch, lift-off.
    pub(crate) fn glide_down<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>) -> Moved<R> {
        let surface = self.pivot.surface(scene);
        let stance = self.pivot.stance(scene, grip);
        let moment = stance.gliding::<W::Bend>(scene, &surface);
        self.glide_by(scene, grip, &moment.downhill())
    }

    /// The same from a fold of the branch, on in the direction of the sign.
    pub(crate) fn glide_over<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        direction: R,
    ) -> Moved<R> {
        let surface = self.pivot.surface(scene);
        let stance = self.pivot.stance(scene, grip);
        let moment = stance.gliding::<W::Bend>(scene, &surface);
        self.glide_by(scene, grip, &moment.over_fold(direction))
    }

    /// Turns downhill, and the foot comes to balance on the way: the energy is that of the turn and that of the foot, and
    /// both fall by themselves. Where a contact that was there at the beginning blocks both together, one goes first.
    fn glide_by<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let stance = self.pivot.stance(scene, grip);
        if self.pivot.surface(scene).normal.dot(stance.force) > stance.rounding() {
            return Moved::by(Trigger::Clear);
        }
        let begin = self.clone();
        let mut moved = self.go(scene, grip, (downhill.turn, Order::Together));
        if W::SURFACES {
            for order in [[Order::Turn, Order::Slide], [Order::Slide, Order::Turn]] {
                if !begin.is_blocked(scene, &moved) {
                    break;
                }
                *self = begin.clone();
                moved = self.go(scene, grip, (downhill.turn, order[0]));
                if moved.trigger == Trigger::Balanced {
                    moved = self.go(scene, grip, (downhill.turn, order[1]));
                }
            }
        }
        if moved.trigger == Trigger::Balanced {
            self.rest(scene, grip);
        }
        Moved {
            snapped: downhill.snapped,
            unsure: moved.unsure || downhill.unsure,
            ..moved
        }
    }

    /// By a contact that was there at the beginning.
    fn is_blocked(&self, scene: &impl World<R>, moved: &Moved<R>) -> bool {
        matches!(moved.trigger, Trigger::Touch(pair)
            if self.pivot.placed(scene).gap(scene, pair) <= R::TOUCH.doubled())
    }

    /// One leg at a frozen hand.
    fn go<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        (turn, order): (R, Order),
    ) -> Moved<R> {
        let stance = self.pivot.stance(scene, grip);
        let surface = self.pivot.surface(scene);
        let (turn, slide) = match order {
            Order::Together => (turn, surface.tangent.dot(stance.force)),
            Order::Turn => (turn, R::ZERO),
            Order::Slide => (R::ZERO, surface.tangent.dot(stance.force)),
        };
        let bend = stance.gliding::<W::Bend>(scene, &surface).bend;
        let mut leg = Leg::whole(Motion::turning(turn).with_foot(bend), Trigger::Balanced);
        let shift = surface.tangent * slide;
        leg.stop_at_touch(scene, &stance.placed, (shift, &self.contacts()));
        let frozen = Way::slide(Vec2::ZERO);
        leg.stop_at(&stance.reaction(surface.normal, &frozen), Trigger::Clear);
        let moved = leg.moved();
        let behind = surface.tangent.dot(stance.force) - slide * moved.part;
        self.pivot = self.pivot.moved(R::ZERO, leg.turn());
        self.pivot.glide(scene, grip);
        self.pivot = self.pivot.moved(-behind, R::ZERO);
        moved
    }

    /// In balance but for the rounding of the way, which it takes out.
    fn rest<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>) {
        let surface = self.pivot.surface(scene);
        let stance = self.pivot.stance(scene, grip);
        let moment = stance.gliding::<W::Bend>(scene, &surface);
        self.pivot = self.pivot.moved(R::ZERO, moment.polish());
        self.pivot.glide(scene, grip);
    }
}
