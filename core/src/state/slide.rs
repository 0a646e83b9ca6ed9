//! One vertex that slides on a surface with the hand (STATICS 3.6). Its reaction lies on an edge of the dynamic friction cone, so that its
//! foot is explicit and only the angle moves, with a second harmonic in its moment. Without friction that edge is the normal: the vertex
//! glides.

use super::SingleVertex;
use super::segment::Segment;
use super::side_end::stop_at_end_of_slide;
use super::single_vertex::Travel;
use crate::certified::CertifiedTurn;
use crate::contact::Regime;
use crate::detect::PointPath;
use crate::friction::SlidingEdge;
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::moment::{Downhill, Moment, Sliding};
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::verb::{Moved, Trigger};
use crate::work::Work;
use crate::world::{Surface, World};

impl<R: Real> SingleVertex<R> {
    /// The surface, and the edge of its friction cone in a slide along sign·t.
    fn sliding(&self, scene: &impl World<R>, sign: R) -> (Surface<R>, SlidingEdge<R>) {
        let surface = self.pivot.surface(scene);
        (surface, surface.sliding(sign))
    }

    /// A certified frame: it slides along sign·t and turns.
    pub(crate) fn follow_sliding<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        (sign, work): (R, &mut Work),
    ) -> bool {
        if self.is_corner(scene) {
            return self.follow_sliding_on_corner(scene, (from, to), (sign, work));
        }
        let load = self.pivot.load(scene, to);
        if load.swings(scene) || !load.is_representable_sliding() {
            return false;
        }
        let (surface, edge) = self.sliding(scene, sign);
        let displacement = from.displacement_to(to);
        let drive = load.sliding_drive((&surface, &edge), &displacement);
        let sliding = |load: &Load<R>| load.sliding::<Sliding<R>>(scene, &surface, &edge);
        let mut moment = sliding(&load);
        let times = moment.softness();
        moment = moment.times(times);
        let drive = drive.times(times);
        let certified = CertifiedTurn::of(&moment, &drive, load.placed.orientation, |o| {
            sliding(&load.turned(scene, o, to)).times(times)
        });
        let Some(certified) = certified else {
            return false;
        };
        // Because of the turn the reaction deviates from the straight line to where the hand alone would take it.
        let normal = -surface.normal.dot(load.force);
        let stray = load.lever.length_bound() * certified.turn_bound + load.rounding();
        if normal <= stray {
            return false;
        }
        let mut end = Self {
            regime: Regime::Slide(sign),
            ..self.clone()
        };
        end.pivot.orientation = certified.orientation;
        end.pivot.slide(scene, to, &edge);
        if W::GLIDES {
            // The foot's path closes no gap to the surface that it is on. A point touches nothing else.
            if W::SEVERAL && !end.has_room_to_turn(scene, &certified, work) {
                return false;
            }
        } else {
            let rate = certified.rate(&moment, &drive);
            let advances = Self::least_advance(&load, &edge, (&displacement, sign), rate);
            let slack = Self::slack(&displacement);
            let pivot = end.pivot;
            let way = (pivot.foot - self.pivot.foot).abs();
            // The foot moves in one direction.
            let bound = way + certified.turn_bound;
            let travel = Travel {
                bound,
                open: bound,
                turn: certified.turn_bound,
            };
            if advances <= slack
                || normal + stray >= surface.friction.threshold()
                || !pivot.is_on_side(scene)
                || !end.has_room(scene, [&self.pivot, &pivot], &travel, work)
            {
                return false;
            }
        }
        *self = end;
        true
    }

    /// The least velocity of the foot along its slide, times cos(lambda), per unit of the displacement: from its angular velocity and the
    /// most by which that changes on the path.
    fn least_advance(
        load: &Load<R>,
        edge: &SlidingEdge<R>,
        (displacement, sign): (&Displacement<R>, R),
        (rate, spread): (R, R),
    ) -> R {
        let foot = load.foot(edge, displacement);
        let velocity = foot.along + foot.turning.y * rate;
        sign * velocity - load.lever.length_bound() * spread
    }

    /// A foot that moves back by less than this, per unit of a displacement, rests except for the rounding (rule 7).
    pub(super) fn slack(displacement: &Displacement<R>) -> R {
        R::of_displacement(displacement.size())
    }

    /// Slides along sign·t as the hand moves, to the first of fold, touch, lift-off, halt, N = N*.
    #[inline(never)]
    pub(crate) fn advance_sliding<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        sign: R,
    ) -> Moved<R> {
        self.room = R::ZERO;
        if self.swings(scene, from) {
            return self.advance_swinging(scene, (from, to), sign);
        }
        if self.is_corner(scene) {
            return self.advance_sliding_on_corner(scene, (from, to), sign);
        }
        let load = self.pivot.load(scene, from);
        let (surface, edge) = self.sliding(scene, sign);
        let displacement = from.displacement_to(to);
        let moment = load.sliding::<Sliding<R>>(scene, &surface, &edge);
        let drive = load.sliding_drive((&surface, &edge), &displacement);
        let mut segment = Segment::balanced(&moment, &drive, Trigger::Balanced);
        let foot = load.foot(&edge, &displacement);
        if W::SEVERAL {
            let path = PointPath::of_foot(surface.tangent, &foot, edge.cos);
            segment.stop_at_touch(scene, &load.placed, (&path, &self.contacts()));
        }
        let normal = load.reaction(surface.normal, &displacement);
        segment.stop_at(&normal, Trigger::Clear);
        if !W::GLIDES {
            let ahead = foot.combine(sign, foot, R::ZERO);
            segment.stop_at_reversal(&ahead, Self::slack(&displacement), Trigger::Halts);
            if let Some(loosens) = surface.friction.loosens(normal) {
                segment.stop_at(&loosens, Trigger::Pressed);
            }
            if W::CORNERS {
                let at = (&load.placed, self.pivot.contact);
                stop_at_end_of_slide(scene, &mut segment, at, (&foot, edge.cos, sign));
            }
        }
        let moved = segment.moved();
        self.pivot = self.pivot.moved(R::ZERO, segment.turn());
        if moved.unsure || moved.trigger != Trigger::Balanced {
            self.pivot
                .slide_on_side(scene, &from.lerp(to, moved.part), &edge);
        } else if !self.rest(scene, to, &edge) && W::GLIDES {
            // Near a fork of the balance the digits of the number type do not determine the branch: continue from there with the hand
            // frozen.
            let down = self.glide_down(scene, to);
            return Moved {
                part: R::ONE,
                work: down.work.saturating_add(moved.work),
                ..down
            };
        } else if !W::GLIDES && self.is_pulled_off(scene, to) {
            // In balance to the last digit the hand lifts it off.
            return Moved {
                trigger: Trigger::Clear,
                ..moved
            };
        }
        moved
    }

    /// Returns whether the load pulls the vertex off its surface beyond doubt.
    fn is_pulled_off(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let load = self.pivot.load(scene, grip);
        let (normal, _) = self.pivot.surface(scene).reaction(load.force);
        normal < -load.rounding_with_foot()
    }

    /// The moment about the sliding foot, as a function of the angle.
    fn sliding_moment(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        sign: R,
    ) -> Moment<R, Sliding<R>> {
        let (surface, edge) = self.sliding(scene, sign);
        self.pivot.load(scene, grip).sliding(scene, &surface, &edge)
    }

    /// Glides downhill at a frozen hand, to the first of balance, touch, lift-off.
    pub(crate) fn glide_down<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>) -> Moved<R> {
        let downhill = if self.swings(scene, grip) {
            self.swing_down(scene, grip, (None, R::ONE))
        } else {
            self.sliding_moment(scene, grip, R::ONE).downhill()
        };
        self.slide_by(scene, grip, (&downhill, R::ONE))
    }

    /// The balance of a slide along sign·t folds: turns on in a direction, with the foot in balance.
    #[inline(never)]
    pub(crate) fn snap_sliding<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        (direction, sign): (R, R),
    ) -> Moved<R> {
        if W::CORNERS {
            // On a side with ends the foot does not move to its balance immediately: it turns and slips there.
            self.regime = Regime::LOOSE;
            return self.relax(scene, grip, Some(sign));
        }
        let downhill = if self.swings(scene, grip) {
            self.swing_down(scene, grip, (Some(direction), sign))
        } else {
            let moment = self.sliding_moment(scene, grip, sign);
            moment.over_fold(direction)
        };
        self.slide_by(scene, grip, (&downhill, sign))
    }

    /// The direction in which the body turns as its foot begins to slide along sign·t, if the balance of that slide is not stable.
    pub(crate) fn topples<W: World<R>>(&self, scene: &W, grip: &Grip<R>, sign: R) -> Option<R> {
        if self.is_corner(scene) {
            return self.topples_on_corner(scene, grip, sign);
        }
        let (_, edge) = self.sliding(scene, sign);
        let lever = self.pivot.load(scene, grip).lever;
        let ahead = -edge.balanced.dot(lever.turned()) * sign;
        let topples = if self.swings(scene, grip) {
            self.swing(scene, grip, sign).topples()
        } else {
            self.sliding_moment(scene, grip, sign).stability() <= R::ZERO
        };
        topples.then_some(ahead.sign())
    }

    /// Turns downhill, with the foot in balance from the beginning: it gets there in a straight line, on which energy falls.
    fn slide_by<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        (downhill, sign): (&Downhill<R>, R),
    ) -> Moved<R> {
        self.room = R::ZERO;
        let (surface, edge) = self.sliding(scene, sign);
        self.pivot.slide(scene, grip, &edge);
        let load = self.pivot.load(scene, grip);
        if surface.normal.dot(load.force) > load.rounding() {
            return Moved::by(Trigger::Clear);
        }
        let mut segment = Segment::<R, Sliding<R>>::turning(downhill.turn, Trigger::Balanced)
            .with(downhill.looks);
        let frozen = Displacement::slide(Vec2::ZERO);
        if W::SEVERAL {
            let foot = load.foot(&edge, &frozen);
            let path = PointPath::of_foot(surface.tangent, &foot, edge.cos);
            segment.stop_at_touch(scene, &load.placed, (&path, &self.contacts()));
        }
        if !self.swings(scene, grip) {
            segment.stop_at(&load.reaction(surface.normal, &frozen), Trigger::Clear);
        }
        let moved = segment.moved();
        self.pivot = self.pivot.moved(R::ZERO, segment.turn());
        if moved.trigger == Trigger::Balanced {
            self.rest(scene, grip, &edge);
        } else {
            self.pivot.slide(scene, grip, &edge);
        }
        Moved {
            snapped: downhill.snapped,
            unsure: moved.unsure || downhill.unsure,
            ..moved
        }
    }

    /// Slides on along sign·t, after another contact has let go: while two contacts bear, a slide is located less accurately than the
    /// balance of one, which is close by except for a soft grip, and not inside a surface. Returns false, and the vertex sticks where it
    /// is, if there is no such balance, or if it is farther away than a search may end.
    pub(crate) fn slide_on<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>, sign: R) -> bool {
        let begin = self.pivot;
        let (_, edge) = self.sliding(scene, sign);
        let mut slides = if self.swings(scene, grip) {
            self.pivot.slide(scene, grip, &edge);
            self.swings_in_balance(scene, grip, sign)
        } else if self.is_corner(scene) {
            self.rest_on_corner(scene, grip, sign)
        } else {
            self.rest(scene, grip, &edge)
        };
        if self.is_inside(scene) || !self.pivot.is_on_side(scene) {
            self.pivot = begin;
            let load = self.pivot.load(scene, grip);
            let found_to = Self::found_to(&load);
            let moment = if self.is_corner(scene) {
                load.moment()
            } else {
                self.sliding_moment(scene, grip, sign).now()
            };
            slides &= moment.abs() <= found_to;
        }
        self.regime = if slides {
            Regime::Slide(sign)
        } else {
            self.pivot = begin;
            Regime::LOOSE
        };
        slides
    }

    /// Returns whether a vertex is inside a surface.
    pub(super) fn is_inside<W: World<R>>(&self, scene: &W) -> bool {
        let placed = self.pivot.placed(scene);
        !placed.touching(scene, -R::TOUCH).is_empty()
            || W::CORNERS && placed.is_in_obstacle(scene, R::TOUCH)
    }

    /// In balance except for the rounding of the path, which it removes. Returns false if the error is larger.
    fn rest(&mut self, scene: &impl World<R>, grip: &Grip<R>, edge: &SlidingEdge<R>) -> bool {
        if self.swings(scene, grip) {
            self.pivot.slide(scene, grip, edge);
            return true;
        }
        let load = self.pivot.load(scene, grip);
        let moment = load.sliding::<Sliding<R>>(scene, &self.pivot.surface(scene), edge);
        let turn = moment.polish();
        self.pivot = self.pivot.moved(R::ZERO, turn);
        self.pivot.slide(scene, grip, edge);
        turn != R::ZERO || moment.now().abs() <= load.rounding()
    }
}

#[cfg(test)]
mod tests;
