//! Convex shapes in the plane: a point, a segment or a polygon, counter-clockwise, m.

/// A point or a vector, m.
pub type Point = [f64; 2];

/// a - b
pub fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// a · b
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// |a|
pub fn length(a: Point) -> f64 {
    a[0].hypot(a[1])
}

/// Points of the body frame in the world frame, for a pose x, y (m), theta (rad).
pub fn placed(points: &[Point], [x, y, theta]: [f64; 3]) -> Vec<Point> {
    let (sin, cos) = theta.sin_cos();
    let place = |p: &Point| [x + cos * p[0] - sin * p[1], y + sin * p[0] + cos * p[1]];
    points.iter().map(place).collect()
}

/// The number of sides of a shape: none for a point, two for a segment.
pub fn sides(shape: &[Point]) -> usize {
    if shape.len() < 2 { 0 } else { shape.len() }
}

/// Both ends of a side.
pub(crate) fn ends(shape: &[Point], side: usize) -> [Point; 2] {
    [shape[side], shape[(side + 1) % shape.len()]]
}

/// The outward unit normal of a side.
pub fn outward(shape: &[Point], side: usize) -> Point {
    let [from, to] = ends(shape, side);
    let along = sub(to, from);
    let long = length(along);
    [along[1] / long, -along[0] / long]
}

/// The separation of two convex shapes along the axis that separates them best (m), which is at most their distance; negative if
/// their interiors overlap. For two points, their distance.
pub fn separation(a: &[Point], b: &[Point]) -> f64 {
    if let ([a], [b]) = (a, b) {
        return length(sub(*a, *b));
    }
    beyond(a, b).max(beyond(b, a))
}

/// The largest distance of `other` beyond a side of `shape`, or beyond an end of a segment.
fn beyond(shape: &[Point], other: &[Point]) -> f64 {
    let along = |at: Point, way: Point| {
        let gaps = other.iter().map(|p| dot(way, sub(*p, at)));
        gaps.fold(f64::INFINITY, f64::min)
    };
    let side = |side: usize| {
        let normal = outward(shape, side);
        let past = along(shape[side], normal);
        if shape.len() > 2 {
            return past;
        }
        past.max(along(shape[side], [normal[1], -normal[0]]))
    };
    (0..sides(shape))
        .map(side)
        .fold(f64::NEG_INFINITY, f64::max)
}
