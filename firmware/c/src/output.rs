//! The output to C: the answer of a step, forces and contacts. SI units, world frame; forces are those on the body.

use stiction_core::{Event as CoreEvent, Output as CoreOutput, StateKind, Status as CoreStatus};

/// At most this many events of a frame are reported.
pub const EVENTS: usize = 16;
/// At most this many contacts at a time.
pub const CONTACTS: usize = 8;

const _: () =
    assert!(EVENTS == stiction_core::MAX_EVENTS && CONTACTS == stiction_core::MAX_CONTACTS);

/// The contact state.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// No contact.
    NonContact,
    /// One vertex on one surface.
    SingleVertex,
    /// Two collinear contacts.
    Edge,
    /// Two contacts on two surfaces.
    TwoVertex,
    /// One vertex on two surfaces.
    Corner,
    /// Three contacts or more.
    Locked,
}

/// What happened in a frame.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// A vertex reached a surface.
    Touch,
    /// A contact opened.
    Lift,
    /// A slip ended where friction is mu_d N.
    Slip,
    /// The body left an edge and turns about one of its vertices.
    Tip,
    /// The body lies on an edge.
    Land,
    /// The balance folded and the body snapped to the next one.
    Snap,
    /// Three or more contacts fix the body.
    Jam,
    /// A contact began to slide with the hand.
    Slide,
    /// A contact that slid sticks again.
    Stop,
    /// The hand took hold of the body.
    Grasp,
    /// The hand let go of the body.
    Release,
}

/// What limited an answer; a larger value is more severe.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Nothing.
    Ok,
    /// More than 128 events in a frame: the rest was one jump of the hand.
    EventLimit,
    /// The hand is tilted so far out of the plane that its angle is hardly known.
    Twist,
    /// A search ended at its bound.
    IterationLimit,
    /// Only reactions beyond 64 k_h L hold the body: it stays.
    Jammed,
    /// The budget was used up: the body is behind the hand, and goes on in the next step.
    Behind,
    /// No motion is consistent with the friction: the body stays out of balance.
    Ambiguous,
    /// The hand is beyond the range of the numbers: the last pose is held.
    Saturated,
    /// The hand is not finite: the last pose is held.
    HeldLast,
}

/// The answer of a step.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Output {
    /// Position of the origin of the body's frame (m).
    pub x: f32,
    /// Position of the origin of the body's frame (m).
    pub y: f32,
    /// Angle of the body (rad), in [-pi, pi], to which `turns` whole turns are added.
    pub theta: f32,
    /// Whole turns of the body.
    pub turns: i32,
    /// Depth of the hand (m).
    pub depth: f32,
    /// The longest slip of the frame (m); 0 without one.
    pub longest_slip: f32,
    /// The fraction of the hand's displacement that is left to follow, 0 to 1; more than 0 if the budget was used up.
    pub behind: f32,
    /// Slips that ended in this frame.
    pub slips: u32,
    /// Units of work that the step took.
    pub work: u32,
    /// 1: the hand holds the body.
    pub held: u8,
    /// The contact state.
    pub state: State,
    /// What limited the answer.
    pub status: Status,
    /// The number of events.
    pub event_count: u8,
    /// What happened, in order; a run of equal events is reported once.
    pub events: [Event; EVENTS],
}

impl Output {
    pub(crate) fn of(output: &CoreOutput<f32>) -> Self {
        let mut events = [Event::Touch; EVENTS];
        for (to, &from) in events.iter_mut().zip(output.events()) {
            *to = from.into();
        }
        let [x, y] = output.position;
        Self {
            x,
            y,
            theta: output.angle.rest,
            turns: output.angle.turns,
            depth: output.depth,
            longest_slip: output.longest_slip,
            behind: output.behind,
            slips: output.slips,
            work: output.work,
            held: output.held.into(),
            state: output.state.into(),
            status: output.status.into(),
            event_count: u8::try_from(output.events().len()).unwrap_or(u8::MAX),
            events,
        }
    }
}

/// Force and moment of the hand on the body. A haptic device outputs the opposite to the hand.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force at the holding point (N).
    pub fx: f32,
    /// Force at the holding point (N).
    pub fy: f32,
    /// Moment about the holding point (N m), counter-clockwise.
    pub moment: f32,
}

/// What touches what.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Vertex `feature` of the body on surface `other`.
    Surface,
    /// Vertex `feature` of the body on side `part` of obstacle `other`.
    Side,
    /// Corner `part` of obstacle `other` on side `feature` of the body.
    Corner,
}

/// A contact.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Its position (m).
    pub x: f32,
    /// Its position (m).
    pub y: f32,
    /// Normal force (N), 0 or more.
    pub normal: f32,
    /// Friction on the body (N) along the tangent t = (n_y, -n_x), which is +x on a floor.
    pub friction: f32,
    /// 0: it sticks; 1 or -1: it slides with the hand along t or against it.
    pub sliding: i8,
    /// What touches what.
    pub kind: Kind,
    /// Index of the body's vertex or side, from 0.
    pub feature: u8,
    /// Index of the surface or obstacle, from 0.
    pub other: u8,
    /// Index of the obstacle's side or corner, from 0; 0 on a surface.
    pub part: u8,
}

/// Each name as in the core.
macro_rules! same {
    ($core:ty => $name:ident: $($item:ident)*) => {
        impl From<$core> for $name {
            fn from(given: $core) -> Self {
                match given {
                    $(<$core>::$item => Self::$item,)*
                }
            }
        }
    };
}

same!(StateKind => State: NonContact SingleVertex Edge TwoVertex Corner Locked);
same!(CoreEvent => Event: Touch Lift Slip Tip Land Snap Jam Slide Stop Grasp Release);
same!(CoreStatus => Status: Ok EventLimit Twist IterationLimit Jammed Behind Ambiguous Saturated HeldLast);
