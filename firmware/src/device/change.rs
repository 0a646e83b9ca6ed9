//! A new scene, new parameters or another mode while the device runs. A refused change changes nothing. Otherwise the body stays where it
//! is, its contacts stick at first, and it settles again under the hand that holds it at the same point; a larger force is reached within its
//! limit of rate, a smaller one at once.

use super::controller::{Controller, Run, solver};
use super::refusal::Refusal;
use super::settings::Settings;
use super::store::Store;
use crate::safety::Debt;
use stiction_core::{Description, Output, Present, Real, Solver, Status};
use stiction_wire::Parameters;

/// Where the body of a new scene is placed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Placement {
    /// At the scene's start, from the next sample on; the force becomes zero immediately.
    #[default]
    Start,
    /// Where the body is now. Refused if it would be inside a surface.
    Present,
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Controller<R, V, S, C> {
    /// New stiffnesses, and the friction and memory length of every surface and obstacle. Returns the answer of the settling, if there was
    /// a body to settle.
    ///
    /// # Errors
    /// [`Refusal`]; then nothing has changed.
    pub fn set_parameters(&mut self, new: &Parameters) -> Result<Option<Output<f32>>, Refusal> {
        let mut store = self.run.store.clone();
        store.stiffness_translation = new.stiffness_translation;
        store.stiffness_rotation = new.stiffness_rotation;
        for surface in &mut store.surfaces {
            surface.friction_static = new.friction_static;
            surface.friction_dynamic = new.friction_dynamic;
            surface.memory = new.memory;
        }
        store.obstacles.set_friction(new);
        store.with_given(|given| self.set_scene(given, Placement::Present))
    }

    /// A new scene, within the capacities V and S.
    ///
    /// # Errors
    /// [`Refusal`]; then nothing has changed.
    #[inline(never)]
    pub fn set_scene(
        &mut self,
        description: &Description<'_, f32>,
        placement: Placement,
    ) -> Result<Option<Output<f32>>, Refusal> {
        if placement == Placement::Present && self.run.state.is_some() {
            // With its own start it must be sound, too.
            self.place(description, false)?;
            return self.carry_on(description).map(Some);
        }
        self.place(description, true)?;
        self.run.begin();
        if placement == Placement::Start {
            self.let_go();
        }
        Ok(None)
    }
    /// A scene that is sound, and if it is to be taken, the scene of the run.
    // Not compiled into its caller, as are the others here: the stack is that of the one that runs.
    #[inline(never)]
    fn place(&mut self, description: &Description<'_, f32>, taken: bool) -> Result<(), Refusal> {
        let solver = solver(description, &self.settings)?;
        let store = Store::new(description).ok_or(Refusal::Unsettled(Status::Saturated))?;
        if taken {
            (self.run.solver, self.run.store) = (solver, store);
        }
        Ok(())
    }
    /// The body goes on where it is, in another scene.
    #[inline(never)]
    fn carry_on(&mut self, description: &Description<'_, f32>) -> Result<Output<f32>, Refusal> {
        let store = Store::new(description).ok_or(Refusal::Unsettled(Status::Saturated))?;
        let present = self.run.present()?;
        let settings = &self.settings;
        match Solver::carry(&present, description, |there| solver(there, settings)) {
            Ok(carried) => {
                let run = &mut self.run;
                // The solver counts turns from the present ones of the body.
                run.turns = run.pose.angle.turns;
                run.store = store;
                run.state = Some(carried.state);
                run.solver = carried.solver;
                let output = run.accept(carried.output);
                let limits = &self.settings.limits;
                let present = limits.sized(&self.given, run.store.stiffness());
                self.demand.grows_from = Some(present.size);
                self.debt = Debt::default();
                self.want(None);
                Ok(output)
            }
            Err(error) => Err(error.into()),
        }
    }

    /// How the device runs from now on: evolution, budget, limits, the period of ticks. The body stays as it is; the force continues from
    /// its present value, and so do the counts.
    ///
    /// # Errors
    /// [`Refusal`] if a limit cannot be used, or the stiffnesses of the scene would not be passive; then nothing has changed.
    pub fn set_settings(&mut self, settings: &Settings) -> Result<(), Refusal> {
        settings.check()?;
        self.run.store.with_given(|given| settings.admit(given))?;
        self.run.solver = settings.apply(self.run.solver.clone());
        self.settings = *settings;
        self.debt = Debt::default();
        self.demand.limits = Some(settings.limits);
        Ok(())
    }
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Run<R, V, S, C> {
    /// The body at its present pose, without whole turns.
    #[inline(never)]
    fn present(&self) -> Result<Present<f32>, Refusal> {
        let (pose, store) = (self.pose, &self.store);
        let Some(state) = &self.state else {
            return Err(Refusal::Unsettled(Status::HeldLast));
        };
        let own_turns = pose.angle.turns.saturating_sub(self.turns);
        Ok(Present {
            position: pose.position,
            angle: pose.angle,
            held: pose.held,
            hold: state.hold(),
            holding_point: store.holding_point,
            hand: state.hand().turned(own_turns.saturating_neg()),
            wrench: self.solver.wrench(state),
            stiffness: [store.stiffness_translation, store.stiffness_rotation],
        })
    }
}
