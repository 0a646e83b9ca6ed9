//! The solver of the board's scene on this machine, to compare the bits of the board's poses.

use stiction_core::{Description, Event, Evolution, Hand, Output, Real, Scene, Solver, State};
use stiction_wire::{Mode, Pose};

use super::BOX;

/// The solver of the board's scene, run in parallel to the board.
pub struct Beside<R: Real, const V: usize = 8, const S: usize = 4, const C: usize = 0> {
    /// The solver.
    pub solver: Solver<R, V, S, C>,
    /// Where the body is; `None` before the first sample.
    pub state: Option<State<R>>,
}

impl<R: Real<Si = f32>> Beside<R> {
    /// For a board with [`BOX`].
    pub fn new(mode: &Mode) -> Self {
        Self::of(&BOX, mode)
    }
    /// For a board with another scene.
    pub fn of(description: &Description<'_, f32>, mode: &Mode) -> Self {
        Self::solving(Scene::new(description).unwrap(), mode.evolution)
    }
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Beside<R, V, S, C> {
    /// For a board with a scene of any size and model.
    pub fn solving(scene: Scene<R, V, S, C>, evolution: Evolution) -> Self {
        Self {
            solver: Solver::new(scene, evolution),
            state: None,
        }
    }
    /// The answer to a sample.
    pub fn step(&mut self, hand: Hand<f32>) -> Output<f32> {
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

/// Asserts, bit for bit, that a pose reports an answer; its events are those of this answer alone.
pub fn assert_same(pose: &Pose, output: &Output<f32>, case: &str) {
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
