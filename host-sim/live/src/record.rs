//! The record of a run for the plots and the summary: the scene's numbers and one [`Frame`] per hand frame, in f64 (an f32 run
//! is widened without loss), SI units, world frame, angles unwrapped.

use std::collections::BTreeSet;

use stiction_core::{
    Contact, Event, Evolution, Model, Output, Real, SiFloat, State, StateKind, Status, Touch,
};
use stiction_judge::insertion::Meter;
use stiction_scene::{HostSolver, Indices, ObstacleInfo, SurfaceInfo, WrittenScene};

use crate::meter;
use crate::number::Number;
use crate::trace::Record;

/// A recorded run.
#[derive(Clone, Debug)]
pub struct Run {
    /// The scene.
    pub scene: WrittenScene,
    /// Whitney's meter, if the scene has a peg and a hole.
    pub meter: Option<Meter>,
    /// The number type of the solver.
    pub number: Number,
    /// The evolution within a frame.
    pub evolution: Evolution,
    /// The frames, in the order of time.
    pub frames: Vec<Frame>,
}

impl Run {
    /// Returns a run of a scene, without frames yet.
    pub fn of(scene: &WrittenScene, number: Number, evolution: Evolution) -> Self {
        Self {
            scene: scene.clone(),
            meter: meter::of_scene(scene),
            number,
            evolution,
            frames: Vec::new(),
        }
    }

    /// Returns the obstacles and their corners that are touched in any frame.
    pub fn touched_corners(&self) -> BTreeSet<[usize; 2]> {
        let contacts = self.frames.iter().flat_map(|frame| &frame.contacts);
        contacts
            .filter_map(|contact| contact.touch.corner())
            .collect()
    }

    /// Returns the record of a frame.
    pub fn record(&self, frame: &Frame) -> Record<'_> {
        let single = self.number.is_single();
        Record::new(frame, &self.scene, self.meter.as_ref(), single)
    }
}

/// The names of surfaces and obstacles.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Names of the surfaces, in the order of the scene.
    pub surfaces: Vec<String>,
    /// Names of the obstacles, in the order of the scene.
    pub obstacles: Vec<String>,
}

impl Names {
    /// Collects the names in a scene.
    pub fn of(surfaces: &[SurfaceInfo], obstacles: &[ObstacleInfo]) -> Self {
        let surfaces = surfaces.iter().map(|surface| surface.name.clone());
        let obstacles = obstacles.iter().map(|obstacle| obstacle.name.clone());
        Self {
            surfaces: surfaces.collect(),
            obstacles: obstacles.collect(),
        }
    }
}

/// One hand frame and the equilibrium at its end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Time of the hand's sample (s).
    pub t: f64,
    /// Hand: x, y (m), phi (rad); the last valid one if an invalid sample was held.
    pub hand: [f64; 3],
    /// Whether the hand holds the body.
    pub held: bool,
    /// Body: x, y (m), theta (rad).
    pub pose: [f64; 3],
    /// Depth coordinate (m).
    pub depth: f64,
    /// The contact state.
    pub state: StateKind,
    /// The contacts.
    pub contacts: Vec<ContactRecord>,
    /// Force (N) and moment about the holding point (N·m) of the hand on the body.
    pub wrench: [f64; 3],
    /// Slips that ended in this frame.
    pub slips: u32,
    /// Length of the longest of them (m).
    pub longest_slip: f64,
    /// What happened, in order.
    pub events: Vec<Event>,
    /// What limited the answer.
    pub status: Status,
    /// The part of the hand's displacement that is not yet followed, 0 to 1, if a frame has a budget of work.
    pub behind: Option<f64>,
}

/// A contact of the body: one of its vertices on a surface or on a side of an obstacle, or a corner of an obstacle on a side of
/// the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactRecord {
    /// What touches what, as indices into the lists of the scene.
    pub touch: Touch,
    /// Contact point (m).
    pub point: [f64; 2],
    /// Reaction N on the body along the normal n (N).
    pub normal: f64,
    /// Friction T on the body along the tangent t = (n_y, -n_x) (N).
    pub friction: f64,
    /// 0 if it sticks, 1 or -1 if it slides along t or against it.
    pub sliding: i8,
    /// The unit normal n towards the body.
    pub direction: [f64; 2],
}

impl Frame {
    /// Returns the frame at time `t` (s) with the solver's answer and the state after it.
    pub fn new<R: Real<Si: SiFloat>, M: Model>(
        t: f64,
        solver: &HostSolver<R, M>,
        state: &State<R>,
        output: &Output<R::Si>,
    ) -> Self {
        let mut frame = Self::default().renewed(t, solver, state, output);
        set_contacts(&mut frame.contacts, solver, state);
        frame
    }

    /// Does the same without contacts and reuses the memory of another frame.
    pub(crate) fn renewed<R: Real<Si: SiFloat>, M: Model>(
        self,
        t: f64,
        solver: &HostSolver<R, M>,
        state: &State<R>,
        output: &Output<R::Si>,
    ) -> Self {
        let placed = |[x, y]: [R::Si; 2], angle: R::Si| [x.widen(), y.widen(), angle.widen()];
        let (hand, wrench) = (state.hand(), solver.wrench(state));
        let (mut contacts, mut events) = (self.contacts, self.events);
        contacts.clear();
        events.clear();
        events.extend_from_slice(output.events());
        Self {
            t,
            hand: placed(hand.position, hand.angle.radians()),
            held: output.held,
            pose: placed(output.position, output.angle.radians()),
            depth: output.depth.widen(),
            state: output.state,
            contacts,
            wrench: placed(wrench.force, wrench.moment),
            slips: output.slips,
            longest_slip: output.longest_slip.widen(),
            events,
            status: output.status,
            behind: (solver.budget() < u32::MAX).then(|| output.behind.widen()),
        }
    }

    /// Translates to the indices of the scene file, if the solver's obstacles have others.
    pub fn with_indices(mut self, indices: Option<&Indices>) -> Self {
        rename(&mut self.contacts, indices);
        self
    }

    /// Returns the holding point in the world while the hand holds the body: p_h - F / k_h (m).
    pub fn holding_point(&self, stiffness_translation: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.hand[axis] - self.wrench[axis] / stiffness_translation)
    }
}

/// Replaces the contacts with those of a state.
pub(crate) fn set_contacts<R: Real<Si: SiFloat>, M: Model>(
    contacts: &mut Vec<ContactRecord>,
    solver: &HostSolver<R, M>,
    state: &State<R>,
) {
    let contact = |contact: &Contact<R::Si>| ContactRecord {
        touch: contact.touch,
        direction: contact.direction.map(R::Si::widen),
        point: contact.point.map(R::Si::widen),
        normal: contact.normal.widen(),
        friction: contact.friction.widen(),
        sliding: contact.sliding,
    };
    contacts.clear();
    contacts.extend(solver.contacts(state).iter().map(contact));
}

/// Gives contacts the indices of the scene file, if the solver's obstacles have others.
pub(crate) fn rename(contacts: &mut [ContactRecord], indices: Option<&Indices>) {
    if let Some(indices) = indices {
        for contact in contacts {
            contact.touch = indices.touch(contact.touch);
        }
    }
}
