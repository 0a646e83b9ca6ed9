//! The first point on a path at which a function reaches a level: where static friction gives way, within the tolerance.

/// Parts into which the path is divided, each halved if the function may reach the level inside.
const PARTS: u32 = 16;
/// Number of halvings.
const HALVINGS: u32 = 44;

/// A function on a path from 0 to 1, minus infinity beyond the point from which it is undefined.
#[derive(Clone, Copy)]
pub(crate) struct Way<'a>(pub(crate) &'a dyn Fn(f64) -> Option<f64>);

/// A point of the path, and the function there.
#[derive(Clone, Copy)]
struct Reading {
    part: f64,
    value: f64,
}

impl Way<'_> {
    pub(crate) fn at(&self, part: f64) -> f64 {
        (self.0)(part).unwrap_or(f64::NEG_INFINITY)
    }

    /// The first point, starting at `begin`, at which the function is at least `level`; otherwise its highest evaluated value.
    pub(crate) fn reaches(&self, level: f64, begin: f64) -> Result<f64, f64> {
        let spot = |part| Reading {
            part,
            value: self.at(part),
        };
        let mut from = spot(begin);
        let mut highest = from.value;
        if highest >= level {
            return Ok(begin);
        }
        for i in 1..=PARTS {
            let part = begin + (1.0 - begin) * f64::from(i) / f64::from(PARTS);
            let to = spot(part);
            if let Some(found) = self.between(level, from, to, HALVINGS) {
                return Ok(found);
            }
            highest = highest.max(to.value);
            from = to;
        }
        Err(highest)
    }

    /// The first such position within a part at whose start the function is below the level. If neither its ends nor its middle reach
    /// the level, the interior is searched if the curvature through these three points could reach it; four times the
    /// curvature, to be safe.
    fn between(&self, level: f64, from: Reading, to: Reading, halvings: u32) -> Option<f64> {
        if from.value == f64::NEG_INFINITY {
            return None;
        }
        let part = f64::midpoint(from.part, to.part);
        if halvings == 0 || part <= from.part || part >= to.part {
            return (to.value >= level).then_some(to.part);
        }
        let value = self.at(part);
        let middle = Reading { part, value };
        let most = from.value.max(value).max(to.value);
        let bend = (from.value - 2.0 * value + to.value).abs();
        if most + bend / 2.0 < level {
            return None;
        }
        let halves = halvings - 1;
        self.between(level, from, middle, halves).or_else(|| {
            if value >= level {
                return Some(part);
            }
            self.between(level, middle, to, halves)
        })
    }

    /// The zero between two points at which the function has different signs.
    pub(crate) fn zero(&self, (mut a, mut b): (f64, f64)) -> f64 {
        let sign = self.at(a).signum();
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(a, b);
            if self.at(middle).signum() == sign {
                a = middle;
            } else {
                b = middle;
            }
        }
        a
    }
}
