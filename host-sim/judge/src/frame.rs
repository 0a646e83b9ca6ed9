//! A record of a trace: SI units, world frame, angles unwrapped; and how the hand moves from one record to the next.

use crate::touch::Touch;

macro_rules! named {
    ($(#[$doc:meta])* $kind:ident { $($(#[$text:meta])* $variant:ident = $name:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $kind { $($(#[$text])* $variant,)* }

        impl $kind {
            /// All names in a trace.
            pub(crate) const NAMES: &[&str] = &[$($name),*];

            /// Its name in a trace.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name),*
                }
            }

            /// The variant with this name in a trace.
            pub fn named(name: &str) -> Option<Self> {
                match name {
                    $($name => Some(Self::$variant),)*
                    _ => None,
                }
            }
        }
    };
}

/// How the hand moves from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Evolution {
    /// Straight: a slip begins anywhere on its path.
    #[default]
    Path,
    /// It jumps: a slip begins at the end.
    Frame,
}

named! {
    /// The contact state.
    State {
        /// No contact.
        NonContact = "non-contact",
        /// One contact.
        SingleVertex = "single-vertex",
        /// Two contacts in one line, of one normal.
        Edge = "edge",
        /// Two contacts that are not in one line.
        TwoVertex = "two-vertex",
        /// One vertex on two surfaces or sides.
        Corner = "corner",
        /// Three or more contacts.
        Locked = "locked",
    }
}

named! {
    /// What happened in a frame.
    Event {
        /// A vertex reached a surface.
        Touch = "touch",
        /// A contact opened.
        Lift = "lift",
        /// A slip ended at mu_d N.
        Slip = "slip",
        /// The body left an edge and turns about one of its vertices.
        Tip = "tip",
        /// A second vertex reached the surface of the first.
        Land = "land",
        /// The rotation branch folded.
        Snap = "snap",
        /// Three or more contacts fix the body.
        Jam = "jam",
        /// The hand grasped the body.
        Grasp = "grasp",
        /// The hand let go of the body.
        Release = "release",
        /// A contact began to slide with the hand.
        Slide = "slide",
        /// A sliding contact sticks again.
        Stop = "stop",
    }
}

named! {
    /// What limited the answer.
    Status {
        /// Nothing.
        Ok = "ok",
        /// Too many slips, or too small ones: the rest of the frame was one jump of the hand.
        EventLimit = "event-limit",
        /// A search ended at its bound.
        IterationLimit = "iteration-limit",
        /// No motion is consistent: the body stays, out of balance.
        Ambiguous = "ambiguous",
        /// The hand was out of range; the last pose is held.
        Saturated = "saturated",
        /// The hand's sample was not finite; the last pose is held.
        HeldLast = "held-last",
        /// The load needs reactions beyond 64 k_h L: the body stays.
        Jammed = "jammed",
        /// A budget ended before the hand's path did: the body has followed part of the path.
        Behind = "behind",
        /// The hand's swing leaves its rotation about the plane's normal ill-defined.
        Twist = "twist",
    }
}

impl Status {
    /// Whether the body has followed the reported hand and is in balance with it: then every law applies.
    pub(crate) const fn is_followed(self) -> bool {
        matches!(
            self,
            Self::Ok | Self::Twist | Self::EventLimit | Self::IterationLimit
        )
    }
}

/// A contact of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The pair of touching features.
    pub touch: Touch,
    /// Where they touch (m).
    pub point: [f64; 2],
    /// The unit normal n towards the body, if the trace contains it.
    pub direction: Option<[f64; 2]>,
    /// N (N), on the body along n.
    pub normal: f64,
    /// T (N), on the body along the tangent (n_y, -n_x).
    pub friction: f64,
    /// 1 if it slides with the hand along the tangent, -1 if against it; 0 if it sticks. `None` in an older trace, in which
    /// contacts only stick and slip.
    pub sliding: Option<i8>,
}

impl Contact {
    /// Whether it sticks, or the trace does not report slides.
    pub(crate) fn rests(&self) -> bool {
        self.sliding.unwrap_or(0) == 0
    }
}

/// One record.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Time (s).
    pub t: f64,
    /// Hand: x, y (m), phi (rad).
    pub hand: [f64; 3],
    /// The hand holds the body.
    pub held: bool,
    /// Body: x, y (m), theta (rad).
    pub pose: [f64; 3],
    /// Depth coordinate (m).
    pub depth: f64,
    /// The contact state.
    pub state: State,
    /// The contacts.
    pub contacts: Vec<Contact>,
    /// False if the format had no space for all contacts.
    pub complete: bool,
    /// Force (N) and moment about the holding point (N·m) of the hand's springs on the body.
    pub wrench: [f64; 3],
    /// Slips that ended at mu_d N.
    pub slips: u32,
    /// What happened, in order; a run of equal events counts once.
    pub events: Vec<Event>,
    /// What limited the answer.
    pub status: Status,
    /// The fraction of the hand's displacement that the body has not yet followed, if the trace contains it.
    pub behind: Option<f64>,
}

impl Frame {
    pub(crate) fn has_contacts_of(&self, other: &Self) -> bool {
        self.contacts.len() == other.contacts.len()
            && (self.contacts.iter()).all(|contact| other.contact(contact.touch).is_some())
    }

    /// Whether it has contacts and reports for each whether it slides.
    pub(crate) fn tells_slides(&self) -> bool {
        !self.contacts.is_empty() && (self.contacts.iter()).all(|contact| contact.sliding.is_some())
    }

    pub(crate) fn slides(&self) -> bool {
        !self.contacts.iter().all(Contact::rests)
    }

    /// The contact between the features of `touch`.
    pub(crate) fn contact(&self, touch: Touch) -> Option<&Contact> {
        (self.contacts.iter()).find(|contact| contact.touch == touch)
    }

    pub(crate) fn meets_obstacles(&self) -> bool {
        let mut touches = self.contacts.iter().map(|contact| contact.touch);
        touches.any(|touch| touch.obstacle().is_some())
    }
}
