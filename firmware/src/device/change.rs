//! A new scene, new parameters or another mode while the device runs. A refused change changes nothing. Otherwise the body stays where it
//! is, its contacts stick at first, and it settles again under the hand that holds it at the same point; the force moves to the new value
//! within its rate limit.

use super::controller::{Controller, Hold, Run, is_held_last, solver, turned};
use super::refusal::Refusal;
use super::settings::Settings;
use super::store::Described;
use crate::model::BoardModel;
use stiction_core::{Description, Evolution, Hand, Output, Real, Solver, State, Wrench};
use stiction_wire::Parameters;

/// The rounding of the position of a hold, as a fraction of the body size.
const ROUNDING: f32 = 1e-4;

/// A solver with a state of its own: the length unit of a point depends on its holding point, so that no other solver fits.
struct Settled<R: Real, const V: usize, const S: usize, M: BoardModel> {
    solver: Solver<R, V, S, M>,
    state: State<R>,
    /// The answer of the settling.
    output: Output<f32>,
}

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
        M::set_friction(&mut store.obstacles, new);
        store.with_given(|given| self.set(given, Placement::Present))
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
        self.set_scene_among(description, M::NO_OBSTACLES, placement)
    }

    /// Like [`Self::set_scene`], with the obstacles that the model may have.
    ///
    /// # Errors
    /// Like [`Self::set_scene`].
    pub fn set_scene_among(
        &mut self,
        description: &Description<'_, f32>,
        obstacles: M::Surroundings<'_>,
        placement: Placement,
    ) -> Result<Option<Output<f32>>, Refusal> {
        let given = Described {
            description,
            obstacles,
        };
        self.set(given, placement)
    }

    fn set(
        &mut self,
        given: Described<'_, '_, M>,
        placement: Placement,
    ) -> Result<Option<Output<f32>>, Refusal> {
        let mut next = Run::new(given, &self.settings)?;
        if placement == Placement::Start {
            self.run = next;
            self.reset();
            return Ok(None);
        }
        let Some(state) = &self.run.state else {
            self.run = next;
            return Ok(None);
        };
        let settled = self.run.settled(state, given, &self.settings)?;
        next.state = Some(settled.state);
        next.hold = self.run.hold;
        // The solver counts turns from the present ones of the body.
        next.turns = self.run.pose.angle.turns;
        next.solver = settled.solver;
        let output = next.accept(settled.output);
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
        settings.admit(&self.run.store.description())?;
        self.run.solver = settings.apply(self.run.solver.clone());
        self.settings = *settings;
        self.demand.limits = Some(settings.limits);
        Ok(())
    }
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, M: BoardModel> Run<R, V, S, M> {
    /// The body at its present pose, without whole turns, in another scene, and settled there. A holding point applies to the first hold
    /// only.
    fn settled(
        &self,
        state: &State<R>,
        given: Described<'_, '_, M>,
        settings: &Settings,
    ) -> Result<Settled<R, V, S, M>, Refusal> {
        let description = given.description;
        let angle = self.pose.angle;
        let [x, y] = self.pose.position;
        let relative = angle.turns.saturating_sub(self.turns);
        let hand = turned(state.hand(), relative.saturating_neg());
        let mut there = Description {
            start: [x, y, angle.rest],
            ..*description
        };
        there.holding_point = match (self.pose.held, self.hold) {
            (_, Hold::Never) => description.holding_point,
            (true, Hold::Given) => self.store.holding_point,
            (true, Hold::Taken) | (false, _) => None,
        };
        let given = Described {
            description: &there,
            obstacles: given.obstacles,
        };
        let solver = solver::<R, V, S, M>(given, settings)?;
        let (state, output) = if self.pose.held && self.hold == Hold::Taken {
            self.taken_on(state, hand, given, settings)?
        } else {
            solver.start(hand)
        };
        if is_held_last(output.status) {
            Err(Refusal::Unsettled(output.status))
        } else if self.pose.held && !output.held {
            Err(Refusal::OutOfReach)
        } else {
            Ok(Settled {
                solver,
                state,
                output,
            })
        }
    }

    /// Continues a hold that was taken earlier: a hand that pulls with zero force takes it again, and jumps to its present position.
    fn taken_on(
        &self,
        state: &State<R>,
        hand: Hand<f32>,
        given: Described<'_, '_, M>,
        settings: &Settings,
    ) -> Result<(State<R>, Output<f32>), Refusal> {
        let Wrench { force, moment } = self.solver.wrench(state);
        let ([x, y], [fx, fy]) = (hand.position, force);
        let (k_h, k_theta) = (
            self.store.stiffness_translation,
            self.store.stiffness_rotation,
        );
        // Without a rotational spring, the angle at which it would rest is the present one.
        let turn = if k_theta > 0.0 { moment / k_theta } else { 0.0 };
        let idle = Hand {
            position: [x - fx / k_h, y - fy / k_h],
            angle: hand.angle.plus(-turn),
            ..hand
        };
        let mut there = *given.description;
        let reach = there.reach;
        let coordinates = there.vertices.iter().flatten();
        let size = coordinates.fold(0.0, |size, &x| Real::max(size, Real::abs(x)));
        // The point was within reach; rounding must not move it outside.
        there.reach = reach + ROUNDING * size;
        let given = Described {
            description: &there,
            obstacles: given.obstacles,
        };
        let solver = solver::<R, V, S, M>(given, settings)?.with_evolution(Evolution::Frame);
        let (mut state, taken) = solver.start(idle);
        if !taken.held {
            return Err(Refusal::OutOfReach);
        }
        let output = solver.step(&mut state, hand);
        Ok((state, output))
    }
}
