//! A new scene, new parameters or another mode while the device runs. A refused change changes nothing. Otherwise the body stays where it
//! is, its contacts stick at first, and it settles again under the hand that holds it at the same point; the force moves to the new value
//! within its rate limit.

use super::controller::{Controller, Run, solver};
use super::refusal::Refusal;
use super::settings::Settings;
use crate::model::{BoardModel, StoreObstacles};
use stiction_core::{Carried, Description, Output, Present, Real, Solver, State};
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

impl<R: Real<Si = f32>, const V: usize, const S: usize, M: BoardModel> Controller<R, V, S, M> {
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
    pub fn set_scene(
        &mut self,
        description: &Description<'_, f32>,
        placement: Placement,
    ) -> Result<Option<Output<f32>>, Refusal> {
        let mut next = Run::new(description, &self.settings)?;
        if placement == Placement::Start {
            self.run = next;
            self.reset();
            return Ok(None);
        }
        let Some(state) = &self.run.state else {
            self.run = next;
            return Ok(None);
        };
        let carried = self.run.carried(state, description, &self.settings)?;
        next.state = Some(carried.state);
        // The solver counts turns from the present ones of the body.
        next.turns = self.run.pose.angle.turns;
        next.solver = carried.solver;
        let output = next.accept(carried.output);
        self.run = next;
        self.want();
        Ok(Some(output))
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
        self.demand.limits = Some(settings.limits);
        Ok(())
    }
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, M: BoardModel> Run<R, V, S, M> {
    /// The body at its present pose, without whole turns, in another scene.
    fn carried(
        &self,
        state: &State<R>,
        description: &Description<'_, f32>,
        settings: &Settings,
    ) -> Result<Carried<R, V, S, M>, Refusal> {
        let (pose, store) = (self.pose, &self.store);
        let own_turns = pose.angle.turns.saturating_sub(self.turns);
        let present = Present {
            position: pose.position,
            angle: pose.angle,
            held: pose.held,
            hold: state.hold(),
            holding_point: store.holding_point,
            hand: state.hand().turned(own_turns.saturating_neg()),
            wrench: self.solver.wrench(state),
            stiffness: [store.stiffness_translation, store.stiffness_rotation],
        };
        Ok(Solver::carry(&present, description, |description| {
            solver(description, settings)
        })?)
    }
}
