//! The loads that contacts can bear without moving: the cone of the wrenches of all reactions within friction, represented as
//! non-negative combinations of its edges. There are two answers that are certain; between them, nothing is decided:
//!
//! * [`bears`](Bearing::bears): some combination of the edges equals the load, which its coefficients prove, and the same holds
//!   for every load that is nearly equal.
//! * [`least`](Bearing::least): every combination needs a reaction of at least this size, which a motion of the body proves:
//!   the contacts have to absorb the work of the load along a twist, and a contact with normal force N absorbs at most N times
//!   the most that an edge of its cone absorbs.

use crate::finding::Bounds;
use crate::frame::{Contact, Frame};
use crate::model::{Grip, Model};
use crate::touch::Face;
use crate::vector::{Vec2, Vec3, add, cross, cross3, dot3, length3, scaled, sub};

/// The contacts of a body in a pose, and the friction that may be assumed.
pub(crate) struct Bearing<'a> {
    model: &'a Model,
    grip: &'a Grip,
    pose: [f64; 3],
    contacts: Vec<Cone>,
    /// Uncertainty due to rounding: of an edge, relative, and of a load (N).
    unknown: f64,
    blur: f64,
}

/// The reactions of a contact with N = 1: wrenches about the holding point, moments over L.
struct Cone {
    edges: [Vec3; 2],
    tangent: Vec3,
    /// |R| / N at the edges.
    slant: f64,
}

impl<'a> Bearing<'a> {
    /// The cones of all contacts of a frame, with the friction `mu` of each.
    pub(crate) fn new(
        model: &'a Model,
        bounds: &Bounds,
        grip: &'a Grip,
        frame: &Frame,
        mu: impl Fn(&Face) -> f64,
    ) -> Self {
        let holding = model.holding_point(frame.pose, grip);
        let cone = |contact: &Contact| {
            let face = model.face(frame.pose, contact.touch);
            let lever = sub(model.foot(frame.pose, contact.touch), holding);
            let wrench = |force: Vec2| [force[0], force[1], cross(lever, force) / model.size];
            let mu = mu(&face);
            Cone {
                edges: [1.0, -1.0]
                    .map(|side| wrench(add(face.normal, scaled(face.tangent(), side * mu)))),
                tangent: wrench(face.tangent()),
                slant: mu.hypot(1.0),
            }
        };
        let unknown = model.carried(frame, bounds) / model.size;
        let angle = frame.pose[2].abs().max(frame.hand[2].abs()).max(1.0);
        let of_angle = 64.0 * bounds.rounding * angle * model.scene.stiffness_rotation / model.size;
        let contacts: Vec<Cone> = frame.contacts.iter().map(cone).collect();
        let slant = contacts
            .iter()
            .fold(1.0_f64, |most, cone| most.max(cone.slant));
        Self {
            model,
            grip,
            pose: frame.pose,
            contacts,
            unknown,
            blur: unknown * (2.0 * slant * model.limit() + model.unit_force()) + of_angle,
        }
    }

    /// The load on the contacts for a hand pose: the wrench of springs and weight.
    fn load(&self, hand: [f64; 3]) -> Vec3 {
        let load = self.model.load(self.pose, hand, self.grip);
        [load.force[0], load.force[1], load.moment / self.model.size]
    }

    /// Whether the contacts bear this load, and every load that differs from it by no more than rounding and the fraction
    /// `doubt` of its own magnitude, with no N beyond `limit` (N).
    pub(crate) fn bears(&self, hand: [f64; 3], doubt: f64, limit: f64) -> bool {
        let load = self.load(hand);
        // It holds on a whole ball if it holds at the corners of an octahedron around it.
        let radius = 3.0_f64.sqrt() * (self.blur + doubt * length3(load));
        (0..3).all(|axis| {
            [radius, -radius].iter().all(|shift| {
                let mut needed = load.map(|part| -part);
                needed[axis] += shift;
                self.is_sum(needed, limit)
            })
        })
    }

    /// Whether a wrench is a non-negative combination of three edges.
    fn is_sum(&self, wrench: Vec3, limit: f64) -> bool {
        let edges: Vec<(usize, Vec3)> = (self.contacts.iter().enumerate())
            .flat_map(|(i, cone)| cone.edges.map(|edge| (i, edge)))
            .collect();
        for (i, a) in edges.iter().enumerate() {
            for (j, b) in edges[..i].iter().enumerate() {
                for c in &edges[..j] {
                    let volume = dot3(a.1, cross3(b.1, c.1));
                    let parts = [(b, c), (c, a), (a, b)]
                        .map(|(p, q)| dot3(wrench, cross3(p.1, q.1)) / volume);
                    let within = |k: usize| {
                        let of = [a, b, c]
                            .into_iter()
                            .zip(parts)
                            .filter(|(edge, _)| edge.0 == k);
                        of.map(|(_, part)| part).sum::<f64>() <= limit
                    };
                    let is_positive = parts.iter().all(|part| *part >= 0.0);
                    if is_positive && (0..self.contacts.len()).all(within) {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// A lower bound of the largest N (N): infinite for a load that no reactions bear.
    pub(crate) fn least(&self, hand: [f64; 3]) -> f64 {
        let load = self.load(hand);
        self.twists()
            .map(|twist| self.bound(twist, load))
            .fold(0.0, f64::max)
    }

    /// Whether no reactions bear the load, however large: along some twist the load does work that no contact absorbs, whatever the
    /// rounding errors of both.
    pub(crate) fn never_bears(&self, hand: [f64; 3]) -> bool {
        let load = self.load(hand);
        let free = |twist: &Vec3| {
            let taken = self.contacts.iter().map(|cone| Self::taken(cone, *twist));
            taken.fold(f64::MIN, f64::max) <= self.unknown
        };
        let free: Vec<Vec3> = self.twists().filter(free).collect();
        let opening = unit(free.iter().fold([0.0; 3], |sum, twist| plus(sum, *twist)));
        // All sums of free motions are free. The nearer a sum is to the motion that opens all contacts, the more certainly it is free;
        // the farther it is from that motion, the more strongly the load drives it.
        let parts = [1.0, 0.5, 0.25, 0.125, 0.0625];
        let sums = free
            .iter()
            .flat_map(|twist| parts.map(|part| unit(plus(*twist, opening.map(|x| part * x)))));
        sums.into_iter().any(|twist| {
            let opens = |cone: &Cone| Self::taken(cone, twist) <= -self.unknown * cone.slant;
            dot3(twist, load) > self.blur && self.contacts.iter().all(opens)
        })
    }

    /// Unit twists at which the work of the contacts changes its sign.
    fn twists(&self) -> impl Iterator<Item = Vec3> {
        let lines: Vec<Vec3> = (self.contacts.iter())
            .flat_map(|cone| [cone.edges[0], cone.edges[1], cone.tangent])
            .collect();
        let pairs = (0..lines.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs
            .map(move |(i, j)| cross3(lines[i], lines[j]))
            .filter(|normal| length3(*normal) > 0.0)
            .flat_map(|normal| [1.0, -1.0].map(|side| unit(normal.map(|x| side * x))))
    }

    /// The most work that a contact absorbs along a unit twist, with N = 1.
    fn taken(cone: &Cone, twist: Vec3) -> f64 {
        let [a, b] = cone.edges.map(|edge| dot3(twist, edge));
        -a.min(b)
    }

    /// The lower bound of the largest N that follows from a unit twist.
    fn bound(&self, twist: Vec3, load: Vec3) -> f64 {
        let work = dot3(twist, load) - self.blur;
        if work <= 0.0 {
            return 0.0;
        }
        let slack = |cone: &Cone| (self.unknown * cone.slant + Self::taken(cone, twist)).max(0.0);
        work / self.contacts.iter().map(slack).sum::<f64>()
    }
}

fn plus(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|k| a[k] + b[k])
}

fn unit(a: Vec3) -> Vec3 {
    let length = length3(a);
    a.map(|x| x / length)
}
