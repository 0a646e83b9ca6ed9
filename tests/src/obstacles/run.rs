//! The driver among obstacles: moves the hand through a scene and returns every answer as a frame for the judge.

use super::scene::{Among, Model, SURFACES, Scene, VERTICES};
use crate::number::Number;
use crate::run::planar;
use stiction_core::{Evolution, Hand, Output, Solver, State};
use stiction_judge::{Contact, Frame, Touch};

/// The pairs of touching features of a frame, in order.
pub fn touches(frame: &Frame) -> Vec<Touch> {
    let mut touches: Vec<Touch> = frame.contacts.iter().map(|c| c.touch).collect();
    touches.sort();
    touches
}

/// A solver with its state and its last answer.
pub struct Run<R: Number> {
    /// The solver.
    pub solver: Solver<R, VERTICES, SURFACES, Model>,
    /// Its state after [`Self::frame`].
    pub state: State<R>,
    /// The last answer, at time 0.
    pub frame: Frame,
    /// The last answer as the solver gives it.
    pub output: Output<R::Si>,
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
        Self {
            frame: frame::<R>(&solver, &state, &output),
            solver,
            state,
            output,
        }
    }

    /// One frame with the hand at x, y (m), phi (rad).
    pub fn step(&mut self, hand: [f64; 3]) -> &Frame {
        self.output = self.solver.step(&mut self.state, planar::<R>(hand));
        self.frame = frame::<R>(&self.solver, &self.state, &self.output);
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
    let contact = |contact: &stiction_core::Contact<_>| Contact {
        touch: contact.touch,
        point: wide(contact.point),
        direction: Some(wide(contact.direction)),
        normal: R::wide(contact.normal),
        friction: R::wide(contact.friction),
        sliding: Some(contact.sliding),
    };
    let pose = |[x, y]: [f64; 2], angle| [x, y, R::wide_angle(angle)];
    let [fx, fy] = wide(wrench.force);
    Frame {
        t: 0.0,
        hand: pose(wide(hand.position), hand.angle),
        held: output.held,
        pose: pose(wide(output.position), output.angle),
        depth: 0.0,
        state: output.state,
        contacts: solver.contacts(state).iter().map(contact).collect(),
        complete: true,
        wrench: [fx, fy, R::wide(wrench.moment)],
        slips: output.slips,
        events: output.events().to_vec(),
        status: output.status,
        behind: None,
    }
}
