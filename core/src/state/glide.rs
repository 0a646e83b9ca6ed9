//! One vertex on a surface without friction (STATICS 3.6): it glides. Its foot is where the tangential forces balance, so
//! that the angle alone moves as if free, with a second harmonic in its moment; there is no stick, no slip and no test of
//! friction.

use super::SingleVertex;
use super::segment::Segment;
use crate::certified::CertifiedTurn;
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::moment::{Downhill, Gliding, Moment};
use crate::real::Real;
use crate::verb::{Moved, Trigger};
use crate::world::World;

impl<R: Real> SingleVertex<R> {
    /// A certified frame: it glides and turns.
    pub(crate) fn glide_on<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        tolerance: R,
    ) -> bool {
        let mut load = self.pivot.load(scene, to);
        load.tolerance = tolerance;
        if !load.is_representable() {
            return false;
        }
        let surface = self.pivot.surface(scene);
        let displacement = from.displacement_to(to);
        let gliding = |load: &Load<R>| load.gliding::<Gliding<R>>(scene, &surface);
        let drive = load.lever.conj_mul(displacement.pressing(&surface).hand);
        let mut moment = gliding(&load);
        let times = moment.softness();
        moment = moment.times(times);
        let certified = CertifiedTurn::of(&moment, drive * times, load.placed.orientation, |o| {
            gliding(&load.turned(scene, o, to)).times(times)
        });
        let Some(certified) = certified else {
            return false;
        };
        // The reaction strays by the turn from the straight line to where the hand alone would take it.
        let normal = -surface.normal.dot(load.force);
        let stray = load.lever.length_bound() * certified.turn_bound + load.rounding();
        if normal <= stray {
            return false;
        }
        // The foot's path closes no gap to the surface that it is on. A point touches nothing else.
        if W::SEVERAL && !self.has_room_to_turn(scene, &certified) {
            return false;
        }
        self.pivot.orientation = certified.orientation;
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
        let load = self.pivot.load(scene, from);
        let surface = self.pivot.surface(scene);
        let displacement = from.displacement_to(to);
        let moment = load.gliding::<Gliding<R>>(scene, &surface);
        let pressing = displacement.pressing(&surface);
        let mut segment = Segment::balanced(&moment, (load.lever, &pressing), Trigger::Balanced);
        if W::SEVERAL {
            // The foot's path closes no gap to the surface that it is on.
            segment.stop_at_touch(scene, &load.placed, (Vec2::ZERO, &self.contacts()));
        }
        segment.stop_at(
            &load.reaction(surface.normal, &displacement),
            Trigger::Clear,
        );
        let moved = segment.moved();
        self.pivot = self.pivot.moved(R::ZERO, segment.turn());
        if moved.unsure || moved.trigger != Trigger::Balanced {
            self.pivot.glide(scene, &from.lerp(to, moved.part));
        } else if !self.come_to_rest(scene, to) {
            // Next to where a balance forks the number type's digits do not tell the direction: on from there with the hand frozen.
            return Moved {
                part: R::ONE,
                ..self.glide_down(scene, to)
            };
        }
        moved
    }

    /// The moment about the gliding foot, as a function of the angle.
    fn gliding(&self, scene: &impl World<R>, load: &Load<R>) -> Moment<R, Gliding<R>> {
        load.gliding(scene, &self.pivot.surface(scene))
    }

    /// Glides downhill at a frozen hand, to the first of balance, touch, lift-off.
    pub(crate) fn glide_down<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>) -> Moved<R> {
        let moment = self.gliding(scene, &self.pivot.load(scene, grip));
        self.glide_by(scene, grip, &moment.downhill())
    }

    /// The same from a fold of the branch, on in the direction of the sign.
    pub(crate) fn glide_over<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        direction: R,
    ) -> Moved<R> {
        let moment = self.gliding(scene, &self.pivot.load(scene, grip));
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
        let load = self.pivot.load(scene, grip);
        let surface = self.pivot.surface(scene);
        if surface.normal.dot(load.force) > load.rounding() {
            return Moved::by(Trigger::Clear);
        }
        let mut segment = Segment::<R, Gliding<R>>::turning(downhill.turn, Trigger::Balanced);
        if W::SEVERAL {
            segment.stop_at_touch(scene, &load.placed, (Vec2::ZERO, &self.contacts()));
        }
        let frozen = Displacement::slide(Vec2::ZERO);
        segment.stop_at(&load.reaction(surface.normal, &frozen), Trigger::Clear);
        let moved = segment.moved();
        self.pivot = self.pivot.moved(R::ZERO, segment.turn());
        if moved.trigger == Trigger::Balanced {
            self.come_to_rest(scene, grip);
        } else {
            self.pivot.glide(scene, grip);
        }
        Moved {
            snapped: downhill.snapped,
            unsure: moved.unsure || downhill.unsure,
            ..moved
        }
    }

    /// In balance but for the rounding of the path, which it takes out. False if more is left.
    fn come_to_rest<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>) -> bool {
        let load = self.pivot.load(scene, grip);
        let moment = self.gliding(scene, &load);
        let turn = moment.polish();
        self.pivot = self.pivot.moved(R::ZERO, turn);
        self.pivot.glide(scene, grip);
        turn != R::ZERO || moment.now().abs() <= load.rounding()
    }
}
