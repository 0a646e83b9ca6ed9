//! Two contacts that are not on one line (STATICS 5): the amount by which static friction fails to hold them, and the drive of a
//! slip in which both frictions oppose the motion.

use crate::frame::Contact;
use crate::model::{Grip, Model, Wrench};
use crate::slip::Onset;
use crate::touch::Face;
use crate::vector::{Vec2, Vec3, add, cross, cross3, dot, dot3, length, length3, scaled, sub};

#[derive(Clone, Copy)]
pub(crate) struct Brace<'a> {
    pub(crate) model: &'a Model,
    pub(crate) grip: &'a Grip,
    pub(crate) pose: [f64; 3],
    pub(crate) contacts: [&'a Contact; 2],
}

impl Brace<'_> {
    fn feet(&self) -> [Vec2; 2] {
        self.contacts
            .map(|contact| self.model.foot(self.pose, contact.touch))
    }

    fn face(&self, contact: &Contact) -> Face {
        self.model.face(self.pose, contact.touch)
    }

    /// The levers of both feet about the holding point.
    fn levers(&self) -> [Vec2; 2] {
        let holding = self.model.holding_point(self.pose, self.grip);
        self.feet().map(|foot| sub(foot, holding))
    }

    fn load(&self, hand: [f64; 3]) -> Wrench {
        self.model.load(self.pose, hand, self.grip)
    }

    /// The least amount (N) by which reactions that bear the load leave the cones of a given friction (E5); negative if some of
    /// them lie inside. Minus infinity if the body is jammed.
    pub(crate) fn excess(&self, hand: [f64; 3], friction: Onset) -> f64 {
        let Wrench { force, moment } = self.load(hand);
        let [first, second] = self.feet();
        let [lever, _] = self.levers();
        let apart = length(sub(second, first));
        let along = scaled(sub(second, first), 1.0 / apart);
        let across = [-along[1], along[0]];
        let about_first = (moment - cross(lever, force)) / apart;
        let rest = [
            scaled(across, about_first - dot(force, across)),
            add(
                scaled(across, -about_first),
                scaled(along, -dot(force, along)),
            ),
        ];
        // Each cone edge in the form p + q lambda.
        let mut lines = Vec::with_capacity(4);
        for ((contact, rest), sign) in self.contacts.iter().zip(rest).zip([1.0, -1.0]) {
            let face = self.face(contact);
            let mu = friction(&face);
            for side in [1.0, -1.0] {
                let edge = sub(scaled(face.tangent(), side), scaled(face.normal, mu));
                let edge = scaled(edge, 1.0 / mu.hypot(1.0));
                lines.push((dot(rest, edge), sign * dot(along, edge)));
            }
        }
        lowest_maximum(&lines)
    }

    /// The drive of a slip (N), with friction opposing a motion of the body: positive while the slip continues; a zero of
    /// (E6), in units of the wrenches of both edges. `motion`: the change of the holding point and of the angle (m, rad).
    pub(crate) fn drive(&self, hand: [f64; 3], motion: (Vec2, f64)) -> f64 {
        let size = self.model.size;
        let Wrench { force, moment } = self.load(hand);
        let levers = self.levers();
        let wrench =
            |force: Vec2, lever: Vec2| -> Vec3 { [force[0], force[1], cross(lever, force) / size] };
        let [first, second] = [0, 1].map(|i| wrench(self.face(self.contacts[i]).normal, levers[i]));
        // The twist that keeps both contacts closed: velocity of the holding point, turn × L.
        let twist = cross3(first, second);
        let (way, turn) = motion;
        let forth = dot3(twist, [way[0], way[1], turn * size]).signum();
        let edges = [0, 1].map(|i| {
            let face = self.face(self.contacts[i]);
            let velocity = wrench(face.tangent(), levers[i]);
            let sign = (forth * dot3(twist, velocity)).signum();
            let mu = face.friction_dynamic;
            let edge = sub(face.normal, scaled(face.tangent(), sign * mu));
            wrench(edge, levers[i])
        });
        let normal = cross3(edges[0], edges[1]);
        let sizes = edges.map(length3);
        dot3([force[0], force[1], moment / size], normal) / (sizes[0] * sizes[1])
    }
}

/// The minimum over lambda of the maximum of p + q lambda.
fn lowest_maximum(lines: &[(f64, f64)]) -> f64 {
    let falls = lines.iter().all(|(_, q)| *q < 0.0);
    let rises = lines.iter().all(|(_, q)| *q > 0.0);
    if falls || rises {
        return f64::NEG_INFINITY;
    }
    let at = |lambda: f64| {
        let values = lines.iter().map(|(p, q)| p + q * lambda);
        values.fold(f64::NEG_INFINITY, f64::max)
    };
    let mut lowest = at(0.0);
    for (i, (p, q)) in lines.iter().enumerate() {
        for (other_p, other_q) in &lines[..i] {
            let lambda = (other_p - p) / (q - other_q);
            if lambda.is_finite() {
                lowest = lowest.min(at(lambda));
            }
        }
    }
    lowest
}
