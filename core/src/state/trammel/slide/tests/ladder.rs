//! Statics of two contacts that slide, written out: for every angle the feet on both planes, the reactions on the edges of the dynamic
//! cones, and the couple that they leave.

use super::*;
use crate::fixtures::bench::{TRIANGLE, derivative, directions};
use crate::geometry::{Angle, Orientation};
use crate::grip::Grip;
use crate::pivot::Pivot;
use crate::scene::{Description, Scene, SurfaceDescription};
use crate::state::TwoVertex;

/// The same in the solver's types.
pub(super) struct Case {
    pub(super) scene: Scene<f64, 3, 2>,
    pub(super) state: TwoVertex<f64>,
    pub(super) grip: Grip<f64>,
}

/// A triangle with vertex 0 on the first plane and vertex 1 on the second one.
#[derive(Clone, Debug)]
pub(super) struct Ladder {
    pub(super) planes: [(f64, f64); 2],
    pub(super) mu_d: [f64; 2],
    pub(super) drop: [f64; 2],
    pub(super) memory: f64,
    pub(super) weight: f64,
    pub(super) stiffness: f64,
    pub(super) holding_point: Vec2<f64>,
    pub(super) theta: f64,
    /// The sign of the turn.
    pub(super) sense: f64,
}

fn rotated(turn: f64, [x, y]: [f64; 2]) -> Vec2<f64> {
    let (sin, cos) = libm::sincos(turn);
    Vec2::new(cos * x - sin * y, sin * x + cos * y)
}

impl Ladder {
    /// At an angle between 40 and 140 degrees, with none of its feet near a turning point.
    pub(super) fn random(random: &mut Random) -> Option<Self> {
        let tilt = 0.5 * random.next();
        let ladder = Self {
            planes: [(tilt, 0.0), (tilt + 1.6 + 0.8 * random.next(), -0.7)],
            mu_d: [0.2 + 0.2 * random.next(), 0.3 + 0.3 * random.next()],
            drop: [0.2, 0.3],
            memory: 0.02,
            weight: (0.3 * random.next()).max(0.0),
            stiffness: 0.01 + random.next().abs(),
            holding_point: random.vector(),
            theta: tilt + 0.8 + 0.7 * random.next(),
            sense: random.next().signum(),
        };
        let regular = ladder.speeds(ladder.theta).map(f64::abs);
        let lawful = regular.into_iter().all(|v| v > 0.05 && v < 5.0)
            && ladder.spread().abs() > 0.1
            && ladder.least_gap(ladder.theta) > 1e-3;
        lawful.then_some(ladder)
    }

    pub(super) fn with_memory(self, memory: f64) -> Self {
        Self { memory, ..self }
    }

    fn axes(&self, i: usize) -> [Vec2<f64>; 2] {
        directions(self.planes[i].0)
    }

    /// The positions of both contacts at an angle.
    pub(super) fn contacts(&self, theta: f64) -> [Vec2<f64>; 2] {
        let [n1, t1] = self.axes(0);
        let [n2, _] = self.axes(1);
        let arm = rotated(theta, TRIANGLE[1]) - rotated(theta, TRIANGLE[0]);
        let origin = n1 * self.planes[0].1;
        let along = (self.planes[1].1 - n2.dot(origin + arm)) / n2.dot(t1);
        let first = origin + t1 * along;
        [first, first + arm]
    }

    /// The feet along both planes.
    pub(super) fn feet(&self, theta: f64) -> [f64; 2] {
        let contacts = self.contacts(theta);
        [0, 1].map(|i| self.axes(i)[1].dot(contacts[i]))
    }

    /// Their velocities per angle.
    pub(super) fn speeds(&self, theta: f64) -> [f64; 2] {
        [0, 1].map(|i| derivative(|theta| self.feet(theta)[i], theta))
    }

    /// n - s mu t, for each contact; s as the motion begins.
    fn edges(&self, mu: [f64; 2]) -> [Vec2<f64>; 2] {
        let speeds = self.speeds(self.theta);
        [0, 1].map(|i| {
            let [normal, tangent] = self.axes(i);
            normal - tangent * (mu[i] * (speeds[i] * self.sense).signum())
        })
    }

    fn spread(&self) -> f64 {
        let [f1, f2] = self.edges(self.mu_d);
        f1.cross(f2)
    }

    /// The least gap of the vertices that are no contacts.
    pub(super) fn least_gap(&self, theta: f64) -> f64 {
        let contacts = self.contacts(theta);
        let gaps = [(1, 0), (2, 0), (0, 1), (2, 1)].map(|(vertex, plane)| {
            let (_, offset) = self.planes[plane];
            let arm = rotated(theta, TRIANGLE[vertex]) - rotated(theta, TRIANGLE[0]);
            self.axes(plane)[0].dot(contacts[0] + arm) - offset
        });
        gaps.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Force, and moment about contact 1, of hand and weight.
    fn load(&self, hand: &HandAt, theta: f64) -> (Vec2<f64>, f64) {
        let [contact, _] = self.contacts(theta);
        let lever = rotated(theta, [self.holding_point.x, self.holding_point.y]);
        let spring = hand.place - (contact + lever);
        let [a, b, c] = TRIANGLE;
        let middle = [a[0] + b[0] + c[0], a[1] + b[1] + c[1]].map(|x| x / 3.0);
        let weight = Vec2::new(0.0, -self.weight);
        let couple = self.stiffness * (hand.angle - theta);
        let moment = couple + lever.cross(spring) + rotated(theta, middle).cross(weight);
        (spring + weight, moment)
    }

    /// N_1, N_2 of edges that bear a force, and the couple that they leave.
    fn borne(&self, (force, moment): (Vec2<f64>, f64), theta: f64) -> ([f64; 2], f64) {
        let [f1, f2] = self.edges(self.mu_d);
        let [c1, c2] = self.contacts(theta);
        let n1 = -force.cross(f2) / f1.cross(f2);
        let n2 = -f1.cross(force) / f1.cross(f2);
        ([n1, n2], moment + n2 * (c2 - c1).cross(f2))
    }

    /// N_1, N_2 on the edges, and the drive of the motion: the couple over that of a drag along the motion.
    pub(super) fn balance(&self, hand: &HandAt, theta: f64) -> ([f64; 2], f64) {
        let (normals, couple) = self.borne(self.load(hand, theta), theta);
        (normals, couple / self.resistance(theta))
    }

    fn resistance(&self, theta: f64) -> f64 {
        let speeds = self.speeds(theta).map(|v| v * self.sense);
        let [c1, c2] = self.contacts(theta);
        let [d1, d2] = [0, 1].map(|i| self.axes(i)[1] * speeds[i]);
        self.borne((d1 + d2, (c2 - c1).cross(d2)), theta).1
    }

    /// -d/d(angle of the motion) of the drive, hand frozen.
    pub(super) fn stability(&self, hand: &HandAt, theta: f64) -> f64 {
        -self.sense * derivative(|theta| self.balance(hand, theta).1, theta)
    }

    /// The hand that balances the body with these N_i on edges with these coefficients.
    pub(super) fn holding(&self, [n1, n2]: [f64; 2], mu: [f64; 2]) -> HandAt {
        let theta = self.theta;
        let [f1, f2] = self.edges(mu);
        let [c1, c2] = self.contacts(theta);
        let (force, moment) = (-(f1 * n1 + f2 * n2), -n2 * (c2 - c1).cross(f2));
        let at_rest = HandAt {
            place: Vec2::ZERO,
            angle: theta,
        };
        let place = force - self.load(&at_rest, theta).0;
        let untwisted = HandAt {
            place,
            angle: theta,
        };
        let left = moment - self.load(&untwisted, theta).1;
        HandAt {
            place,
            angle: theta + left / self.stiffness,
        }
    }

    /// The lengths of a slip that begins where mu_s bears these N_i: to first order in mu_s - mu_d.
    pub(super) fn lengths(&self, normals: [f64; 2], hand: &HandAt, theta: f64) -> [f64; 2] {
        let there = Self {
            theta,
            ..self.clone()
        };
        let mu_s = [0, 1].map(|i| self.mu_d[i] + self.drop[i]);
        // The edges keep the signs of the motion.
        let (_, jump) = there.balance(&there.holding(normals, mu_s), theta);
        let turn = jump / self.stability(hand, theta);
        self.speeds(theta).map(|v| v.abs() * turn)
    }

    pub(super) fn case(&self, hand: &HandAt) -> Option<Case> {
        let surfaces = [0, 1].map(|i| {
            let [normal, _] = self.axes(i);
            SurfaceDescription {
                normal: [normal.x, normal.y],
                offset: self.planes[i].1,
                friction_static: self.mu_d[i] + self.drop[i],
                friction_dynamic: self.mu_d[i],
                memory: Some(self.memory),
            }
        });
        let [contact, _] = self.contacts(self.theta);
        let scene = Scene::new(&Description {
            vertices: &TRIANGLE,
            start: [contact.x, contact.y, self.theta],
            weight: self.weight,
            holding_point: None,
            reach: 0.0,
            stiffness_translation: 1.0,
            stiffness_rotation: self.stiffness,
            surfaces: &surfaces,
            obstacles: &[],
        });
        let [first, second] = [0, 1].map(|i| Pair {
            vertex: i,
            surface: i,
        });
        let pivot = Pivot {
            contact: first,
            foot: self.feet(self.theta)[0],
            orientation: Orientation::new(Angle::from_radians(self.theta)),
        };
        Some(Case {
            scene: scene.ok()?,
            state: TwoVertex::new(pivot, second),
            grip: self.grip(hand),
        })
    }

    pub(super) fn grip(&self, hand: &HandAt) -> Grip<f64> {
        Grip {
            holding_point: self.holding_point,
            hand: hand.place,
            angle: Angle::from_radians(hand.angle),
        }
    }

    /// The sign of the solver's twist that turns in this sense.
    pub(super) fn direction(&self, case: &Case) -> f64 {
        let contacts = (&case.state.pivot, case.state.other);
        let trammel = Trammel::in_sense(&case.scene, contacts, &case.grip, 1.0);
        trammel.twist().1.signum() * self.sense
    }
}
