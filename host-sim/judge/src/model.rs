//! The scene with derived quantities, the hand's grip, and the forces on the body: hand, weight and reactions (N, N·m,
//! world frame).

use crate::body::{centroid, size};
use crate::finding::Bounds;
use crate::frame::{Contact, Frame};
use crate::level::level;
use crate::scene::Scene;
use crate::sides::Sides;
use crate::touch::Face;
use crate::vector::{Vec2, add, cross, distance, dot, length, scaled, sub};

#[derive(Clone, Debug)]
pub(crate) struct Model {
    pub(crate) scene: Scene,
    /// L (m)
    pub(crate) size: f64,
    centroid: Vec2,
    /// The surface farthest from the origin (m).
    farthest: f64,
    pub(crate) sides: Sides,
}

/// Where the hand holds the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Grip {
    /// g (m), body frame.
    pub(crate) point: Vec2,
    /// phi - theta at which the rotational spring rests (rad).
    pub(crate) offset: f64,
}

impl Grip {
    /// The grip on a body that is grasped where it is.
    pub(crate) fn taken(pose: [f64; 3], hand: [f64; 3]) -> Self {
        let from_origin = [hand[0] - pose[0], hand[1] - pose[1]];
        Self {
            point: crate::vector::turned(from_origin, -pose[2]),
            offset: hand[2] - pose[2],
        }
    }
}

/// A force and the moment about the holding point.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wrench {
    pub(crate) force: Vec2,
    pub(crate) moment: f64,
}

/// The forces and moments that the residuals of a frame are relative to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// The scale of forces (N).
    pub(crate) force: f64,
    /// The scale of moments, as a force: moment / L (N).
    pub(crate) moment: f64,
}

/// The uncertainty of the force (N) and the moment (N·m) of the springs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exactness {
    pub(crate) force: f64,
    pub(crate) moment: f64,
}

/// In units of L: the default memory length of a surface, and the shortest one, which 0 stands for.
const MEMORY: f64 = 1.0 / 4096.0;
const SHORTEST: f64 = 1.0 / 524_288.0;

/// The largest reaction that is borne without a limit, in units of k_h L; beyond it a body is jammed.
const LIMIT: f64 = 64.0;

impl Model {
    pub(crate) fn new(mut scene: Scene) -> Self {
        scene.obstacles = level(&scene);
        let offsets = scene.surfaces.iter().map(|surface| surface.offset.abs());
        Self {
            size: size(&scene.vertices),
            centroid: centroid(&scene.vertices),
            farthest: offsets.fold(0.0, f64::max),
            sides: Sides::new(&scene),
            scene,
        }
    }

    /// G
    pub(crate) fn holding_point(&self, pose: [f64; 3], grip: &Grip) -> Vec2 {
        Scene::place(pose, grip.point)
    }

    /// From the body's origin to its centroid (m), body frame.
    pub(crate) fn centroid(&self) -> Vec2 {
        self.centroid
    }

    /// The weight (N).
    pub(crate) fn weight(&self) -> Vec2 {
        [0.0, -self.scene.weight]
    }

    /// k_h L (N)
    pub(crate) fn unit_force(&self) -> f64 {
        self.scene.stiffness_translation * self.size
    }

    /// L of a solver (m). That of a point, whose size means nothing, is 1 m, or the nearest power of two from r/4 to 8 r, with the radius r
    /// of the springs and the lever of the holding point (STATICS 1).
    fn unit_length(&self) -> f64 {
        let scene = &self.scene;
        let [vertex] = scene.vertices[..] else {
            return self.size;
        };
        let springs = (scene.stiffness_rotation / scene.stiffness_translation).sqrt();
        let lever = scene.holding_point.map(|g| length(sub(g, vertex)));
        let radius = lever.into_iter().fold(springs, f64::hypot);
        let mut unit = self.size;
        while radius > 0.0 && unit > 8.0 * radius {
            unit /= 2.0;
        }
        while unit < radius / 4.0 {
            unit *= 2.0;
        }
        unit
    }

    /// The largest reaction that is borne (N): 64 k_h L.
    pub(crate) fn limit(&self) -> f64 {
        LIMIT * self.scene.stiffness_translation * self.unit_length()
    }

    /// D_c (m) of a contact.
    fn memory(&self, face: &Face) -> f64 {
        let unit = self.unit_length();
        let given = face.memory.map(|given| given.max(SHORTEST * unit));
        given.unwrap_or(MEMORY * unit)
    }

    /// N* = k_h D_c / (mu_s - mu_d): a contact that is pressed less has no stiction of its own. Infinite for mu_s = mu_d.
    pub(crate) fn threshold(&self, face: &Face) -> f64 {
        let drop = face.friction_static - face.friction_dynamic;
        self.scene.stiffness_translation * self.memory(face) / drop.max(0.0)
    }

    pub(crate) fn springs(&self, pose: [f64; 3], hand: [f64; 3], grip: &Grip) -> Wrench {
        let way = sub([hand[0], hand[1]], self.holding_point(pose, grip));
        Wrench {
            force: scaled(way, self.scene.stiffness_translation),
            moment: self.scene.stiffness_rotation * (hand[2] - grip.offset - pose[2]),
        }
    }

    /// Springs and weight together: the load on the contacts.
    pub(crate) fn load(&self, pose: [f64; 3], hand: [f64; 3], grip: &Grip) -> Wrench {
        let springs = self.springs(pose, hand, grip);
        let lever = sub(
            Scene::place(pose, self.centroid),
            self.holding_point(pose, grip),
        );
        Wrench {
            force: add(springs.force, self.weight()),
            moment: springs.moment + cross(lever, self.weight()),
        }
    }

    /// N n + T t (N)
    pub(crate) fn reaction(&self, pose: [f64; 3], contact: &Contact) -> Vec2 {
        let face = self.face(pose, contact.touch);
        add(
            scaled(face.normal, contact.normal),
            scaled(face.tangent(), contact.friction),
        )
    }

    /// The farthest coordinate of body and surfaces (m).
    fn extent(&self, frame: &Frame) -> f64 {
        let [x, y, _] = frame.pose;
        let points = frame.contacts.iter().flat_map(|contact| contact.point);
        [x, y, self.farthest]
            .into_iter()
            .chain(points)
            .fold(self.size, |most, x| most.max(x.abs()))
    }

    /// The farthest coordinate, or how far a vertex moves when the body turns by its whole angle.
    pub(crate) fn reach(&self, frame: &Frame) -> f64 {
        self.extent(frame).max(self.size * frame.pose[2].abs())
    }

    /// 64 roundings of the reach (m).
    pub(crate) fn carried(&self, frame: &Frame, bounds: &Bounds) -> f64 {
        64.0 * bounds.rounding * self.reach(frame)
    }

    /// The length that gaps are relative to (m).
    pub(crate) fn length_scale(&self, frame: &Frame, bounds: &Bounds) -> f64 {
        let far = if bounds.far { self.reach(frame) } else { 0.0 };
        let carried = self.carried(frame, bounds) / bounds.gap;
        self.size.max(far).max(carried)
    }

    /// The accuracy of the springs' force (N) and moment (N·m) as computed from the printed numbers.
    pub(crate) fn exactness(&self, frame: &Frame, grip: &Grip, bounds: &Bounds) -> Exactness {
        let springs = self.springs(frame.pose, frame.hand, grip);
        let [x, y, phi] = frame.hand;
        let extent = self.reach(frame).max(x.abs()).max(y.abs());
        let turns = frame.pose[2].abs().max(phi.abs()).max(1.0);
        let force = length(springs.force) + self.scene.stiffness_translation * extent;
        let moment = springs.moment.abs() + self.scene.stiffness_rotation * turns;
        let few = 2.0 * bounds.exact;
        Exactness {
            force: few * force,
            moment: few * (moment + force * self.size),
        }
    }

    /// The scale of forces and moments of a frame; `bound` is the allowed residual.
    pub(crate) fn scale(&self, frame: &Frame, grip: &Grip, bound: f64, rounding: f64) -> Scale {
        let springs = self.springs(frame.pose, frame.hand, grip);
        let largest = (frame.contacts.iter())
            .map(|contact| contact.normal.hypot(contact.friction))
            .fold(length(springs.force).max(self.scene.weight), f64::max);
        let carried = 64.0 * rounding / bound;
        let turns = frame.pose[2].abs().max(frame.hand[2].abs()).max(1.0);
        let [x, y, _] = frame.hand;
        let extent = self.extent(frame).max(x.abs()).max(y.abs());
        let floor = carried * self.scene.stiffness_translation * extent;
        let force = largest.max(floor).max(f64::MIN_POSITIVE);
        // If a force is known to within a rounding, its moment is known to within its lever times that.
        let holding = self.holding_point(frame.pose, grip);
        let levers = (frame.contacts.iter())
            .map(|contact| distance(self.foot(frame.pose, contact.touch), holding));
        let lever = levers.fold(0.0, f64::max) / self.size;
        let moment = (springs.moment.abs() / self.size)
            .max(carried * self.scene.stiffness_rotation * turns / self.size)
            .max(floor * lever);
        Scale {
            force,
            moment: force.max(moment),
        }
    }
}

/// The normal and the tangential part of the reaction that balances a force, for a unit normal.
pub(crate) fn borne(force: Vec2, normal: Vec2) -> (f64, f64) {
    let tangent = [normal[1], -normal[0]];
    (-dot(force, normal), -dot(force, tangent))
}
