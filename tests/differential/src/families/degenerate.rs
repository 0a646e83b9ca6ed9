//! Cases in which rounding decides: far steps of the hand, two level supports, pegs in holes.

use super::{known, ordinary};
use crate::case::Case;
use stiction_tests::draw::Draw;
use stiction_tests::haptic::{Kind, scene};
use stiction_tests::obstacles::{Among, Obstacle};
use stiction_tests::run::polyline;
use stiction_tests::{Number, Setup};

/// Frames of a case with far steps.
const STEPS: usize = 60;
/// The longest of these steps (L), and how far the hand goes from its start, so that every number type represents it.
const LONGEST: f64 = 5.0;

/// Every number of a case is exact in f32.
fn exact(mut case: Case) -> Case {
    case.among = case.among.rounded::<f32>();
    case.twin = case.twin.map(|twin| twin.rounded::<f32>());
    for hand in &mut case.hands {
        *hand = hand.map(f32::rounded);
    }
    case
}

pub(super) fn jumps(seed: u64) -> Option<Case> {
    let kind = [Kind::StickSlip, Kind::Equal][usize::from(seed % 2 == 1)];
    let case = ordinary::of(scene(kind, 1000 + seed));
    Some(jumping(case, seed))
}

pub(super) fn worlds_jumps(seed: u64) -> Option<Case> {
    Some(jumping(ordinary::worlds(1000 + seed)?, seed))
}

/// The hand's first pose, then poses at random distances from the one before.
fn jumping(mut case: Case, seed: u64) -> Case {
    let (mut draw, l) = (Draw::new(0x7a3b + seed), case.among.setup.size());
    let start = case.hands[0];
    let mut hands = vec![start];
    let mut at = start;
    for _ in 0..STEPS {
        let far = draw.power(-2.5, LONGEST.log10());
        let towards = draw.between(-3.15, 3.15);
        let turn = draw.one(&[0.0, 0.1, 1.0]) * draw.between(-1.0, 1.0);
        let to = [
            at[0] + far * l * towards.cos(),
            at[1] + far * l * towards.sin(),
            at[2] + turn,
        ];
        let within = |k: usize, most: f64| to[k].clamp(start[k] - most, start[k] + most);
        at = [within(0, 2.5 * l), within(1, 2.5 * l), within(2, 2.5)];
        hands.push(at);
    }
    case.hands = hands;
    exact(case)
}

pub(super) fn slow(seed: u64) -> Option<Case> {
    if seed % 2 == 1 {
        return ordinary::worlds(5000 + seed);
    }
    let mut case = ordinary::haptic(5000 + seed / 2)?;
    case.hands.truncate(401);
    Some(case)
}

/// A box or plank that lies level on two supports, or hangs close above them.
pub(super) fn supports(seed: u64) -> Option<Case> {
    let draw = &mut Draw::new(0x5e55_0000 + seed);
    let (wide, stiffness) = (0.1 * draw.power(-0.3, 0.3), 1000.0 * draw.power(-0.7, 0.3));
    let high = wide * draw.one(&[0.05, 0.3, 0.6]);
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let setup = Setup::new(&corners.map(|[x, y]: [f64; 2]| [x * wide, y * high]));
    let unit = stiffness * setup.size();
    let above = draw.one(&[0.0, 0.0, 0.02]) * wide;
    let off = draw.one(&[0.0, 0.25]) * draw.between(-1.0, 1.0) * wide;
    let setup = setup
        .at([off, 0.5 * high + above, 0.0])
        .held_at([
            draw.between(-0.25, 0.25) * wide,
            draw.between(-0.3, 0.5) * high,
        ])
        .springs(stiffness, unit * wide * draw.power(-2.0, 0.3))
        .weighing(draw.one(&[0.0, 0.05, 0.2]) * unit);
    let [left, right] = [-1.0, 1.0].map(|side| side * draw.between(0.1, 0.35) * wide);
    let mut obstacles = vec![support(draw, left, wide), support(draw, right, wide)];
    for _ in 0..draw.below(3) {
        let at = draw.one(&[-1.0, 1.0]) * draw.between(0.75, 1.3) * wide;
        let rise = draw.one(&[0.0, 0.1, 0.4]) * wide;
        let Obstacle { vertices, friction } = support(draw, at, wide);
        let vertices = vertices.into_iter().map(|[x, y]| [x, y + rise]).collect();
        obstacles.push(Obstacle { vertices, friction });
    }
    let hands = pressed(draw, &setup, 9, 400);
    Some(exact(Case::new(Among { setup, obstacles }, hands)))
}

/// A post, a pin or a board whose top is at y = 0.
fn support(draw: &mut Draw, at: f64, wide: f64) -> Obstacle {
    let mu = draw.between(0.1, 0.9);
    let friction = [mu, mu * draw.one(&[0.0, 0.5, 0.8, 1.0])];
    let half = draw.one(&[0.0, 0.03, 0.1]) * wide;
    let vertices = if half == 0.0 {
        vec![[at, 0.0]]
    } else {
        let deep = -0.5 * wide;
        vec![
            [at - half, deep],
            [at + half, deep],
            [at + half, 0.0],
            [at - half, 0.0],
        ]
    };
    Obstacle { vertices, friction }
}

/// Straight strokes above y = 0 that press, drag, turn and lift.
fn pressed(draw: &mut Draw, setup: &Setup, strokes: usize, frames: usize) -> Vec<[f64; 3]> {
    let (l, [x, y]) = (setup.size(), setup.grip());
    let sunk = setup.weight / setup.stiffness_translation;
    let mut keyframes = vec![[x, y + sunk, setup.start[2]]];
    for _ in 0..strokes {
        let [fx, _, _] = keyframes[keyframes.len() - 1];
        let along = draw.between(-0.6, 0.6) * draw.one(&[0.0, 1.0, 1.0]) * l;
        let down = draw.one(&[-0.05, 0.02, 0.05, 0.1, 0.15]) * draw.between(0.5, 1.0) * l;
        let turn = draw.one(&[0.0, 0.0, 0.1, 0.6]) * draw.between(-1.0, 1.0);
        let along = (fx + along).clamp(x - 1.2 * l, x + 1.2 * l);
        keyframes.push([along, y + sunk - down, turn]);
    }
    polyline(&keyframes, frames / strokes)
}

/// A peg above a hole with a clearance of 5 to 50 µm on each side; down, and out again.
pub(super) fn pegs(seed: u64) -> Option<Case> {
    let draw = &mut Draw::new(0x9e61_0000 + seed);
    let (wide, high, deep) = (0.02, 0.05, 0.03);
    let half = 0.5 * wide + draw.between(5e-6, 5e-5);
    let mu = draw.between(0.05, 0.5);
    let friction = [mu, mu * draw.one(&[0.5, 0.7, 0.9])];
    let bevel = 0.002;
    let wall = |side: f64| {
        let corners = [
            [0.05, -0.05],
            [0.05, 0.0],
            [half + bevel, 0.0],
            [half, -bevel],
            [half, -0.05],
        ];
        let mut vertices = corners.map(|[x, y]: [f64; 2]| [side * x, y]).to_vec();
        if side < 0.0 {
            vertices.reverse();
        }
        Obstacle { vertices, friction }
    };
    let [x, phi] = [draw.between(-1e-3, 1e-3), draw.between(-8e-3, 8e-3)];
    let stiffness = draw.power(2.5, 3.5);
    let setup = Setup::block(wide, high)
        .at([x, 0.002, phi])
        .held_at([0.0, draw.between(0.3, 1.0) * high])
        .springs(stiffness, stiffness * draw.power(-4.0, -3.0));
    let [x, y] = setup.grip();
    let keyframes = vec![[0.0, x, y, phi], [2.0, x, y - deep, phi], [4.0, x, y, phi]];
    let obstacles = [-1.0, 1.0].map(wall).to_vec();
    Some(Case::along(Among { setup, obstacles }, keyframes, 1000.0))
}

/// The bundled scenes, then pegs.
pub(super) fn strokes(seed: u64) -> Option<Case> {
    known::bundled(seed).or_else(|| pegs(seed.checked_sub(18)?))
}
