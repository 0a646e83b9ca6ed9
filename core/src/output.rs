//! What the solver gives: with every step the pose for the renderer and what happened on the way; when asked for, the
//! contacts and the hand's wrench for the haptic device. SI units, world frame, in the float [`Real::Si`](crate::Real::Si) of the number type.

use crate::geometry::Angle;
use crate::real::Real;
use crate::transition::Transitions;
use core::ops::Deref;
use heapless::Vec;

/// At most this many contacts are carried at once; further ones are not reported.
pub const MAX_CONTACTS: usize = 8;
/// At most this many events of one frame are reported; a run of equal events counts once.
pub const MAX_EVENTS: usize = 16;

/// The contact state (STATICS 8; the first four are the paper's).
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

/// What happened in a frame. The arms of the transition table tell the same in more detail:
/// [`Transition`](crate::Transition).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Event {
    /// A vertex came to a surface.
    Touch,
    /// A contact opened without another one taking over its motion.
    Lift,
    /// A slip ended at |T| = mu_d N.
    Slip,
    /// The body left an edge and turns about one of its vertices.
    Tip,
    /// A second vertex came to the surface of the first: the body lies on an edge.
    Land,
    /// The balance of moments folded and the body snapped to the next one (STATICS 3.1).
    Snap,
    /// A contact more: three or more fix the body.
    Jam,
    /// The hand took hold of the body where it is; the first hold, at the holding point of the scene, is not told.
    Grasp,
    /// The hand let go of the body.
    Release,
}

impl Event {
    /// All events.
    pub const ALL: [Self; 9] = [
        Self::Touch,
        Self::Lift,
        Self::Slip,
        Self::Tip,
        Self::Land,
        Self::Snap,
        Self::Jam,
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
            Self::Grasp => "grasp",
            Self::Release => "release",
        }
    }
}

/// What limited the answer. Ordered: the gravest of a frame is reported. Up to [`Self::EventLimit`] the pose is a balance within
/// all friction cones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Status {
    /// Nothing.
    #[default]
    Ok,
    /// More events than [`Solver::with_event_limit`](crate::Solver::with_event_limit) tells apart: the rest of the frame was one
    /// jump of the hand. Or, after 100 slips in a frame, slips too short to be told apart became a slide at mu_d (STATICS 7).
    EventLimit,
    /// A search ended at its bound; the best answer so far is given, and said so until the hand moves.
    IterationLimit,
    /// No mode of motion is consistent with the friction laws: the body stayed, out of balance. Said in every frame until the
    /// hand moves (STATICS 9, rule 8).
    Ambiguous,
    /// The hand, or its pull on the body, was beyond the range of the number type; the last pose is held.
    Saturated,
    /// The hand's sample was not finite or absent; the last pose is held.
    HeldLast,
}

impl Status {
    /// All statuses, the gravest last.
    pub const ALL: [Self; 6] = [
        Self::Ok,
        Self::EventLimit,
        Self::IterationLimit,
        Self::Ambiguous,
        Self::Saturated,
        Self::HeldLast,
    ];

    /// The name in a trace.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::EventLimit => "event-limit",
            Self::IterationLimit => "iteration-limit",
            Self::Ambiguous => "ambiguous",
            Self::Saturated => "saturated",
            Self::HeldLast => "held-last",
        }
    }
}

/// One contact: a vertex of the body on a surface. SI units, world frame; forces are those on the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact<F> {
    /// Index of the vertex in the scene's list.
    pub vertex: usize,
    /// Index of the surface in the scene's list.
    pub surface: usize,
    /// Where they touch (m).
    pub point: [F; 2],
    /// Reaction N >= 0 on the body along the surface's normal n (N).
    pub normal: F,
    /// Friction T on the body along the tangent t = (n_y, -n_x), which is +x on a floor (N); |T| <= mu_s N, unless the status says that
    /// the pose is out of balance. Of an edge, where only
    /// the sum counts, in proportion to N.
    pub friction: F,
}

/// Force and moment of the hand on the body, world frame.
///
/// ```
/// # use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_core::{Evolution, Hand, Solver};
///
/// # let scene: Scene<f32, 4, 1> = Scene::new(&Description {
/// #     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
/// #     start: [0.0, 0.03, 0.0],
/// #     weight: 0.0,
/// #     holding_point: Some([0.0, 0.02]),
/// #     reach: 0.0,
/// #     stiffness_translation: 500.0,
/// #     stiffness_rotation: 0.5,
/// #     surfaces: &[SurfaceDescription {
/// #         normal: [0.0, 1.0],
/// #         offset: 0.0,
/// #         friction_static: 0.5,
/// #         friction_dynamic: 0.3,
/// #     }],
/// # })?;
/// // The hand goes 10 mm below the holding point and 3 mm beyond it along +x. That is less than
/// // mu_s · 10 mm, so the box sticks.
/// let solver = Solver::new(scene, Evolution::Path);
/// let (mut state, _) = solver.start(Hand::new(0.0, 0.04, 0.0));
/// solver.step(&mut state, Hand::new(0.003, 0.04, 0.0));
///
/// let wrench = solver.wrench(&state);
/// let is = |value: f32, expected: f32| (value - expected).abs() < 1e-3;
/// assert!(is(wrench.force[0], 1.5) && is(wrench.force[1], -5.0), "along and down");
/// let [x, y] = wrench.feedback().force;
/// assert!(is(x, -1.5) && is(y, 5.0), "the hand is pulled back and pushed up");
///
/// let contacts = solver.contacts(&state);
/// assert_eq!(contacts.len(), 2, "an edge");
/// let normal: f32 = contacts.iter().map(|c| c.normal).sum();
/// let friction: f32 = contacts.iter().map(|c| c.friction).sum();
/// assert!(is(normal, 5.0), "the floor bears the push");
/// assert!(is(friction, -1.5), "friction on the box acts along -t = -x");
/// # // The wrench and the contacts add up to nothing, in moment too: about the left vertex.
/// # let [fx, fy] = wrench.force;
/// # let at = [0.05, 0.05]; // the holding point from there
/// # assert!(is(at[0] * fy - at[1] * fx + wrench.moment + 0.1 * contacts[1].normal, 0.0));
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench<F> {
    /// Force F at the holding point (N).
    pub force: [F; 2],
    /// Moment M about the holding point (N·m), counter-clockwise positive.
    pub moment: F,
}

impl<F: Real> Wrench<F> {
    /// The wrench that a haptic device gives to the hand: the opposite of the one on the body.
    #[must_use]
    pub fn feedback(&self) -> Self {
        let [x, y] = self.force;
        Self {
            force: [-x, -y],
            moment: -self.moment,
        }
    }
}

/// The contacts of a state, in a fixed order as long as the state lasts, at most [`MAX_CONTACTS`]. A list that can be read like a
/// slice; [`Wrench`] has an example.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contacts<F> {
    list: Vec<Contact<F>, MAX_CONTACTS>,
}

impl<F> Contacts<F> {
    pub(crate) fn add(&mut self, contact: Contact<F>) {
        // A state has never more contacts than there is room for.
        let _ = self.list.push(contact);
    }
}

impl<F> Deref for Contacts<F> {
    type Target = [Contact<F>];
    fn deref(&self) -> &[Contact<F>] {
        &self.list
    }
}

/// The answer of one step. SI units, world frame. Forces are asked for apart, [`Solver::wrench`](crate::Solver::wrench) and
/// [`Solver::contacts`](crate::Solver::contacts), as not every frame needs them.
///
/// ```
/// # use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_core::{Event, Evolution, Hand, Solver, StateKind, Status, Transition};
///
/// # let scene: Scene<f32, 4, 1> = Scene::new(&Description {
/// #     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
/// #     start: [0.0, 0.05, 0.0],
/// #     weight: 0.0,
/// #     holding_point: Some([0.0, 0.02]),
/// #     reach: 0.0,
/// #     stiffness_translation: 500.0,
/// #     stiffness_rotation: 0.5,
/// #     surfaces: &[SurfaceDescription {
/// #         normal: [0.0, 1.0],
/// #         offset: 0.0,
/// #         friction_static: 0.5,
/// #         friction_dynamic: 0.3,
/// #     }],
/// # })?;
/// // A box that hangs 20 mm over the floor is put down flat and pressed, then dragged, then lifted.
/// let solver = Solver::new(scene, Evolution::Path);
/// let (mut state, _) = solver.start(Hand::new(0.0, 0.07, 0.0));
///
/// let down = solver.step(&mut state, Hand::new(0.0, 0.04, 0.0));
/// assert_eq!((down.state, down.events()), (StateKind::Edge, &[Event::Land][..]));
///
/// let along = solver.step(&mut state, Hand::new(0.006, 0.04, 0.0));
/// assert_eq!((along.slips, along.events()), (1, &[Event::Slip][..]));
/// assert!((along.longest_slip - 0.002).abs() < 1e-6, "(mu_s - mu_d) · 10 mm");
/// assert!(along.transitions.iter().any(|arm| arm == Transition::EdgeSlips));
///
/// let up = solver.step(&mut state, Hand::new(0.006, 0.07, 0.0));
/// assert_eq!((up.state, up.status), (StateKind::NonContact, Status::Ok));
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Output<F> {
    /// The hand holds the body (its switch is on and it took hold within reach).
    pub held: bool,
    /// Position p of the origin of the body frame (m).
    pub position: [F; 2],
    /// Orientation theta of the body, unwrapped, counter-clockwise positive.
    pub angle: Angle<F>,
    /// Depth coordinate (m), passed through from the hand.
    pub depth: F,
    /// The contact state.
    pub state: StateKind,
    /// Slips that ended at mu_d N in this frame. Where mu_s = mu_d, a slide up to the next event counts as one, or a few.
    pub slips: u32,
    /// The longest of them (m) >= 0: the way of the (first) sliding vertex along its surface; 0 without a slip.
    pub longest_slip: F,
    /// What limited the answer.
    pub status: Status,
    /// The arms of the transition table taken in this frame.
    pub transitions: Transitions,
    pub(crate) events: Vec<Event, MAX_EVENTS>,
}

impl<F: Real> Output<F> {
    /// What happened in this frame, in order; the first [`MAX_EVENTS`], a run of equal ones told once.
    pub fn events(&self) -> &[Event] {
        &self.events
    }
}
