//! What a run leaves behind for the plots and the summary: the scene's numbers and one [`Frame`] per hand frame, in f64
//! (an f32 run is widened without loss), SI units, world frame, angles unwrapped.

use stiction_core::{Event, Evolution, Model, Output, Real, SiFloat, State, StateKind, Status};
use stiction_scene::{HostSolver, SceneFile, SurfaceInfo};

use crate::number::Number;

/// A recorded run.
#[derive(Clone, Debug)]
pub struct Run {
    /// The scene's name: its file name without the extension.
    pub title: String,
    /// Vertices of the body (m), body frame, counter-clockwise; 1: a point, 2: a rod.
    pub body: Vec<[f64; 2]>,
    /// The surfaces, in the order of the scene file.
    pub surfaces: Vec<SurfaceInfo>,
    /// k_h (N/m)
    pub stiffness_translation: f64,
    /// k_theta (N·m/rad)
    pub stiffness_rotation: f64,
    /// Weight (N) at the centroid, along world -y.
    pub weight: f64,
    /// The initial holding point (m), body frame; `None`: taken from the hand at the grasp.
    pub holding_point: Option<[f64; 2]>,
    /// The number type of the solver.
    pub number: Number,
    /// The evolution within a frame.
    pub evolution: Evolution,
    /// The frames, in the order of time.
    pub frames: Vec<Frame>,
}

impl Run {
    /// Of a scene, without frames yet.
    pub fn of(scene: &SceneFile, number: Number, evolution: Evolution) -> Self {
        Self {
            title: scene.title.clone(),
            body: scene.vertices.clone(),
            surfaces: scene.surfaces.clone(),
            stiffness_translation: scene.stiffness_translation,
            stiffness_rotation: scene.stiffness_rotation,
            weight: scene.weight,
            holding_point: scene.holding_point,
            number,
            evolution,
            frames: Vec::new(),
        }
    }

    /// The names of the surfaces.
    pub(crate) fn surface_names(&self) -> Vec<String> {
        let names = self.surfaces.iter().map(|surface| surface.name.clone());
        names.collect()
    }
}

/// One hand frame and the equilibrium at its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Time of the hand's sample (s).
    pub t: f64,
    /// Hand: x, y (m), phi (rad); the last good one where a bad one was held.
    pub hand: [f64; 3],
    /// The hand holds the body.
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
    /// The longest of them (m).
    pub longest_slip: f64,
    /// What happened, in order.
    pub events: Vec<Event>,
    /// What limited the answer.
    pub status: Status,
    /// The part of the hand's displacement that is not yet followed, 0 to 1, where a frame has a budget of work.
    pub behind: Option<f64>,
}

/// A vertex of the body on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactRecord {
    /// Index into [`Run::body`].
    pub vertex: usize,
    /// Index into [`Run::surfaces`].
    pub surface: usize,
    /// Where they touch (m).
    pub point: [f64; 2],
    /// Reaction N on the body along the surface's normal (N).
    pub normal: f64,
    /// Friction T on the body along the tangent t = (n_y, -n_x) (N).
    pub friction: f64,
    /// 0 where it sticks, 1 or -1 where it slides along t or against it.
    pub sliding: i8,
}

impl Frame {
    /// The frame at time `t` (s) with the solver's answer and the state after it.
    pub fn new<R: Real<Si: SiFloat>, M: Model>(
        t: f64,
        solver: &HostSolver<R, M>,
        state: &State<R>,
        output: &Output<R::Si>,
    ) -> Self {
        let placed = |[x, y]: [R::Si; 2], angle: R::Si| [x.widen(), y.widen(), angle.widen()];
        let (hand, wrench) = (state.hand(), solver.wrench(state));
        Self {
            t,
            hand: placed(hand.position, hand.angle.radians()),
            held: output.held,
            pose: placed(output.position, output.angle.radians()),
            depth: output.depth.widen(),
            state: output.state,
            contacts: solver
                .contacts(state)
                .iter()
                .map(|contact| ContactRecord {
                    vertex: contact.vertex,
                    surface: contact.surface,
                    point: contact.point.map(R::Si::widen),
                    normal: contact.normal.widen(),
                    friction: contact.friction.widen(),
                    sliding: contact.sliding,
                })
                .collect(),
            wrench: placed(wrench.force, wrench.moment),
            slips: output.slips,
            longest_slip: output.longest_slip.widen(),
            events: output.events().to_vec(),
            status: output.status,
            behind: (solver.budget() < u32::MAX).then(|| output.behind.widen()),
        }
    }

    /// The holding point in the world while the hand holds the body: p_h - F / k_h (m).
    pub(crate) fn holding_point(&self, stiffness_translation: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.hand[axis] - self.wrench[axis] / stiffness_translation)
    }
}
