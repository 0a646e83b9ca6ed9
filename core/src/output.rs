//! The results of a step: the pose for the renderer and what happened in the frame. SI units, world frame, in the float
//! [`Real::Si`](crate::Real::Si) of the number type.

use crate::event::{Event, MAX_EVENTS, StateKind, Status};
use crate::geometry::Angle;
use crate::real::Real;
use crate::transition::Transitions;
use heapless::Vec;

/// The answer of one step. SI units, world frame. Forces are requested separately, by [`Solver::wrench`](crate::Solver::wrench) and
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
/// #         memory: None,
/// #     }],
/// #     obstacles: &[],
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
    /// Slips that ended at mu_d N in this frame. If mu_s = mu_d, a slide up to the next event counts as one slip, or a few.
    pub slips: u32,
    /// The longest of them (m) >= 0: the displacement of the (first) sliding vertex along its surface; 0 without a slip.
    pub longest_slip: F,
    /// What limited the answer.
    pub status: Status,
    /// The fraction of the hand's displacement that is left to follow, 0 to 1: more than 0 if the status is [`Status::Behind`], or more
    /// severe while the body is behind.
    pub behind: F,
    /// The units of work that the step took ([`Solver::with_budget`](crate::Solver::with_budget)).
    pub work: u32,
    /// The arms of the transition table taken in this frame.
    pub transitions: Transitions,
    pub(crate) events: Vec<Event, MAX_EVENTS>,
}

impl<F: Real> Output<F> {
    /// What happened in this frame, in order; the first [`MAX_EVENTS`], a run of equal ones reported once.
    pub fn events(&self) -> &[Event] {
        &self.events
    }
}
