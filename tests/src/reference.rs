//! A slow second solution of the statics, for checking the fast one: hand poses to body poses and contact forces, plain SI `f64`.
//!
//! The hand moves along the straight line between two frames in sub-steps. In each the contacts stick or slide as they
//! do, followed by walking down what does not balance in steps of 1e-3 rad or body sizes; when something happens, the instant is
//! bisected. What is out of balance there moves under the frozen hand in steps of 1e-3 until forces found by trying every subset of
//! friction-cone edges hold it. It shares no code and no closed form with the solver.
//!
//! The law: a slide is a motion with the hand; a slip, under the frozen hand, needs *stiction*. That is one bit of the body: with
//! it friction at rest is mu_s, without it mu_d. One vertex or an edge gets it where N reaches N* = k_h memory / (mu_s - mu_d), and
//! keeps it after a slip that ends at N* or more; two contacts on two surfaces get or keep it where the longer of their ways in a
//! slip is a memory length. Without it, what yields slides. A touch from free flight clears it.
//!
//! Rules where the law leaves a choice:
//! * A foot is compared with the memory length of its own surface; a memory below 2^-19 body sizes counts as that.
//! * A hand that rests ends a slide, and clears the bit, as one that turns back does.
//! * A yield without the bit whose slide the hand does not drive, or that has no balance nearby, is a slip.
//! * A slide whose balance folds sticks, without the bit, if dynamic friction holds the foot where it is; otherwise it is a slip.
//! * Where one vertex no longer presses, but the free body would not leave, the rates of the forces decide as at a touch.
//! * A contact that no longer presses in a joint slide opens if that leaves its gap open; otherwise both stick, without the bit.
//! * Sliding contacts that close a third one, or a corner, stick without the bit.
//! * Several contacts all of whose gaps the free body opens lift, before they yield.
//! * A vertex that closes another contact in mid-slip slips on with it if dynamic friction does not hold both; the length of that
//!   slip counts from there. If it does, that is the end of a slip, and on two surfaces both stick.
//! * Where two surfaces do not turn the body, what brakes a joint slide is equal drag at both contacts instead of a couple.
//! * In a joint slip, of the driven directions one that presses on both contacts comes first, then the one driven most. It keeps
//!   its direction where a contact no longer presses but cannot open.
//! * A joint slip whose balance pulls on a contact opens it, if the other one holds or slips either way; otherwise rest is
//!   tested anew.
//! * A slip counts where it ends at dynamic friction in contact; an opening before anything has moved is none.
//! * Corners and three contacts or more get or lose the bit only through what remains of them.
//!
//! Among obstacles a contact is a vertex of the body on a side of an obstacle or a corner of an obstacle on a side of the body. All that
//! is looked at is its point, its normal, which may turn with the body, its gap, and whether it is on its side. The rules:
//! * Body and obstacle are apart by the largest gap along an axis. A point does not see a thin wall, nor a rod a pin, from the other
//!   side before it has gone round an end of it.
//! * A sliding or slipping contact that leaves its side is passed on to the pair at the same place, of this or another obstacle, whose
//!   normal comes next as the normal turns towards the slide. What follows is a slip under the frozen hand in the same direction, counted
//!   and remembered as any other. Where the new normal is not pressed the body is free; of two contacts, the new one opens.
//! * A flat contact is two contacts, of the same obstacle or not, in one line within 1e-6 rad: the outermost. Where one of them leaves its
//!   side the ends are looked for anew and the motion goes on; while it sticks nothing leaves a side.
//! * Friction of a flat contact between different coefficients is shared as mu N; it has stiction where the sum of N / N* is 1.
//! * Two contacts of one obstacle closer than 2^-19 body sizes are one: the new one, as the body turns on about it. Of several
//!   that close at one place that stays whose gap was the larger before; then a vertex, then the lower index.
//! * Coplanar sides of equal friction are one side, by the name of the first of them. Where corners of two obstacles meet, only the
//!   first can be touched; one that lies elsewhere on or in an obstacle or a half-plane cannot.
//! * A body that is let go moves straight, holding point and angle, until something is in its way. Where what it was let go from
//!   blocks it at once, the holding point goes first and the body turns after. (From half-planes alone it is put where it is free.)
//! * Several contacts lift before they yield only if the way to the free pose opens all of them at once.
//!
//! Where it is approximate:
//! * Two events that undo each other within one sub-step, one slide step or (a grazing touch) one turn of 1e-3 rad are not seen.
//! * A snap is noticed as a turn of more than 0.03 rad; a smaller one happens unseen, with the same end.
//! * A body can jump over an obstacle in a sub-step in which the hand goes farther than both are thick, and in a turn of 1e-3 rad.
//! * Rates are differences over 3e-5 body sizes of the hand's way, 1e-6 after a touch.
//! * Where two contacts slip, the hand is balanced by equal viscous drag at both; their normal forces are right at the end of
//!   the slip, but the instant at which one of them opens depends on this choice.
//! * Of several motions of three contacts that fit, the one that turns about a sticking contact comes first, then the slip with the
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

/// A vertex may be this far inside a surface unseen, in body sizes.
const CLEARANCE: f64 = 1e-12;
/// A contact is on its side as long as it is beyond the end by less than this, in body sizes: more than the rounding of the place at
/// which it is passed on.
const BESIDE: f64 = 1e-11;
/// Vertices this close to a surface touch it from the beginning, in body sizes.
const TOUCHING: f64 = 1e-5;
/// Largest turn in one look at the moment, rad.
const TURN: f64 = 1e-3;

/// The force of one contact on the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactForce {
    /// What touches what.
    pub touch: Touch,
    /// Force along the contact's normal, N.
    pub normal: f64,
    /// Force along the tangent (n_y, -n_x), N.
    pub friction: f64,
    /// The direction along the tangent in which the contact slides with the hand, 1 or -1; 0 while it sticks.
    pub slides: i8,
}

/// A contact of a body that is put where another run has left it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foot {
    /// What touches what.
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
    /// The pose from which the present motion began.
    before: Pose,
    contacts: Vec<Touch>,
    /// For each contact the direction of its slide along the tangent, 1 or -1; `None` while they stick.
    slide: Option<Vec<f64>>,
    stiction: bool,
    /// For each obstacle the axis along which the body is clear of it.
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

    /// A body that is in equilibrium at `pose` with these contacts, with or without the bit of stiction.
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

    /// The contacts with their forces; of three or more, one possible set of forces.
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

    /// Slips that ended at dynamic friction in the last frame; a slide with the hand is none.
    pub fn slips(&self) -> u32 {
        self.slips
    }

    /// Whether more happened in a part of the last frame than is followed, so that the body jumped to its end.
    pub fn skipped(&self) -> bool {
        self.skipped
    }

    /// Whether no motion fitted somewhere in the last frame, so that the body was left where it was for the rest of it.
    pub fn ambiguous(&self) -> bool {
        self.ambiguous
    }
}

/// The hand pose at a part of the way.
fn blend(from: [f64; 3], to: [f64; 3], part: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| from[k] + part * (to[k] - from[k]))
}
