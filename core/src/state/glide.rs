//! One vertex on a surface without friction (STATICS 3.6): it glides. Its foot is where the tangential forces balance, so
//! that the angle alone moves as if free, with a second harmonic in its moment; there is no stick, no slip and no test of
//! friction.

use super::SingleVertex;
use super::leg::Leg;
use crate::calm::Calm;
use crate::geometry::Vec2;
use crate::grip::{Grip, Way};
use crate::load::Stance;
use crate::moment::{Downhill, Gliding, Moment};
use crate::real::Real;
use crate::verb::{Moved, Trigger};
use crate::world::World;

impl<R: Real> SingleVertex<R> {
    /// A calm frame: it glides and turns.
    pub(crate) fn glide_on<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        tolerance: R,
    ) -> bool {
        let mut stance = self.pivot.stance(scene, to);
        stance.tolerance = tolerance;
        if !stance.is_carried() {
            return false;
        }
        let surface = self.pivot.surface(scene);
        let way = from.way_to(to);
        let gliding = |stance: &Stance<R>| stance.gliding::<Gliding<R>>(scene, &surface);
        let drive = stance.lever.conj_mul(way.pressing(&surface).hand);
        let mut moment = gliding(&stance);
        let times = moment.softness();
        moment = moment.times(times);
        let calm = Calm::turn(&moment, drive * times, stance.placed.orientation, |o| {
            gliding(&stance.turned(scene, o, to)).times(times)
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
        // The foot's way closes no gap to the surface that it is on. A point touches nothing else.
        if W::SEVERAL && !self.has_room_to_turn(scene, &calm) {
            return false;
        }
        self.pivot.orientation = calm.orientation;
        self.pivot.glide(scene, to);
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
        let moment = stance.gliding::<Gliding<R>>(scene, &surface);
        let pressing = way.pressing(&surface);
        let mut leg = Leg::balanced(&moment, (stance.lever, &pressing), Trigger::Balanced);
        if W::SEVERAL {
            // The foot's way closes no gap to the surface that it is on.
            leg.stop_at_touch(scene, &stance.placed, (Vec2::ZERO, &self.contacts()));
        }
        leg.stop_at(&stance.reaction(surface.normal, &way), Trigger::Clear);
        let moved = leg.moved();
        self.pivot = self.pivot.moved(R::ZERO, leg.turn());
        if moved.unsure || moved.trigger != Trigger::Balanced {
            self.pivot.glide(scene, &from.lerp(to, moved.part));
        } else if !self.rest(scene, to) {
            // Next to where a balance forks the number type's digits do not tell the way: on from there with the hand frozen.
            return Moved {
                part: R::ONE,
                ..self.glide_down(scene, to)
            };
        }
        moved
    }

    /// The moment about the gliding foot, as a function of the angle.
    fn gliding(&self, scene: &impl World<R>, stance: &Stance<R>) -> Moment<R, Gliding<R>> {
        stance.gliding(scene, &self.pivot.surface(scene))
    }

    /// Glides downhill at a frozen hand, to the first of balance, touch, lift-off.
    pub(crate) fn glide_down<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>) -> Moved<R> {
        let moment = self.gliding(scene, &self.pivot.stance(scene, grip));
        self.glide_by(scene, grip, &moment.downhill())
    }

    /// The same from a fold of the branch, on in the direction of the sign.
    pub(crate) fn glide_over<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        direction: R,
    ) -> Moved<R> {
        let moment = self.gliding(scene, &self.pivot.stance(scene, grip));
        self.glide_by(scene, grip, &moment.over_fold(direction))
    }

    /// Turns downhill, the foot in balance from the beginning: it gets there in a straight line, on which energy falls.
    fn glide_by<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        self.pivot.glide(scene, grip);
        let stance = self.pivot.stance(scene, grip);
        let surface = self.pivot.surface(scene);
        if surface.normal.dot(stance.force) > stance.rounding() {
            return Moved::by(Trigger::Clear);
        }
        let mut leg = Leg::<R, Gliding<R>>::turning(downhill.turn, Trigger::Balanced);
        if W::SEVERAL {
            leg.stop_at_touch(scene, &stance.placed, (Vec2::ZERO, &self.contacts()));
        }
        let frozen = Way::slide(Vec2::ZERO);
        leg.stop_at(&stance.reaction(surface.normal, &frozen), Trigger::Clear);
        let moved = leg.moved();
        self.pivot = self.pivot.moved(R::ZERO, leg.turn());
        if moved.trigger == Trigger::Balanced {
            self.rest(scene, grip);
        } else {
            self.pivot.glide(scene, grip);
        }
        Moved {
            snapped: downhill.snapped,
            unsure: moved.unsure || downhill.unsure,
            ..moved
        }
    }

    /// In balance but for the rounding of the way, which it takes out. False if more is left.
    fn rest<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>) -> bool {
        let stance = self.pivot.stance(scene, grip);
        let moment = self.gliding(scene, &stance);
        let turn = moment.polish();
        self.pivot = self.pivot.moved(R::ZERO, turn);
        self.pivot.glide(scene, grip);
        turn != R::ZERO || moment.now().abs() <= stance.rounding()
    }
}
