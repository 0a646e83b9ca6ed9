//! A contact as the solver knows it, a pair of a feature of the body and a feature of the surroundings; the lists of contacts and
//! of their reactions.

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
