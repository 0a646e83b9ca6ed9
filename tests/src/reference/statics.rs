//! Which loads the friction cones of the contacts can bear, and the forces of two contacts that slide together.

use super::Reference;
use super::cone::{inner, nearest, norm, normal_to, times};
use super::contact::Touch;
use super::scene::{Friction, Pose, Screw, Vector, add, cross, dot, scale, sub};

/// Two contacts that slide together along the one motion they leave free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sliding {
    /// Reactions along the two normals, N.
    pub normals: [f64; 2],
    /// The fraction of the braking wrench that would balance the load: positive if the load drives the motion.
    pub drive: f64,
    /// The numerator of `drive`: it changes sign only where the sliding body is balanced.
    pub excess: f64,
    /// The denominator of `drive`.
    pub whole: f64,
}

impl Reference {
    /// The wrench about the body origin of a force along `direction` at the contact; also the gradient of its position along
    /// `direction`.
    pub(super) fn line(&self, pose: &Pose, touch: Touch, direction: Vector) -> Screw {
        let arm = sub(self.scene.point(pose, touch), pose.position);
        [
            direction[0],
            direction[1],
            cross(arm, direction) / self.size,
        ]
    }

    /// The line of the contact's normal.
    pub(super) fn normal_line(&self, pose: &Pose, touch: Touch) -> Screw {
        self.line(pose, touch, self.scene.normal(pose, touch))
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

    /// Normal and tangential part of the reaction that a single contact would have to supply, N.
    pub(super) fn reaction(&self, pose: &Pose, touch: Touch, hand: [f64; 3]) -> [f64; 2] {
        let force = self.scene.applied_force(pose, hand);
        [
            -dot(self.scene.normal(pose, touch), force),
            -dot(self.scene.tangent(pose, touch), force),
        ]
    }

    /// Whether forces inside the cones of friction at rest of `contacts` balance the load.
    pub(super) fn admissible(&self, pose: &Pose, contacts: &[Touch], hand: [f64; 3]) -> bool {
        self.borne(pose, contacts, hand, |friction| self.grip(friction))
    }

    /// As above, with dynamic friction.
    pub(super) fn admissible_in_slip(
        &self,
        pose: &Pose,
        contacts: &[Touch],
        hand: [f64; 3],
    ) -> bool {
        self.borne(pose, contacts, hand, |friction| friction.mu_d)
    }

    fn borne(
        &self,
        pose: &Pose,
        contacts: &[Touch],
        hand: [f64; 3],
        friction: impl Fn(Friction) -> f64,
    ) -> bool {
        let load = times(-1.0, self.load(pose, hand));
        let edges = self.cone_edges(pose, contacts, friction);
        nearest(&edges, load).distance <= self.force_tolerance(pose, hand)
    }

    /// The line of a unit normal force plus `lean` times as much along the tangent.
    fn edge_of_cone(&self, pose: &Pose, touch: Touch, lean: f64) -> Screw {
        let tilt = scale(lean, self.scene.tangent(pose, touch));
        self.line(pose, touch, add(self.scene.normal(pose, touch), tilt))
    }

    /// Two edges per contact: leaning to +t, leaning to -t.
    pub(super) fn cone_edges(
        &self,
        pose: &Pose,
        contacts: &[Touch],
        friction: impl Fn(Friction) -> f64,
    ) -> Vec<Screw> {
        let lean = |touch: Touch, sign: f64| {
            let grip = friction(self.scene.friction(touch));
            self.edge_of_cone(pose, touch, sign * grip)
        };
        contacts
            .iter()
            .flat_map(|&touch| [lean(touch, 1.0), lean(touch, -1.0)])
            .collect()
    }

    /// The edges of the cones of friction at rest that bear a load at the limit: for each contact, the weight of its edge that
    /// leans to +t and of its edge that leans to -t.
    pub(super) fn bound_edges(
        &self,
        pose: &Pose,
        contacts: &[Touch],
        hand: [f64; 3],
    ) -> Vec<[f64; 2]> {
        let load = times(-1.0, self.load(pose, hand));
        let edges = self.cone_edges(pose, contacts, |friction| self.grip(friction));
        let weights = nearest(&edges, load).weights;
        let least = 1e-9 * weights.iter().fold(0.0, |most: f64, &w| most.max(w));
        let counted = |w: f64| if w > least { w } else { 0.0 };
        weights
            .chunks(2)
            .map(|w| [counted(w[0]), counted(w[1])])
            .collect()
    }

    /// How fast the contacts of a pair move along their tangents in a motion.
    pub(super) fn speeds(&self, pose: &Pose, pair: [Touch; 2], twist: Screw) -> [f64; 2] {
        pair.map(|touch| {
            let tangent = self.scene.tangent(pose, touch);
            inner(self.line(pose, touch, tangent), twist)
        })
    }

    /// The state of two contacts that slip at `mu_d` along `twist`; `None` if no drag could balance them.
    pub(super) fn sliding(
        &self,
        pose: &Pose,
        pair: [Touch; 2],
        twist: Screw,
        hand: [f64; 3],
    ) -> Option<Sliding> {
        let speeds = self.speeds(pose, pair, twist);
        let drag = self.drag(pose, pair, speeds);
        self.balanced(pose, pair, (speeds.map(sign), drag), hand)
    }

    /// Equal viscous drag at two contacts.
    pub(super) fn drag(&self, pose: &Pose, pair: [Touch; 2], speeds: [f64; 2]) -> Screw {
        let tangents = pair.map(|touch| self.line(pose, touch, self.scene.tangent(pose, touch)));
        [0, 1, 2].map(|k| -speeds[0] * tangents[0][k] - speeds[1] * tangents[1][k])
    }

    /// The state of two contacts that move along `ways` times their tangents, with a wrench along `brake` that balances the
    /// rest of the load; `None` if it could not.
    pub(super) fn balanced(
        &self,
        pose: &Pose,
        pair: [Touch; 2],
        (ways, brake): ([f64; 2], Screw),
        hand: [f64; 3],
    ) -> Option<Sliding> {
        let lines = [0, 1].map(|i| {
            let mu_d = self.scene.friction(pair[i]).mu_d;
            self.edge_of_cone(pose, pair[i], -mu_d * ways[i])
        });
        let load = times(-1.0, self.load(pose, hand));
        let whole = determinant(lines[0], lines[1], brake);
        if whole.abs() < 1e-14 {
            return None;
        }
        let excess = determinant(lines[0], lines[1], load);
        let normals = [
            determinant(load, lines[1], brake) / whole,
            determinant(lines[0], load, brake) / whole,
        ];
        Some(Sliding {
            normals,
            drive: excess / whole,
            excess,
            whole,
        })
    }

    /// The drive of two contacts that slide along `ways` under a load that reactions with these normal forces balance, each on the
    /// edge of its static cone: the force that vanishes when they begin to move.
    pub(super) fn drive_of_yield(
        &self,
        pose: &Pose,
        pair: [Touch; 2],
        (ways, brake): ([f64; 2], Screw),
        normals: [f64; 2],
    ) -> f64 {
        let reaction = |i: usize, mu: f64| self.edge_of_cone(pose, pair[i], -mu * ways[i]);
        let of = |i: usize| self.scene.friction(pair[i]);
        let sliding = [0, 1].map(|i| reaction(i, of(i).mu_d));
        let [first, second] = [0, 1].map(|i| times(normals[i], reaction(i, of(i).mu_s)));
        let needed = [0, 1, 2].map(|k| first[k] + second[k]);
        determinant(sliding[0], sliding[1], needed) / determinant(sliding[0], sliding[1], brake)
    }
}

/// -1, 0 or 1.
pub(super) fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

fn determinant(a: Screw, b: Screw, c: Screw) -> f64 {
    inner(normal_to(a, b), c)
}
