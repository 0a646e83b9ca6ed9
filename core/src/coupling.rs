//! The springs between hand and body: force F = k_h (p_h - G), couple M = k_theta (phi - theta), and with the weight the
//! load on the contacts. Lengths / L, forces / (k_h L): k_h is 1.

use crate::detect::Placed;
use crate::geometry::{Angle, Orientation, Pose, Vec2};
use crate::motion::{Bend, Margin};
use crate::real::Real;
use crate::roots::Moment;
use crate::scene::{Surface, World};
use crate::state::Pair;
use crate::support::Screw;

/// The hand's hold on the body: the boundary condition of every equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Grip<R> {
    /// g, body frame.
    pub(crate) holding_point: Vec2<R>,
    /// p_h, world frame.
    pub(crate) hand: Vec2<R>,
    /// phi less its rest offset.
    pub(crate) angle: Angle<R>,
}

impl<R: Real> Grip<R> {
    /// F and k_theta (phi - theta) on a body in a pose.
    pub(crate) fn springs(&self, scene: &impl World<R>, pose: &Pose<R>) -> (Vec2<R>, R) {
        let held = pose.position + pose.orientation.rotation().apply(self.holding_point);
        let turn = self.angle.minus(pose.orientation.angle());
        (self.hand - held, scene.stiffness() * turn)
    }

    /// The straight way of the hand: `self` at 0, `to` at 1.
    pub(crate) fn lerp(&self, to: &Self, part: R) -> Self {
        Self {
            holding_point: to.holding_point,
            hand: self.hand.lerp(to.hand, part),
            angle: self.angle.plus(to.angle.minus(self.angle) * part),
        }
    }

    /// On the straight way of the hand to another grip, as far as there but at most so far.
    pub(crate) fn toward(&self, to: &Self, most: R) -> Self {
        let way = self.way_to(to).size();
        self.lerp(to, if way > most { most / way } else { R::ONE })
    }

    /// The way of the hand to another grip: displacement and turn.
    pub(crate) fn way_to(&self, to: &Self) -> Way<R> {
        Way {
            hand: to.hand - self.hand,
            turn: to.angle.minus(self.angle),
        }
    }
}

/// A way of the hand relative to the contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way<R> {
    pub(crate) hand: Vec2<R>,
    pub(crate) turn: R,
}

impl<R: Real> Way<R> {
    /// The contact slides by `shift` while the hand is frozen: relative to it the hand goes back.
    pub(crate) fn slide(shift: Vec2<R>) -> Self {
        Self {
            hand: -shift,
            turn: R::ZERO,
        }
    }

    /// The hand turns only.
    pub(crate) fn turn(turn: R) -> Self {
        Self {
            hand: Vec2::ZERO,
            turn,
        }
    }

    /// What of it a foot that glides along a surface without friction does not follow.
    pub(crate) fn pressing(&self, surface: &Surface<R>) -> Self {
        Self {
            hand: surface.normal * surface.normal.dot(self.hand),
            turn: self.turn,
        }
    }

    /// How far the body can be moved by it: displacement and turn at a lever of one body size.
    pub(crate) fn size(&self) -> R {
        self.hand.reach() + self.turn.abs()
    }
}

/// A vertex that is held at a place of its surface, and the angle of the body about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pivot<R> {
    pub(crate) contact: Pair,
    /// t·c: where along the surface. It changes by slips alone.
    pub(crate) foot: R,
    pub(crate) orientation: Orientation<R>,
}

impl<R: Real> Pivot<R> {
    /// Of a body in a pose at which the vertex of `contact` is on the surface.
    pub(crate) fn at(scene: &impl World<R>, pose: &Pose<R>, contact: Pair) -> Self {
        let vertex = scene.vertex(contact.vertex);
        let point = pose.position + pose.orientation.rotation().apply(vertex);
        Self {
            contact,
            foot: scene.surface(contact.surface).tangent.dot(point),
            orientation: pose.orientation,
        }
    }

    pub(crate) fn surface(&self, scene: &impl World<R>) -> Surface<R> {
        scene.surface(self.contact.surface)
    }

    /// c, exactly on the surface.
    pub(crate) fn point(&self, scene: &impl World<R>) -> Vec2<R> {
        let surface = self.surface(scene);
        surface.origin + surface.tangent * self.foot
    }

    pub(crate) fn placed(&self, scene: &impl World<R>) -> Placed<R> {
        Placed {
            point: self.point(scene),
            body_point: scene.vertex(self.contact.vertex),
            orientation: self.orientation,
            on: Some(self.contact.surface),
        }
    }

    /// The load on the body about the pivot.
    pub(crate) fn stance(&self, scene: &impl World<R>, grip: &Grip<R>) -> Stance<R> {
        Stance::new(scene, self.placed(scene), grip)
    }

    /// Without friction: the foot goes to where the tangential forces balance, the angle as it is (E10).
    pub(crate) fn glide(&mut self, scene: &impl World<R>, grip: &Grip<R>) {
        let arm = grip.holding_point - scene.vertex(self.contact.vertex);
        let lever = self.orientation.rotation().apply(arm);
        let balanced = grip.hand - lever + scene.weight();
        self.foot = self.surface(scene).tangent.dot(balanced);
    }

    /// The same pivot after a slide along t and a turn.
    pub(crate) fn moved(&self, slide: R, turn: R) -> Self {
        Self {
            contact: self.contact,
            foot: self.foot + slide,
            orientation: self.orientation.plus(turn),
        }
    }
}

/// The load of hand and weight on a body, about a point that is fixed in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stance<R> {
    /// The point, its place and the rotation of the body.
    pub(crate) placed: Placed<R>,
    /// R d: from the point to the holding point.
    pub(crate) lever: Vec2<R>,
    /// R (cg - v): from the point to the centroid; zero for a body without weight.
    pub(crate) centroid: Vec2<R>,
    /// F: the hand's force.
    pub(crate) spring: Vec2<R>,
    /// phi - theta
    pub(crate) turn: R,
    /// k_theta (phi - theta)
    pub(crate) couple: R,
    /// z = conj(lever) (p_h - c) + conj(centroid) weight
    pub(crate) hold: Vec2<R>,
    /// F - W y
    pub(crate) force: Vec2<R>,
    pub(crate) stiffness: R,
    /// Balances are found to within this angle (rad); 0: as far as the digits go.
    pub(crate) tolerance: R,
}

impl<R: Real> Stance<R> {
    pub(crate) fn new(scene: &impl World<R>, placed: Placed<R>, grip: &Grip<R>) -> Self {
        let rotation = placed.orientation.rotation();
        let lever = rotation.apply(grip.holding_point - placed.body_point);
        let hand = grip.hand - placed.point;
        let weight = scene.weight();
        let (mut centroid, mut hold) = (Vec2::ZERO, lever.conj_mul(hand));
        if weight != Vec2::ZERO {
            centroid = rotation.apply(scene.centroid() - placed.body_point);
            hold = hold + centroid.conj_mul(weight);
        }
        let spring = hand - lever;
        let turn = grip.angle.minus(placed.orientation.angle());
        Self {
            placed,
            lever,
            centroid,
            spring,
            turn,
            couple: scene.stiffness() * turn,
            hold,
            force: spring + weight,
            stiffness: scene.stiffness(),
            tolerance: scene.tolerance(),
        }
    }

    /// The same body with another orientation about the point.
    pub(crate) fn turned(
        &self,
        scene: &impl World<R>,
        orientation: Orientation<R>,
        grip: &Grip<R>,
    ) -> Self {
        let placed = Placed {
            orientation,
            ..self.placed
        };
        Self::new(scene, placed, grip)
    }

    /// The moment of the load about the point, (E1).
    pub(crate) fn moment(&self) -> R {
        self.couple + self.hold.y
    }

    /// The load as force and moment about the point.
    pub(crate) fn load(&self) -> Screw<R> {
        Screw {
            force: self.force,
            moment: self.moment(),
        }
    }

    /// -dM/dtheta: positive where the balance is stable.
    pub(crate) fn stability(&self) -> R {
        self.stiffness + self.hold.x
    }

    /// The number type certainly carries the pull, the turn and the moments of both.
    pub(crate) fn is_carried(&self) -> bool {
        self.hold.reach() + self.couple.abs() <= R::LOAD
            && self.spring.reach() + self.lever.reach() <= R::RANGE
            && self.turn.abs() <= R::TURN
    }

    /// The moment as a function of a turn about the pinned point.
    pub(crate) fn pinned<B: Bend<R>>(&self) -> Moment<R, B> {
        Moment {
            couple: self.couple,
            stiffness: self.stiffness,
            hold: self.hold,
            bend: B::NONE,
            tolerance: self.tolerance,
        }
    }

    /// The same where the point glides along a surface without friction (E10): wherever its foot is now, in balance along
    /// the tangent.
    pub(crate) fn gliding<B: Bend<R>>(
        &self,
        scene: &impl World<R>,
        surface: &Surface<R>,
    ) -> Moment<R, B> {
        let (along, off) = (
            surface.tangent.dot(self.lever),
            surface.normal.dot(self.lever),
        );
        // -h
        let pull = surface.normal.dot(self.force) + off;
        let mut hold = Vec2::new(pull * off, pull * along);
        let weight = scene.weight();
        if weight != Vec2::ZERO {
            hold = hold + (self.centroid - self.lever).conj_mul(weight);
        }
        Moment {
            couple: self.couple,
            stiffness: self.stiffness,
            hold,
            bend: B::gliding((along, off)),
            tolerance: self.tolerance,
        }
    }

    /// The rounding of forces and moments at a place.
    pub(crate) fn rounding(&self) -> R {
        R::rounding(self.size()).doubled().doubled()
    }

    /// The same with the foot, which is rounded as a coordinate.
    pub(crate) fn rounding_with_foot(&self) -> R {
        self.rounding() + R::rounding(self.placed.point.reach())
    }

    /// The size of what forces and moments are sums of.
    pub(crate) fn size(&self) -> R {
        self.force.reach() + self.lever.reach() + self.couple.abs()
    }

    /// The part of the contact's reaction in a direction, on a way of the hand with the body turning about the point.
    pub(crate) fn reaction(&self, direction: Vec2<R>, way: &Way<R>) -> Margin<R> {
        Margin {
            start: -direction.dot(self.force),
            along: -direction.dot(way.hand),
            turning: Vec2::new(
                direction.dot(self.lever),
                direction.dot(self.lever.turned()),
            ),
            rounding: self.rounding(),
        }
    }
}

#[cfg(test)]
mod tests;
