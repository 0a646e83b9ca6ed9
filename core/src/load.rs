//! The load of hand and weight on a body about one of its points: force, moment, stability, reaction. Lengths / L, forces
//! / (k_h L): k_h is 1.

use crate::balance_curve::Margin;
use crate::detect::Placed;
use crate::friction::SlidingEdge;
use crate::geometry::{Orientation, Vec2};
use crate::grip::{Displacement, Grip};
use crate::moment::{Drive, Moment, SecondHarmonic};
use crate::real::Real;
use crate::surface::Surface;
use crate::thresholds::Thresholds;
use crate::world::World;
use crate::wrench2::Wrench2;

/// The load of hand and weight on a body, about a point that is fixed in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load<R> {
    /// The point, its position and the rotation of the body.
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
}

impl<R: Real> Load<R> {
    /// The load of a grip on a body placed by a point: force, couple and z about that point, as in (E1); with k_h = 1.
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
        }
    }

    /// Returns whether the body swings freely about the holding point (STATICS 3.7).
    pub(crate) fn swings(&self, scene: &impl World<R>) -> bool {
        scene.swings(self.lever - self.centroid)
    }

    /// The load of the body turned to another orientation about the point.
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
    pub(crate) fn wrench(&self) -> Wrench2<R> {
        Wrench2 {
            force: self.force,
            moment: self.moment(),
        }
    }

    /// -dM/dtheta: positive where the balance is stable.
    pub(crate) fn stability(&self) -> R {
        self.stiffness + self.hold.x
    }

    /// Returns whether the number type can represent the pull, the turn, and the moments of both about the pinned point.
    pub(crate) fn is_representable(&self) -> bool {
        self.fits(self.hold.length_bound())
    }

    /// Returns whether the number type can represent the pull, the turn, and the moments of both about a sliding foot, bounded by its lever.
    pub(crate) fn is_representable_sliding(&self) -> bool {
        let lever = self.lever.length_bound();
        self.fits(self.hold.length_bound().max(lever * lever))
    }

    fn fits(&self, moment: R) -> bool {
        moment + self.couple.abs() <= R::LOAD
            && (self.spring + self.lever).length_bound() <= R::RANGE
            && self.turn.abs() <= R::TURN
    }

    /// The moment as a function of a turn about the pinned point.
    pub(crate) fn pinned<H: SecondHarmonic<R>>(&self) -> Moment<R, H> {
        Moment {
            couple: self.couple,
            stiffness: self.stiffness,
            hold: self.hold,
            harmonic: H::NONE,
        }
    }

    /// The moment of a turn about the point, times cos(lambda), if the point slides along a surface with its reaction on an edge of the friction cone (E10): wherever
    /// its foot is now, the moment is taken about the foot at which that edge balances the load.
    pub(crate) fn sliding<H: SecondHarmonic<R>>(
        &self,
        scene: &impl World<R>,
        surface: &Surface<R>,
        edge: &SlidingEdge<R>,
    ) -> Moment<R, H> {
        let (along, off) = (
            surface.tangent.dot(self.lever),
            surface.normal.dot(self.lever),
        );
        // -h
        let pull = surface.normal.dot(self.force) + off;
        let mut hold = self.lever.conj_mul(edge.reaction) * pull;
        let weight = scene.weight();
        if weight != Vec2::ZERO {
            hold = hold + (self.centroid - self.lever).conj_mul(weight) * edge.cos;
        }
        // The mean of the second harmonic.
        let square = R::sum_of_products(along, along, off, off).halved();
        Moment {
            couple: R::difference_of_products(self.couple, edge.cos, square, edge.sin),
            stiffness: self.stiffness * edge.cos,
            hold,
            harmonic: H::sliding((along, off), (edge.cos, edge.sin)),
        }
    }

    /// The change of the moment about the pinned point with a displacement.
    pub(crate) fn drive(&self, displacement: &Displacement<R>) -> Drive<R> {
        Drive {
            couple: self.stiffness * displacement.turn,
            hold: self.lever.conj_mul(displacement.hand),
        }
    }

    /// The change of the moment of a sliding point with a displacement.
    pub(crate) fn sliding_drive(
        &self,
        (surface, edge): (&Surface<R>, &SlidingEdge<R>),
        displacement: &Displacement<R>,
    ) -> Drive<R> {
        let pressing = displacement.pressing(surface, edge);
        Drive {
            couple: self.stiffness * edge.cos * pressing.turn,
            hold: self.lever.conj_mul(pressing.hand),
        }
    }

    /// The displacement of the foot along t, times cos(lambda), of a point that slides with the hand (E10).
    pub(crate) fn foot(&self, edge: &SlidingEdge<R>, displacement: &Displacement<R>) -> Margin<R> {
        Margin {
            start: R::ZERO,
            along: edge.balanced.dot(displacement.hand),
            turning: -Vec2::new(
                edge.balanced.dot(self.lever),
                edge.balanced.dot(self.lever.turned()),
            ),
            rounding: self.rounding(),
        }
    }

    /// The residual that reactions may leave of it: rounding, and what is as small as a gap that counts as closed. At the edge of a cone
    /// nothing is driven yet.
    pub(crate) fn little(&self) -> R {
        R::of_reactions(self.rounding()) + self.size() * R::TOUCH
    }

    /// A displacement of the hand after which a load that contacts could only just bear certainly exceeds this residual.
    pub(crate) fn release(&self) -> R {
        self.little().doubled()
    }

    /// The rounding of forces and moments at a point.
    pub(crate) fn rounding(&self) -> R {
        R::of_sums(self.size())
    }

    /// The rounding of forces and moments at a point, including the foot, which is rounded as a coordinate.
    pub(crate) fn rounding_with_foot(&self) -> R {
        self.rounding() + R::rounding(self.placed.point.length_bound())
    }

    /// The magnitude of the terms of forces and moments. Compiled once per image.
    #[inline(never)]
    pub(crate) fn size(&self) -> R {
        self.force.length_bound() + self.lever.length_bound() + self.couple.abs()
    }

    /// The component of the contact's reaction in a direction, on a path of the hand with the body turning about the point.
    pub(crate) fn reaction(&self, direction: Vec2<R>, displacement: &Displacement<R>) -> Margin<R> {
        Margin {
            start: -direction.dot(self.force),
            along: -direction.dot(displacement.hand),
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
