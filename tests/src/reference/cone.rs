//! Non-negative combinations of wrenches, found by trying every subset: do forces inside the friction cones balance a load?
//! In three dimensions the nearest point of a cone lies on a face spanned by at most three of its edges, so the best of all
//! subsets of up to three edges with non-negative weights is the nearest point.

use super::scene::Screw;

/// The nearest point of a cone: the weight of each edge, and the remaining distance.
pub(super) struct Nearest {
    pub weights: Vec<f64>,
    pub distance: f64,
}

/// The non-negative combination of `edges` nearest to `target`.
pub(super) fn nearest(edges: &[Screw], target: Screw) -> Nearest {
    let mut best = Nearest {
        weights: vec![0.0; edges.len()],
        distance: norm(target),
    };
    let count = edges.len();
    let mut consider = |subset: &[usize]| {
        let chosen: Vec<Screw> = subset.iter().map(|&i| edges[i]).collect();
        let Some((weights, distance)) = least_squares(&chosen, target) else {
            return;
        };
        if distance < best.distance && weights.iter().take(subset.len()).all(|&w| w >= 0.0) {
            best.distance = distance;
            best.weights.fill(0.0);
            subset
                .iter()
                .zip(weights)
                .for_each(|(&i, w)| best.weights[i] = w);
        }
    };
    for a in 0..count {
        consider(&[a]);
        for b in a + 1..count {
            consider(&[a, b]);
            for c in b + 1..count {
                consider(&[a, b, c]);
            }
        }
    }
    best
}

/// Weights of up to three independent `columns` whose combination is nearest to `target`, and the distance; `None` if
/// the columns are dependent.
pub(super) fn least_squares(columns: &[Screw], target: Screw) -> Option<([f64; 3], f64)> {
    let mut basis = [[0.0; 3]; 3];
    let mut triangle = [[0.0; 3]; 3];
    for (j, &column) in columns.iter().enumerate() {
        let mut rest = column;
        for _ in 0..2 {
            for i in 0..j {
                let part = inner(basis[i], rest);
                triangle[i][j] += part;
                rest = minus(rest, times(part, basis[i]));
            }
        }
        triangle[j][j] = norm(rest);
        if triangle[j][j] <= 1e-10 * norm(column) {
            return None;
        }
        basis[j] = times(1.0 / triangle[j][j], rest);
    }
    let mut rest = target;
    let mut weights = [0.0; 3];
    for j in 0..columns.len() {
        weights[j] = inner(basis[j], rest);
        rest = minus(rest, times(weights[j], basis[j]));
    }
    for i in (0..columns.len()).rev() {
        let later: f64 = (i + 1..columns.len())
            .map(|j| triangle[i][j] * weights[j])
            .sum();
        weights[i] = (weights[i] - later) / triangle[i][i];
    }
    Some((weights, if columns.len() == 3 { 0.0 } else { norm(rest) }))
}

pub(super) fn inner(a: Screw, b: Screw) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn norm(a: Screw) -> f64 {
    inner(a, a).sqrt()
}

pub(super) fn times(factor: f64, a: Screw) -> Screw {
    a.map(|x| factor * x)
}

pub(super) fn plus(a: Screw, b: Screw) -> Screw {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn minus(a: Screw, b: Screw) -> Screw {
    plus(a, times(-1.0, b))
}

/// The vector at right angles to both.
pub(super) fn normal_to(a: Screw, b: Screw) -> Screw {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
