//! Points at which a function of one variable changes: its minimum, its crossing, and the angle at which a moment vanishes.

use super::TURN;

/// The first angle, starting at `angle` in the direction of the moment, at which the moment vanishes; `None` if it is farther
/// than `limit`.
pub(super) fn descend(angle: f64, limit: f64, moment: impl Fn(f64) -> f64) -> Option<f64> {
    let way = moment(angle);
    if way == 0.0 {
        return Some(angle);
    }
    let height = |x| way.signum() * moment(x);
    let mut here = angle;
    while (here - angle).abs() <= limit {
        let next = dip(here, here + way.signum() * TURN, height);
        if height(next) <= 0.0 {
            return Some(bisect(here, next, |x| height(x) <= 0.0).1);
        }
        here = next;
    }
    None
}

/// The minimum between `from` and `to` if `height` falls at one end, rises at the other and is not positive at the
/// minimum; `to` otherwise.
pub(super) fn dip(from: f64, to: f64, height: impl Fn(f64) -> f64) -> f64 {
    let at = |part: f64| from + part * (to - from);
    let rises = |part: f64| height(at(part + 1e-3)) > height(at(part));
    if height(to) <= 0.0 || rises(0.0) || !rises(1.0) {
        return to;
    }
    let (bottom, _) = bisect(0.0, 1.0, rises);
    if height(at(bottom)) <= 0.0 {
        at(bottom)
    } else {
        to
    }
}

/// The last point before and the first point after `crossed` becomes true between `low` (false) and `high` (true).
pub(super) fn bisect(mut low: f64, mut high: f64, crossed: impl Fn(f64) -> bool) -> (f64, f64) {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        if crossed(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    (low, high)
}
