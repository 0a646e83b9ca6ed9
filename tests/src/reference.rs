//! A slow second solution of the statics, for checking the fast one: hand poses to body poses and contact forces, plain SI `f64`.
//!
//! The hand moves along the straight line between two frames in sub-steps. In each the body rests, followed by walking down the
//! moment in steps of 1e-3 rad; when it cannot, the instant is bisected, the hand frozen there, and the body moves in steps of
//! 1e-3 body sizes or rad until forces found by trying every subset of friction-cone edges hold it. It shares no code and no
//! closed form with the solver.
//!
//! Where it is approximate:
//! * Two events that undo each other within one sub-step, one slide step or (a grazing touch) one turn of 1e-3 rad are not seen.
//! * A snap is noticed as a turn of more than 0.03 rad; a smaller one happens unseen, with the same end.
//! * Events that follow each other ever faster (continuous sliding, the slips of a body being lifted or set down obliquely) are
//!   cut short: the body relaxes at the end of the sub-step or where its contacts change. The number of slips is then not the
//!   true one, and where static friction is larger than dynamic, the phase of the slips is open: see `skipped`.
//! * Where two contacts slide, the hand is balanced by equal viscous drag at both; their normal forces are right at the end of
//!   the slide, but the instant at which one of them opens depends on this choice.
//! * Of several motions that fit the one that turns about a sticking contact comes first, then the slide with the strongest drive.

mod cone;
mod free;
mod relax;
mod scene;
mod search;
mod statics;
mod walk;

pub use scene::{Scene, Surface};

use scene::{Pose, Touch};
use search::bisect;
use walk::{End, SNAP};

/// A vertex may be this far inside a surface unseen, in body sizes.
const CLEARANCE: f64 = 1e-12;
/// Vertices this close to a surface touch it from the beginning, in body sizes.
const TOUCHING: f64 = 1e-5;
/// Largest turn in one look at the moment, rad.
const TURN: f64 = 1e-3;
/// An event that follows another sooner than this, in sub-steps, belongs to a sequence without end.
const SOON: f64 = 1e-7;
/// The same where static friction equals dynamic friction, so that a slip leaves the body about to slip again.
const SOON_SLIDING: f64 = 1e-3;
/// Events in a sub-step.
const EVENTS: u32 = 100;

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
    skipped: bool,
    ambiguous: bool,
}

impl Reference {
    /// The equilibrium reached from `start` (x, y, m; theta, rad) with the hand held at `first_hand` (x, y, m; phi, rad).
    pub fn new(scene: Scene, start: [f64; 3], first_hand: [f64; 3]) -> Self {
        let pose = Pose {
            position: [start[0], start[1]],
            angle: start[2],
        };
        let size = scene.size();
        let contacts: Vec<_> = scene
            .touches()
            .filter(|&touch| scene.gap(&pose, touch) <= TOUCHING * size)
            .map(|touch| (touch.vertex, touch.surface))
            .collect();
        let mut reference = Self::resumed(scene, start, &contacts, first_hand);
        reference.relax(first_hand);
        reference
    }

    /// A body that is in equilibrium at `pose` with these contacts (vertex, surface).
    pub fn resumed(
        scene: Scene,
        pose: [f64; 3],
        contacts: &[(usize, usize)],
        hand: [f64; 3],
    ) -> Self {
        let size = scene.size();
        let pose = Pose {
            position: [pose[0], pose[1]],
            angle: pose[2],
        };
        let mut contacts: Vec<Touch> = contacts
            .iter()
            .map(|&(vertex, surface)| Touch { vertex, surface })
            .collect();
        contacts.sort_by_key(|touch| (touch.vertex, touch.surface));
        let mut reference = Self {
            scene,
            size,
            hand,
            pose,
            contacts,
            slips: 0,
            skipped: false,
            ambiguous: false,
        };
        reference.pose = reference.onto(pose, &reference.contacts);
        reference
    }

    /// Moves the hand straight to `hand` (x, y, m; phi, rad) in `substeps` parts.
    pub fn step(&mut self, hand: [f64; 3], substeps: usize) {
        self.slips = 0;
        self.skipped = false;
        self.ambiguous = false;
        let from = self.hand;
        for k in 1..=substeps {
            self.advance(blend(from, hand, k as f64 / substeps as f64));
            if self.ambiguous {
                self.hand = hand;
                break;
            }
        }
    }

    /// Position, m, and unwrapped orientation, rad, of the body frame.
    pub fn pose(&self) -> [f64; 3] {
        [
            self.pose.position[0],
            self.pose.position[1],
            self.pose.angle,
        ]
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

    /// Whether slips of the last frame followed each other without end, so that where the last one stopped is not known.
    pub fn skipped(&self) -> bool {
        self.skipped
    }

    /// Whether no motion fitted somewhere in the last frame, so that the body was left where it was for the rest of it.
    pub fn ambiguous(&self) -> bool {
        self.ambiguous
    }

    /// Follows the hand to `to`, from event to event.
    fn advance(&mut self, to: [f64; 3]) {
        let from = self.hand;
        let (mut done, mut hurried) = (0.0, 0);
        for _ in 0..EVENTS {
            let after = if hurried < 3 {
                if let Some(pose) = self.at_rest(to) {
                    self.pose = pose;
                    self.hand = to;
                    return;
                }
                let (before, after) = bisect(done, 1.0, |part| {
                    self.at_rest(blend(from, to, part)).is_none()
                });
                if let Some(pose) = self.at_rest(blend(from, to, before)) {
                    self.pose = pose;
                }
                after
            } else {
                let relaxed = self.relaxed(to);
                if relaxed.follows(self) {
                    *self = relaxed;
                    break;
                }
                let changes = |part| !self.relaxed(blend(from, to, part)).follows(self);
                let (before, after) = bisect(done, 1.0, changes);
                *self = self.relaxed(blend(from, to, before));
                after
            };
            self.relax(blend(from, to, after));
            let slides = self.slides();
            let soon = if slides { SOON_SLIDING } else { SOON };
            hurried = if after - done < soon { hurried + 1 } else { 0 };
            self.skipped |= !slides && hurried > 0 && done > 0.0;
            done = after;
            if self.ambiguous {
                break;
            }
        }
        if !self.ambiguous {
            self.relax(to);
        }
        self.hand = to;
    }

    /// The body relaxed under a frozen hand.
    fn relaxed(&self, hand: [f64; 3]) -> Self {
        let mut relaxed = self.clone();
        relaxed.relax(hand);
        relaxed
    }

    /// Whether this is where the body comes from `before` without a change of contacts.
    fn follows(&self, before: &Self) -> bool {
        self.contacts == before.contacts && !self.ambiguous
    }

    /// Whether a contact slides continuously.
    fn slides(&self) -> bool {
        let surfaces = self
            .contacts
            .iter()
            .map(|touch| &self.scene.surfaces[touch.surface]);
        surfaces
            .into_iter()
            .any(|surface| surface.mu_s <= surface.mu_d * (1.0 + 1e-9))
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
