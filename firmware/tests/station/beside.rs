//! The solver of the board's scene on this machine, and whether a pose of the board has its bits.

use crate::common::BOX;
use stiction_core::frame::{Mode, Pose};
use stiction_core::{Description, Event, Hand, Output, Real, Scene, Solver, State};

/// The solver of the board's scene, beside it.
pub(crate) struct Beside<R: Real> {
    pub(crate) solver: Solver<R, 8, 4>,
    pub(crate) state: Option<State<R>>,
}

impl<R: Real<Si = f32>> Beside<R> {
    pub(crate) fn new(mode: &Mode) -> Self {
        Self::of(&BOX, mode)
    }
    /// Beside a board with another scene.
    pub(crate) fn of(description: &Description<'_, f32>, mode: &Mode) -> Self {
        let scene: Scene<R, 8, 4> = Scene::new(description).unwrap();
        Self {
            solver: Solver::new(scene, mode.evolution),
            state: None,
        }
    }
    pub(crate) fn step(&mut self, hand: Hand<f32>) -> Output<f32> {
        match &mut self.state {
            Some(state) => self.solver.step(state, hand),
            None => {
                let (state, output) = self.solver.start(hand);
                self.state = Some(state);
                output
            }
        }
    }
}

/// Bit for bit, what a pose tells of an answer; its events are those of this answer alone.
pub(crate) fn assert_same(pose: &Pose, output: &Output<f32>, case: &str) {
    let bits = |numbers: [f32; 4]| numbers.map(f32::to_bits);
    let ([x, y], [ex, ey]) = (pose.position, output.position);
    assert_eq!(
        bits([x, y, pose.rest, pose.depth]),
        bits([ex, ey, output.angle.rest, output.depth]),
        "{case}: {pose:?} {output:?}"
    );
    assert_eq!(
        i32::from(pose.turns),
        output.angle.turns.rem_euclid(8),
        "{case}"
    );
    assert_eq!(
        (pose.state, pose.status, pose.held),
        (output.state, output.status, output.held),
        "{case}"
    );
    for event in Event::ALL {
        let happened = output.events().contains(&event);
        assert_eq!(pose.events.contains(event), happened, "{case}");
    }
}
