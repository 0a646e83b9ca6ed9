//! What is compared: a solver as a black box, from a scene and hand poses to frames. SI units, world frame.

use crate::case::Case;
use std::time::Duration;
use stiction_core::Fixed;
use stiction_judge::{Bounds, Frame, Scene};
use stiction_tests::laws;
use stiction_tests::obstacles::Among;
use stiction_tests::obstacles::guard::{Outcome, within};

/// A run is given up after this.
const PATIENCE: Duration = Duration::from_secs(60);

/// A run of a solver through one scene. Hands are x, y (m), phi (rad).
pub trait Subject {
    /// The first answer, with the hand at its first pose.
    fn start(&mut self, hand: [f64; 3]) -> Frame;
    /// The answer to the next pose of the hand.
    fn step(&mut self, hand: [f64; 3]) -> Frame;
}

/// A run, or why a scene is refused.
pub type Made = Result<Box<dyn Subject>, String>;

/// A number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// `f64`
    F64,
    /// `f32`
    F32,
    /// [`Fixed`]
    Fixed,
}

impl Digits {
    /// The judge's bounds.
    pub const fn bounds(self) -> Bounds {
        match self {
            Self::F64 => laws::bounds::<f64>(),
            Self::F32 => laws::bounds::<f32>(),
            Self::Fixed => laws::bounds::<Fixed>(),
        }
    }

    /// The judge's scene. Obstacles are not rounded to the number type, so that sides in one plane stay there.
    pub fn judged(self, among: &Among) -> Scene {
        match self {
            Self::F32 | Self::Fixed if among.obstacles.is_empty() => among.judged::<f32>(),
            _ => among.judged::<f64>(),
        }
    }

    /// Poses that are closer than this are equal, in L and rad: far below what is felt, far above rounding that has gone through a slip.
    pub const fn equal(self) -> f64 {
        match self {
            Self::F64 => 1e-6,
            Self::F32 | Self::Fixed => 1e-3,
        }
    }
}

/// A solver in a number type.
#[derive(Clone, Copy, Debug)]
pub struct Solver {
    /// What it is called on the command line.
    pub name: &'static str,
    /// Its number type.
    pub digits: Digits,
    /// A run through a scene, or why the solver refuses the scene.
    pub make: fn(&Among) -> Made,
}

impl Solver {
    pub(crate) const fn new(name: &'static str, digits: Digits, make: fn(&Among) -> Made) -> Self {
        Self { name, digits, make }
    }

    /// All frames of a case, the first one at the hand's first pose, one second apart; or why there are none: refused, a panic, too slow.
    ///
    /// # Errors
    /// The reason in words.
    pub fn run(self, case: &Case) -> Result<Vec<Frame>, String> {
        let case = case.clone();
        let whole = move || {
            let mut subject = (self.make)(&case.among)?;
            let mut frames = Vec::with_capacity(case.hands.len());
            for (i, &hand) in case.hands.iter().enumerate() {
                let mut frame = match i {
                    0 => subject.start(hand),
                    _ => subject.step(hand),
                };
                frame.t = i as f64;
                frames.push(frame);
            }
            Ok(frames)
        };
        match within(PATIENCE, whole) {
            Outcome::Done(frames) => frames,
            Outcome::Panic(words) => Err(format!("panic: {words}")),
            Outcome::Late => Err("too slow".to_owned()),
        }
    }
}
