//! Whether a body that is out of balance could move: contacts open, one sticks and the body turns about it, one slides, or two do. The
//! springs let the body move as the forces on it demand, against friction, and no contact closes (STATICS 5, 6). A positive answer is
//! certain; near a limit, the answer is negative.

use crate::frame::Frame;
use crate::model::{Grip, Model};
use crate::vector::{Vec2, Vec3, cross, dot3, length3, sub};

/// Velocities and reactions count if they exceed this fraction of the largest.
const CLEAR: f64 = 1e-3;

/// A contact: wrenches of unit forces along its normal and its tangent, moments about the holding point over L, and mu_d.
struct Screws {
    normal: Vec3,
    tangent: Vec3,
    friction: f64,
}

struct Body {
    contacts: Vec<Screws>,
    load: Vec3,
    /// How far a force of 1 N moves the holding point, and the turn times L that a moment over L of 1 N causes (m).
    yields: Vec3,
}

/// Whether some motion clearly follows the load.
pub(crate) fn can_move(model: &Model, grip: &Grip, frame: &Frame) -> bool {
    let holding = model.holding_point(frame.pose, grip);
    let load = model.load(frame.pose, frame.hand, grip);
    let contact = |contact: &crate::frame::Contact| {
        let face = model.face(frame.pose, contact.touch);
        let lever = sub(model.foot(frame.pose, contact.touch), holding);
        let wrench = |along: Vec2| [along[0], along[1], cross(lever, along) / model.size];
        Screws {
            normal: wrench(face.normal),
            tangent: wrench(face.tangent()),
            friction: face.friction_dynamic,
        }
    };
    let k = model.scene.stiffness_translation;
    let turning = match model.scene.stiffness_rotation {
        0.0 => k,
        of_springs => of_springs / (model.size * model.size),
    };
    let body = Body {
        contacts: frame.contacts.iter().map(contact).collect(),
        load: [load.force[0], load.force[1], load.moment / model.size],
        yields: [1.0 / k, 1.0 / k, 1.0 / turning],
    };
    body.can_move()
}

impl Body {
    fn can_move(&self) -> bool {
        let all = 0..self.contacts.len();
        let signs = [1.0, -1.0];
        self.opens(&[], self.load)
            || all
                .clone()
                .any(|i| self.turns(i) || signs.iter().any(|&sign| self.slides(i, sign)))
            || all.clone().any(|i| {
                (0..i).any(|j| {
                    signs
                        .iter()
                        .any(|&a| signs.iter().any(|&b| self.both([(i, a), (j, b)])))
                })
            })
    }

    /// The twist under a wrench.
    fn twist(&self, wrench: Vec3) -> Vec3 {
        std::array::from_fn(|k| self.yields[k] * wrench[k])
    }

    /// The velocity along a wrench's line under another wrench.
    fn along(&self, line: Vec3, wrench: Vec3) -> f64 {
        dot3(line, self.twist(wrench))
    }

    /// The largest velocity that counts as zero.
    fn slow(&self) -> f64 {
        CLEAR * length3(self.twist(self.load))
    }

    /// Whether all contacts open, except the given ones.
    fn opens(&self, but: &[usize], wrench: Vec3) -> bool {
        (self.contacts.iter().enumerate())
            .filter(|(i, _)| !but.contains(i))
            .all(|(_, contact)| self.along(contact.normal, wrench) > self.slow())
    }

    fn loaded(&self, parts: &[(Vec3, f64)]) -> Vec3 {
        parts.iter().fold(self.load, |sum, (wrench, size)| {
            std::array::from_fn(|k| sum[k] + size * wrench[k])
        })
    }

    fn clear_force(&self) -> f64 {
        CLEAR * length3(self.load)
    }

    /// The edge of the cone of a contact that slides along sign·t.
    fn edge(&self, i: usize, sign: f64) -> Vec3 {
        let Screws {
            normal,
            tangent,
            friction,
        } = &self.contacts[i];
        std::array::from_fn(|k| normal[k] - sign * friction * tangent[k])
    }

    fn slides(&self, i: usize, sign: f64) -> bool {
        let (normal, edge) = (self.contacts[i].normal, self.edge(i, sign));
        let gives = self.along(normal, edge);
        let force = -self.along(normal, self.load) / gives;
        let wrench = self.loaded(&[(edge, force)]);
        gives > CLEAR * self.along(normal, normal)
            && force > self.clear_force()
            && sign * self.along(self.contacts[i].tangent, wrench) > self.slow()
            && self.opens(&[i], wrench)
    }

    /// Whether the body turns about a sticking contact.
    fn turns(&self, i: usize) -> bool {
        let Screws {
            normal,
            tangent,
            friction,
        } = &self.contacts[i];
        let Some([force, rub]) = self.closing([(*normal, *normal), (*tangent, *tangent)]) else {
            return false;
        };
        let wrench = self.loaded(&[(*normal, force), (*tangent, rub)]);
        force > self.clear_force()
            && rub.abs() < friction * force - self.clear_force()
            && self.opens(&[i], wrench)
            && length3(self.twist(wrench)) > self.slow()
    }

    fn both(&self, pair: [(usize, f64); 2]) -> bool {
        let edges = pair.map(|(i, sign)| self.edge(i, sign));
        let lines = pair.map(|(i, _)| self.contacts[i].normal);
        let Some(forces) = self.closing([(lines[0], edges[0]), (lines[1], edges[1])]) else {
            return false;
        };
        let wrench = self.loaded(&[(edges[0], forces[0]), (edges[1], forces[1])]);
        let goes = |&(i, sign): &(usize, f64)| {
            sign * self.along(self.contacts[i].tangent, wrench) > self.slow()
        };
        forces.iter().all(|&force| force > self.clear_force())
            && pair.iter().all(goes)
            && self.opens(&pair.map(|(i, _)| i), wrench)
    }

    /// The multiples of two wrenches that prevent motion along two lines;
    /// `None` if they are linearly dependent, or push in the wrong direction.
    fn closing(&self, [(a, of_a), (b, of_b)]: [(Vec3, Vec3); 2]) -> Option<[f64; 2]> {
        let [aa, ab] = [self.along(a, of_a), self.along(a, of_b)];
        let [ba, bb] = [self.along(b, of_a), self.along(b, of_b)];
        let volume = aa * bb - ab * ba;
        let [free_a, free_b] = [self.along(a, self.load), self.along(b, self.load)];
        let size = self.along(a, a) * self.along(b, b);
        (volume > CLEAR * size).then(|| {
            [
                (ab * free_b - bb * free_a) / volume,
                (ba * free_a - aa * free_b) / volume,
            ]
        })
    }
}
