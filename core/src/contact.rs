//! A contact as the solver knows it, a pair of a feature of the body and a feature of the surroundings; the lists of contacts and
//! of their reactions.

use crate::real::Real;
use heapless::Vec;

/// At most this many contacts at once; further ones are not reported.
pub const MAX_CONTACTS: usize = 8;

/// A contact: a feature of the body on a feature of the surroundings; here a vertex on a half-plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Pair {
    pub(crate) vertex: u8,
    pub(crate) surface: u8,
}

pub(crate) type Pairs = Vec<Pair, MAX_CONTACTS>;

/// Reactions as (N, T), in the order of the contacts.
pub(crate) type Reactions<R> = Vec<[R; 2], MAX_CONTACTS>;

/// Whether the contacts of a body stick or slide with the hand: the memory of friction, one for all of them (STATICS 7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Regime<R> {
    /// They stick: with stiction up to mu_s N, without it up to mu_d N.
    Stick { stiction: bool },
    /// They slide at mu_d N: one vertex or an edge along sign·t, two contacts in the sense of that sign of their twist.
    Slide(R),
}

impl<R: Real> Regime<R> {
    /// How a contact begins.
    pub(crate) const LOOSE: Self = Self::Stick { stiction: false };

    /// The contacts stick, and mu_s bounds their friction.
    pub(crate) fn has_stiction(self) -> bool {
        self == Self::Stick { stiction: true }
    }

    /// The sign of a slide.
    pub(crate) fn slide(self) -> Option<R> {
        match self {
            Self::Slide(sign) => Some(sign),
            Self::Stick { .. } => None,
        }
    }

    /// At the end of a slip, or after a jump, along sign·t: what presses hard enough sticks, the rest slides on (rule 4).
    pub(crate) fn after_slip(sticks: bool, sign: R) -> Self {
        if sticks {
            Self::Stick { stiction: true }
        } else {
            Self::Slide(sign)
        }
    }
}
