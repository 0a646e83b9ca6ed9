//! The quantities of the trammel motion at a point: the velocities, the balance of a load (E6) and the reactions, as values or with the
//! bounds that certified searches need.

use super::Trammel;
use crate::balance_curve::Place;
use crate::bounded::{Quantity, QuantityVec};
use crate::geometry::Vec2;
use crate::real::Real;
use core::ops::{Add, Mul, Sub};

/// The quantities of the motion at a point.
pub(super) struct Quantities<Q> {
    /// (E6), delta times the resistance: zero in balance.
    pub(super) imbalance: Q,
    /// N_1, N_2 times the resistance.
    pub(super) normals: [Q; 2],
    /// det [w1 w2 drag]
    pub(super) resistance: Q,
    /// Velocities of the contacts along their tangents.
    pub(super) velocities: [Q; 2],
}

/// The quantities of a point of the motion that do not depend on the load.
pub(super) struct Kinematics<Q> {
    /// f_1, f_2
    pub(super) reactions: [QuantityVec<Q>; 2],
    /// r×f_2
    pub(super) second: Q,
    /// -(the force and the moment of a drag along the motion)
    pub(super) drag: QuantityVec<Q>,
    pub(super) drag_moment: Q,
    /// (E6), times the resistance, of a force along each tangent at its contact.
    pub(super) frictions: [Q; 2],
    /// f_1×f_2
    pub(super) spread: Q,
    pub(super) resistance: Q,
    pub(super) velocities: [Q; 2],
}

/// The contacts at a point: their arm, directions and velocities.
pub(super) struct Frame<Q> {
    /// r = c2 - c1
    pub(super) arm: QuantityVec<Q>,
    /// f_1, f_2
    pub(super) reactions: [QuantityVec<Q>; 2],
    /// t_1, t_2
    pub(super) tangents: [QuantityVec<Q>; 2],
    /// v_i·t_i
    pub(super) velocities: [Q; 2],
}

impl<Q> Kinematics<Q> {
    /// From a frame, with bounds that cover only a window.
    pub(super) fn of<R: Real>(frame: Frame<Q>, window: R) -> Self
    where
        Q: Quantity<R>,
    {
        let Frame {
            arm,
            reactions: [f1, f2],
            tangents: [t1, t2],
            velocities,
        } = frame;
        let second = arm.cross(f2).within(window);
        let drag = (t1.scaled(velocities[0]) + t2.scaled(velocities[1])).within(window);
        let tangent_moment = arm.cross(t2).within(window);
        let drag_moment = tangent_moment * velocities[1];
        let spread = f1.cross(f2);
        Self {
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
}

impl<Q: Copy + Add<Output = Q> + Sub<Output = Q> + Mul<Output = Q>> Kinematics<Q> {
    /// (E6) of a load, delta times the resistance.
    pub(super) fn imbalance(&self, (force, moment): Wrench<Q>) -> Q {
        let [f1, _] = self.reactions;
        moment * self.spread - self.second * f1.cross(force)
    }

    /// The contributions of a load to N_1 and N_2, times the resistance.
    pub(super) fn normals(&self, (force, moment): Wrench<Q>) -> [Q; 2] {
        let [f1, f2] = self.reactions;
        [
            self.second * force.cross(self.drag)
                - moment * f2.cross(self.drag)
                - self.drag_moment * force.cross(f2),
            moment * f1.cross(self.drag) - self.drag_moment * f1.cross(force),
        ]
    }

    /// The same in balance, from the force alone, times f_1×f_2.
    pub(super) fn balanced_normals(&self, (force, _): Wrench<Q>) -> [Q; 2] {
        let [f1, f2] = self.reactions;
        [f2.cross(force), force.cross(f1)]
    }

    /// The derivative of (E6) with respect to x, for a wrench that changes: `swing` is that of r.
    pub(super) fn slope(
        &self,
        swing: QuantityVec<Q>,
        (force, _): Wrench<Q>,
        (force_slope, moment_slope): Wrench<Q>,
    ) -> Q {
        let [f1, f2] = self.reactions;
        moment_slope * self.spread
            - swing.cross(f2) * f1.cross(force)
            - self.second * f1.cross(force_slope)
    }
}

impl<R: Real> Trammel<R> {
    pub(super) fn velocities<Q: Quantity<R>>(&self, p: &Place<R>) -> [Q; 2] {
        let [first, second] = self.surfaces;
        let rate: Q = self.sense.curve.rate_as();
        let slide: Q = self.sense.curve.part_velocity_as(p);
        let turning: QuantityVec<Q> = self.rotated(p, self.arm.turned());
        let along = second.tangent.dot(first.tangent);
        let swing =
            turning.x * Q::constant(second.tangent.x) + turning.y * Q::constant(second.tangent.y);
        [slide, slide * Q::constant(along) + swing * rate]
    }

    pub(super) fn rotated<Q: Quantity<R>>(&self, p: &Place<R>, v: Vec2<R>) -> QuantityVec<Q> {
        let (cos, sin): (Q, Q) = self.sense.curve.rotation_as(p);
        let at = QuantityVec::<Q>::constant(v);
        QuantityVec {
            x: at.x * cos - at.y * sin,
            y: at.x * sin + at.y * cos,
        }
    }

    /// The quantities of the point that do not depend on the load.
    pub(super) fn kinematics<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Kinematics<Q> {
        let arm = self.rotated(p, self.arm).within(window);
        let reactions = self.sense.reactions.map(QuantityVec::<Q>::constant);
        let tangents = (self.surfaces).map(|s| QuantityVec::<Q>::constant(s.tangent));
        let velocities = self.velocities(p).map(|v: Q| v.within(window));
        let frame = Frame {
            arm,
            reactions,
            tangents,
            velocities,
        };
        Kinematics::of(frame, window)
    }

    /// The derivative of (E6) with respect to x at the frozen hand.
    pub(super) fn imbalance_slope<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Q {
        let load = self.load_at(p, window);
        let slope = self.load_slope_at(p, window);
        self.kinematics(p, window).slope(self.swing(p), load, slope)
    }

    /// The rate of change of r along x.
    pub(super) fn swing<Q: Quantity<R>>(&self, p: &Place<R>) -> QuantityVec<Q> {
        let rate: Q = self.sense.curve.rate_as();
        self.rotated(p, self.arm.turned()).scaled(rate)
    }

    pub(super) fn quantities<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Quantities<Q> {
        let place = self.kinematics(p, window);
        let load = self.load_at(p, window);
        Quantities {
            imbalance: place.imbalance(load),
            normals: place.normals(load),
            resistance: place.resistance,
            velocities: place.velocities,
        }
    }

    /// The position of the hand relative to contact 1.
    fn hand_at<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> QuantityVec<Q> {
        let slide: Q = self.sense.curve.part_as(p, window);
        let hand = self.relative(self.load.spring + self.load.lever);
        (hand - self.relative(self.surfaces[0].tangent).scaled(slide)).within(window)
    }

    fn relative<Q: Quantity<R>>(&self, v: Vec2<R>) -> QuantityVec<Q> {
        QuantityVec::constant(v * self.per_load)
    }

    /// Force and moment about contact 1.
    pub(super) fn load_at<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Wrench<Q> {
        let turn: Q = self.sense.curve.turn_as(p, window);
        let lever = self.rotated(p, self.load.lever);
        let centroid = self.rotated(p, self.load.centroid);
        let hand = self.hand_at(p, window);
        let weight = self.relative(self.weight);
        let force = hand - lever.scaled(Q::constant(self.per_load)) + weight;
        let couple = Q::constant(self.load.couple * self.per_load)
            - turn * Q::constant(self.load.stiffness * self.per_load);
        let moment = couple + lever.cross(hand) + centroid.cross(weight);
        (force.within(window), moment.within(window))
    }

    /// Their rates of change along x.
    pub(super) fn load_slope_at<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Wrench<Q> {
        let rate: Q = self.sense.curve.rate_as();
        let slide: Q = self.sense.curve.part_velocity_as(p);
        let lever = self.rotated(p, self.load.lever);
        let swing = self.rotated(p, self.load.lever.turned()).scaled(rate);
        let dip = self.rotated(p, self.load.centroid.turned()).scaled(rate);
        let back = self.relative(self.surfaces[0].tangent).scaled(slide);
        let couple = rate * Q::constant(self.load.stiffness * self.per_load);
        let moment = swing.cross(self.hand_at(p, window)) - lever.cross(back) - couple
            + dip.cross(self.relative(self.weight));
        let force =
            QuantityVec::constant(Vec2::ZERO) - back - swing.scaled(Q::constant(self.per_load));
        (force.within(window), moment.within(window))
    }
}

/// A force and its moment about contact 1, in units of the load.
pub(super) type Wrench<Q> = (QuantityVec<Q>, Q);
