//! Convex shapes, vertices counter-clockwise (m): sides, normals, and the distance between two shapes (one vertex: a point, two:
//! a segment with two sides).

use crate::vector::{Vec2, distance, dot, length, scaled, sub};

/// The number of sides of a shape: none for a point, two for a segment.
pub(crate) fn sides(shape: &[Vec2]) -> usize {
    if shape.len() < 2 { 0 } else { shape.len() }
}

/// The vertices at the ends of a side.
pub(crate) fn ends(shape: &[Vec2], side: usize) -> [Vec2; 2] {
    [shape[side], shape[(side + 1) % shape.len()]]
}

/// The unit normal of a side, pointing out of the shape.
pub(crate) fn outward(shape: &[Vec2], side: usize) -> Vec2 {
    let [from, to] = ends(shape, side);
    let [x, y] = sub(to, from);
    scaled([y, -x], 1.0 / length([x, y]))
}

/// The vertices before and after a vertex; none for a point.
pub(crate) fn neighbours(shape: &[Vec2], index: usize) -> impl Iterator<Item = Vec2> + '_ {
    let count = shape.len();
    let places = [(index + 1) % count, (index + count - 1) % count];
    places
        .into_iter()
        .filter(move |_| count > 1)
        .map(|k| shape[k])
}

/// The largest gap along the axes of both shapes: if negative, the depth of one in the other; if positive, at most their distance.
pub(crate) fn separation(a: &[Vec2], b: &[Vec2]) -> f64 {
    if let ([a], [b]) = (a, b) {
        return distance(*a, *b);
    }
    beyond(a, b).max(beyond(b, a))
}

/// The largest gap along the axes of the first shape.
fn beyond(shape: &[Vec2], other: &[Vec2]) -> f64 {
    let along = |at: Vec2, way: Vec2| {
        let gaps = other.iter().map(|&point| dot(way, sub(point, at)));
        gaps.fold(f64::INFINITY, f64::min)
    };
    let mut most = f64::NEG_INFINITY;
    for side in 0..sides(shape) {
        let normal = outward(shape, side);
        most = most.max(along(shape[side], normal));
        if shape.len() == 2 {
            // A segment also has an axis along itself.
            most = most.max(along(shape[side], [normal[1], -normal[0]]));
        }
    }
    most
}

/// The distance between two segments, either of which may be a point (m).
pub(crate) fn gap_of_segments(a: [Vec2; 2], b: [Vec2; 2]) -> f64 {
    let to_segment = |point: Vec2, [from, to]: [Vec2; 2]| {
        let along = sub(to, from);
        let square = dot(along, along);
        let part = if square > 0.0 {
            (dot(sub(point, from), along) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        distance(
            point,
            [from[0] + part * along[0], from[1] + part * along[1]],
        )
    };
    let ends = [
        to_segment(a[0], b),
        to_segment(a[1], b),
        to_segment(b[0], a),
        to_segment(b[1], a),
    ];
    let nearest = ends.into_iter().fold(f64::INFINITY, f64::min);
    if cross_each_other(a, b) { 0.0 } else { nearest }
}

fn cross_each_other([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    let side = |from: Vec2, to: Vec2, point: Vec2| {
        let [x, y] = sub(to, from);
        dot([-y, x], sub(point, from))
    };
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::{gap_of_segments, neighbours, separation};

    const BOX: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];

    #[test]
    fn separation_is_depth_inside_and_distance_along_an_axis_outside() {
        let at = |x: f64, y: f64| separation(&BOX, &[[x, y]]);
        assert_eq!(at(1.0, 0.75), -0.25);
        assert_eq!(at(1.0, 1.5), 0.5);
        assert_eq!(at(3.0, 1.5), 1.0);
        let wall = [[-1.0, 0.5], [0.25, 0.5]];
        assert_eq!(separation(&BOX, &wall), -0.25);
        // A wall has ends: a point beyond an end is apart from it, even on its line.
        assert_eq!(separation(&wall, &[[1.0, 0.5]]), 0.75);
        assert_eq!(separation(&wall, &[[0.0, 0.25]]), 0.25);
        assert_eq!(separation(&[[0.0, 3.0]], &[[4.0, 0.0]]), 5.0);
    }

    #[test]
    fn distances_of_segments() {
        let cross = gap_of_segments([[-1.0, 0.0], [1.0, 0.0]], [[0.0, -1.0], [0.0, 1.0]]);
        assert_eq!(cross, 0.0);
        let point = gap_of_segments([[3.0, 4.0]; 2], [[-1.0, 0.0], [0.0, 0.0]]);
        assert_eq!(point, 5.0);
        assert_eq!(neighbours(&[[0.0; 2]], 0).count(), 0);
    }
}
