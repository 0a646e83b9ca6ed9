//! Level floors in pieces: tiles that touch, overlap or leave gaps, posts, thin walls, pins, with tops that differ by less than 2^-19 of
//! the body (STATICS 12), in any direction. A box that lies on one moves as on a half-plane, as long as the pieces on both sides of where
//! its load acts support it.

use super::scene::{Among, OBSTACLES, Obstacle};
use super::shape::{Point, placed};
use super::worlds::frame_by_frame;
use crate::draw::Draw;
use crate::setup::Setup;
use std::f64::consts::PI;

/// Frames of a drag.
pub const FRAMES: usize = 400;
/// The body's width and height (m).
const BOX: [f64; 2] = [1.0, 0.6];
/// The largest gap between two pieces (m): less than half of the body, so that it is supported on both sides of its load.
const GAP: f64 = 0.3;
/// The largest difference of tops (m): half of what counts as level.
const DROP: f64 = 1e-6;
/// How deep the hand presses (m).
const DEEP: f64 = 0.2;

/// A box on a floor, and the hand that drags it along.
#[derive(Clone, Debug)]
pub struct Floor {
    /// The floor in pieces.
    pub among: Among,
    /// That box on a half-plane.
    pub whole: Among,
    /// x, y (m), phi (rad) of the hand, frame by frame.
    pub hands: Vec<[f64; 3]>,
}

/// A piece from `x` on, with its top at `y`, and how wide it is.
fn piece(draw: &mut Draw, [x, y]: Point) -> (Vec<Point>, f64) {
    let wide = match draw.below(4) {
        0 => draw.between(0.005, 0.03),
        _ => draw.between(0.1, 0.5),
    };
    let deep = y - draw.between(0.2, 1.0);
    match draw.below(8) {
        0 => (vec![[x, y]], 0.0),
        1 => (vec![[x, deep], [x, y]], 0.0),
        2 => (vec![[x, y], [x + wide, y]], wide),
        _ => {
            let corners = [[x, deep], [x + wide, deep], [x + wide, y], [x, y]];
            (corners.to_vec(), wide)
        }
    }
}

impl Floor {
    /// The floor with this number.
    pub fn of(number: u64) -> Self {
        let draw = &mut Draw::new(0xF100_0000 + number);
        let mu = draw.between(0.05, 0.4);
        let friction = [mu, mu * draw.one(&[1.0, 0.8, 0.5])];
        let is_even = draw.below(3) == 0;
        let (mut pieces, mut x) = (Vec::new(), -0.5 * BOX[0] - draw.between(0.0, 0.5));
        let mut end = x;
        while pieces.len() < OBSTACLES {
            let y = if is_even {
                0.0
            } else {
                -draw.between(0.0, DROP)
            };
            let (corners, wide) = piece(draw, [x, y]);
            pieces.push(corners);
            x += wide;
            end = f64::max(end, x);
            x += match draw.below(3) {
                0 => 0.0,
                1 => draw.between(0.0, GAP),
                _ => -draw.between(0.0, 0.5 * wide),
            };
        }
        // The load stays where pieces are on both sides.
        let along = end - GAP;
        let keys = [(0.0, 0.0), (along, 0.02), (0.3 * along, -0.02)];
        Self::dragged(draw, pieces, friction, keys)
    }

    /// Two blocks side by side, several times as long as the box, which the hand drags from one to the other and tips over: another edge of it
    /// lands far from the block on which it began.
    pub fn of_blocks(number: u64) -> Self {
        let draw = &mut Draw::new(0xB10C_0000 + number);
        let mu = draw.between(0.05, 0.4);
        let friction = [mu, mu * draw.one(&[1.0, 0.8, 0.5])];
        let [left, right] = [draw.between(1.0, 2.0), draw.between(4.5, 5.5)];
        let block = |from: f64, to: f64| vec![[from, -1.0], [to, -1.0], [to, 0.0], [from, 0.0]];
        let joint = draw.between(-0.4, 0.4);
        let mut pieces = vec![block(joint - left, joint), block(joint, joint + right)];
        if draw.below(2) == 0 {
            pieces.reverse();
        }
        let (far, tilt) = (draw.between(2.5, 4.0), draw.between(0.2, 0.6));
        let keys = [(0.0, tilt), (far, tilt), (far - 0.5, -tilt)];
        Self::dragged(draw, pieces, friction, keys)
    }

    /// Pieces in any direction, and where along them the hand presses the box down and drags it to, with its tilt there.
    fn dragged(
        draw: &mut Draw,
        pieces: Vec<Vec<Point>>,
        friction: [f64; 2],
        keys: [(f64, f64); 3],
    ) -> Self {
        let any = draw.between(-1.0, 1.0);
        let angle = draw.one(&[0.0, 0.25, 0.5, 1.0, any]) * PI;
        let turned = |points: &[Point]| placed(points, [0.0, 0.0, angle]);
        let obstacle = |corners: Vec<Point>| Obstacle {
            vertices: turned(&corners),
            friction,
        };
        let obstacles = pieces.into_iter().map(obstacle).collect();
        let pose = |[x, y]: Point, phi: f64| {
            let [x, y] = turned(&[[x, y]])[0];
            [x, y, angle + phi]
        };
        let grip = draw.between(0.0, 0.2);
        let [(from, tilt), ..] = keys;
        // The lower corner of a tilted box is above the floor.
        let height = 0.02 + 0.5 * BOX[0] * tilt.sin().abs();
        let [x, y] = placed(&[[0.0, grip]], [from, height, tilt])[0];
        let setup = Setup::block(BOX[0], BOX[1])
            .at(pose([from, height], tilt))
            .held_at([0.0, grip])
            .springs(1.0, draw.one(&[0.02, 0.2]));
        let [begin, far, back] = keys.map(|(x, tilt)| pose([x, grip - DEEP], tilt));
        let keys = [
            (0, pose([x, y], tilt)),
            (FRAMES / 10, begin),
            (FRAMES * 7 / 10, far),
            (FRAMES, back),
        ];
        let up = turned(&[[0.0, 1.0]])[0];
        Self {
            whole: Among {
                setup: setup.clone().surface(up, 0.0, friction),
                obstacles: Vec::new(),
            },
            among: Among { setup, obstacles },
            hands: frame_by_frame(&keys),
        }
    }
}
