//! How far a frame is from satisfying a law, in units of the tolerance.

/// The names of all laws.
pub mod law {
    /// No number is infinite or missing; if one is, the frame is not judged further.
    pub const FINITE: &str = "every number is finite";
    /// No contact refers to a vertex, side or corner that the scene does not have; if one does, the frame is not judged further.
    pub const EXISTS: &str = "a contact is of what there is";
    /// A frame is later than the previous one.
    pub const TIME: &str = "times increase";
    /// `state` follows from how many vertices are on how many surfaces; for contacts with obstacles, from their number, and from
    /// whether two are on one line.
    pub const NAME: &str = "the state is named after its contacts";
    /// No contact is listed twice, and no two contacts with one obstacle are at the same place.
    pub const ONCE: &str = "a vertex touches a surface once";
    /// n·x >= b for every vertex, and along some axis body and obstacle do not overlap.
    pub const OUTSIDE: &str = "no vertex is inside a surface";
    /// n·x = b for the vertex of a contact, or the corner of an obstacle on a side of the body.
    pub const ON_SURFACE: &str = "a contact is on its surface";
    /// `point` is where the pose places the vertex, or where the corner of the obstacle is.
    pub const AT_VERTEX: &str = "a contact is at its vertex";
    /// The contact with an obstacle is between the ends of its side.
    pub const ON_SIDE: &str = "a contact is between the ends of its side";
    /// The sides next to the vertex or corner are not behind the line that it touches: n lies between their normals.
    pub const FACES: &str = "a contact faces what it touches";
    /// `direction`, if reported, is n.
    pub const DIRECTION: &str = "a contact's direction is its normal";
    /// Features that touch an obstacle in two consecutive frames are reported as a contact.
    pub const REPORTED: &str = "what touches an obstacle is a contact";
    /// Without an event, contacts with obstacles stay, or a slide replaces them at an end of a side.
    pub const PASSED_ON: &str = "contacts change as reported, or at an end";
    /// A body whose path between two frames is known does not cross a side on that path.
    pub const PASSES: &str = "nothing passes through an obstacle";
    /// The forces of hand, weight and reactions sum to zero.
    pub const FORCES: &str = "forces balance";
    /// The moments of hand, weight and reactions sum to zero.
    pub const MOMENTS: &str = "moments balance";
    /// F = k_h (p_h - G), M = k_theta (phi - theta).
    pub const WRENCH: &str = "the wrench is that of the springs";
    /// |T| <= mu_s N.
    pub const CONE: &str = "friction is in its cone";
    /// N >= 0.
    pub const PUSH: &str = "surfaces do not pull";
    /// The wrench is zero if `held` is false.
    pub const IDLE: &str = "a hand that does not hold gives no wrench";
    /// A body that is not held, whose hand is out of range or not finite, or that no motion can balance, stays where it was.
    pub const RESTS: &str = "a body that nothing moves stays";
    /// `held` changes with the events `grasp` and `release`.
    pub const HOLD: &str = "grasp and release are reported";
    /// A contact stays where it stopped as long as nothing happens.
    pub const STICKS: &str = "a contact that sticks stays";
    /// The hand is on the path that it is reported to have followed; for traces whose path is given.
    pub const HAND: &str = "the hand is that of its path";
    /// Contacts appear and disappear with the events that report it, and otherwise only at an end of a side.
    pub const COME_AND_GO: &str = "contacts come and go as reported";
    /// The frame shows the condition that its status reports: a repetition of the previous frame, so many events, a remaining part of
    /// the hand's displacement, or a load that no reactions bear and no motion follows.
    pub const STATUS: &str = "a status is borne out by its frame";
    /// `slips` and `events` report the same slips.
    pub const SLIPS: &str = "slips are as many as reported";
    /// A body to which something has happened is not where it was.
    pub const MOVES: &str = "what happens moves the body";
    /// The angle of a body that turns about a contact, or about the hand, continues along its branch except for a `snap`, which is
    /// reported where the branch folds.
    pub const SNAPS: &str = "a balance snaps where it folds";
    /// The laws that need all events in order.
    pub const OF_EVENTS: &[&str] = &[COME_AND_GO, SLIPS, MOVES, SNAPS, STATUS, SLIDE_REPORTED];
    /// A slip begins where the contacts at their old positions can no longer bear the load.
    pub const SLIP_BEGINS: &str = "a slip begins where static friction gives way";
    /// At that point of the hand's path, at the contacts' new positions, |T| = mu_d N against the motion.
    pub const SLIP_ENDS: &str = "a slip ends at mu_d N";
    /// After several slips: somewhere on the hand's path in this frame, |T| = mu_d N at the current positions of the contacts.
    pub const SLIP_LAST: &str = "the last slip of a frame ends at mu_d N";
    /// T = -s mu_d N of a contact that slides along s t.
    pub const SLIDES: &str = "a slide is at mu_d N against its motion";
    /// The contacts that slide do so with the signs of one motion of the body, and all contacts slide.
    pub const ONE_MOTION: &str = "contacts slide as one motion can";
    /// A contact that slides along s t does not move back, as long as nothing else happens.
    pub const FORWARD: &str = "a slide goes forward";
    /// A slide begins and ends with the events `slide` and `stop`, or with another event that explains it.
    pub const SLIDE_REPORTED: &str = "slide and stop are reported";
    /// A slide sticks where N rises to N* = k_h D_c / (mu_s - mu_d).
    pub const SLIDE_STOPS: &str = "a slide stops where N reaches N*";
    /// A body whose contacts bear the load at both ends of the hand's path, and therefore along all of it, stays where it is.
    pub const HOLDS: &str = "what the contacts bear is not let go";
    /// A body is `jammed` if the load needs reactions beyond 64 k_h L, and only then.
    pub const JAMMED: &str = "jammed is what 64 k_h L cannot hold";
    /// Nowhere between the two positions does |T| <= mu_d N hold, nor is balance lost.
    pub const SLIP_FIRST: &str = "a slip ends at the first place it can";
}

/// One law on one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The law.
    pub law: &'static str,
    /// The distance of the frame from satisfying the law, relative to its scale; 0 if the law holds exactly.
    pub residual: f64,
    /// The residual up to which the law holds.
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

    /// The finding of a law that either holds or does not.
    pub(crate) fn whether(law: &'static str, holds: bool) -> Self {
        Self::new(law, if holds { 0.0 } else { f64::INFINITY }, 1.0)
    }

    /// The residual in units of its bound; infinite if it is NaN.
    pub fn severity(&self) -> f64 {
        let severity = self.residual / self.bound;
        if severity.is_nan() {
            f64::INFINITY
        } else {
            severity
        }
    }

    /// Whether the law holds.
    pub fn holds(&self) -> bool {
        self.severity() <= 1.0
    }
}

/// The tolerances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Forces and reactions, relative to the largest force in the frame, and moments, relative to that force × L; at
    /// least 64 roundings of coordinate × stiffness, for moments times the lever of the hand.
    pub residual: f64,
    /// Gaps and positions, relative to L; at least 64 roundings of the farthest coordinate. Contacts that close simultaneously may
    /// be 1e-10 L apart, in single precision 2^-19 L (STATICS 7).
    pub gap: f64,
    /// Gaps and positions are relative to the farthest coordinate, or L × theta, if that is larger than L.
    pub far: bool,
    /// Start and end of slips: forces, relative to the largest force in this frame and the previous one, at least 64
    /// roundings of coordinate × stiffness. This bound is tighter than that of the balance, because a slip that is short
    /// by a fraction of its length changes the force only by that fraction of (mu_s - mu_d) N. Over the scenes of
    /// `stiction trade`, lawful slips of the solver stay below a tenth of this bound, or below the 64 roundings.
    pub slip: f64,
    /// Positions of sticking contacts, relative to the farthest coordinate, and half the allowed error of springs, relative to
    /// coordinate × stiffness: a few roundings of the printed numbers.
    pub exact: f64,
    /// Half the spacing of the trace's numbers near 1: the error of one rounding.
    pub rounding: f64,
}

impl Bounds {
    /// Bounds for a trace of f64 values.
    pub const DOUBLE: Self = Self {
        residual: 1e-9,
        gap: 1e-9,
        far: true,
        slip: 1e-9,
        exact: 4.0 * f64::EPSILON,
        rounding: f64::EPSILON / 2.0,
    };
    /// Bounds for a trace of f32 values, from a solver in f32 or fixed point.
    pub const SINGLE: Self = Self {
        residual: 5e-4,
        gap: 4e-6,
        far: true,
        slip: 2e-5,
        exact: 4.0 * f32::EPSILON as f64,
        rounding: f32::EPSILON as f64 / 2.0,
    };
}
