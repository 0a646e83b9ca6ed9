//! A contact as the solver knows it, a pair of a feature of the body and a feature of the surroundings; the lists of contacts and of their
//! reactions.

use crate::list::gather;
use crate::real::Real;
use core::array;
use heapless::Vec;

/// At most this many contacts at a time; further ones are not reported.
pub const MAX_CONTACTS: usize = 8;

/// A contact: a feature of the body on a feature of the surroundings. Either a vertex on a surface, which is a half-plane or (numbered
/// after the half-planes) the side of an obstacle that begins at the corner of that index; or such a corner on a side of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Pair {
    /// The vertex; or the side of the body that begins at the vertex of this index, with [`Self::CORNER`] added.
    pub(crate) vertex: u8,
    pub(crate) surface: u8,
}

impl Pair {
    /// Marks a corner on a side of the body.
    const CORNER: u8 = 0x80;
    /// A body among obstacles has no more vertices.
    pub(crate) const MAX_VERTICES: usize = Self::CORNER as usize;

    /// A corner of an obstacle on a side of the body.
    pub(crate) const fn of_corner(corner: u8, body_side: u8) -> Self {
        Self {
            vertex: body_side | Self::CORNER,
            surface: corner,
        }
    }

    /// Returns whether this is a corner of an obstacle on a side of the body.
    pub(crate) const fn is_corner(self) -> bool {
        self.vertex & Self::CORNER != 0
    }

    /// The side of the body that a corner touches.
    pub(crate) const fn body_side(self) -> u8 {
        self.vertex & !Self::CORNER
    }
}

pub(crate) type Pairs = Vec<Pair, MAX_CONTACTS>;

/// Contacts that have just opened, as plain data, two in a word: a state that stores them is copied and compared as quickly as one without.
/// If there are more than six, only the first six are stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Opened([u32; 3]);

impl Opened {
    /// Stands for no contact; no corner has that index as a surface.
    const ABSENT: Pair = Pair {
        vertex: u8::MAX,
        surface: u8::MAX,
    };
    pub(crate) const NONE: Self = Self([u32::MAX; 3]);

    pub(crate) fn of(mut pairs: impl Iterator<Item = Pair>) -> Self {
        Self(array::from_fn(|_| {
            let [a, b] = array::from_fn(|_| pairs.next().unwrap_or(Self::ABSENT));
            u32::from_le_bytes([a.vertex, a.surface, b.vertex, b.surface])
        }))
    }

    pub(crate) fn pairs(self) -> Pairs {
        let both = |two: u32| {
            let [a, on_a, b, on_b] = two.to_le_bytes();
            [(a, on_a), (b, on_b)].map(|(vertex, surface)| Pair { vertex, surface })
        };
        let places = self.0.into_iter().flat_map(both);
        gather(places.filter(|&pair| pair != Self::ABSENT))
    }
}

/// Reactions as (N, T), in the order of the contacts.
pub(crate) type Reactions<R> = Vec<[R; 2], MAX_CONTACTS>;

/// Whether the contacts of a body stick or slide with the hand: the memory of friction, one for all of them (STATICS 7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Regime<R> {
    /// They stick: with stiction up to mu_s N, without it up to mu_d N.
    Stick { stiction: bool },
    /// They slide at mu_d N: one vertex or an edge along sign·t, two contacts along their twist with that sign.
    Slide(R),
}

impl<R: Real> Regime<R> {
    /// The regime in which a contact begins.
    pub(crate) const LOOSE: Self = Self::Stick { stiction: false };

    /// The contacts stick, and mu_s limits their friction.
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

    /// At the end of a slip, or after a jump, along sign·t: a contact that is pressed hard enough sticks, others slide on (rule 4).
    pub(crate) fn after_slip(sticks: bool, sign: R) -> Self {
        if sticks {
            Self::Stick { stiction: true }
        } else {
            Self::Slide(sign)
        }
    }
}
