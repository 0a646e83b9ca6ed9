//! The driver: moves the hand through a scene and returns every answer as a frame in f64.

use crate::number::Number;
use crate::setup::{SURFACES, Setup, VERTICES};
use stiction_core::{
    Angle, Contact, Event, Evolution, Full, Hand, Model, Output, Solver, State, StateKind, Status,
    Transitions,
};

/// One answer of the solver, in f64; see [`Output`].
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// x, y (m), phi (rad) of the hand.
    pub hand: [f64; 3],
    /// The hand holds the body.
    pub held: bool,
    /// x, y (m), theta (rad) of the body.
    pub pose: [f64; 3],
    /// Depth coordinate (m).
    pub depth: f64,
    /// The contact state.
    pub state: StateKind,
    /// The contacts.
    pub contacts: Vec<Contact<f64>>,
    /// Force (N) and moment (N·m) of the hand on the body.
    pub wrench: [f64; 3],
    /// Slips that ended at mu_d N.
    pub slips: u32,
    /// The longest of them (m).
    pub longest_slip: f64,
    /// The events of the frame.
    pub events: Vec<Event>,
    /// What limited the answer.
    pub status: Status,
    /// The arms of the transition table that were taken.
    pub transitions: Transitions,
}

impl Frame {
    /// From the output of a number type.
    pub fn new<R: Number, const V: usize, const S: usize, M: Model>(
        solver: &Solver<R, V, S, M>,
        state: &State<R>,
        output: &Output<R::Si>,
    ) -> Self {
        let wide = R::wide;
        let pose =
            |[x, y]: [R::Si; 2], angle: Angle<R::Si>| [wide(x), wide(y), R::wide_angle(angle)];
        let contact = |c: &Contact<R::Si>| Contact {
            touch: c.touch,
            direction: c.direction.map(wide),
            point: c.point.map(wide),
            normal: wide(c.normal),
            friction: wide(c.friction),
            sliding: c.sliding,
        };
        let (hand, wrench) = (state.hand(), solver.wrench(state));
        let [fx, fy] = wrench.force;
        Self {
            hand: pose(hand.position, hand.angle),
            held: output.held,
            pose: pose(output.position, output.angle),
            depth: wide(output.depth),
            state: output.state,
            contacts: solver.contacts(state).iter().map(contact).collect(),
            wrench: [wide(fx), wide(fy), wide(wrench.moment)],
            slips: output.slips,
            longest_slip: wide(output.longest_slip),
            events: output.events().to_vec(),
            status: output.status,
            transitions: output.transitions,
        }
    }
    /// The sum of the normal forces (N).
    pub fn normal(&self) -> f64 {
        self.contacts.iter().map(|c| c.normal).sum()
    }
    /// The sum of the frictions along the tangents (N).
    pub fn friction(&self) -> f64 {
        self.contacts.iter().map(|c| c.friction).sum()
    }
    /// True if the event happened in this frame.
    pub fn saw(&self, event: Event) -> bool {
        self.events.contains(&event)
    }
}

/// A run with the capacities that all scenes of the tests share.
pub type Run<R> = RunOf<R, VERTICES, SURFACES, Full>;

/// A solver with its state and its last answer.
pub struct RunOf<R: Number, const V: usize, const S: usize, M: Model> {
    /// The solver.
    pub solver: Solver<R, V, S, M>,
    /// Its state after [`Self::frame`].
    pub state: State<R>,
    /// The last answer.
    pub frame: Frame,
}

/// The point on a hand's path at which something first happens.
#[derive(Clone, Debug)]
pub struct Onset {
    /// x, y (m), phi (rad) of the hand: the first pose at which it has happened.
    pub hand: [f64; 3],
    /// The answer for the last pose at which it had not happened yet.
    pub before: Frame,
}

impl<R: Number, const V: usize, const S: usize, M: Model> RunOf<R, V, S, M> {
    /// Starts a scene with the hand at x, y (m), phi (rad).
    ///
    /// # Panics
    /// If the scene is refused.
    pub fn start(setup: &Setup, evolution: Evolution, hand: [f64; 3]) -> Self {
        Self::start_with(setup, evolution, planar::<R>(hand))
    }
    /// Starts a scene with any hand.
    ///
    /// # Panics
    /// If the scene is refused.
    pub fn start_with(setup: &Setup, evolution: Evolution, hand: Hand<R::Si>) -> Self {
        let scene = setup
            .scene_of::<R, V, S, M>()
            .unwrap_or_else(|e| panic!("{}: {e}: {setup:?}", R::NAME));
        let solver = Solver::new(scene, evolution);
        let (state, output) = solver.start(hand);
        let frame = Frame::new(&solver, &state, &output);
        Self {
            solver,
            state,
            frame,
        }
    }
    /// One frame with the hand at x, y (m), phi (rad).
    pub fn step(&mut self, hand: [f64; 3]) -> &Frame {
        self.feed(planar::<R>(hand))
    }
    /// One frame with any hand.
    pub fn feed(&mut self, hand: Hand<R::Si>) -> &Frame {
        let output = self.solver.step(&mut self.state, hand);
        self.frame = Frame::new(&self.solver, &self.state, &output);
        &self.frame
    }
    /// Moves the hand straight from its current pose to `to`, in equal frames.
    pub fn lead(&mut self, to: [f64; 3], frames: usize) -> Vec<Frame> {
        let from = self.frame.hand;
        let hand = |i| between(from, to, i as f64 / frames as f64);
        (1..=frames).map(|i| self.step(hand(i)).clone()).collect()
    }
    /// Moves the hand straight towards `to` in a single frame that ends at the first pose at which something `happened`,
    /// found by bisection to the last digit of the number type.
    ///
    /// # Panics
    /// If it has not happened at `to`.
    pub fn onset(&mut self, to: [f64; 3], happened: impl Fn(&Frame) -> bool) -> Onset {
        let (from, state) = (self.frame.hand, self.state.clone());
        let (mut low, mut high) = (0.0, 1.0);
        let mut before = self.frame.clone();
        assert!(
            happened(self.step(to)),
            "nothing happens on the path from {from:?} to {to:?}: {:?}",
            self.frame
        );
        loop {
            let middle = (low + high) / 2.0;
            let hand = between(from, to, middle).map(R::rounded);
            if hand == before.hand || hand == self.frame.hand || middle == low || middle == high {
                break;
            }
            let mut trial = state.clone();
            let output = self.solver.step(&mut trial, planar::<R>(hand));
            let frame = Frame::new(&self.solver, &trial, &output);
            if happened(&frame) {
                (self.state, self.frame, high) = (trial, frame, middle);
            } else {
                (before, low) = (frame, middle);
            }
        }
        Onset {
            hand: self.frame.hand,
            before,
        }
    }
}

/// Runs a whole path: the first pose starts the scene, every further one is a frame.
pub fn run<R: Number>(setup: &Setup, evolution: Evolution, hands: &[[f64; 3]]) -> Vec<Frame> {
    let mut run = Run::<R>::start(setup, evolution, hands[0]);
    let first = run.frame.clone();
    let rest = hands[1..].iter().map(|&hand| run.step(hand).clone());
    std::iter::once(first).chain(rest).collect()
}

/// The solvers of the three number types are compiled with this crate, once, and not with every test program that runs them: a generic
/// function is compiled where it is first needed.
pub static COMPILED: [Whole; 3] = [run::<f64>, run::<f32>, run::<stiction_core::Fixed>];

/// A whole run, as [`run`].
type Whole = fn(&Setup, Evolution, &[[f64; 3]]) -> Vec<Frame>;

/// Straight lines between keyframes, each in equal frames, both ends included.
pub fn polyline(keyframes: &[[f64; 3]], frames_per_leg: usize) -> Vec<[f64; 3]> {
    let leg = |pair: &[[f64; 3]]| {
        let (from, to) = (pair[0], pair[1]);
        (1..=frames_per_leg).map(move |i| between(from, to, i as f64 / frames_per_leg as f64))
    };
    std::iter::once(keyframes[0])
        .chain(keyframes.windows(2).flat_map(leg))
        .collect()
}

pub(crate) fn between(from: [f64; 3], to: [f64; 3], part: f64) -> [f64; 3] {
    std::array::from_fn(|k| from[k] + (to[k] - from[k]) * part)
}

/// A hand that holds, at x, y (m), phi (rad).
pub fn planar<R: Number>([x, y, phi]: [f64; 3]) -> Hand<R::Si> {
    Hand::new(R::si(x), R::si(y), R::si(phi))
}
