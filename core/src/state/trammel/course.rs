//! The motion of a body that keeps two contacts among obstacles (STATICS 12): its surfaces may turn with it, so that it is no trammel. A
//! piece of it is a graph over its twist at the beginning: the body is moved by x times that twist and then across it until the other gap
//! is closed. Everything at a point is computed with its slope. World frame, lengths / L, forces / (k_h L).

use super::kinematics::{Frame, Kinematics, Wrench};
use super::{Trammel, Turning};
use crate::bounded::{QuantityVec, Sloped};
use crate::contact::Pair;
use crate::detect::Watch;
use crate::falls::Level;
use crate::geometry::Vec2;
use crate::grip::Grip;
use crate::motion::Instant;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::state::side_end::room_ahead;
use crate::thresholds::Thresholds;
use crate::world::{Surface, World};

mod certified;
mod follow;
mod slip;
mod way;

pub(crate) use certified::{certified_slide_among, certified_slip};

/// The cost of finding a point, in units of work.
pub(crate) const SPOT: u32 = 4;
/// Corrections of a point across the motion, at most.
const MAX_CORRECTIONS: usize = 6;

/// A piece of the motion of two contacts, from the position of a pivot.
pub(crate) struct Course<'a, R, W> {
    scene: &'a W,
    grip: &'a Grip<R>,
    pivot: Pivot<R>,
    other: Pair,
    /// The unit twist at the beginning: slide along t_1 and turn.
    twist: [R; 2],
    /// Returns whether the gap of the other contact changes across it.
    is_held: bool,
    /// Signs of v_i·t_i; 0 if a contact rests.
    signs: [R; 2],
    /// The unit of forces and moments is 1 over this.
    per_load: R,
    /// Axes along which the body was last separated from obstacles.
    watch: Watch,
}

/// A point of the motion.
#[derive(Clone, Copy)]
struct Spot<R> {
    pivot: Pivot<R>,
    surfaces: [Surface<R>; 2],
    /// r = c_2 - c_1
    arm: Vec2<R>,
    /// The displacement of the body's material along t_1, and its turn, per x.
    slide: Sloped<R>,
    turn: Sloped<R>,
}

impl<R: Real> Spot<R> {
    /// The change of the other gap with slide and turn of the pivot.
    fn gradient(&self) -> [R; 2] {
        let [first, second] = self.surfaces;
        [
            second.normal.dot(first.tangent),
            second.normal.dot(self.arm.turned()),
        ]
    }

    /// The velocity of the body's material at an arm from contact 1.
    fn velocity_at(&self, arm: Vec2<R>) -> Vec2<R> {
        self.surfaces[0].tangent * self.slide.value + arm.turned() * self.turn.value
    }
}

/// A vector and its rate of change.
fn sloped<R: Real>(value: Vec2<R>, slope: Vec2<R>) -> QuantityVec<Sloped<R>> {
    let part = |value, slope| Sloped { value, slope };
    QuantityVec {
        x: part(value.x, slope.x),
        y: part(value.y, slope.y),
    }
}

fn dot<R: Real>(a: QuantityVec<Sloped<R>>, b: QuantityVec<Sloped<R>>) -> Sloped<R> {
    a.x * b.x + a.y * b.y
}

impl<'a, R: Real, W: World<R>> Course<'a, R, W> {
    /// In a direction of the unit twist, with the friction of a trammel.
    pub(crate) fn of(
        scene: &'a W,
        (pivot, other): (&Pivot<R>, Pair),
        grip: &'a Grip<R>,
        trammel: &Trammel<R>,
    ) -> Self {
        let direction = trammel.sense.direction;
        let mut course = Self {
            scene,
            grip,
            pivot: *pivot,
            other,
            twist: [direction, R::ZERO],
            is_held: false,
            signs: trammel.sense.signs,
            per_load: trammel.per_load,
            watch: Watch::NONE,
        };
        let [by_slide, by_turn] = course.bare(*pivot).gradient();
        let size = by_slide.hypot(by_turn);
        if size > R::standstill() {
            course.is_held = true;
            course.twist = [-by_turn, by_slide].map(|part| direction * part / size);
        }
        course
    }

    /// The same with watched axes.
    pub(crate) fn watching(self, watch: Watch) -> Self {
        Self { watch, ..self }
    }

    fn contacts(&self) -> [Pair; 2] {
        [self.pivot.contact, self.other]
    }

    /// A pivot at rest.
    fn bare(&self, pivot: Pivot<R>) -> Spot<R> {
        let rotation = pivot.orientation.rotation();
        let none = Sloped {
            value: R::ZERO,
            slope: R::ZERO,
        };
        Spot {
            pivot,
            surfaces: self
                .contacts()
                .map(|contact| self.scene.face(contact, rotation)),
            arm: pivot.placed(self.scene).arm_to(self.scene, self.other),
            slide: none,
            turn: none,
        }
    }

    /// The pivot at x along the twist and y across it.
    fn pivot_at(&self, x: R, y: R) -> Pivot<R> {
        let [slide, turn] = self.twist;
        self.pivot.moved(slide * x - turn * y, turn * x + slide * y)
    }

    /// The change of the other gap across the twist.
    fn across(&self, [by_slide, by_turn]: [R; 2]) -> R {
        let [slide, turn] = self.twist;
        R::difference_of_products(by_turn, slide, by_slide, turn)
    }

    /// The point at x, with both gaps closed.
    fn spot(&self, x: R) -> Spot<R> {
        let [slide, turn] = self.twist;
        let mut spot = self.bare(self.pivot_at(x, R::ZERO));
        if self.is_held {
            let mut y = R::ZERO;
            for _ in 0..MAX_CORRECTIONS {
                let gap = spot.pivot.placed(self.scene).gap(self.scene, self.other);
                let across = self.across(spot.gradient());
                if gap.abs() <= R::EPSILON || across.abs() <= R::standstill() {
                    break;
                }
                y = y - gap / across;
                spot = self.bare(self.pivot_at(x, y));
            }
        }
        let gradient = spot.gradient();
        let [by_slide, by_turn] = gradient;
        let across = self.across(gradient);
        if !self.is_held || across == R::ZERO {
            (spot.slide.value, spot.turn.value) = (slide, turn);
            return spot;
        }
        let bent = -R::sum_of_products(by_slide, slide, by_turn, turn) / across;
        spot.slide.value = slide - turn * bent;
        spot.turn.value = turn + slide * bent;
        let [first, second] = spot.surfaces;
        let [spin1, spin2] = self.spins(&spot);
        let swing = self.swing(&spot);
        let slide_changes = (second.normal.turned().dot(first.tangent)) * (spin2 - spin1);
        let turn_changes = second.normal.dot(spot.arm) * spin2 + second.normal.dot(swing.turned());
        let bends = -R::sum_of_products(
            slide_changes,
            spot.slide.value,
            turn_changes,
            spot.turn.value,
        ) / across;
        spot.slide.slope = -(turn * bends);
        spot.turn.slope = slide * bends;
        spot
    }

    /// How fast the normals turn: that of a corner turns with the body.
    fn spins(&self, spot: &Spot<R>) -> [R; 2] {
        self.contacts().map(|contact| {
            if contact.is_corner() {
                spot.turn.value
            } else {
                R::ZERO
            }
        })
    }

    /// The velocity of contact 1: a corner stays.
    fn foot_velocity(&self, spot: &Spot<R>) -> Vec2<R> {
        if self.pivot.contact.is_corner() {
            Vec2::ZERO
        } else {
            spot.velocity_at(Vec2::ZERO)
        }
    }

    /// The rate of change of r.
    fn swing(&self, spot: &Spot<R>) -> Vec2<R> {
        let other = if self.other.is_corner() {
            Vec2::ZERO
        } else {
            spot.velocity_at(spot.arm)
        };
        other - self.foot_velocity(spot)
    }

    fn instant(&self, x: R) -> Instant<R> {
        self.body(&self.spot(x))
    }

    /// The body at a point.
    fn body(&self, spot: &Spot<R>) -> Instant<R> {
        Instant {
            placed: spot.pivot.placed(self.scene),
            velocity: spot.velocity_at(Vec2::ZERO),
            turn: spot.turn.value,
        }
    }

    /// The maximum length of a piece: an eighth of slide and turn, or 3/8 |g| / K, where g is the gradient of the other gap. It changes by
    /// no more than K = 2 (1 + |r|) with slide and turn, as the second normal turns with the body at most, and r changes by the slide and
    /// |r| times the turn. So it remains g to within half its size: across every point along the twist the gap is closed at exactly one
    /// point, the corrections converge to it (Kantorovich), and the motion bends by 30 degrees at most, so that it is 1 / cos 30 times as
    /// long as the twist.
    fn longest(&self) -> R {
        let most = R::HALF.halved().halved();
        let start = self.bare(self.pivot);
        let [by_slide, by_turn] = start.gradient();
        let bends = (R::ONE + start.arm.length_bound()).doubled();
        if self.is_held {
            let eighth = by_slide.hypot(by_turn).halved().halved().halved();
            most.min((eighth.doubled() + eighth) / bends).max(R::MICRO)
        } else {
            most
        }
    }

    /// Both contacts at a point, with the edges of their cones.
    fn frame(&self, spot: &Spot<R>) -> Frame<Sloped<R>> {
        let [first, second] = spot.surfaces;
        let [spin1, spin2] = self.spins(spot);
        let [s1, s2] = self.signs;
        let turning = |direction: Vec2<R>, spin| sloped(direction, direction.turned() * spin);
        let reaction = |surface: Surface<R>, sign: R, spin| {
            let edge = surface.friction.sliding_edge(sign);
            turning(surface.direction(edge), spin)
        };
        let tangents = [
            turning(first.tangent, spin1),
            turning(second.tangent, spin2),
        ];
        let arm = sloped(spot.arm, self.swing(spot));
        let along = dot(tangents[0], tangents[1]);
        // t_2·(i r)
        let lever = tangents[1].y * arm.x - tangents[1].x * arm.y;
        Frame {
            arm,
            reactions: [reaction(first, s1, spin1), reaction(second, s2, spin2)],
            tangents,
            velocities: [spot.slide, along * spot.slide + lever * spot.turn],
        }
    }

    /// The velocities of both contacts at the beginning, and their rates of change.
    pub(super) fn turning(&self) -> Turning<R> {
        self.frame(&self.spot(R::ZERO)).velocities
    }

    /// The kinematics of a point, independent of the load, and the force and the moment about contact 1 of the present hand and of what a
    /// displacement adds.
    fn terms(
        &self,
        spot: &Spot<R>,
        (force, couple): (Vec2<R>, R),
    ) -> (Kinematics<Sloped<R>>, [Wrench<Sloped<R>>; 2]) {
        let place = Kinematics::of(self.frame(spot), R::ZERO);
        let load = spot.pivot.load(self.scene, self.grip);
        let per = self.per_load;
        let foot = self.foot_velocity(spot);
        let held = spot.velocity_at(load.lever);
        let lever_rate = held - foot;
        let weight_rate = spot.velocity_at(load.centroid) - foot;
        let hand = (load.spring + load.lever) * per;
        let moment_rate = lever_rate.cross(hand) - load.lever.cross(foot) * per
            + weight_rate.cross(self.scene.weight() * per)
            - load.stiffness * per * spot.turn.value;
        let moment = Sloped {
            value: load.moment() * per,
            slope: moment_rate,
        };
        let added = Sloped {
            value: couple + load.lever.cross(force),
            slope: lever_rate.cross(force),
        };
        (
            place,
            [
                (sloped(load.force * per, -(held * per)), moment),
                (QuantityVec::constant(force), added),
            ],
        )
    }

    /// The distance of a contact from the end of its side towards which it moves; `None` if the side has no end there.
    fn ahead(&self, spot: &Spot<R>, index: usize) -> Option<Level<R>> {
        let contact = *self.contacts().get(index)?;
        let sign = *self.signs.get(index)?;
        self.scene.corner(contact.surface)?;
        let body = self.body(spot);
        (sign != R::ZERO).then(|| room_ahead(self.scene, &body, (contact, sign)))
    }
}

#[cfg(test)]
mod tests;
