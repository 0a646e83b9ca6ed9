//! Bodies of about size 1, and obstacles: pins, thin walls, boxes, triangles, pentagons, and combinations of them: steps, tables,
//! holes, corners of two walls.

use super::super::shape::Point;
use crate::draw::Draw;

/// Cosine and sine of an angle that grows with `part`, a full turn from 0 to 4, computed by division alone.
pub(crate) fn circle(part: f64) -> Point {
    let quarter = part.rem_euclid(4.0);
    let t = quarter.fract();
    let (cos, sin) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    match quarter as usize {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// Corners on an ellipse of this size.
fn polygon(draw: &mut Draw, corners: usize, size: f64) -> Vec<Point> {
    let ratio = draw.between(0.3, 1.0);
    let corner = |i: usize| {
        let [cos, sin] = circle(4.0 * (i as f64 + draw.between(-0.3, 0.3)) / corners as f64);
        [0.5 * size * cos, 0.5 * size * ratio * sin]
    };
    (0..corners).map(corner).collect()
}

/// An upright rectangle from its lower left to its upper right corner.
fn block([x, y]: Point, [right, top]: Point) -> Vec<Point> {
    vec![[x, y], [right, y], [right, top], [x, top]]
}

/// A point, a rod, a box, a triangle or a pentagon.
pub(crate) fn body(draw: &mut Draw) -> Vec<Point> {
    match draw.below(6) {
        0 => vec![[0.0, 0.0]],
        1 => vec![[-0.5, 0.0], [0.5, 0.0]],
        2 => polygon(draw, 3, 1.0),
        3 => polygon(draw, 5, 1.0),
        _ => {
            let (width, height) = (0.45, draw.between(0.05, 0.4));
            block([-width, -height], [width, height])
        }
    }
}

/// Obstacles that belong together, somewhere around the origin.
pub(crate) fn group(draw: &mut Draw, body: &[Point]) -> Vec<Vec<Point>> {
    let size = draw.one(&[0.3, 1.0, 2.0]) * draw.between(0.7, 1.4);
    let pieces = match draw.below(9) {
        0 => vec![vec![[0.0, 0.0]]],
        1 => vec![vec![[-0.5 * size, 0.0], [0.5 * size, 0.0]]],
        2 => vec![block([-0.5 * size, -0.5 * size], [0.5 * size, 0.0])],
        3 => vec![polygon(draw, 3, size)],
        4 => vec![polygon(draw, 5, size)],
        5 => step(draw, size),
        6 => table(size),
        7 => hole(draw, body),
        _ => angle(draw, size),
    };
    let turned = if draw.below(2) == 0 {
        [1.0, 0.0]
    } else {
        circle(draw.between(0.0, 4.0))
    };
    let [x, y] = circle(draw.between(0.0, 4.0));
    let away = draw.between(0.4, 2.0);
    let place = |p: &Point| {
        let [cos, sin] = turned;
        [
            away * x + cos * p[0] - sin * p[1],
            away * y + sin * p[0] + cos * p[1],
        ]
    };
    let placed = |piece: &Vec<Point>| piece.iter().map(place).collect();
    pieces.iter().map(placed).collect()
}

/// Two boxes next to each other, sometimes of the same height: a seam.
fn step(draw: &mut Draw, size: f64) -> Vec<Vec<Point>> {
    let rise = draw.one(&[0.0, 0.1, 0.3]) * size;
    vec![
        block([-size, -0.5 * size], [0.0, 0.0]),
        block([0.0, -0.5 * size], [size, rise]),
    ]
}

/// A board on two legs.
fn table(size: f64) -> Vec<Vec<Point>> {
    vec![
        block([-size, -0.1], [size, 0.0]),
        block([-0.9 * size, -0.8], [-0.8 * size, -0.1]),
        block([0.8 * size, -0.8], [0.9 * size, -0.1]),
    ]
}

/// Two boxes that leave a hole, either slightly or much wider than the body is high.
fn hole(draw: &mut Draw, body: &[Point]) -> Vec<Vec<Point>> {
    let highest = body.iter().map(|p| p[1]).fold(0.0, f64::max);
    let half = (highest * draw.one(&[1.001, 1.02, 1.3])).max(0.02);
    vec![
        block([-half - 0.8, -1.0], [-half, 0.0]),
        block([half, -1.0], [half + 0.8, 0.0]),
    ]
}

/// Two thin walls that meet in a point, or a wall with a pin at its end.
fn angle(draw: &mut Draw, size: f64) -> Vec<Vec<Point>> {
    let [x, y] = circle(draw.between(0.3, 3.7)).map(|x| x * size);
    vec![vec![[0.0, 0.0], [size, 0.0]], vec![[x, y], [0.0, 0.0]]]
}
