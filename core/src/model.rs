//! Only what a scene requires: the parts of the solver that a scene can do without are left out of the binary, by its
//! type. `V = 1` (a point tool) has no edges, `S = 1` has no state of two surfaces; a [`Model`] leaves out friction or
//! weight.

/// The parts of the solver that a scene may need besides its geometry.
pub trait Model: Clone + core::fmt::Debug + PartialEq + sealed::Sealed + 'static {
    /// Friction: sticking and slipping. Without it every mu is 0, and on a single surface contacts glide.
    const FRICTION: bool;
    /// The body's weight. Without it W is 0.
    const WEIGHT: bool;
}

/// A model with friction, with weight, or without.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts<const FRICTION: bool, const WEIGHT: bool>;

impl<const FRICTION: bool, const WEIGHT: bool> Model for Parts<FRICTION, WEIGHT> {
    const FRICTION: bool = FRICTION;
    const WEIGHT: bool = WEIGHT;
}

/// Everything: friction and weight.
pub type Full = Parts<true, true>;
/// Friction, no weight.
pub type Weightless = Parts<true, false>;
/// Weight, no friction.
pub type Frictionless = Parts<false, true>;
/// Neither friction nor weight.
pub type Bare = Parts<false, false>;

mod sealed {
    pub trait Sealed {}
    impl<const FRICTION: bool, const WEIGHT: bool> Sealed for super::Parts<FRICTION, WEIGHT> {}
}
