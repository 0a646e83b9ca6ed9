//! Closed rooms: convex cells whose sides are thin walls or boxes that share their corners, sometimes with a wall across. A body inside
//! cannot leave, wherever the hand jumps; whether it has left is decided from the room's sides alone.

use super::scene::{Among, Obstacle, farthest_corner};
use super::shape::{Point, dot, outward, placed, sides, sub};
use super::worlds::{World, friction, pieces};
use crate::draw::Draw;
use crate::setup::Setup;

/// Jumps of the hand in a room.
const JUMPS: usize = 100;
/// The longest jump, in body sizes.
const FARTHEST: f64 = 1e3;
/// The body is at least this far from the walls at the start, in body sizes.
const CLEAR: f64 = 0.02;

/// The room with this number: it lies within `farthest` body sizes of the origin, and so do the ends of the hand's jumps.
pub fn room(number: u64, farthest: f64) -> World {
    let draw = &mut Draw::new(0x4007_0000 + number);
    let body = pieces::body(draw);
    let most = farthest_corner(farthest, Setup::new(&body).size());
    let (start, cell, walls) = loop {
        let start = [0.0, 0.0, draw.between(-3.0, 3.0)];
        let (cell, walls) = cell(draw);
        let is_whole = walls.iter().flatten().flatten().all(|x| x.abs() <= most);
        if is_whole && -beyond(&cell, &placed(&body, start)) >= CLEAR {
            break (start, cell, walls);
        }
    };
    let kind = draw.below(4);
    let obstacle = |vertices| Obstacle {
        vertices,
        friction: friction(draw, kind),
    };
    let obstacles = walls.into_iter().map(obstacle).collect();
    let weight = draw.one(&[0.0, 0.0, 0.2]);
    let setup = Setup::new(&body)
        .at(start)
        .held_at([draw.between(-0.3, 0.3), draw.between(-0.3, 0.3)])
        .springs(100.0, 100.0 * draw.one(&[0.02, 0.2, 2.0]))
        .weighing(100.0 * weight);
    let [x, y] = setup.grip();
    let mut keyframes = vec![(0, [x, y, start[2]])];
    let most = FARTHEST.min(0.8 * farthest);
    // Mostly far jumps, so that one frame crosses the walls several times.
    let powers = [0.1, 1.0, 0.01 * most, 0.1 * most, most];
    for frame in 1..=JUMPS {
        let far = draw.one(&powers).min(most) * draw.between(0.3, 1.0);
        let [x, y] = pieces::circle(draw.between(0.0, 4.0));
        let turns = draw.one(&[0.0, 0.3, 3.0]);
        let phi = start[2] + turns * draw.between(-1.0, 1.0);
        keyframes.push((frame, [far * x, far * y, phi]));
    }
    World {
        among: Among { setup, obstacles },
        keyframes,
        room: Some(cell),
    }
}

/// How far a body protrudes from a convex cell (m); negative inside.
pub fn beyond(cell: &[Point], body: &[Point]) -> f64 {
    let past = |side: usize| {
        let normal = outward(cell, side);
        let gaps = body.iter().map(|&p| dot(normal, sub(p, cell[side])));
        gaps.fold(f64::NEG_INFINITY, f64::max)
    };
    (0..sides(cell)).map(past).fold(f64::NEG_INFINITY, f64::max)
}

/// A cell around the origin, counter-clockwise, and its walls.
fn cell(draw: &mut Draw) -> (Vec<Point>, Vec<Vec<Point>>) {
    let corners = 3 + draw.below(4);
    let size = draw.one(&[0.8, 1.5, 3.0]) * draw.between(0.9, 1.3);
    let [x, y] = [draw.between(-0.2, 0.2), draw.between(-0.2, 0.2)];
    let corner = |i: usize| {
        let [cos, sin] =
            pieces::circle(4.0 * (i as f64 + draw.between(-0.2, 0.2)) / corners as f64);
        [x + size * cos, y + size * sin]
    };
    let all: Vec<Point> = (0..corners).map(corner).collect();
    let thick = draw.below(2) == 0;
    let side = |i: usize| {
        let (from, to) = (all[i], all[(i + 1) % corners]);
        if thick {
            let out = |p: Point| p.map(|x| 1.5 * x);
            vec![to, from, out(from), out(to)]
        } else {
            vec![from, to]
        }
    };
    let mut walls: Vec<_> = (0..corners).map(side).collect();
    if corners < 5 || draw.below(2) == 0 {
        return (all, walls);
    }
    // A wall from the first corner to the third or to the last but one: the origin is in one of the parts.
    walls.push(vec![all[0], all[2]]);
    let part: Vec<Point> = [0].into_iter().chain(2..corners).map(|i| all[i]).collect();
    (part, walls)
}
