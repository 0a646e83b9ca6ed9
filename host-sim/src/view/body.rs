//! A body that a solver of any number type moves: the hand's samples in, records of the trace out.

use std::sync::Arc;

use stiction_core::{
    Angle, Evolution, Fixed, Hand, Output, Real, SiFloat, Solver, State, Wrench, narrow_hand,
};
use stiction_scene::{HostSolver, SceneFile};

use super::carry::{Hold, Present, carried};
use crate::number::Number;
use crate::record::Frame;

/// A body in a hand.
pub(super) trait Body: Send {
    /// The hand goes to a pose and the body follows.
    fn step(&mut self, hand: &Hand<f64>);
    /// The record after the last step, at time `t` (s).
    fn frame(&self, t: f64) -> Frame;
    /// Where it is.
    fn present(&self) -> Present;
    /// A snapshot.
    fn copy(&self) -> Box<dyn Body>;
}

/// Scene, number type and evolution.
#[derive(Clone, Debug)]
pub(super) struct Setting {
    pub(super) scene: Arc<SceneFile>,
    pub(super) number: Number,
    pub(super) evolution: Evolution,
}

impl Setting {
    /// What every other setting is compared with.
    pub(super) fn reference(&self) -> Self {
        Self {
            number: Number::F64,
            evolution: Evolution::Path,
            ..self.clone()
        }
    }

    /// The body at its start, with the hand at its first pose: record 0 of a trace.
    pub(super) fn start(&self, hand: &Hand<f64>) -> Result<Box<dyn Body>, String> {
        Ok(match self.number {
            Number::F32 => Box::new(Solved::<f32>::start(self, hand)?),
            Number::F64 => Box::new(Solved::<f64>::start(self, hand)?),
            Number::Fixed => Box::new(Solved::<Fixed>::start(self, hand)?),
        })
    }

    /// A body that goes on from where it is.
    pub(super) fn carry(&self, present: &Present) -> Result<Box<dyn Body>, String> {
        Ok(match self.number {
            Number::F32 => Box::new(Solved::<f32>::carry(self, present)?),
            Number::F64 => Box::new(Solved::<f64>::carry(self, present)?),
            Number::Fixed => Box::new(Solved::<Fixed>::carry(self, present)?),
        })
    }
}

struct Solved<R: Real> {
    solver: Arc<HostSolver<R>>,
    state: State<R>,
    /// With the turns as seen from outside.
    output: Output<R::Si>,
    hold: Hold,
    /// Whole turns that the solver's angles are less than those outside.
    turns: i32,
    stiffness: [f64; 2],
}

impl<R: Real<Si: SiFloat>> Solved<R> {
    fn start(setting: &Setting, hand: &Hand<f64>) -> Result<Self, String> {
        let scene = setting.scene.scene().map_err(|error| error.to_string())?;
        let solver = Solver::new(scene, setting.evolution);
        let (state, output) = solver.start(narrow_hand(hand));
        Ok(Self::new(
            setting,
            solver,
            (state, output),
            (Hold::Never, 0),
        ))
    }

    fn carry(setting: &Setting, present: &Present) -> Result<Self, String> {
        let carried = carried(&setting.scene, setting.evolution, present)?;
        let answer = (carried.state, carried.output);
        let before = (present.hold, present.angle.turns);
        Ok(Self::new(setting, carried.solver, answer, before))
    }

    fn new(
        setting: &Setting,
        solver: HostSolver<R>,
        (state, output): (State<R>, Output<R::Si>),
        (hold, turns): (Hold, i32),
    ) -> Self {
        let scene = &setting.scene;
        let mut body = Self {
            solver: Arc::new(solver),
            state,
            output: output.clone(),
            hold,
            turns,
            stiffness: [scene.stiffness_translation, scene.stiffness_rotation],
        };
        body.accept(output);
        body
    }

    fn accept(&mut self, mut output: Output<R::Si>) {
        output.angle.turns = output.angle.turns.saturating_add(self.turns);
        self.hold = self.hold.after(output.events(), output.held);
        self.output = output;
    }
}

impl<R: Real<Si: SiFloat>> Body for Solved<R>
where
    R: Send + Sync,
    R::Si: Send + Sync,
{
    fn step(&mut self, hand: &Hand<f64>) {
        let hand = turned(hand, self.turns.saturating_neg());
        let output = self.solver.step(&mut self.state, narrow_hand(&hand));
        self.accept(output);
    }

    fn frame(&self, t: f64) -> Frame {
        let mut frame = Frame::new(t, &self.solver, &self.state, &self.output);
        if self.turns != 0 {
            frame.hand[2] += std::f64::consts::TAU * f64::from(self.turns);
        }
        frame
    }

    fn present(&self) -> Present {
        let angle = Angle {
            turns: self.output.angle.turns,
            rest: self.output.angle.rest.widen(),
        };
        let (hand, wrench) = (self.state.hand(), self.solver.wrench(&self.state));
        let hand = Hand {
            position: hand.position.map(R::Si::widen),
            angle: Angle {
                turns: hand.angle.turns,
                rest: hand.angle.rest.widen(),
            },
            depth: hand.depth.widen(),
            held: hand.held,
            tilted: hand.tilted,
        };
        let own_turns = angle.turns.saturating_sub(self.turns);
        Present {
            position: self.output.position.map(R::Si::widen),
            angle,
            held: self.output.held,
            hold: self.hold,
            hand: turned(&hand, own_turns.saturating_neg()),
            wrench: Wrench {
                force: wrench.force.map(R::Si::widen),
                moment: wrench.moment.widen(),
            },
            stiffness: self.stiffness,
        }
    }

    fn copy(&self) -> Box<dyn Body> {
        Box::new(Self {
            solver: Arc::clone(&self.solver),
            state: self.state.clone(),
            output: self.output.clone(),
            ..*self
        })
    }
}

/// A hand turned on by whole turns.
fn turned(hand: &Hand<f64>, turns: i32) -> Hand<f64> {
    let mut hand = *hand;
    hand.angle.turns = hand.angle.turns.saturating_add(turns);
    hand
}
