//! The motions that can begin if contacts do not bear the load: their velocities, whether the load drives them, and whether every contact
//! that does not last opens.

use super::{FixedPose, Mode};
use crate::contact::Pair;
use crate::detect::Placed;
use crate::geometry::Vec2;
use crate::grip::Grip;
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::state::trammel::{Demand, Trammel};
use crate::thresholds::Thresholds;
use crate::work::{DRIVEN, MOTION};
use crate::world::{Surface, World};

/// The instantaneous velocity of the body: of the pivot, and the turn.
#[derive(Clone, Copy)]
pub(super) struct Twist<R> {
    velocity: Vec2<R>,
    turn: R,
}

impl<R: Real> FixedPose<R> {
    /// Returns whether it is driven by the load, and no gap of another contact closes.
    pub(super) fn is_consistent(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        mode: &Mode<R>,
    ) -> bool {
        self.is_consistent_with(scene, grip, (mode, Demand::Pressed))
    }

    /// The same with a demand on the reactions.
    pub(super) fn is_consistent_with(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        mode: (&Mode<R>, Demand),
    ) -> bool {
        let slowest = self.slowest_opening(scene, grip, mode);
        slowest.is_some_and(|rate| rate >= -R::in_plane())
    }

    /// Returns whether it is driven by the load, and every gap of another contact opens.
    pub(in crate::state) fn opens(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        mode: &Mode<R>,
    ) -> bool {
        let slowest = self.slowest_opening(scene, grip, (mode, Demand::Pressed));
        slowest.is_some_and(|rate| rate > R::in_plane())
    }

    /// The least rate at which the gap of a contact that does not last opens; `None` if the load does not drive it.
    fn slowest_opening(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        (mode, demand): (&Mode<R>, Demand),
    ) -> Option<R> {
        let twist = self.twist(scene, grip, mode, demand)?;
        let placed = self.pivot.placed(scene);
        let lasting = mode.0.map(|i| self.contact(i));
        let others = self.contacts.iter().filter(|c| !lasting.contains(c));
        let rates = others.map(|c| self.opening(scene, &placed, (&twist, *c)));
        Some(rates.fold(R::HUGE, R::min))
    }

    /// The rate at which the gap of a contact opens.
    fn opening(
        &self,
        scene: &impl World<R>,
        placed: &Placed<R>,
        (twist, contact): (&Twist<R>, Pair),
    ) -> R {
        let velocity = twist.velocity + placed.arm_to(scene, contact).turned() * twist.turn;
        self.surface(scene, contact).normal.dot(velocity)
    }

    /// The motion of a mode, if the load drives it.
    pub(super) fn twist<W: World<R>>(
        &self,
        scene: &W,
        grip: &Grip<R>,
        mode: &Mode<R>,
        demand: Demand,
    ) -> Option<Twist<R>> {
        self.cone.spend(MOTION);
        let ([first, second], sliding) = *mode;
        let [a, b] = [first, second].map(|i| self.contact(i));
        let load = self.pivot.load(scene, grip);
        match sliding {
            None => {
                let pressed = [a, b].iter().any(|&c| {
                    let normal = self.surface(scene, c).normal;
                    normal.dot(load.force) < R::ZERO
                });
                pressed.then(|| self.pivoting(scene, &load, a))?
            }
            Some(sign) if a == b => {
                let pivot = Pivot::at(scene, &load.placed.pose(), a);
                let about = pivot.load(scene, grip);
                let along = self.sliding(&about, &self.surface(scene, a), sign)?;
                let stability = about.stability();
                let is_alone = || {
                    !W::CORNERS
                        || demand == Demand::AtTheEnd
                        || !self.takes_along(scene, grip, (a, sign))
                };
                if stability <= R::ZERO || !is_alone() {
                    return None;
                }
                let mut drives = -about.lever.cross(along.velocity);
                if W::CORNERS && a.is_corner() {
                    // The contact stays, and the whole load passes by it.
                    drives = drives + along.velocity.cross(about.force);
                }
                let turn = drives / stability;
                let arm = load.placed.arm_to(scene, a);
                Some(Twist {
                    velocity: along.velocity - arm.turned() * turn,
                    turn,
                })
            }
            Some(sign) if load.placed.are_in_line(scene, [a, b]) => {
                self.sliding(&load, &self.surface(scene, a), sign)
            }
            Some(_) if a.vertex == b.vertex && !a.is_corner() => None,
            Some(_) => {
                self.cone.spend(DRIVEN);
                let pivot = Pivot::at(scene, &load.placed.pose(), a);
                let (slide, turn) = Trammel::driven(scene, (&pivot, b), grip, demand)?.twist();
                let arm = load.placed.arm_to(scene, a);
                Some(Twist {
                    velocity: self.surface(scene, a).tangent * slide - arm.turned() * turn,
                    turn,
                })
            }
        }
    }

    /// A turn about one contact, in the direction of the moment about it.
    fn pivoting(&self, scene: &impl World<R>, load: &Load<R>, about: Pair) -> Option<Twist<R>> {
        let arm = load.placed.arm_to(scene, about);
        let moment = load.moment() - arm.cross(load.force);
        let turn = moment.sign();
        (moment.abs() > load.rounding()).then_some(Twist {
            velocity: -(arm.turned() * turn),
            turn,
        })
    }

    /// A slide along sign·t takes another contact along: the moment about the sliding contact presses the body onto the other one, and
    /// still does so with the friction of a slide of both. On its own it would slide away from that contact and fall back onto it, again
    /// and again.
    fn takes_along(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        (slides, sign): (Pair, R),
    ) -> bool {
        let load = self.pivot.load(scene, grip);
        let Some(turn) = self.pivoting(scene, &load, slides) else {
            return false;
        };
        let pivot = Pivot::at(scene, &load.placed.pose(), slides);
        let mut others = self.contacts.iter().filter(|&&other| other != slides);
        others.any(|&other| {
            let is_closed = self.opening(scene, &load.placed, (&turn, other)) < -R::in_plane();
            is_closed
                && [R::ONE, -R::ONE].into_iter().any(|direction| {
                    self.cone.spend(DRIVEN);
                    let both = Trammel::in_sense(scene, (&pivot, other), grip, direction);
                    both.signs()[0] == sign && both.moment_presses()
                })
        })
    }

    /// A slide of one contact, or of an edge, along sign·t.
    fn sliding(&self, load: &Load<R>, surface: &Surface<R>, sign: R) -> Option<Twist<R>> {
        let (normal, friction) = surface.reaction(load.force);
        let rounding = load.rounding();
        let driven =
            normal > R::ZERO && (surface.friction).is_driven(normal, friction, sign, rounding);
        driven.then_some(Twist {
            velocity: surface.tangent * sign,
            turn: R::ZERO,
        })
    }
}

#[cfg(test)]
mod tests;
