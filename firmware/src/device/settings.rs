//! How a device runs: the settings of its solver, its limits, and the stiffnesses that they permit.

use crate::safety::{LimitError, Limits, Passivity};
use stiction_core::{Description, Evolution, Real, Solver};

/// How a device runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How a frame is evolved.
    pub evolution: Evolution,
    /// The pieces of work of a step, see [`Solver::with_budget`]; `u32::MAX`: as many as it needs.
    pub budget: u32,
    /// A body that is behind the hand goes on in ticks without a new sample. If false, it goes on with the next sample only: a step for
    /// every sample, as in a file.
    pub goes_on: bool,
    /// The limits of the force on the hand.
    pub limits: Limits,
    /// The damping of the device. `None`: it drives no motors, forces are only reported, and every stiffness is permitted.
    pub passivity: Option<Passivity>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            evolution: Evolution::default(),
            budget: u32::MAX,
            goes_on: true,
            limits: Limits::DEFAULT,
            passivity: None,
        }
    }
}

impl Settings {
    pub(super) fn check(&self) -> Result<(), LimitError> {
        self.limits.check()?;
        match &self.passivity {
            Some(passivity) => passivity.check(),
            None => Ok(()),
        }
    }

    /// Checks that the stiffnesses of a scene leave the device passive.
    pub(super) fn admit(&self, scene: &Description<'_, f32>) -> Result<(), LimitError> {
        match &self.passivity {
            Some(passivity) => {
                passivity.admit(scene.stiffness_translation, scene.stiffness_rotation)
            }
            None => Ok(()),
        }
    }

    pub(super) fn apply<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>(
        &self,
        solver: Solver<R, V, S, C>,
    ) -> Solver<R, V, S, C> {
        solver
            .with_evolution(self.evolution)
            .with_budget(self.budget)
    }
}
