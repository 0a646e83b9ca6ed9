//! A random walk of the hand in whole numbers, so that it is the same on every machine: straight legs between random poses around a corner
//! of floor and wall, or among obstacles, which push the body of the benchmarks into all contact states.

use super::place::Place;
use stiction_core::{
    Angle, Contacts, Evolution, Hand, Output, Real, SiFloat, Solver, State, Wrench,
};

/// Whole numbers of the walk per metre or radian.
const UNITS_PER_ONE: i32 = 1 << 14;
/// The range of the hand (m, m, rad): the middle and the largest distance from it.
const REACH: [[f64; 2]; 3] = [[0.0, 0.17], [0.05, 0.06], [0.0, 2.0]];
/// The hand's samples; they never end.
#[derive(Clone, Debug)]
pub struct Walk {
    random: u32,
    from: [i32; 3],
    to: [i32; 3],
    /// Frames of this leg, and how many of them are done.
    length: i32,
    gone: i32,
    held: bool,
}

impl Walk {
    /// Begins over the floor, the body's bottom side down.
    pub fn new() -> Self {
        let [start, _, _] = REACH.map(|[middle, _]| in_units(middle));
        let start = [start, in_units(0.1), 0];
        Self {
            random: 0x2545_F491,
            from: start,
            to: start,
            length: 1,
            gone: 0,
            held: true,
        }
    }

    /// The next random number (xorshift).
    fn random(&mut self) -> u32 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 17;
        self.random ^= self.random << 5;
        self.random
    }

    /// A random whole number of at most this size.
    fn within(&mut self, size: i32) -> i32 {
        let size = size.unsigned_abs();
        (self.random() % (2 * size + 1)).cast_signed() - size.cast_signed()
    }

    /// The next leg: every other one ends with a side of the body nearly level, one in 32 has the hold switch off.
    fn turn(&mut self) {
        let target = REACH.map(|[middle, size]| in_units(middle) + self.within(in_units(size)));
        let [x, y, mut phi] = target;
        if self.random().is_multiple_of(2) {
            let quarter = in_units(core::f64::consts::FRAC_PI_2);
            phi = self.within(1) * quarter + self.within(in_units(0.02));
        }
        self.from = self.to;
        self.to = [x, y, phi];
        self.length = 128 + self.within(120);
        self.gone = 0;
        self.held = !self.random().is_multiple_of(32);
    }

    /// The next sample.
    pub fn sample<F: SiFloat>(&mut self) -> Hand<F> {
        if self.gone == self.length {
            self.turn();
        }
        self.gone += 1;
        let ([x, y, phi], [to_x, to_y, to_phi]) = (self.from, self.to);
        let now = [(x, to_x), (y, to_y), (phi, to_phi)]
            .map(|(from, to)| from + (to - from) * self.gone / self.length);
        // Exact: the numbers have less than 24 bits and the unit is a power of two.
        let [x, y, rest] = now.map(|n| F::from_int(n) / F::from_int(UNITS_PER_ONE));
        Hand {
            position: [x, y],
            angle: Angle { turns: 0, rest },
            depth: rest,
            held: self.held,
            tilted: false,
        }
    }
}

impl Default for Walk {
    fn default() -> Self {
        Self::new()
    }
}

fn in_units(value: f64) -> i32 {
    (value * f64::from(UNITS_PER_ONE)) as i32
}

/// All results of the solver for a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer<F> {
    /// The answer of the step.
    pub output: Output<F>,
    /// The wrench of the hand.
    pub wrench: Wrench<F>,
    /// The contacts with their forces.
    pub contacts: Contacts<F>,
}

/// Moves the body along the walk, for at least one frame, and passes every answer to a function.
pub fn follow<R: Real<Si: SiFloat>, M: Place>(
    evolution: Evolution,
    frames: u32,
    mut seen: impl FnMut(&Answer<R::Si>),
) {
    let Some(scene) = M::scene::<R>() else { return };
    let solver = Solver::new(scene, evolution);
    let mut walk = Walk::new();
    let mut see = |state: &State<R>, output| {
        seen(&Answer {
            output,
            wrench: solver.wrench(state),
            contacts: solver.contacts(state),
        });
    };
    let (mut state, output) = solver.start(walk.sample());
    see(&state, output);
    for _ in 1..frames {
        let output = solver.step(&mut state, walk.sample());
        see(&state, output);
    }
}
