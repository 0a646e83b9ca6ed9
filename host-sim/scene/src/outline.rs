//! The outline of a body or of an obstacle: what is wrong with a list of corners that is not a strictly convex polygon in
//! counter-clockwise order, and the polygon that it was probably meant to be.

use std::fmt;

/// A corner that is less than this far from a line (distances of the farthest two corners) is on it: the solver's bound in f32, beyond which it
/// refuses an outline.
const FLAT: f64 = 3.1e-5;

type Point = [f64; 2];

/// The first fault of an outline, with the indices of its corners or of the corners at which its sides begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Two corners at one place.
    Twice(usize, usize),
    /// Two sides that cross: a bow-tie.
    Cross(usize, usize),
    Clockwise,
    /// A corner in a dent.
    Dent(usize),
    /// A corner on the line through its neighbours.
    Line(usize),
}

impl Fault {
    /// The corner at which it is; `None` for the whole outline.
    pub(crate) const fn corner(self) -> Option<usize> {
        match self {
            Self::Twice(_, i) | Self::Cross(i, _) | Self::Dent(i) | Self::Line(i) => Some(i),
            Self::Clockwise => None,
        }
    }

    /// What is wrong with a list, whose name is `key`, and what is allowed.
    pub(crate) fn message(self, key: &str) -> String {
        match self {
            Self::Twice(i, k) => format!(
                "`{key}[{k}]` is at the place of `{key}[{i}]`, allowed: a place of its own for each; leave one of them out"
            ),
            Self::Cross(i, k) => format!(
                "the sides that begin at `{key}[{i}]` and at `{key}[{k}]` cross, as in a bow-tie, allowed: a convex polygon; put the corners in order"
            ),
            Self::Clockwise => format!(
                "`{key}` is in clockwise order, allowed: counter-clockwise, as seen with x to the right and y upwards; reverse the list"
            ),
            Self::Dent(i) => format!(
                "`{key}[{i}]` is in a dent, allowed: a convex polygon; leave it out, or divide the shape into convex ones"
            ),
            Self::Line(i) => format!(
                "`{key}[{i}]` is in line with the corners before and after it, allowed: a strictly convex polygon; leave it out"
            ),
        }
    }
}

fn cross([ax, ay]: Point, [bx, by]: Point) -> f64 {
    ax * by - ay * bx
}

fn from_to([ax, ay]: Point, [bx, by]: Point) -> Point {
    [bx - ax, by - ay]
}

fn distance(a: Point, b: Point) -> f64 {
    let [x, y] = from_to(a, b);
    x.hypot(y)
}

/// The largest distance of two corners.
pub(crate) fn size(corners: &[Point]) -> f64 {
    let distances = corners
        .iter()
        .flat_map(|&a| corners.iter().map(move |&b| distance(a, b)));
    distances.fold(0.0, f64::max)
}

/// How far corner `i` is on the right of the line from the corner before it to the one after it: positive in a convex polygon that is
/// counter-clockwise.
fn height(corners: &[Point], i: usize) -> f64 {
    let count = corners.len();
    let [before, at, after] = [count - 1, 0, 1].map(|step| corners[(i + step) % count]);
    match distance(before, after) {
        0.0 => 0.0,
        length => cross(from_to(before, at), from_to(before, after)) / length,
    }
}

/// Whether two sides without a common corner have a common point.
fn do_cross(corners: &[Point], i: usize, k: usize) -> bool {
    let count = corners.len();
    let side = |i: usize| (corners[i], corners[(i + 1) % count]);
    let ((a, b), (c, d)) = (side(i), side(k));
    let turns = |a, b, c| cross(from_to(a, b), from_to(a, c));
    let separates = |a, b, c, d| turns(a, b, c) * turns(a, b, d) < 0.0;
    separates(a, b, c, d) && separates(c, d, a, b)
}

/// The first fault of an outline of finite corners; `None` if it has none that has a name.
pub(crate) fn fault(corners: &[Point]) -> Option<Fault> {
    let count = corners.len();
    let flat = FLAT * size(corners);
    let pairs = || (0..count).flat_map(|i| (i + 1..count).map(move |k| (i, k)));
    if let Some((i, k)) = pairs().find(|&(i, k)| distance(corners[i], corners[k]) <= flat) {
        return Some(Fault::Twice(i, k));
    }
    if count < 3 {
        return None;
    }
    let is_apart = |&(i, k): &(usize, usize)| k > i + 1 && (i + count - k) != 1;
    if let Some((i, k)) = pairs()
        .filter(is_apart)
        .find(|&(i, k)| do_cross(corners, i, k))
    {
        return Some(Fault::Cross(i, k));
    }
    let from = corners[0];
    let areas =
        (1..count - 1).map(|i| cross(from_to(from, corners[i]), from_to(from, corners[i + 1])));
    let turn = areas.sum::<f64>().signum();
    let heights: Vec<f64> = (0..count).map(|i| turn * height(corners, i)).collect();
    if let Some(i) = heights.iter().position(|&height| height < -flat) {
        return Some(Fault::Dent(i));
    }
    if turn < 0.0 {
        return Some(Fault::Clockwise);
    }
    let line = heights.iter().position(|&height| height <= flat);
    line.map(Fault::Line)
}

/// A change that mends an outline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    /// A corner was left out, for this reason.
    Left(usize, &'static str),
    /// The order is the opposite one.
    Reversed,
    /// The corners are in the order of their hull.
    Sorted,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Left(i, why) => write!(f, "corner {i} is left out: {why}"),
            Self::Reversed => write!(f, "the order, which was clockwise, is reversed"),
            Self::Sorted => write!(
                f,
                "the corners, whose sides crossed, are in the order of their hull"
            ),
        }
    }
}

/// The convex polygon of a list of finite corners, and what was changed for it: its hull, counter-clockwise, from the first corner that remains.
/// Corners in one line are a rod, corners at one place a point.
pub(crate) fn repaired(corners: &[Point]) -> (Vec<Point>, Vec<Change>) {
    let flat = FLAT * size(corners);
    let (mut rest, mut changes) = (Vec::new(), Vec::new());
    for (i, corner) in corners.iter().enumerate() {
        match rest
            .iter()
            .any(|&k: &usize| distance(corners[k], *corner) <= flat)
        {
            true => changes.push(Change::Left(i, "it is at the place of another one")),
            false => rest.push(i),
        }
    }
    let hull = hull(corners, &rest, flat);
    let (is_sorted, is_reversed) = (
        follows(&hull, &rest),
        follows(&hull.iter().rev().copied().collect::<Vec<_>>(), &rest),
    );
    for &i in rest.iter().filter(|i| !hull.contains(i)) {
        changes.push(Change::Left(
            i,
            "it is within the hull of the others or on its sides",
        ));
    }
    if !is_sorted && hull.len() > 2 {
        changes.push(if is_reversed {
            Change::Reversed
        } else {
            Change::Sorted
        });
    }
    let first = rest.iter().find_map(|i| hull.iter().position(|k| k == i));
    let mut hull = hull;
    hull.rotate_left(first.unwrap_or(0));
    (hull.into_iter().map(|i| corners[i]).collect(), changes)
}

/// Whether the corners of a hull have the cyclic order of a list.
fn follows(hull: &[usize], list: &[usize]) -> bool {
    let places: Vec<usize> = hull
        .iter()
        .filter_map(|i| list.iter().position(|k| k == i))
        .collect();
    let falls = (0..places.len())
        .filter(|&i| places[i] > places[(i + 1) % places.len()])
        .count();
    falls <= 1
}

/// The corners of the hull, counter-clockwise, without those on its sides.
fn hull(corners: &[Point], among: &[usize], flat: f64) -> Vec<usize> {
    let mut sorted = among.to_vec();
    sorted.sort_by(|&a, &b| {
        corners[a]
            .partial_cmp(&corners[b])
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    if sorted.len() < 3 {
        return among.to_vec();
    }
    let mut chain = half(corners, sorted.iter().copied());
    let upper = half(corners, sorted.iter().rev().copied());
    // Each chain ends where the other one begins.
    chain.pop();
    chain.extend(&upper[..upper.len() - 1]);
    // The flattest corner first: leaving it out changes its neighbours.
    while chain.len() > 2 {
        let outline: Vec<Point> = chain.iter().map(|&i| corners[i]).collect();
        let heights = (0..chain.len()).map(|i| (i, height(&outline, i)));
        let flattest = heights.min_by(|(_, a), (_, b)| a.total_cmp(b));
        match flattest {
            Some((i, height)) if height <= flat => chain.remove(i),
            _ => break,
        };
    }
    chain
}

/// The lower half of the hull of corners in the order of x, by Andrew's monotone chain; in the opposite order, the upper half.
fn half(corners: &[Point], order: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut chain: Vec<usize> = Vec::new();
    for i in order {
        while let [.., a, b] = chain[..]
            && cross(
                from_to(corners[a], corners[b]),
                from_to(corners[a], corners[i]),
            ) <= 0.0
        {
            chain.pop();
        }
        chain.push(i);
    }
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [Point; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    fn with(at: usize, corner: Point) -> Vec<Point> {
        let mut corners = SQUARE.to_vec();
        corners.insert(at, corner);
        corners
    }

    /// Each kind of fault in a square, and the square that comes of it.
    #[test]
    fn each_fault_has_its_name_and_is_mended() {
        let clockwise: Vec<Point> = SQUARE.into_iter().rev().collect();
        let [a, b, c, d] = SQUARE;
        for (corners, expected) in [
            (SQUARE.to_vec(), None),
            (clockwise, Some(Fault::Clockwise)),
            (with(2, [1.0, 0.5]), Some(Fault::Line(2))),
            (with(2, [0.9, 0.5]), Some(Fault::Dent(2))),
            (with(2, [1.0, 0.0]), Some(Fault::Twice(1, 2))),
            (with(4, [0.0, 0.0]), Some(Fault::Twice(0, 4))),
            (vec![a, c, b, d], Some(Fault::Cross(0, 2))),
            (vec![a, b, d, c], Some(Fault::Cross(1, 3))),
        ] {
            assert_eq!(fault(&corners), expected, "{corners:?}");
            let (mended, changes) = repaired(&corners);
            assert_eq!(fault(&mended), None, "{corners:?} {mended:?}");
            assert_eq!(changes.is_empty(), expected.is_none(), "{changes:?}");
            let mut sorted = mended.clone();
            sorted.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
            assert_eq!(sorted, [a, d, b, c], "{corners:?} {mended:?}");
            assert_eq!(mended[0], corners[0], "the first corner remains the first");
        }
    }

    #[test]
    fn what_has_no_area_is_a_rod_or_a_point() {
        let line = [[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]];
        assert_eq!(repaired(&line).0, [[0.0, 0.0], [1.0, 0.0]]);
        assert_eq!(repaired(&[[2.0, 1.0]; 3]).0, [[2.0, 1.0]]);
    }
}
