//! What loads contacts can bear without moving: the cone of the wrenches of all reactions within friction, as sums of its edges
//! with no negative part. Two answers that are certain, and between them nothing is said:
//!
//! * [`bears`](Bearing::bears): some such sum is the load, by its parts; and so for every load that is nearly the same.
//! * [`least`](Bearing::least): every such sum needs a reaction of at least this size, by a motion of the body: the work of
//!   the load along a twist has to be taken up by the contacts, and one that gives N takes no more than N times the most that
//!   an edge of its cone takes.

use crate::finding::Bounds;
use crate::frame::{Contact, Frame};
use crate::model::{Grip, LIMIT, Model};
use crate::touch::Face;
use crate::vector::{Vec2, Vec3, add, cross, cross3, dot3, length3, scaled, sub};

/// The contacts of a body in a pose, and the friction that is counted on.
pub(crate) struct Bearing<'a> {
    model: &'a Model,
    grip: &'a Grip,
    pose: [f64; 3],
    contacts: Vec<Cone>,
    /// What rounding leaves open: of an edge, relative, and of a load (N).
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
    /// Of all contacts of a frame, with the friction `mu` of each.
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
            blur: unknown * (2.0 * LIMIT * slant + 1.0) * model.unit_force() + of_angle,
        }
    }

    /// What the contacts have to bear, with the hand at a place: the wrench of springs and weight.
    fn load(&self, hand: [f64; 3]) -> Vec3 {
        let load = self.model.load(self.pose, hand, self.grip);
        [load.force[0], load.force[1], load.moment / self.model.size]
    }

    /// The contacts bear this load, and every one that differs from it by no more than rounding and the part `doubt` of its own
    /// size, with no N beyond `limit` (N).
    pub(crate) fn bears(&self, hand: [f64; 3], doubt: f64, limit: f64) -> bool {
        let load = self.load(hand);
        // Over all of a ball if over the corners of an octahedron around it.
        let radius = 3.0_f64.sqrt() * (self.blur + doubt * length3(load));
        (0..3).all(|axis| {
            [radius, -radius].iter().all(|shift| {
                let mut needed = load.map(|part| -part);
                needed[axis] += shift;
                self.is_sum(needed, limit)
            })
        })
    }

    /// A wrench is a sum of three edges, without a negative part.
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

    /// The largest N is at least this (N): infinite for a load that no reactions bear.
    pub(crate) fn least(&self, hand: [f64; 3]) -> f64 {
        let load = self.load(hand);
        let lines: Vec<Vec3> = (self.contacts.iter())
            .flat_map(|cone| [cone.edges[0], cone.edges[1], cone.tangent])
            .collect();
        let mut least = 0.0_f64;
        for (i, a) in lines.iter().enumerate() {
            for b in &lines[..i] {
                let normal = cross3(*a, *b);
                let size = length3(normal);
                if size > 0.0 {
                    for side in [1.0, -1.0] {
                        least = least.max(self.bound(normal.map(|x| side * x / size), load));
                    }
                }
            }
        }
        least
    }

    /// What a unit twist says of the largest N.
    fn bound(&self, twist: Vec3, load: Vec3) -> f64 {
        let work = dot3(twist, load) - self.blur;
        if work <= 0.0 {
            return 0.0;
        }
        let slack = |cone: &Cone| {
            let [a, b] = cone.edges.map(|edge| dot3(twist, edge));
            (self.unknown * cone.slant - a.min(b)).max(0.0)
        };
        work / self.contacts.iter().map(slack).sum::<f64>()
    }
}
