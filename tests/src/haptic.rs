//! Scenes of ordinary haptic use: convex bodies of 3 to 8 vertices on floors, walls and wedges, moved by a hand at 1 kHz that
//! touches obliquely, presses, drags, turns, lifts and returns. They are the same in every run. SI units, world frame.

pub mod measures;
mod places;
mod strokes;

use crate::draw::{Draw, polygon};
use crate::random::Scenario;
use crate::setup::Setup;
use places::{Place, place};
use strokes::Hand;

/// What varies. An index selects the same body, surroundings and hand in every kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// mu_d is 0.5 to 0.95 of mu_s.
    StickSlip,
    /// mu_d = mu_s
    Equal,
    /// As stick-slip, with a hundredth of its k_theta.
    Soft,
    /// As stick-slip, k_theta = 0.
    Free,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::StickSlip, Self::Equal, Self::Soft, Self::Free];

    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::StickSlip => "stick-slip",
            Self::Equal => "equal",
            Self::Soft => "soft",
            Self::Free => "free",
        }
    }
    fn friction(self, friction_static: f64, ratio: f64) -> [f64; 2] {
        match self {
            Self::Equal => [friction_static; 2],
            _ => [friction_static, friction_static * ratio],
        }
    }
    fn stiffness_rotation(self, ordinary: f64) -> f64 {
        match self {
            Self::StickSlip | Self::Equal => ordinary,
            Self::Soft => ordinary / 100.0,
            Self::Free => 0.0,
        }
    }
}

/// The scenes of a kind, as an endless iterator.
pub fn scenes(kind: Kind) -> impl Iterator<Item = Scenario> {
    (0..).map(move |index| scene(kind, index))
}

/// One scene. Its keyframes are the hand's samples, 1 kHz, 3 to 4 s: `hands(1)` is the run, `hands(3)` the same with every
/// frame cut into three. All numbers are exact in f32, so that every number type runs exactly the same scene.
pub fn scene(kind: Kind, index: u64) -> Scenario {
    let mut draw = Draw::new(index);
    let (corners, size) = (3 + draw.below(6), 0.1 * draw.power(-0.3, 0.3));
    let body = Setup::new(&polygon(&mut draw, corners, size));
    let l = body.size();
    let holding_point = [0.0; 2].map(|_: f64| draw.between(-0.2, 0.2) * l);
    let stiffness = 1000.0 * draw.power(-0.7, 0.3);
    let rotation = stiffness * l * l * draw.power(-1.0, 0.3);
    let weight = draw.one(&[0.0, 0.0, 0.02, 0.1]) * stiffness * l;
    let mut setup = body
        .held_at(holding_point)
        .springs(stiffness, kind.stiffness_rotation(rotation))
        .weighing(weight);
    for Place { normal, offset } in place(&mut draw, l) {
        let (friction_static, ratio) = (draw.between(0.25, 0.7), draw.between(0.5, 0.95));
        setup = setup.surface(normal, offset, kind.friction(friction_static, ratio));
    }
    let hand = Hand::above(draw, &setup);
    let (start, keyframes) = (hand.body(), hand.samples());
    Scenario {
        setup: setup.at(start).rounded::<f32>(),
        keyframes,
    }
}
