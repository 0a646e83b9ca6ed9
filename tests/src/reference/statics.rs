//! Forces at the contacts of a resting or sliding body: which loads the friction cones can carry, and how they carry them.

use super::cone::{inner, nearest, norm, normal_to, times};
use super::scene::{Pose, Screw, Touch, Vector, add, cross, dot, scale, sub};
use super::{ContactForce, Reference};

/// Two contacts that slide together along the one motion they leave free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sliding {
    /// Reactions along the two normals, N.
    pub normals: [f64; 2],
    /// Viscous drag along the motion that would balance the load: positive if the load drives the motion.
    pub drive: f64,
    /// The numerator of `drive`: changes sign only where the sliding body is balanced.
    pub excess: f64,
}

impl Reference {
    /// The wrench about the body origin of a force along `direction` at the contact; also the gradient of its position along
    /// `direction`.
    pub(super) fn line(&self, pose: &Pose, touch: Touch, direction: Vector) -> Screw {
        let arm = sub(pose.apply(self.scene.vertices[touch.vertex]), pose.position);
        [
            direction[0],
            direction[1],
            cross(arm, direction) / self.size,
        ]
    }

    /// The line of the contact's normal.
    pub(super) fn normal_line(&self, pose: &Pose, touch: Touch) -> Screw {
        self.line(pose, touch, self.scene.surfaces[touch.surface].normal)
    }

    /// The wrench of hand and weight about the body origin.
    pub(super) fn load(&self, pose: &Pose, hand: [f64; 3]) -> Screw {
        let force = self.scene.applied_force(pose, hand);
        [
            force[0],
            force[1],
            self.scene.applied_moment(pose, hand, pose.position) / self.size,
        ]
    }

    /// Forces below this count as zero, N.
    pub(super) fn force_tolerance(&self, pose: &Pose, hand: [f64; 3]) -> f64 {
        1e-12 * (self.scene.k_h * self.size + norm(self.load(pose, hand)))
    }

    /// Normal and tangential part of the reaction a single contact would have to give, N.
    pub(super) fn reaction(&self, pose: &Pose, touch: Touch, hand: [f64; 3]) -> [f64; 2] {
        let surface = &self.scene.surfaces[touch.surface];
        let force = self.scene.applied_force(pose, hand);
        [-dot(surface.normal, force), -dot(surface.tangent(), force)]
    }

    /// Whether forces inside the static cones of `contacts` balance the load.
    pub(super) fn admissible(&self, pose: &Pose, contacts: &[Touch], hand: [f64; 3]) -> bool {
        let load = times(-1.0, self.load(pose, hand));
        nearest(&self.cone_edges(pose, contacts), load).distance <= self.force_tolerance(pose, hand)
    }

    /// Two edges per contact: leaning to +t, leaning to -t.
    fn cone_edges(&self, pose: &Pose, contacts: &[Touch]) -> Vec<Screw> {
        let lean = |touch: Touch, sign: f64| {
            let surface = &self.scene.surfaces[touch.surface];
            self.line(
                pose,
                touch,
                add(
                    surface.normal,
                    scale(sign * surface.mu_s, surface.tangent()),
                ),
            )
        };
        contacts
            .iter()
            .flat_map(|&touch| [lean(touch, 1.0), lean(touch, -1.0)])
            .collect()
    }

    /// The state of two contacts that slide at `mu_d` along `twist`; `None` where no drag could balance them.
    pub(super) fn sliding(
        &self,
        pose: &Pose,
        pair: [Touch; 2],
        twist: Screw,
        hand: [f64; 3],
    ) -> Option<Sliding> {
        let surfaces = pair.map(|touch| &self.scene.surfaces[touch.surface]);
        let tangents = [0, 1].map(|i| self.line(pose, pair[i], surfaces[i].tangent()));
        let speeds = tangents.map(|tangent| inner(tangent, twist));
        let forces = [0, 1].map(|i| {
            add(
                surfaces[i].normal,
                scale(-surfaces[i].mu_d * sign(speeds[i]), surfaces[i].tangent()),
            )
        });
        let lines = [0, 1].map(|i| self.line(pose, pair[i], forces[i]));
        let drag = [0, 1, 2].map(|k| -speeds[0] * tangents[0][k] - speeds[1] * tangents[1][k]);
        let load = times(-1.0, self.load(pose, hand));
        let whole = determinant(lines[0], lines[1], drag);
        if whole.abs() < 1e-14 {
            return None;
        }
        let excess = determinant(lines[0], lines[1], load);
        let normals = [
            determinant(load, lines[1], drag) / whole,
            determinant(lines[0], load, drag) / whole,
        ];
        Some(Sliding {
            normals,
            drive: excess / whole,
            excess,
        })
    }

    /// The forces at the contacts; where statics leaves them open, the middle of what two cones allow, or one possible set.
    pub(super) fn contact_forces(&self) -> Vec<ContactForce> {
        let force = |touch: Touch, [normal, friction]: [f64; 2]| ContactForce {
            vertex: touch.vertex,
            surface: touch.surface,
            normal,
            friction,
        };
        match *self.contacts.as_slice() {
            [only] => vec![force(only, self.reaction(&self.pose, only, self.hand))],
            [a, b] if a.surface == b.surface => {
                let forces = self.edge_forces([a, b]);
                vec![force(a, forces[0]), force(b, forces[1])]
            }
            [a, b] if a.vertex != b.vertex => {
                let forces = self.braced_forces([a, b]);
                vec![force(a, forces[0]), force(b, forces[1])]
            }
            _ => {
                let load = times(-1.0, self.load(&self.pose, self.hand));
                let weights = nearest(&self.cone_edges(&self.pose, &self.contacts), load).weights;
                let split = |(&touch, w): (&Touch, &[f64])| {
                    force(
                        touch,
                        [
                            w[0] + w[1],
                            self.scene.surfaces[touch.surface].mu_s * (w[0] - w[1]),
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

    /// Normal forces of an edge from the moments about its ends, friction shared in their proportion.
    fn edge_forces(&self, pair: [Touch; 2]) -> [[f64; 2]; 2] {
        let surface = &self.scene.surfaces[pair[0].surface];
        let points = pair.map(|touch| self.pose.apply(self.scene.vertices[touch.vertex]));
        let about = points.map(|point| self.scene.applied_moment(&self.pose, self.hand, point));
        let reach = cross(sub(points[1], points[0]), surface.normal);
        let normals = [about[1] / reach, -about[0] / reach];
        let [total, friction] = self.reaction(&self.pose, pair[0], self.hand);
        normals.map(|normal| {
            [
                normal,
                if total == 0.0 {
                    0.0
                } else {
                    friction * normal / total
                },
            ]
        })
    }

    /// Forces of two contacts on two surfaces: in the middle of the internal forces along their connection that both static
    /// cones allow, at the end if the other is infinite.
    fn braced_forces(&self, pair: [Touch; 2]) -> [[f64; 2]; 2] {
        let points = pair.map(|touch| self.pose.apply(self.scene.vertices[touch.vertex]));
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
            let surface = &self.scene.surfaces[touch.surface];
            for side in [1.0, -1.0] {
                let inward = add(
                    scale(surface.mu_s, surface.normal),
                    scale(side, surface.tangent()),
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
            let surface = &self.scene.surfaces[touch.surface];
            [dot(surface.normal, total), dot(surface.tangent(), total)]
        };
        let extra = scale(internal, along);
        [
            split(pair[0], add(first, extra)),
            split(pair[1], sub(second, extra)),
        ]
    }
}

/// -1, 0 or 1.
pub(super) fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

fn determinant(a: Screw, b: Screw, c: Screw) -> f64 {
    inner(normal_to(a, b), c)
}
