//! The answers of the solver. SI units, world frame.

use crate::event::{Event, StateKind, Status};
use crate::geometry::Angle;
use crate::log::Events;

/// The answer of one step. SI units, world frame. Forces are requested separately, by [`Solver::wrench`](crate::Solver::wrench) and
/// [`Solver::contacts`](crate::Solver::contacts), as not every frame needs them.
#[derive(Clone, Debug, PartialEq)]
pub struct Output<F> {
    /// The hand holds the body: its switch is on and it took hold within reach.
    pub held: bool,
    /// Position p of the origin of the body frame (m).
    pub position: [F; 2],
    /// Orientation theta of the body, unwrapped, counter-clockwise positive.
    pub angle: Angle<F>,
    /// Depth coordinate (m), passed through from the hand.
    pub depth: F,
    /// The contact state.
    pub state: StateKind,
    /// Slips that ended at mu_d N in this frame.
    pub slips: u32,
    /// The longest of them (m) >= 0: the way of the first sliding foot along its surface; 0 without a slip.
    pub longest_slip: F,
    /// What limited the answer.
    pub status: Status,
    /// The part of the hand's displacement that is left to follow, 0 to 1: more than 0 if the status is [`Status::Behind`], or more severe
    /// while the body is behind.
    pub behind: F,
    /// Pieces of work that the step took: windows of a motion, words of settling, candidates of a selection (R41).
    pub work: u32,
    pub(crate) events: Events,
}

/// The tangent of a state, SI units, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent<F> {
    /// Rows: x, y (m) of the holding point and the angle (rad) of the body; columns: x, y (m) and angle (rad) of the hand.
    pub compliance: [[F; 3]; 3],
    /// Rows: force along x and y (N) and moment (N·m) that the hand feels about the holding point; columns: as above. Negative where it is
    /// pushed back.
    pub stiffness: [[F; 3]; 3],
}

impl<F> Output<F> {
    /// What happened in this frame, in order; the first [`MAX_EVENTS`](crate::MAX_EVENTS), a run of equal ones once.
    pub fn events(&self) -> &[Event] {
        &self.events
    }
}
