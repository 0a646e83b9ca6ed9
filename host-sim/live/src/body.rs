//! A body moved by a solver of any number type: takes samples of the hand, returns records of the trace.

mod carry;

use std::sync::Arc;

use stiction_core::{
    Angle, Evolution, Fixed, Full, Hand, Model, Output, Present, Real, SiFloat, Solver, State,
    Wrench, narrow_hand,
};
use stiction_scene::{Among, HostSolver, Indices, InputError, SceneFile};

use crate::number::Number;
use crate::record::Frame;
use crate::simulate::{OBSTACLES, has_solver};
use carry::{Begun, carried};

/// A body that can be held by a hand.
pub trait Body: Send {
    /// Moves the hand to a pose; the body follows.
    fn step(&mut self, hand: &Hand<f64>);
    /// Returns the record of the last step, at time `t` (s).
    fn frame(&self, t: f64) -> Frame;
    /// Returns the current pose and hold.
    fn present(&self) -> Present<f64>;
    /// Returns a snapshot.
    fn copy(&self) -> Box<dyn Body>;
}

/// Scene, number type and evolution.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The scene.
    pub scene: Arc<SceneFile>,
    /// The number type.
    pub number: Number,
    /// The evolution within a frame.
    pub evolution: Evolution,
}

impl Setting {
    /// Returns the setting that every other setting is compared with.
    pub fn reference(&self) -> Self {
        Self {
            number: Number::F64,
            evolution: Evolution::Path,
            ..self.clone()
        }
    }

    /// Returns the body at its start, with the hand at its first pose: record 0 of a trace.
    ///
    /// # Errors
    /// The scene cannot be used in this number type.
    pub fn start(&self, hand: &Hand<f64>) -> Result<Box<dyn Body>, String> {
        self.solved(&Start::Scene(hand))
    }

    /// Returns a body that continues from its present pose.
    ///
    /// # Errors
    /// The body cannot be there under this setting.
    pub fn carry(&self, present: &Present<f64>) -> Result<Box<dyn Body>, String> {
        self.solved(&Start::Present(present))
    }

    /// Chooses the solver that the scene needs: with obstacles only if the scene has some.
    fn solved(&self, way: &Start<'_>) -> Result<Box<dyn Body>, String> {
        has_solver(&self.scene).map_err(|error| error.to_string())?;
        let has_obstacles = OBSTACLES && !self.scene.obstacles.is_empty();
        Ok(match (self.number, has_obstacles) {
            (Number::F32, false) => Box::new(Solved::<f32, Full>::new(self, way)?),
            (Number::F64, false) => Box::new(Solved::<f64, Full>::new(self, way)?),
            (Number::Fixed, false) => Box::new(Solved::<Fixed, Full>::new(self, way)?),
            (Number::F32, true) => Box::new(Solved::<f32, Among>::new(self, way)?),
            (Number::F64, true) => Box::new(Solved::<f64, Among>::new(self, way)?),
            (Number::Fixed, true) => Box::new(Solved::<Fixed, Among>::new(self, way)?),
        })
    }
}

enum Start<'a> {
    /// At the start of the scene, with this hand.
    Scene(&'a Hand<f64>),
    /// From its present pose.
    Present(&'a Present<f64>),
}

/// Checks that a scene is accepted by the solver that it needs, in f64.
///
/// # Errors
/// The key and the line if it does not; or the solver is not built in.
pub fn check(scene: &SceneFile) -> Result<(), InputError> {
    has_solver(scene)?;
    if OBSTACLES && !scene.obstacles.is_empty() {
        scene.check_scene::<f64>()
    } else {
        scene.scene::<f64>().map(drop)
    }
}

/// Checks that a scene suits a board, which takes no obstacles.
///
/// # Errors
/// The key and the line if it does not.
pub fn without_obstacles(scene: &SceneFile) -> Result<(), InputError> {
    scene.scene::<f64>().map(|_| ())
}

struct Solved<R: Real, M: Model> {
    solver: Arc<HostSolver<R, M>>,
    /// Indices of the solver's obstacles in the scene file, if they differ.
    indices: Option<Arc<Indices>>,
    state: State<R>,
    /// With the turns as reported to the outside.
    output: Output<R::Si>,
    /// Whole turns by which the reported angles exceed the solver's.
    turns: i32,
    stiffness: [f64; 2],
    holding_point: Option<[f64; 2]>,
}

impl<R: Real<Si: SiFloat>, M: Model> Solved<R, M> {
    fn new(setting: &Setting, way: &Start<'_>) -> Result<Self, String> {
        let scene = &setting.scene;
        let (begun, turns) = match way {
            Start::Scene(hand) => (Self::start(setting, hand)?, 0),
            Start::Present(present) => {
                let begun = carried(scene, setting.evolution, present)?;
                (begun, present.angle.turns)
            }
        };
        Ok(Self {
            solver: Arc::new(begun.solver),
            indices: begun.indices.map(Arc::new),
            state: begun.state,
            output: with_turns(begun.output, turns),
            turns,
            stiffness: [scene.stiffness_translation, scene.stiffness_rotation],
            holding_point: scene.holding_point,
        })
    }

    fn start(setting: &Setting, hand: &Hand<f64>) -> Result<Begun<R, M>, String> {
        let scene = setting.scene.written.scene_in();
        let (scene, indices) = scene.map_err(|error| error.to_string())?;
        let solver = Solver::new(scene, setting.evolution);
        let (state, output) = solver.start(narrow_hand(hand));
        Ok(Begun {
            solver,
            indices,
            state,
            output,
        })
    }
}

impl<R: Real<Si: SiFloat>, M: Model + 'static> Body for Solved<R, M>
where
    R: Send + Sync,
    R::Si: Send + Sync,
    HostSolver<R, M>: Send + Sync,
{
    fn step(&mut self, hand: &Hand<f64>) {
        let hand = hand.turned(self.turns.saturating_neg());
        let output = self.solver.step(&mut self.state, narrow_hand(&hand));
        self.output = with_turns(output, self.turns);
    }

    fn frame(&self, t: f64) -> Frame {
        let mut frame = Frame::new(t, &self.solver, &self.state, &self.output);
        if self.turns != 0 {
            frame.hand[2] += std::f64::consts::TAU * f64::from(self.turns);
        }
        frame.with_indices(self.indices.as_deref())
    }

    fn present(&self) -> Present<f64> {
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
            hold: self.state.hold(),
            holding_point: self.holding_point,
            hand: hand.turned(own_turns.saturating_neg()),
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
            indices: self.indices.clone(),
            state: self.state.clone(),
            output: self.output.clone(),
            ..*self
        })
    }
}

/// Returns an answer whose angle has these whole turns in addition.
fn with_turns<F>(mut output: Output<F>, turns: i32) -> Output<F> {
    output.angle.turns = output.angle.turns.saturating_add(turns);
    output
}
