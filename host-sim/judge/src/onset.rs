//! The first point on a path at which a function reaches a level: where static friction gives way, within the tolerance.

/// Parts into which the path is divided, each halved if the function may reach the level inside.
const PARTS: u32 = 16;
/// Number of halvings.
const HALVINGS: u32 = 44;

/// A function on a path from 0 to 1, minus infinity beyond the point from which it is undefined.
#[derive(Clone, Copy)]
pub(crate) struct Way<'a>(pub(crate) &'a dyn Fn(f64) -> Option<f64>);

impl Way<'_> {
    pub(crate) fn at(&self, part: f64) -> f64 {
        (self.0)(part).unwrap_or(f64::NEG_INFINITY)
    }

    /// The first point, starting at `begin`, at which the function is at least `level`; otherwise its highest evaluated value.
    pub(crate) fn reaches(&self, level: f64, begin: f64) -> Result<f64, f64> {
        let mut from = (begin, self.at(begin));
        let mut highest = from.1;
        if highest >= level {
            return Ok(begin);
        }
        for i in 1..=PARTS {
            let part = begin + (1.0 - begin) * f64::from(i) / f64::from(PARTS);
            let to = (part, self.at(part));
            if let Some(found) = self.between(level, from, to, HALVINGS) {
                return Ok(found);
            }
            highest = highest.max(to.1);
            from = to;
        }
        Err(highest)
    }

    /// The first such position within a part at whose start the function is below the level. If neither its ends nor its middle reach
    /// the level, the interior is searched if the curvature through these three points could reach it; four times the
    /// curvature, to be safe.
    fn between(
        &self,
        level: f64,
        (a, at_a): (f64, f64),
        (b, at_b): (f64, f64),
        halvings: u32,
    ) -> Option<f64> {
        if at_a == f64::NEG_INFINITY {
            return None;
        }
        let middle = f64::midpoint(a, b);
        if halvings == 0 || middle <= a || middle >= b {
            return (at_b >= level).then_some(b);
        }
        let at_middle = self.at(middle);
        let most = at_a.max(at_middle).max(at_b);
        let bend = (at_a - 2.0 * at_middle + at_b).abs();
        if most + bend / 2.0 < level {
            return None;
        }
        let halves = halvings - 1;
        self.between(level, (a, at_a), (middle, at_middle), halves)
            .or_else(|| {
                if at_middle >= level {
                    return Some(middle);
                }
                self.between(level, (middle, at_middle), (b, at_b), halves)
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
