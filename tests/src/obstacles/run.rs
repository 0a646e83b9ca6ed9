//! The driver among obstacles: moves the hand through a scene and returns every answer as a frame in f64.

use super::scene::{Among, Model, SURFACES, Scene, VERTICES};
use super::shape::Point;
use crate::number::Number;
use crate::reference::Touch;
use crate::run::planar;
use stiction_core::{Event, Evolution, Hand, Output, Solver, State, Status};

/// A contact in f64, SI units, world frame; forces are those on the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The pair of touching features.
    pub touch: Touch,
    /// Its position (m).
    pub point: Point,
    /// The unit normal towards the body.
    pub direction: Point,
    /// N (N)
    pub normal: f64,
    /// T (N), along (n_y, -n_x).
    pub friction: f64,
    /// 0 while it sticks, 1 or -1 while it slides along the tangent or against it.
    pub sliding: i8,
}

/// One answer of the solver, in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// x, y (m), phi (rad) of the hand that the state belongs to.
    pub hand: [f64; 3],
    /// The hand holds the body.
    pub held: bool,
    /// x, y (m), theta (rad) of the body.
    pub pose: [f64; 3],
    /// The name of the contact state.
    pub state: &'static str,
    /// The contacts.
    pub contacts: Vec<Contact>,
    /// The numbers of touches and contacts differ: a fault in the solver's lists.
    pub unequal: bool,
    /// Force (N) and moment (N·m, about the holding point) of the hand on the body.
    pub wrench: [f64; 3],
    /// Slips that ended at mu_d N.
    pub slips: u32,
    /// The events of the frame.
    pub events: Vec<Event>,
    /// What limited the answer.
    pub status: Status,
    /// The work of the step, in the solver's units.
    pub work: u32,
}

impl Frame {
    /// The pairs of touching features, in order.
    pub fn touches(&self) -> Vec<Touch> {
        let mut touches: Vec<Touch> = self.contacts.iter().map(|c| c.touch).collect();
        touches.sort();
        touches
    }
}

/// A solver with its state and its last answer.
pub struct Run<R: Number> {
    /// The solver.
    pub solver: Solver<R, VERTICES, SURFACES, Model>,
    /// Its state after [`Self::frame`].
    pub state: State<R>,
    /// The last answer.
    pub frame: Frame,
    /// The fraction of the hand's displacement that is left.
    pub behind: f64,
}

impl<R: Number> Run<R> {
    /// Starts a scene with the hand at x, y (m), phi (rad).
    ///
    /// # Panics
    /// If the scene is refused.
    pub fn start(among: &Among, evolution: Evolution, hand: [f64; 3]) -> Self {
        let scene = among.within::<R>().scene::<R>();
        let scene = scene.unwrap_or_else(|e| panic!("{}: {e}: {among:?}", R::NAME));
        Self::of(scene, evolution, planar::<R>(hand))
    }

    /// Starts from an accepted scene.
    pub fn of(scene: Scene<R>, evolution: Evolution, hand: Hand<R::Si>) -> Self {
        let solver = Solver::new(scene, evolution);
        let (state, output) = solver.start(hand);
        let frame = frame::<R>(&solver, &state, &output);
        Self {
            solver,
            state,
            frame,
            behind: R::wide(output.behind),
        }
    }

    /// One frame with the hand at x, y (m), phi (rad).
    pub fn step(&mut self, hand: [f64; 3]) -> &Frame {
        let output = self.solver.step(&mut self.state, planar::<R>(hand));
        self.frame = frame::<R>(&self.solver, &self.state, &output);
        self.behind = R::wide(output.behind);
        &self.frame
    }
}

fn frame<R: Number>(
    solver: &Solver<R, VERTICES, SURFACES, Model>,
    state: &State<R>,
    output: &Output<R::Si>,
) -> Frame {
    let wide = |p: [R::Si; 2]| p.map(R::wide);
    let (hand, wrench) = (state.hand(), solver.wrench(state));
    let (forces, touches) = (solver.contacts(state), solver.touches(state));
    let contact = |(force, touch)| {
        let (force, touch): (
            &stiction_core::Contact<R::Si>,
            &stiction_core::Touching<R::Si>,
        ) = (force, touch);
        Contact {
            touch: named(touch.touch),
            point: wide(force.point),
            direction: wide(touch.direction),
            normal: R::wide(force.normal),
            friction: R::wide(force.friction),
            sliding: force.sliding,
        }
    };
    let pose = |[x, y]: Point, angle| [x, y, R::wide_angle(angle)];
    let [fx, fy] = wide(wrench.force);
    Frame {
        hand: pose(wide(hand.position), hand.angle),
        held: output.held,
        pose: pose(wide(output.position), output.angle),
        state: output.state.name(),
        contacts: forces.iter().zip(touches.iter()).map(contact).collect(),
        unequal: forces.len() != touches.len(),
        wrench: [fx, fy, R::wide(wrench.moment)],
        slips: output.slips,
        events: output.events().to_vec(),
        status: output.status,
        work: output.work,
    }
}

/// A touch in the types of the reference.
pub fn named(touch: stiction_core::Touch) -> Touch {
    match touch {
        stiction_core::Touch::Surface { vertex, surface } => Touch::Surface { vertex, surface },
        stiction_core::Touch::Side {
            vertex,
            obstacle,
            side,
        } => Touch::Side {
            vertex,
            obstacle,
            side,
        },
        stiction_core::Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => Touch::Corner {
            obstacle,
            corner,
            body_side,
        },
    }
}
