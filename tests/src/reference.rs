//! A slow second solution of the statics, for checking the fast one: hand poses to body poses and contact forces, plain SI `f64`.
//!
//! The hand moves along the straight line between two frames in sub-steps. In each the body rests, followed by walking down the
//! moment in steps of 1e-3 rad; when it cannot, the instant is bisected, the hand frozen there, and the body moves in steps of
//! 1e-3 body sizes or rad until forces found by trying every subset of friction-cone edges hold it. It shares no code and no
//! closed form with the solver.
//!
//! Where it is approximate:
//! * Two events that undo each other within one sub-step, one slide step or (a grazing touch) one turn of
//!   1e-3 rad are not seen.
//! * A snap is noticed as a turn of more than 0.03 rad, so one that is smaller happens unseen, with the same end.
//! * Events that follow each other ever faster (continuous sliding, the slips of a body being lifted) are skipped: the body
//!   relaxes once, at the end of the sub-step. Poses then agree, the number of slips does not.
//! * Where several motions fit, one is taken and `ambiguous` is set only when none does.

mod cone;
mod relax;
mod scene;
mod statics;
mod walk;

pub use scene::{Scene, Surface};

use scene::{Pose, Touch};
use walk::{End, SNAP};

/// A vertex may be this far inside a surface unseen, in body sizes.
const CLEARANCE: f64 = 1e-12;
/// Vertices this close to a surface touch it from the beginning, in body sizes.
const TOUCHING: f64 = 1e-5;
/// An event that follows another sooner than this, in sub-steps, belongs to a sequence without end.
const SOON: f64 = 1e-7;

/// The force of one contact on the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactForce {
    /// Index of the vertex.
    pub vertex: usize,
    /// Index of the surface.
    pub surface: usize,
    /// Force along the surface's normal, N.
    pub normal: f64,
    /// Force along the tangent (n_y, -n_x), N.
    pub friction: f64,
}

/// The body under a moving hand.
#[derive(Clone, Debug)]
pub struct Reference {
    scene: Scene,
    size: f64,
    hand: [f64; 3],
    pose: Pose,
    contacts: Vec<Touch>,
    slips: u32,
    ambiguous: bool,
}

impl Reference {
    /// The equilibrium reached from `start` (x, y, m; theta, rad) with the hand held at `first_hand` (x, y, m; phi, rad).
    pub fn new(scene: Scene, start: [f64; 3], first_hand: [f64; 3]) -> Self {
        let pose = Pose { position: [start[0], start[1]], angle: start[2] };
        let size = scene.size();
        let contacts: Vec<Touch> = scene.touches().filter(|&touch| scene.gap(&pose, touch) <= TOUCHING * size).collect();
        let contacts: Vec<_> = contacts.iter().map(|touch| (touch.vertex, touch.surface)).collect();
        let mut reference = Self::resumed(scene, start, &contacts, first_hand);
        reference.relax(first_hand);
        reference
    }

    /// A body that is in equilibrium at `pose` with these contacts (vertex, surface).
    pub fn resumed(scene: Scene, pose: [f64; 3], contacts: &[(usize, usize)], hand: [f64; 3]) -> Self {
        let size = scene.size();
        let pose = Pose { position: [pose[0], pose[1]], angle: pose[2] };
        let mut contacts: Vec<Touch> = contacts.iter().map(|&(vertex, surface)| Touch { vertex, surface }).collect();
        contacts.sort_by_key(|touch| (touch.vertex, touch.surface));
        let mut reference = Self { scene, size, hand, pose, contacts, slips: 0, ambiguous: false };
        reference.pose = reference.onto(pose, &reference.contacts);
        reference
    }

    /// Moves the hand straight to `hand` (x, y, m; phi, rad) in `substeps` parts.
    pub fn step(&mut self, hand: [f64; 3], substeps: usize) {
        self.slips = 0;
        self.ambiguous = false;
        let from = self.hand;
        for k in 1..=substeps {
            self.advance(blend(from, hand, k as f64 / substeps as f64));
        }
    }

    /// Position, m, and unwrapped orientation, rad, of the body frame.
    pub fn pose(&self) -> [f64; 3] {
        [self.pose.position[0], self.pose.position[1], self.pose.angle]
    }

    /// Name of the contact state.
    pub fn state(&self) -> &'static str {
        match *self.contacts.as_slice() {
            [] => "non-contact",
            [_] => "single-vertex",
            [a, b] if a.vertex == b.vertex => "corner",
            [a, b] if a.surface == b.surface => "edge",
            [_, _] => "two-vertex",
            _ => "locked",
        }
    }

    /// The contacts, by vertex, with their forces; of three or more, one possible set of forces.
    pub fn contacts(&self) -> Vec<ContactForce> {
        self.contact_forces()
    }

    /// Slips that ended at dynamic friction in the last frame.
    pub fn slips(&self) -> u32 {
        self.slips
    }

    /// Whether no motion fitted somewhere in the last frame, so that the body was left where it was.
    pub fn ambiguous(&self) -> bool {
        self.ambiguous
    }

    /// Follows the hand to `to`, from event to event.
    fn advance(&mut self, to: [f64; 3]) {
        let from = self.hand;
        let (mut done, mut hurried) = (0.0, 0);
        while hurried < 3 {
            if let Some(pose) = self.at_rest(to) {
                self.pose = pose;
                self.hand = to;
                return;
            }
            let (before, after) = walk::bisect(done, 1.0, |part| self.at_rest(blend(from, to, part)).is_none());
            if let Some(pose) = self.at_rest(blend(from, to, before)) {
                self.pose = pose;
            }
            self.relax(blend(from, to, after));
            hurried = if after - done < SOON { hurried + 1 } else { 0 };
            done = after;
        }
        self.relax(to);
        self.hand = to;
    }

    /// The pose for this hand with the contacts as they are; `None` if something happens before.
    fn at_rest(&self, hand: [f64; 3]) -> Option<Pose> {
        let pose = match *self.contacts.as_slice() {
            [] => {
                let pose = self.free_pose(hand);
                return (!self.enters(&pose, CLEARANCE)).then_some(pose);
            }
            [first, ref rest @ ..] if rest.iter().all(|touch| touch.vertex == first.vertex) => {
                let (pose, end) = self.turn(&self.pose, first.vertex, hand, (SNAP, true));
                (end == End::Rest).then_some(pose)?
            }
            _ => self.pose,
        };
        self.admissible(&pose, &self.contacts, hand).then_some(pose)
    }
}

/// The hand pose at a part of the way.
fn blend(from: [f64; 3], to: [f64; 3], part: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| from[k] + part * (to[k] - from[k]))
}
