//! The description of a frame: the contact state, what happened, what limited the answer.

/// At most this many events of one frame are reported; a run of equal events counts once.
pub const MAX_EVENTS: usize = 16;

/// The contact state (STATICS 2; the first four are the paper's).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum StateKind {
    /// No contact.
    #[default]
    NonContact,
    /// One vertex on one surface.
    SingleVertex,
    /// Two vertices on one surface.
    Edge,
    /// Two vertices on two surfaces.
    TwoVertex,
    /// One vertex on two surfaces.
    Corner,
    /// Three or more contacts.
    Locked,
}

impl StateKind {
    /// All states, in the order in which they are declared.
    pub const ALL: [Self; 6] = [
        Self::NonContact,
        Self::SingleVertex,
        Self::Edge,
        Self::TwoVertex,
        Self::Corner,
        Self::Locked,
    ];

    /// The name in a trace: `single-vertex`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NonContact => "non-contact",
            Self::SingleVertex => "single-vertex",
            Self::Edge => "edge",
            Self::TwoVertex => "two-vertex",
            Self::Corner => "corner",
            Self::Locked => "locked",
        }
    }
}

/// What happened in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Event {
    /// A vertex reached a surface.
    Touch,
    /// A contact opened without another one taking over its motion.
    Lift,
    /// A slip ended at |T| = mu_d N.
    Slip,
    /// The body left an edge and turns about one of its vertices.
    Tip,
    /// A second vertex reached the surface of the first: the body lies on an edge.
    Land,
    /// The balance of moments folded and the body snapped to the next one (R28).
    Snap,
    /// One more contact: three or more fix the body.
    Jam,
    /// A contact began to slide with the hand at |T| = mu_d N.
    Slide,
    /// A contact that slid with the hand sticks again.
    Stop,
    /// The hand took hold of the body where it is; the first hold, at the holding point of the scene, is not reported.
    Grasp,
    /// The hand let go of the body.
    Release,
}

impl Event {
    /// All events.
    pub const ALL: [Self; 11] = [
        Self::Touch,
        Self::Lift,
        Self::Slip,
        Self::Tip,
        Self::Land,
        Self::Snap,
        Self::Jam,
        Self::Slide,
        Self::Stop,
        Self::Grasp,
        Self::Release,
    ];

    /// The name in a trace.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Touch => "touch",
            Self::Lift => "lift",
            Self::Slip => "slip",
            Self::Tip => "tip",
            Self::Land => "land",
            Self::Snap => "snap",
            Self::Jam => "jam",
            Self::Slide => "slide",
            Self::Stop => "stop",
            Self::Grasp => "grasp",
            Self::Release => "release",
        }
    }
}

/// What limited the answer. Ordered: the most severe of a frame is reported. Up to [`Self::Jammed`], except for [`Self::IterationLimit`],
/// the pose is a balance within all friction cones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Status {
    /// Nothing.
    #[default]
    Ok,
    /// More than 128 events since the body last caught up with the hand: the rest of the hand's path was covered in one jump (R42).
    EventLimit,
    /// The hand is tilted out of the plane by more than 170 degrees, so that its angle in the plane is hardly known
    /// ([`Hand::tilted`](crate::Hand::tilted)); the body still follows the sample.
    Twist,
    /// A search ended at its bound; the best answer so far is given, with this status until the hand moves.
    IterationLimit,
    /// The contacts hold the body, but only with reactions beyond 64 k_h L: it stays (R43). The reported reactions are not exact.
    Jammed,
    /// The budget of the step was used up: the body is behind the hand, and goes on from there in the next step
    /// ([`Solver::with_budget`](crate::Solver::with_budget)).
    Behind,
    /// No mode of motion is consistent with the friction laws: the body stayed, out of balance. Reported in every frame until the hand
    /// moves (R32).
    Ambiguous,
    /// The hand, or its pull on the body, was beyond the range of the number type; the last pose is held.
    Saturated,
    /// The hand's sample was not finite or absent; the last pose is held.
    HeldLast,
}

impl Status {
    /// All statuses, the most severe last.
    pub const ALL: [Self; 9] = [
        Self::Ok,
        Self::EventLimit,
        Self::Twist,
        Self::IterationLimit,
        Self::Jammed,
        Self::Behind,
        Self::Ambiguous,
        Self::Saturated,
        Self::HeldLast,
    ];

    /// The name in a trace.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::EventLimit => "event-limit",
            Self::Twist => "twist",
            Self::IterationLimit => "iteration-limit",
            Self::Jammed => "jammed",
            Self::Behind => "behind",
            Self::Ambiguous => "ambiguous",
            Self::Saturated => "saturated",
            Self::HeldLast => "held-last",
        }
    }
}
