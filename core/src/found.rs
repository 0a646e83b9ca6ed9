//! What was found on a window.

use crate::ending::Ending;
use crate::real::Real;

/// The findings on a window.
pub(crate) struct Found<R> {
    /// Where the first crossing is estimated, and what crosses first in the order of the functions.
    pub(crate) cross: R,
    pub(crate) crossing: Option<Ending>,
    /// What is zero at the end, or at a last Newton step from it.
    pub(crate) hit: Option<(Ending, R)>,
    pub(crate) unsure: bool,
    /// What part of the window would be certain by its bounds.
    pub(crate) part: R,
}

impl<R: Real> Found<R> {
    pub(crate) const NONE: Self = Self {
        cross: R::HUGE,
        crossing: None,
        hit: None,
        unsure: false,
        part: R::ONE,
    };
    /// What the shortest window ends with: a touch first, since it is made good nowhere else.
    pub(crate) fn ending(&self) -> Ending {
        let hit = self.hit.map(|(ending, _)| ending);
        let both = [self.crossing, hit];
        let mut touches = both
            .into_iter()
            .flatten()
            .filter(|ending| ending.is_touch());
        touches
            .next()
            .or(self.crossing)
            .or(hit)
            .unwrap_or(Ending::GoesOn)
    }
    /// Something crosses zero, about there. Of two that do on the shortest window the touch counts.
    pub(crate) fn crosses(&mut self, ending: Ending, at: R) {
        self.cross = self.cross.min(at);
        let is_known = |known: Ending| known.is_touch() || !ending.is_touch();
        if !self.crossing.is_some_and(is_known) {
            self.crossing = Some(ending);
        }
    }
    /// Whether an event comes before the one that was found: the other leads beyond it, or they are one and it is a touch, since a contact
    /// more changes nothing of what else is zero there. `at`: its function a step beyond the end of the window, known to `tol`.
    pub(crate) fn is_preceded(&self, by: Ending, tol: R, at: impl Fn(R) -> R) -> bool {
        self.hit.is_none_or(|(ending, dx)| {
            let value = at(dx);
            value < -tol || by.is_touch() && !ending.is_touch() && value <= tol
        })
    }
}
