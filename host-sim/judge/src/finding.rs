//! How far a frame is from a law, in units of what the law allows.

/// The names of all laws.
pub mod law {
    /// No number is infinite or missing; what else is wrong with such a frame is not looked for.
    pub const FINITE: &str = "every number is finite";
    /// No contact is of a vertex, side or corner that the scene does not have; what else is wrong with such a frame is not looked for.
    pub const EXISTS: &str = "a contact is of what there is";
    /// A frame is later than the one before.
    pub const TIME: &str = "times increase";
    /// `state` says how many vertices are on how many surfaces; of contacts with obstacles, how many there are, and whether two are in
    /// one line.
    pub const NAME: &str = "the state is named after its contacts";
    /// No contact is there twice, and no two with one obstacle at one place.
    pub const ONCE: &str = "a vertex touches a surface once";
    /// n·x >= b for every vertex, and some axis along which the body and an obstacle do not overlap.
    pub const OUTSIDE: &str = "no vertex is inside a surface";
    /// n·x = b for the vertex of a contact, or the corner of an obstacle on a side of the body.
    pub const ON_SURFACE: &str = "a contact is on its surface";
    /// `point` is where the pose puts the vertex, or where the corner of the obstacle is.
    pub const AT_VERTEX: &str = "a contact is at its vertex";
    /// The contact with an obstacle is between the ends of its side.
    pub const ON_SIDE: &str = "a contact is between the ends of its side";
    /// The sides next to the vertex or corner are not behind the line that it touches: n lies between their normals.
    pub const FACES: &str = "a contact faces what it touches";
    /// `direction`, where it is told, is n.
    pub const DIRECTION: &str = "a contact's direction is its normal";
    /// What touches an obstacle in two frames running is a contact.
    pub const REPORTED: &str = "what touches an obstacle is a contact";
    /// Without an event, contacts with obstacles stay, or a slide passes them on at an end of a side.
    pub const PASSED_ON: &str = "contacts change as reported, or at an end";
    /// A body whose way between two frames is known does not cross a side on it.
    pub const PASSES: &str = "nothing passes through an obstacle";
    /// Hand, weight and reactions add up to no force.
    pub const FORCES: &str = "forces balance";
    /// Hand, weight and reactions add up to no moment.
    pub const MOMENTS: &str = "moments balance";
    /// F = k_h (p_h - G), M = k_theta (phi - theta).
    pub const WRENCH: &str = "the wrench is that of the springs";
    /// |T| <= mu_s N.
    pub const CONE: &str = "friction is in its cone";
    /// N >= 0.
    pub const PUSH: &str = "surfaces do not pull";
    /// No wrench where `held` is false.
    pub const IDLE: &str = "a hand that does not hold gives no wrench";
    /// A body that is not held, whose hand is out of range or not finite, or that no motion can balance, is where it was.
    pub const RESTS: &str = "a body that nothing moves stays";
    /// `held` changes with the events `grasp` and `release`.
    pub const HOLD: &str = "grasp and release are reported";
    /// A contact is where it came to, as long as nothing happens.
    pub const STICKS: &str = "a contact that sticks stays";
    /// The hand is that of the path that it is said to have followed; of traces whose path is given.
    pub const HAND: &str = "the hand is that of its path";
    /// Contacts come and go with the events that say so, and with no other one but at an end of a side.
    pub const COME_AND_GO: &str = "contacts come and go as reported";
    /// What a status excuses is there to be seen: a frame that repeats the one before, so many events, a part of the way that is left, a
    /// load that no reactions bear and no motion follows.
    pub const STATUS: &str = "a status is borne out by its frame";
    /// `slips` and `events` tell of the same slips.
    pub const SLIPS: &str = "slips are as many as reported";
    /// A body to which something has happened is not where it was.
    pub const MOVES: &str = "what happens moves the body";
    /// The angle of a body that turns about a contact, or about the hand, goes on along its branch but for a `snap`, which is told where
    /// the branch folds.
    pub const SNAPS: &str = "a balance snaps where it folds";
    /// The laws that ask for all events in their order.
    pub const OF_EVENTS: &[&str] = &[COME_AND_GO, SLIPS, MOVES, SNAPS, STATUS, SLIDE_TOLD];
    /// A slip begins where the contacts at their old places can bear the load no longer.
    pub const SLIP_BEGINS: &str = "a slip begins where static friction gives way";
    /// There, at their new places, |T| = mu_d N against the motion.
    pub const SLIP_ENDS: &str = "a slip ends at mu_d N";
    /// After several slips: somewhere on the hand's way of this frame |T| = mu_d N at the places where the contacts are now.
    pub const SLIP_LAST: &str = "the last slip of a frame ends at mu_d N";
    /// T = -s mu_d N of a contact that slides along s t.
    pub const SLIDES: &str = "a slide is at mu_d N against its motion";
    /// The contacts that slide do so with the signs of one motion of the body, and all of them do.
    pub const ONE_MOTION: &str = "contacts slide as one motion can";
    /// A contact that slides along s t, as long as nothing else happens, does not go back.
    pub const FORWARD: &str = "a slide goes forward";
    /// A slide begins and ends with the events `slide` and `stop`, or with another one that explains it.
    pub const SLIDE_TOLD: &str = "slide and stop are reported";
    /// A slide sticks where N rises to N* = k_h D_c / (mu_s - mu_d).
    pub const SLIDE_STOPS: &str = "a slide stops where N reaches N*";
    /// A body whose contacts bear the load at both ends of the hand's way, and so all along it, stays where it is.
    pub const HOLDS: &str = "what the contacts bear is not let go";
    /// A body is `jammed` where the load needs reactions beyond 64 k_h L, and only there.
    pub const JAMMED: &str = "jammed is what 64 k_h L cannot hold";
    /// Nowhere between the two places |T| <= mu_d N, nor is balance lost.
    pub const SLIP_FIRST: &str = "a slip ends at the first place it can";
}

/// One law on one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The law.
    pub law: &'static str,
    /// How far the frame is from it, relative to its scale; 0 where it holds exactly.
    pub residual: f64,
    /// The residual up to which it holds.
    pub bound: f64,
}

impl Finding {
    pub(crate) fn new(law: &'static str, residual: f64, bound: f64) -> Self {
        Self {
            law,
            residual,
            bound: bound.max(f64::MIN_POSITIVE),
        }
    }

    /// A law that holds or does not.
    pub(crate) fn whether(law: &'static str, holds: bool) -> Self {
        Self::new(law, if holds { 0.0 } else { f64::INFINITY }, 1.0)
    }

    /// The residual in units of its bound; infinite where it is not a number.
    pub fn severity(&self) -> f64 {
        let severity = self.residual / self.bound;
        if severity.is_nan() {
            f64::INFINITY
        } else {
            severity
        }
    }

    /// The law holds.
    pub fn holds(&self) -> bool {
        self.severity() <= 1.0
    }
}

/// What is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Forces and reactions, relative to the largest force in the frame, moments to that force × L; none finer than 64
    /// roundings of coordinate × stiffness, moments than these times the lever of the hand.
    pub residual: f64,
    /// Gaps and places, relative to L; none finer than 64 roundings of the farthest coordinate. Contacts that close together may be
    /// apart by 1e-10 L, in single numbers by 2^-19 L (STATICS 7).
    pub gap: f64,
    /// They are relative to the farthest coordinate, or L × theta, where that is more than L.
    pub far: bool,
    /// Begin and end of slips: forces, relative to the largest force in the frame and the one before, none finer than 64
    /// roundings of coordinate × stiffness. Tighter than the balance, as a slip that is a part of its length too short
    /// leaves only that part of (mu_s - mu_d) N. Over the scenes of `stiction trade` slips of the
    /// solver that are lawful stay below a tenth of it, or below the 64 roundings.
    pub slip: f64,
    /// Places of contacts that stick, relative to the farthest coordinate, and half of what springs may be off, relative to coordinate ×
    /// stiffness: a few roundings of the printed numbers.
    pub exact: f64,
    /// Half the spacing of the trace's numbers near 1: the error of one rounding.
    pub rounding: f64,
}

impl Bounds {
    /// Of a trace of f64 values.
    pub const DOUBLE: Self = Self {
        residual: 1e-9,
        gap: 1e-9,
        far: true,
        slip: 1e-9,
        exact: 4.0 * f64::EPSILON,
        rounding: f64::EPSILON / 2.0,
    };
    /// Of a trace of f32 values, from a solver in f32 or fixed point.
    pub const SINGLE: Self = Self {
        residual: 5e-4,
        gap: 4e-6,
        far: true,
        slip: 2e-5,
        exact: 4.0 * f32::EPSILON as f64,
        rounding: f32::EPSILON as f64 / 2.0,
    };
}
