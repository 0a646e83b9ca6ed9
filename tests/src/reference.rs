//! A slow second solution of the statics, for checking the fast one: from hand poses to body poses and contact forces, in plain SI `f64`.
//!
//! The hand moves along the straight line between two frames in sub-steps. In each sub-step the contacts keep sticking or sliding,
//! and the pose follows by descending along the unbalanced wrench in steps of 1e-3 rad or body sizes; when something happens, its
//! instant is bisected. If the body is then out of balance, it moves under the frozen hand in steps of 1e-3 until forces hold it,
//! which are found by trying every subset of friction-cone edges. The reference shares no code and no closed form with the solver.
//!
//! The law: a slide is a motion with the hand; a slip, under the frozen hand, needs *stiction*. Stiction is one bit of the body: with
//! it, friction at rest is mu_s; without it, mu_d. One vertex or an edge gets the bit when N reaches N* = k_h memory / (mu_s - mu_d),
//! and keeps it after a slip that ends at N* or more; two contacts on two surfaces get or keep it when the longer of their displacements
//! in a slip is at least a memory length. Without the bit, contacts that yield slide. A touch from the air clears the bit.
//!
//! Rules where the law leaves a choice:
//! * A foot is compared with the memory length of its own surface; a memory below 2^-19 body sizes counts as that.
//! * A hand that rests, or turns back, ends a slide and clears the bit.
//! * If contacts yield without the bit, but the hand does not drive the slide, or no balance exists nearby, the result is a slip.
//! * A slide whose balance folds sticks, without the bit, if dynamic friction holds the foot where it is; otherwise it is a slip.
//! * If one vertex no longer presses, but the free body would not leave, the rates of the forces decide as at a touch.
//! * A contact that no longer presses in a joint slide opens if its gap then stays open; otherwise both stick, without the bit.
//! * Sliding contacts that close a third one, or a corner, stick without the bit.
//! * If the free body opens the gaps of several contacts, they lift before they yield.
//! * A vertex that closes another contact in mid-slip slips on with it if dynamic friction does not hold both; the length of that
//!   slip counts from there. If dynamic friction holds both, the slip ends there, and on two surfaces both stick.
//! * Where two surfaces do not turn the body, a joint slide is braked by equal drag at both contacts instead of by a couple.
//! * Of the driven directions of a joint slip, one that presses on both contacts comes first, then the most strongly driven one.
//!   The slip keeps its direction if a contact no longer presses but cannot open.
//! * If the balance of a joint slip pulls on a contact, that contact opens, provided that the other one holds or slips in either
//!   direction; otherwise rest is tested again.
//! * A slip counts if it ends at dynamic friction in contact; contacts that open before anything has moved make no slip.
//! * Corners and sets of three or more contacts get or lose the bit only through the contacts that remain of them.
//!
//! Among obstacles, a contact is a vertex of the body on a side of an obstacle, or a corner of an obstacle on a side of the body. Only four
//! properties of it are used: its point, its normal (which may turn with the body), its gap, and whether it is on its side. The rules:
//! * Body and obstacle are apart by the largest gap along an axis. A point does not see the other side of a thin wall, nor a rod the other
//!   side of a pin, before it has gone round an end.
//! * A sliding or slipping contact that leaves its side is replaced by the pair at the same place, of this or another obstacle, whose
//!   normal comes next as the normal turns towards the slide. Then a slip follows under the frozen hand in the same direction; it is
//!   counted and remembered as any other. If nothing presses along the new normal, the body is free; of two contacts, the new one opens.
//! * A flat contact is represented by two contacts, the outermost ones in a line within 1e-6 rad, on the same obstacle or not. If one of
//!   them leaves its side, the ends are determined again and the motion goes on; while the contact sticks, nothing leaves a side.
//! * Friction of a flat contact between different coefficients is shared in proportion to mu N; the contact has stiction if the sum of N /
//!   N* is 1 or more.
//! * Two contacts of one obstacle closer than 2^-19 body sizes are one: the new one, because the body continues to turn about it. Of
//!   several that close at one place, the one whose gap was largest before stays; then a vertex, then the lowest index.
//! * Coplanar sides of equal friction are one side, named after the first of them. If corners of two obstacles coincide, only the first
//!   can be touched; a corner elsewhere on or in another obstacle or a half-plane cannot be touched.
//! * A body that is let go moves straight, in holding point and angle, until something obstructs
//!   it. If the contact that it has just left blocks it immediately, the holding point moves
//!   first and the body turns afterwards. (From half-planes alone it is put where it is free.)
//! * Several contacts lift before they yield only if the path to the free pose opens all of them simultaneously.
//!
//! Where it is approximate:
//! * Two events that cancel each other within one sub-step, one slide step or (a grazing touch) one turn of 1e-3 rad are not noticed.
//! * A snap is noticed as a turn of more than 0.03 rad; a smaller one goes unnoticed, with the same end.
//! * A body can jump over an obstacle in a sub-step in which the hand moves farther than the thickness of both together, and in a
//!   turn of 1e-3 rad.
//! * Rates are differences over 3e-5 body sizes of the hand's path, 1e-6 after a touch.
//! * When two contacts slip, equal viscous drag at both balances the hand; their normal forces are right at the end of the slip,
//!   but the instant at which one of them opens depends on this choice.
//! * If several motions of three contacts fit the load, one that turns about a sticking contact comes first, then the slip with the
//!   strongest drive.

mod clear;
mod cone;
mod contact;
mod ends;
mod events;
mod follow;
mod forces;
mod free;
mod meet;
mod memory;
mod mode;
mod relax;
mod scene;
mod search;
mod slip;
mod statics;
mod walk;
mod world;

pub use contact::Touch;
pub use scene::{Obstacle, Scene, Surface};

use clear::Axis;
use scene::Pose;

/// A vertex may be this far inside a surface without being noticed, in body sizes.
const CLEARANCE: f64 = 1e-12;
/// A contact is still on its side if it is past the end by less than this, in body sizes: more than the rounding error of the
/// position at which another pair replaces it.
const BESIDE: f64 = 1e-11;
/// Vertices this close to a surface touch it from the start, in body sizes.
const TOUCHING: f64 = 1e-5;
/// Largest turn between two evaluations of the moment, rad.
const TURN: f64 = 1e-3;

/// The force of one contact on the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactForce {
    /// The pair of touching features.
    pub touch: Touch,
    /// Force along the contact's normal, N.
    pub normal: f64,
    /// Force along the tangent (n_y, -n_x), N.
    pub friction: f64,
    /// The direction along the tangent in which the contact slides with the hand, 1 or -1; 0 while it sticks.
    pub slides: i8,
}

/// A contact of a body that is placed where another run has left it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foot {
    /// The pair of touching features.
    pub touch: Touch,
    /// The direction along the tangent in which the contact slides with the hand, 1 or -1; 0 while it sticks.
    pub slides: i8,
}

/// The body under a moving hand.
#[derive(Clone, Debug)]
pub struct Reference {
    scene: Scene,
    size: f64,
    hand: [f64; 3],
    pose: Pose,
    /// The pose from which the current motion began.
    before: Pose,
    contacts: Vec<Touch>,
    /// For each contact the direction of its slide along the tangent, 1 or -1; `None` while they stick.
    slide: Option<Vec<f64>>,
    stiction: bool,
    /// For each obstacle, the axis along which the body is clear of it.
    seen: Vec<Option<Axis>>,
    slips: u32,
    events: u32,
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
        let mut reference = Self::resumed(scene, start, (&[], false), first_hand);
        reference.contacts = reference.touching(&pose, TOUCHING);
        reference.reduce(0);
        reference.contacts.sort();
        reference.pose = reference.onto(pose, &reference.contacts);
        reference.relax(first_hand);
        reference
    }

    /// A body that is in equilibrium at `pose` with these contacts, with or without the stiction bit.
    pub fn resumed(
        scene: Scene,
        pose: [f64; 3],
        (contacts, stiction): (&[Foot], bool),
        hand: [f64; 3],
    ) -> Self {
        let size = scene.size();
        let pose = Pose {
            position: [pose[0], pose[1]],
            angle: pose[2],
        };
        let mut feet = contacts.to_vec();
        feet.sort_by_key(|foot| foot.touch);
        let slides = !feet.is_empty() && feet.iter().all(|foot| foot.slides != 0);
        let obstacles = scene.obstacles.len();
        let mut reference = Self {
            scene,
            size,
            hand,
            pose,
            before: pose,
            contacts: feet.iter().map(|foot| foot.touch).collect(),
            slide: slides.then(|| feet.iter().map(|foot| f64::from(foot.slides)).collect()),
            stiction,
            seen: vec![None; obstacles],
            slips: 0,
            events: 0,
            skipped: false,
            ambiguous: false,
        };
        reference.pose = reference.onto(pose, &reference.contacts);
        reference.look();
        reference
    }

    /// Moves the hand straight to `hand` (x, y, m; phi, rad) in `substeps` parts.
    pub fn step(&mut self, hand: [f64; 3], substeps: usize) {
        self.slips = 0;
        self.events = 0;
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
            [_, _] if self.corner() => "corner",
            [_, _] if self.flat() => "edge",
            [_, _] => "two-vertex",
            _ => "locked",
        }
    }

    /// The contacts with their forces; with three or more contacts, one possible set of forces.
    pub fn contacts(&self) -> Vec<ContactForce> {
        self.contact_forces()
    }

    /// Whether the contacts have stiction: static friction while they stick, and slips where they yield.
    pub fn stiction(&self) -> bool {
        self.stiction
    }

    /// Events in the last frame.
    pub fn events(&self) -> u32 {
        self.events
    }

    /// Slips that ended at dynamic friction in the last frame; a slide with the hand does not count.
    pub fn slips(&self) -> u32 {
        self.slips
    }

    /// Whether part of the last frame contained more events than are followed, so that the body jumped to the end of that part.
    pub fn skipped(&self) -> bool {
        self.skipped
    }

    /// Whether no motion fitted somewhere in the last frame, so that the body stayed where it was for the rest of the frame.
    pub fn ambiguous(&self) -> bool {
        self.ambiguous
    }
}

/// The hand pose at a fraction of the path.
fn blend(from: [f64; 3], to: [f64; 3], part: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| from[k] + part * (to[k] - from[k]))
}
