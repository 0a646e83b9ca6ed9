//! The forces at the contacts of a body that rests or slides.

use super::cone::{nearest, times};
use super::contact::Touch;
use super::scene::{Pose, Vector, add, cross, dot, scale, sub};
use super::{ContactForce, Reference};

impl Reference {
    /// The forces at the contacts; if statics leaves them undetermined, the middle of what two cones allow, or one possible set.
    pub(super) fn contact_forces(&self) -> Vec<ContactForce> {
        let slides = |touch: Touch| {
            let index = self.contacts.iter().position(|&other| other == touch);
            let way = index.and_then(|i| self.slide.as_ref()?.get(i).copied());
            way.map_or(0, |way| if way > 0.0 { 1 } else { -1 })
        };
        let force = |touch: Touch, [normal, friction]: [f64; 2]| ContactForce {
            touch,
            normal,
            friction,
            slides: slides(touch),
        };
        let paired = |pair: [Touch; 2], forces: [[f64; 2]; 2]| {
            [0, 1].map(|i| force(pair[i], forces[i])).to_vec()
        };
        match *self.contacts.as_slice() {
            [only] => vec![force(only, self.reaction(&self.pose, only, self.hand))],
            [a, b] if self.flat() => paired([a, b], self.edge_forces([a, b])),
            [a, b] if !self.corner() => {
                let forces = self.sliding_forces([a, b]);
                paired([a, b], forces.unwrap_or_else(|| self.braced_forces([a, b])))
            }
            _ => {
                let load = times(-1.0, self.load(&self.pose, self.hand));
                let edges =
                    self.cone_edges(&self.pose, &self.contacts, |friction| self.grip(friction));
                let weights = nearest(&edges, load).weights;
                let split = |(&touch, w): (&Touch, &[f64])| {
                    force(
                        touch,
                        [
                            w[0] + w[1],
                            self.grip(self.scene.friction(touch)) * (w[0] - w[1]),
                        ],
                    )
                };
                self.contacts
                    .iter()
                    .zip(weights.chunks(2))
                    .map(split)
                    .collect()
            }
        }
    }

    /// Forces of an edge, with friction shared in proportion to the capacity of each contact.
    fn edge_forces(&self, pair: [Touch; 2]) -> [[f64; 2]; 2] {
        let [total, friction] = self.reaction(&self.pose, pair[0], self.hand);
        let normals = self.edge_normals(&self.pose, pair, self.hand);
        let [a, b] = pair.map(|touch| self.grip(self.scene.friction(touch)));
        if a == b {
            let share = if total == 0.0 { 0.0 } else { friction / total };
            return normals.map(|normal| [normal, share * normal]);
        }
        let most = a * normals[0] + b * normals[1];
        let share = if most == 0.0 { 0.0 } else { friction / most };
        [
            [normals[0], share * a * normals[0]],
            [normals[1], share * b * normals[1]],
        ]
    }

    /// Normal forces of an edge from the moments about its ends.
    pub(super) fn edge_normals(&self, pose: &Pose, pair: [Touch; 2], hand: [f64; 3]) -> [f64; 2] {
        let normal = self.scene.normal(pose, pair[0]);
        let points = pair.map(|touch| self.scene.point(pose, touch));
        let about = points.map(|point| self.scene.applied_moment(pose, hand, point));
        let reach = cross(sub(points[1], points[0]), normal);
        [about[1] / reach, -about[0] / reach]
    }

    /// The dynamic coefficient of a contact, or of an edge: the average over its contacts, weighted by their normal forces.
    pub(super) fn rubbing(&self, pose: &Pose, touch: Touch, hand: [f64; 3]) -> f64 {
        let mu_d = |touch| self.scene.friction(touch).mu_d;
        match *self.contacts.as_slice() {
            [a, b] if mu_d(a) != mu_d(b) && self.lined(pose, [a, b]) => {
                let [first, second] = self.edge_normals(pose, [a, b], hand);
                (mu_d(a) * first + mu_d(b) * second) / (first + second)
            }
            _ => mu_d(touch),
        }
    }

    /// Forces of two contacts that slide on two surfaces.
    fn sliding_forces(&self, pair: [Touch; 2]) -> Option<[[f64; 2]; 2]> {
        let ways = self.pair_ways()?;
        let normals = self.pair_normals(&self.pose, pair, ways, self.hand)?;
        let friction = |i: usize| -ways[i] * self.scene.friction(pair[i]).mu_d * normals[i];
        Some([0, 1].map(|i| [normals[i], friction(i)]))
    }

    /// Forces of two contacts on two surfaces: in the middle of the range of internal forces along their connecting line
    /// that both static cones allow, or at its end if the other is infinite.
    fn braced_forces(&self, pair: [Touch; 2]) -> [[f64; 2]; 2] {
        let points = pair.map(|touch| self.scene.point(&self.pose, touch));
        let along = sub(points[1], points[0]);
        let squared = dot(along, along);
        let across = [-along[1], along[0]];
        let force = self.scene.applied_force(&self.pose, self.hand);
        let moment = self.scene.applied_moment(&self.pose, self.hand, points[0]);
        let second = sub(
            scale(-moment / squared, across),
            scale(dot(force, along) / squared, along),
        );
        let first = sub(scale(-1.0, force), second);
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for (touch, start, direction) in [
            (pair[0], first, along),
            (pair[1], second, scale(-1.0, along)),
        ] {
            let grip = self.grip(self.scene.friction(touch));
            for side in [1.0, -1.0] {
                let inward = add(
                    scale(grip, self.scene.normal(&self.pose, touch)),
                    scale(side, self.scene.tangent(&self.pose, touch)),
                );
                let (constant, slope) = (dot(inward, start), dot(inward, direction));
                if slope > 0.0 {
                    low = low.max(-constant / slope);
                } else if slope < 0.0 {
                    high = high.min(-constant / slope);
                }
            }
        }
        let internal = match (low.is_finite(), high.is_finite()) {
            (true, true) => 0.5 * (low + high),
            (true, false) => low,
            (false, true) => high,
            (false, false) => 0.0,
        };
        let split = |touch: Touch, total: Vector| {
            [
                dot(self.scene.normal(&self.pose, touch), total),
                dot(self.scene.tangent(&self.pose, touch), total),
            ]
        };
        let extra = scale(internal, along);
        [
            split(pair[0], add(first, extra)),
            split(pair[1], sub(second, extra)),
        ]
    }
}
