//! The size of 1 inside the solver, where lengths are in units of L, forces of k_h L and moments of k_h L² (STATICS 10): conversion from SI
//! units and back.

use crate::geometry::Vec2;
use crate::real::Real;

/// The size of 1 inside the solver, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units<F> {
    /// L (m)
    length: F,
    /// k_h L (N)
    force: F,
    /// k_h L² (N·m)
    moment: F,
    /// 1/L (1/m)
    per_length: F,
}

impl<F: Real> Units<F> {
    pub(crate) fn new(length: F, stiffness_translation: F) -> Self {
        let force = stiffness_translation * length;
        Self {
            length,
            force,
            moment: force * length,
            per_length: F::ONE / length,
        }
    }
    /// Returns whether they are neither too large nor too small to divide by.
    pub(crate) fn are_usable(&self) -> bool {
        let usable = |unit: F| unit.is_finite() && unit > F::ONE / F::HUGE;
        usable(self.length) && usable(self.force) && usable(self.moment)
    }
    /// A length in metres made non-dimensional.
    pub(crate) fn length_from_si<R: Real<Si = F>>(&self, x: F) -> R {
        R::from_si(x, self.per_length)
    }
    /// A point in metres made non-dimensional.
    pub(crate) fn point_from_si<R: Real<Si = F>>(&self, [x, y]: [F; 2]) -> Vec2<R> {
        Vec2::new(self.length_from_si(x), self.length_from_si(y))
    }
    /// A force in newtons made non-dimensional.
    pub(crate) fn force_from_si<R: Real<Si = F>>(&self, x: F) -> R {
        R::from_si(x, F::ONE / self.force)
    }
    /// A moment in newton metres made non-dimensional.
    pub(crate) fn moment_from_si<R: Real<Si = F>>(&self, x: F) -> R {
        R::from_si(x, F::ONE / self.moment)
    }
    /// A length in metres.
    pub(crate) fn length_to_si<R: Real<Si = F>>(&self, x: R) -> F {
        x.to_si(self.length)
    }
    /// A point in metres.
    pub(crate) fn point_to_si<R: Real<Si = F>>(&self, v: Vec2<R>) -> [F; 2] {
        [v.x, v.y].map(|x| x.to_si(self.length))
    }
    /// A force in newtons.
    pub(crate) fn force_to_si<R: Real<Si = F>>(&self, x: R) -> F {
        x.to_si(self.force)
    }
    /// A moment in newton metres.
    pub(crate) fn moment_to_si<R: Real<Si = F>>(&self, x: R) -> F {
        x.to_si(self.moment)
    }
}

#[cfg(test)]
mod tests;
