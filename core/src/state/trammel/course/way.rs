//! A short displacement of two contacts among obstacles along their unit twist (STATICS 12.8): as for two vertices (E15), except that the
//! normal of a corner turns with the body, and the corner stays. The loads at both ends of the hand's path on the body in its present pose,
//! and bounds of the changes on a short displacement, prove that there is one balance within reach, and locate it.

use super::super::CertifiedSlide;
use super::super::certified::{MAX_CORRECTIONS, Twist, gradient};
use crate::contact::Pair;
use crate::detect::Placed;
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::verb::seat_sliding;
use crate::world::World;

/// Both contacts at a point, and the rate at which their unit twist changes along it.
pub(super) struct Pairing<R> {
    pub(super) twist: Twist<R>,
    /// The rates of change of c_1 and r.
    pub(super) foot_rate: Vec2<R>,
    pub(super) arm_rate: Vec2<R>,
    /// How fast the directions of the reactions turn.
    pub(super) turning: [Vec2<R>; 2],
    /// A bound of the rate of change of the twist.
    pub(super) bend: R,
}

/// The largest values on a short displacement: of the speed of a contact and the turn, of the change of the twist, and of |f|, |r|, |F|,
/// |M|, the lever, and the hand's distance from contact 1.
pub(super) struct Sizes<R> {
    pub(super) speed: R,
    pub(super) turn: R,
    pub(super) bend: R,
    pub(super) edge: R,
    pub(super) arm: R,
    pub(super) force: R,
    pub(super) moment: R,
    pub(super) lever: R,
    pub(super) hand: R,
}

impl<R: Real> Pairing<R> {
    /// `None` if there is no such twist.
    pub(super) fn at<W: World<R>>(
        scene: &W,
        placed: &Placed<R>,
        (contacts, direction): ([Pair; 2], R),
    ) -> Option<Self> {
        let twist = Twist::at(scene, placed, (contacts, direction))?;
        let [corner1, corner2] = contacts.map(Pair::is_corner);
        let slides = twist.surfaces[0].tangent * twist.slide;
        let velocity = slides + twist.arm.turned() * twist.turn;
        let moves = |is_corner, velocity| if is_corner { Vec2::ZERO } else { velocity };
        let foot_rate = moves(corner1, slides);
        let turns = |is_corner, edge: Vec2<R>| {
            if is_corner {
                edge.turned() * twist.turn
            } else {
                Vec2::ZERO
            }
        };
        let [f1, f2] = twist.reactions;
        let [by_slide, by_turn] = gradient(&twist.surfaces, twist.arm);
        Some(Self {
            foot_rate,
            arm_rate: moves(corner2, velocity) - foot_rate,
            turning: [turns(corner1, f1), turns(corner2, f2)],
            // The second derivatives of the other gap are 1 and |r|, with a quarter more for the length of the twist.
            bend: (R::TWO + twist.arm.length_bound()) / by_slide.hypot(by_turn),
            twist,
        })
    }

    /// -dE/dx at the frozen hand, after the hand has moved back by `less`.
    pub(super) fn stability<W: World<R>>(
        &self,
        scene: &W,
        load: &Load<R>,
        less: &Displacement<R>,
    ) -> R {
        let (twist, [f1_rate, f2_rate]) = (&self.twist, self.turning);
        let [f1, f2] = twist.reactions;
        let force = load.force - less.hand;
        let hand = load.spring + load.lever - less.hand;
        let moment = load.moment() - load.lever.cross(less.hand) - load.stiffness * less.turn;
        let at = |arm: Vec2<R>| twist.surfaces[0].tangent * twist.slide + arm.turned() * twist.turn;
        let held = at(load.lever);
        let falls = (at(load.centroid) - self.foot_rate).cross(scene.weight());
        let moment_rate = (held - self.foot_rate).cross(hand) - load.lever.cross(self.foot_rate)
            + falls
            - load.stiffness * twist.turn;
        let spread_rate = f1_rate.cross(f2) + f1.cross(f2_rate);
        let second_rate = self.arm_rate.cross(f2) + twist.arm.cross(f2_rate);
        let slope = spread_rate * moment + twist.spread * moment_rate
            - second_rate * f1.cross(force)
            - twist.second * (f1_rate.cross(force) - f1.cross(held));
        -slope * twist.sense
    }

    /// Within a distance from here, if the force and the moment at its beginning are no larger than these.
    pub(super) fn within(&self, load: &Load<R>, reach: R, (force, moment): (R, R)) -> Sizes<R> {
        let bend = self.bend + (self.bend / R::from_int(4));
        let swing = bend * reach;
        let (speed, turn) = (
            self.twist.slide.abs() + swing,
            self.twist.turn.abs() + swing,
        );
        let [lever, arm] = [load.lever, self.twist.arm].map(Vec2::length_bound);
        let hand = (load.spring + load.lever).length_bound();
        let [f1, f2] = self.twist.reactions.map(Vec2::length_bound);
        let goes = (speed.doubled() + turn * (lever + arm)) * reach;
        Sizes {
            speed,
            turn,
            bend,
            edge: f1.max(f2),
            arm: arm + goes,
            force: force + goes,
            moment: moment + goes * (hand + lever + R::ONE) + load.stiffness * turn * reach,
            lever: lever + goes,
            hand: hand + goes,
        }
    }
}

impl<R: Real> Sizes<R> {
    /// A bound of |dr/dx|, and of the same for the lever.
    pub(super) fn parts(&self, arm: R) -> R {
        self.speed.doubled() + arm * self.turn
    }

    /// A bound of the second derivative of such a length.
    pub(super) fn bends(&self, arm: R) -> R {
        self.bend * (R::TWO + arm) + self.turn * self.parts(arm)
    }

    /// A bound of |dF/dx|.
    pub(super) fn force_rate(&self) -> R {
        self.speed + self.lever * self.turn
    }

    /// A bound of |d(r×f_2)/dx|.
    pub(super) fn second_rate(&self) -> R {
        self.edge * (self.parts(self.arm) + self.arm * self.turn)
    }

    /// A bound of |d(f_1×f_2)/dx|.
    pub(super) fn spread_rate(&self) -> R {
        (self.edge * self.edge * self.turn).doubled()
    }

    /// A bound of |d²(f_1×F)/dx²|.
    pub(super) fn across_bend(&self) -> R {
        let spin = self.turn * self.turn + self.bend;
        let rates = self.bends(self.lever) + (self.turn * self.force_rate()).doubled();
        self.edge * (rates + self.force * spin)
    }

    /// A bound of |d²(f_1×f_2)/dx²|.
    pub(super) fn spread_bend(&self) -> R {
        let spin = self.turn * self.turn + self.bend;
        (self.edge * self.edge * (spin + self.turn * self.turn)).doubled()
    }

    /// A bound of |d²E/dx²|; `falls`: a bound of the moment of the weight.
    pub(super) fn curvature(&self, stiffness: R, (spread, weight, falls): (R, R, R)) -> R {
        let (turn, edge) = (self.turn, self.edge);
        let spin = turn * turn + self.bend;
        let moment_rate = self.parts(self.lever) * self.hand
            + self.lever * self.speed
            + (self.speed * weight).doubled()
            + (falls + stiffness) * turn;
        let moment_bend = self.bends(self.lever) * self.hand
            + (self.parts(self.lever) * self.speed).doubled()
            + (self.lever + stiffness) * self.bend
            + (falls + weight.doubled()) * (spin + self.bend);
        let second_bend = edge
            * (self.bends(self.arm) + (self.parts(self.arm) * turn).doubled() + self.arm * spin);
        let across = edge * self.force;
        let across_rate = edge * (self.force_rate() + self.force * turn);
        self.spread_bend() * self.moment
            + (self.spread_rate() * moment_rate).doubled()
            + spread * moment_bend
            + second_bend * across
            + (self.second_rate() * across_rate).doubled()
            + self.arm * edge * self.across_bend()
    }
}

/// A displacement along the twist as the hand moves along a path, so short that there is one balance within reach for every fraction of the
/// path (E15).
pub(super) struct Way<'a, R, W> {
    pub(super) scene: &'a W,
    pub(super) contacts: (Pivot<R>, Pair),
    pub(super) direction: R,
    pub(super) to: &'a Grip<R>,
    pub(super) pairing: Pairing<R>,
    /// The load at the hand's end on the body in its present pose.
    pub(super) after: Load<R>,
    pub(super) displacement: Displacement<R>,
    /// The stability of the body in its present pose with the hand at its beginning, at its end, and the smaller one.
    pub(super) standing: R,
    pub(super) stability: R,
    pub(super) least: R,
    /// (E6) with the hand at its end, for the body in its present pose; and the displacement that this requires at the least stability.
    pub(super) drive: R,
    pub(super) newton: R,
    pub(super) reach: R,
    pub(super) sizes: Sizes<R>,
    /// The curvature of (E6) over the least stability.
    pub(super) bend: R,
    /// The most by which f_1×f_2 and the velocities of the contacts change.
    pub(super) spread_falls: R,
    pub(super) slows: R,
}

/// Where a displacement ends in balance.
pub(super) struct End<R> {
    pub(super) pivot: Pivot<R>,
    /// Both reactions, before a last correction of the position, and the most by which that changes them.
    pub(super) reactions: [R; 2],
    pub(super) last: R,
}

impl<'a, R: Real, W: World<R>> Way<'a, R, W> {
    /// In a direction of the unit twist; `None` if that is not certain, or a contact may turn back.
    pub(super) fn of(
        scene: &'a W,
        (pivot, other): (&Pivot<R>, Pair),
        (from, to): (&Grip<R>, &'a Grip<R>),
        direction: R,
    ) -> Option<Self> {
        let placed = pivot.placed(scene);
        let pairing = Pairing::at(scene, &placed, ([pivot.contact, other], direction))?;
        let after = Load::new(scene, placed, to);
        if !after.is_representable() {
            return None;
        }
        let displacement = from.displacement_to(to);
        let stability = pairing.stability(scene, &after, &Displacement::turn(R::ZERO));
        let standing = if displacement.size() > R::ZERO {
            pairing.stability(scene, &after, &displacement)
        } else {
            stability
        };
        let least = standing.min(stability);
        let drive = pairing.twist.drives(after.force, after.moment());
        if least <= R::divisor() || drive < R::ZERO {
            return None;
        }
        let newton = drive / least;
        let reach = newton + newton.halved().halved();
        if (pairing.bend * reach).doubled().doubled().doubled() > R::ONE {
            return None;
        }
        let hand = displacement.hand.length_bound();
        let couple = after.stiffness * displacement.turn.abs();
        let force = after.force.length_bound() + hand;
        let moment = after.moment().abs() + after.lever.length_bound() * hand + couple;
        let sizes = pairing.within(&after, reach, (force, moment));
        let weight = scene.weight().length_bound();
        let falls = after.centroid.length_bound() * weight;
        let spread = pairing.twist.spread.abs();
        let bend = sizes.curvature(after.stiffness, (spread, weight, falls)) / least;
        let spread_falls = sizes.spread_rate() * reach;
        if bend >= R::HUGE || bend * newton > R::HALF.halved() || spread_falls.doubled() > spread {
            return None;
        }
        let slows = (sizes.bends(sizes.arm) + sizes.turn * sizes.parts(sizes.arm)) * reach;
        let goes_on = pairing.twist.velocities.iter().all(|v| v.abs() > slows);
        goes_on.then_some(Self {
            scene,
            contacts: (*pivot, other),
            direction,
            to,
            pairing,
            after,
            displacement,
            standing,
            stability,
            least,
            drive,
            newton,
            reach,
            sizes,
            bend,
            spread_falls,
            slows,
        })
    }

    /// The balance where the hand ends, by Newton's steps from the present pose of the body.
    pub(super) fn end(&self) -> Option<End<R>> {
        let (mut place, other) = self.contacts;
        let (scene, sizes) = (self.scene, &self.sizes);
        let still = Displacement::turn(R::ZERO);
        let (mut slide, mut turn) = (self.pairing.twist.slide, self.pairing.twist.turn);
        let mut step = self.drive / self.stability;
        for _ in 0..MAX_CORRECTIONS {
            place = seat_sliding(scene, place.moved(slide * step, turn * step), other);
            let placed = place.placed(scene);
            let contacts = [place.contact, other];
            let here = Pairing::at(scene, &placed, (contacts, self.direction))?;
            let load = Load::new(scene, placed, self.to);
            step =
                here.twist.drives(load.force, load.moment()) / here.stability(scene, &load, &still);
            (slide, turn) = (here.twist.slide, here.twist.turn);
            // The residual of a Newton step.
            if (self.bend * step * step).halved() > R::EPSILON {
                continue;
            }
            let force_rate = sizes.force_rate() + sizes.force * sizes.turn;
            place = place.moved(slide * step, turn * step);
            // No gap opens by more than a rounding.
            if self.pairing.bend * step * step > R::EPSILON {
                place = seat_sliding(scene, place, other);
            }
            return Some(End {
                pivot: place,
                reactions: here.twist.sizes(load.force),
                last: sizes.edge * force_rate * step.abs() / self.spread(),
            });
        }
        None
    }

    /// |f_1×f_2| at the beginning.
    pub(super) fn spread(&self) -> R {
        self.pairing.twist.spread.abs()
    }

    /// The contribution of a friction to (E6) changes by no more than this.
    pub(super) fn worth_changes(&self) -> R {
        let sizes = &self.sizes;
        let edges = sizes.edge * sizes.edge;
        let worth = sizes.edge * (sizes.second_rate().doubled() + sizes.spread_rate() * sizes.arm);
        (worth + (edges * sizes.turn * sizes.arm).doubled()) * self.reach
    }

    /// The deviation of a reaction of a given size from the straight line between its values at both ends, due to the displacement, in
    /// addition to what `bent` contributes over the spread.
    pub(super) fn strays(&self, size: R, bent: R) -> R {
        let square = self.reach * self.reach;
        let bent = (bent + self.sizes.across_bend() * square) / self.spread();
        let spins = size * (self.sizes.spread_bend() * square) / self.spread();
        bent.doubled() + spins.doubled() + self.after.rounding()
    }

    /// The result at a position.
    pub(super) fn to(&self, pivot: Pivot<R>) -> CertifiedSlide<R> {
        let turn_bound = self.sizes.turn * self.reach;
        CertifiedSlide {
            pivot,
            travel_bound: self.sizes.speed * self.reach + turn_bound,
            turn_bound,
        }
    }
}
