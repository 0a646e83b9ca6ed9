//! What the trammel motion is at a place: the velocities, what balances a load (E6) and the reactions, with the bounds that certified
//! searches need.

use super::Trammel;
use crate::balance_curve::Place;
use crate::bounded::{Bounded, BoundedVec};
use crate::geometry::Vec2;
use crate::real::Real;

/// The quantities of the motion at a place.
pub(super) struct Quantities<R> {
    /// (E6), delta times the resistance: zero in balance.
    pub(super) imbalance: Bounded<R>,
    /// N_1, N_2 times the resistance.
    pub(super) normals: [Bounded<R>; 2],
    /// det [w1 w2 drag]
    pub(super) resistance: Bounded<R>,
    /// Velocities of the contacts along their tangents.
    pub(super) velocities: [Bounded<R>; 2],
}

/// What a place of the motion is, whatever the load.
pub(super) struct Kinematics<R> {
    /// f_1, f_2
    pub(super) reactions: [BoundedVec<R>; 2],
    /// r×f_2
    pub(super) second: Bounded<R>,
    /// -(the force and the moment of a drag along the motion)
    pub(super) drag: BoundedVec<R>,
    pub(super) drag_moment: Bounded<R>,
    /// (E6), times the resistance, of a force along each tangent at its contact.
    pub(super) frictions: [Bounded<R>; 2],
    /// f_1×f_2
    pub(super) spread: Bounded<R>,
    pub(super) resistance: Bounded<R>,
    pub(super) velocities: [Bounded<R>; 2],
}

impl<R: Real> Kinematics<R> {
    /// (E6) of a load, delta times the resistance.
    pub(super) fn imbalance(&self, (force, moment): Wrench<R>) -> Bounded<R> {
        let [f1, _] = self.reactions;
        moment * self.spread - self.second * f1.cross(force)
    }

    /// N_1 and N_2 that a load adds, times the resistance.
    pub(super) fn normals(&self, (force, moment): Wrench<R>) -> [Bounded<R>; 2] {
        let [f1, f2] = self.reactions;
        [
            self.second * force.cross(self.drag)
                - moment * f2.cross(self.drag)
                - self.drag_moment * force.cross(f2),
            moment * f1.cross(self.drag) - self.drag_moment * f1.cross(force),
        ]
    }

    /// The same in balance, of the force alone, times f_1×f_2.
    pub(super) fn balanced_normals(&self, (force, _): Wrench<R>) -> [Bounded<R>; 2] {
        let [f1, f2] = self.reactions;
        [f2.cross(force), force.cross(f1)]
    }

    /// The derivative of (E6) by x, of a wrench that changes: `swing` is that of r.
    pub(super) fn slope(
        &self,
        swing: BoundedVec<R>,
        (force, _): Wrench<R>,
        (force_slope, moment_slope): Wrench<R>,
    ) -> Bounded<R> {
        let [f1, f2] = self.reactions;
        moment_slope * self.spread
            - swing.cross(f2) * f1.cross(force)
            - self.second * f1.cross(force_slope)
    }
}

impl<R: Real> Trammel<R> {
    pub(super) fn velocities(&self, p: &Place<R>) -> [Bounded<R>; 2] {
        let [first, second] = self.surfaces;
        let rate = self.sense.curve.rate_bounded();
        let slide = self.sense.curve.part_velocity(p);
        let turning = self.rotated(p, self.arm.turned());
        let along = second.tangent.dot(first.tangent);
        let swing = turning.x * Bounded::constant(second.tangent.x)
            + turning.y * Bounded::constant(second.tangent.y);
        [slide, slide * Bounded::constant(along) + swing * rate]
    }

    pub(super) fn rotated(&self, p: &Place<R>, v: Vec2<R>) -> BoundedVec<R> {
        let (cos, sin) = self.sense.curve.rotation_bounded(p);
        let at = BoundedVec::constant(v);
        BoundedVec {
            x: at.x * cos - at.y * sin,
            y: at.x * sin + at.y * cos,
        }
    }

    /// What the place is whatever the load.
    pub(super) fn kinematics(&self, p: &Place<R>, window: R) -> Kinematics<R> {
        let arm = self.rotated(p, self.arm).within(window);
        let [f1, f2] = self.sense.reactions.map(BoundedVec::constant);
        let [t1, t2] = self.surfaces.map(|s| BoundedVec::constant(s.tangent));
        let velocities = self.velocities(p).map(|v| v.within(window));
        let second = arm.cross(f2).within(window);
        let drag = (t1.scaled(velocities[0]) + t2.scaled(velocities[1])).within(window);
        let tangent_moment = arm.cross(t2).within(window);
        let drag_moment = tangent_moment * velocities[1];
        let spread = f1.cross(f2);
        Kinematics {
            frictions: [
                -(second * f1.cross(t1)),
                tangent_moment * spread - second * f1.cross(t2),
            ],
            reactions: [f1, f2],
            second,
            drag,
            drag_moment,
            spread,
            resistance: drag_moment * spread - second * f1.cross(drag),
            velocities,
        }
    }

    /// The derivative of (E6) by x at the frozen hand.
    pub(super) fn imbalance_slope(&self, p: &Place<R>, window: R) -> Bounded<R> {
        let load = self.load_at(p, window);
        let slope = self.load_slope_at(p, window);
        self.kinematics(p, window).slope(self.swing(p), load, slope)
    }

    /// How fast r changes along x.
    pub(super) fn swing(&self, p: &Place<R>) -> BoundedVec<R> {
        let rate = self.sense.curve.rate_bounded();
        self.rotated(p, self.arm.turned()).scaled(rate)
    }

    pub(super) fn quantities(&self, p: &Place<R>, window: R) -> Quantities<R> {
        let place = self.kinematics(p, window);
        let load = self.load_at(p, window);
        Quantities {
            imbalance: place.imbalance(load),
            normals: place.normals(load),
            resistance: place.resistance,
            velocities: place.velocities,
        }
    }

    /// The hand from contact 1.
    fn hand_at(&self, p: &Place<R>, window: R) -> BoundedVec<R> {
        let slide = self.sense.curve.part_bounded(p, window);
        let hand = self.relative(self.load.spring + self.load.lever);
        (hand - self.relative(self.surfaces[0].tangent).scaled(slide)).within(window)
    }

    fn relative(&self, v: Vec2<R>) -> BoundedVec<R> {
        BoundedVec::constant(v * self.per_load)
    }

    /// Force and moment about contact 1.
    pub(super) fn load_at(&self, p: &Place<R>, window: R) -> Wrench<R> {
        let turn = self.sense.curve.turn_bounded(p, window);
        let lever = self.rotated(p, self.load.lever);
        let centroid = self.rotated(p, self.load.centroid);
        let hand = self.hand_at(p, window);
        let weight = self.relative(self.weight);
        let force = hand - lever.scaled(Bounded::constant(self.per_load)) + weight;
        let couple = Bounded::constant(self.load.couple * self.per_load)
            - turn * Bounded::constant(self.load.stiffness * self.per_load);
        let moment = couple + lever.cross(hand) + centroid.cross(weight);
        (force.within(window), moment.within(window))
    }

    /// How fast these change along x.
    pub(super) fn load_slope_at(&self, p: &Place<R>, window: R) -> Wrench<R> {
        let rate = self.sense.curve.rate_bounded();
        let slide = self.sense.curve.part_velocity(p);
        let lever = self.rotated(p, self.load.lever);
        let swing = self.rotated(p, self.load.lever.turned()).scaled(rate);
        let dip = self.rotated(p, self.load.centroid.turned()).scaled(rate);
        let back = self.relative(self.surfaces[0].tangent).scaled(slide);
        let couple = rate * Bounded::constant(self.load.stiffness * self.per_load);
        let moment = swing.cross(self.hand_at(p, window)) - lever.cross(back) - couple
            + dip.cross(self.relative(self.weight));
        let force = BoundedVec::constant(Vec2::ZERO)
            - back
            - swing.scaled(Bounded::constant(self.per_load));
        (force.within(window), moment.within(window))
    }
}

/// A force and its moment about contact 1, in units of the load.
pub(super) type Wrench<R> = (BoundedVec<R>, Bounded<R>);
