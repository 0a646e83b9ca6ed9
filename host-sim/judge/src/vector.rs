//! Vectors of the plane, as pairs; wrenches and twists, as triples.

pub(crate) type Vec2 = [f64; 2];
/// Force and moment / L, or velocity and turn × L.
pub(crate) type Vec3 = [f64; 3];

pub(crate) fn add(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn sub(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn scaled(a: Vec2, factor: f64) -> Vec2 {
    [a[0] * factor, a[1] * factor]
}

pub(crate) fn dot(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// a×b = a_x b_y - a_y b_x
pub(crate) fn cross(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn length(a: Vec2) -> f64 {
    a[0].hypot(a[1])
}

pub(crate) fn distance(a: Vec2, b: Vec2) -> f64 {
    length(sub(a, b))
}

/// R(theta) a
pub(crate) fn turned([x, y]: Vec2, theta: f64) -> Vec2 {
    let (sin, cos) = theta.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// The point at a fraction of the straight path from one pose (x, y, angle) to another.
pub(crate) fn between(from: [f64; 3], to: [f64; 3], part: f64) -> [f64; 3] {
    std::array::from_fn(|k| from[k] + (to[k] - from[k]) * part)
}

pub(crate) fn cross3(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

pub(crate) fn dot3(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn length3(a: Vec3) -> f64 {
    dot3(a, a).sqrt()
}
