//! A contact: what touches what, and whether it sticks or slides; and the contacts of a body.

use crate::real::Real;
use core::mem::swap;

/// At most this many contacts at a time; further ones are not reported.
pub const MAX_CONTACTS: usize = 8;

/// What touches what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feature {
    /// V: a vertex of the body on a side of the world.
    Vertex { vertex: u8, side: u8 },
    /// C: a corner of the world on the side of the body that begins at a vertex.
    Corner { corner: u8, body_side: u8 },
}

/// Whether a contact sticks, or slides along its tangent t.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Sense {
    /// It sticks.
    #[default]
    Rests,
    /// It slides along t.
    Plus,
    /// It slides against t.
    Minus,
}

impl Sense {
    /// The sense of a number that is not zero.
    pub(crate) fn of<R: Real>(x: R) -> Self {
        if x > R::ZERO { Self::Plus } else { Self::Minus }
    }
    /// s: 0, 1 or -1
    pub(crate) fn number<R: Real>(self) -> R {
        self.along(R::ONE)
    }
    /// s x
    pub(crate) fn along<R: Real>(self, x: R) -> R {
        match self {
            Self::Rests => R::ZERO,
            Self::Plus => x,
            Self::Minus => -x,
        }
    }
    pub(crate) fn reversed(self) -> Self {
        match self {
            Self::Rests => Self::Rests,
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
        }
    }
    pub(crate) fn slides(self) -> bool {
        self != Self::Rests
    }
    /// Both slide, in different directions.
    pub(crate) fn opposes(self, other: Self) -> bool {
        self.slides() && other.slides() && self != other
    }
    /// 0, 1 or -1
    pub(crate) fn integer(self) -> i8 {
        match self {
            Self::Rests => 0,
            Self::Plus => 1,
            Self::Minus => -1,
        }
    }
}

/// A contact with its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Contact {
    pub(crate) feature: Feature,
    pub(crate) sense: Sense,
}

impl Contact {
    pub(crate) const NONE: Self = Self::at(Feature::Vertex {
        vertex: u8::MAX,
        side: u8::MAX,
    });
    /// One that sticks.
    pub(crate) const fn at(feature: Feature) -> Self {
        Self {
            feature,
            sense: Sense::Rests,
        }
    }
    pub(crate) const fn with(self, sense: Sense) -> Self {
        Self { sense, ..self }
    }
    /// The vertex, if it is one that touches.
    pub(crate) const fn vertex(self) -> Option<u8> {
        match self.feature {
            Feature::Vertex { vertex, .. } => Some(vertex),
            Feature::Corner { .. } => None,
        }
    }
    pub(crate) const fn is_corner(self) -> bool {
        match self.feature {
            Feature::Vertex { .. } => false,
            Feature::Corner { .. } => true,
        }
    }
    /// Two contacts of one vertex: the body can only turn about it.
    pub(crate) fn shares_vertex(self, other: Self) -> bool {
        self.vertex().is_some() && self.vertex() == other.vertex()
    }
    /// Two contacts in one line: on one side of the world, or of the body.
    pub(crate) fn is_in_line(self, other: Self) -> bool {
        match (self.feature, other.feature) {
            (Feature::Vertex { side, .. }, Feature::Vertex { side: of_other, .. }) => {
                side == of_other
            }
            (
                Feature::Corner { body_side, .. },
                Feature::Corner {
                    body_side: of_other,
                    ..
                },
            ) => body_side == of_other,
            (Feature::Vertex { .. }, Feature::Corner { .. })
            | (Feature::Corner { .. }, Feature::Vertex { .. }) => false,
        }
    }
}

/// The contacts of a body, the one that places it first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Contacts {
    list: [Contact; MAX_CONTACTS],
    count: u8,
}

impl Contacts {
    pub(crate) const NONE: Self = Self {
        list: [Contact::NONE; MAX_CONTACTS],
        count: 0,
    };
    #[inline]
    pub(crate) fn len(&self) -> usize {
        usize::from(self.count)
    }
    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }
    #[inline]
    pub(crate) fn as_slice(&self) -> &[Contact] {
        let count = self.len().min(MAX_CONTACTS);
        self.list.get(..count).unwrap_or(&[])
    }
    #[inline]
    pub(crate) fn iter(&self) -> impl Iterator<Item = Contact> + Clone + '_ {
        self.as_slice().iter().copied()
    }
    /// Contact i; none if there are fewer.
    #[inline]
    pub(crate) fn get(&self, i: usize) -> Contact {
        self.as_slice().get(i).copied().unwrap_or(Contact::NONE)
    }
    #[inline]
    pub(crate) fn first(&self) -> Contact {
        self.get(0)
    }
    /// The first two.
    #[inline]
    pub(crate) fn pair(&self) -> [Contact; 2] {
        [self.get(0), self.get(1)]
    }
    pub(crate) fn contains(&self, feature: Feature) -> bool {
        self.iter().any(|c| c.feature == feature)
    }
    /// Adds a contact that sticks, if there is room for it.
    pub(crate) fn add(&mut self, feature: Feature) {
        self.push(Contact::at(feature));
    }
    /// Adds a contact with its sign, if there is room for it.
    pub(crate) fn push(&mut self, contact: Contact) {
        if let Some(place) = self.list.get_mut(usize::from(self.count)) {
            *place = contact;
            self.count = self.count.saturating_add(1);
        }
    }
    /// Contact i becomes another one.
    pub(crate) fn replace(&mut self, i: usize, contact: Contact) {
        if let Some(place) = self.list.get_mut(i) {
            *place = contact;
        }
    }
    /// Contact i goes, the others keep their order.
    pub(crate) fn remove(&mut self, i: usize) {
        let count = self.len();
        if let Some(rest @ [_, ..]) = self.list.get_mut(i..count) {
            rest.rotate_left(1);
            self.count = self.count.saturating_sub(1);
        }
    }
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }
    /// Contact i becomes the first.
    pub(crate) fn lead(&mut self, i: usize) {
        let count = self.len();
        if let Some([first, others @ ..]) = self.list.get_mut(..count)
            && let Some(other) = i.checked_sub(1).and_then(|i| others.get_mut(i))
        {
            swap(first, other);
        }
    }
    /// Only these remain, in this order.
    pub(crate) fn keep(&mut self, lasting: &[Contact]) {
        self.count = 0;
        for (place, contact) in self.list.iter_mut().zip(lasting) {
            *place = *contact;
            self.count = self.count.saturating_add(1);
        }
    }
    /// All stick.
    pub(crate) fn rest(&mut self) {
        for contact in &mut self.list {
            contact.sense = Sense::Rests;
        }
    }
    /// All slide in this sense.
    pub(crate) fn slide(&mut self, sense: Sense) {
        for contact in &mut self.list {
            contact.sense = sense;
        }
    }
    /// The first two get these senses.
    pub(crate) fn slide_pair(&mut self, senses: [Sense; 2]) {
        for (contact, sense) in self.list.iter_mut().zip(senses) {
            contact.sense = sense;
        }
    }
    /// One contact, or several of one vertex: the body can turn about the first.
    pub(crate) fn turn_about_first(&self) -> bool {
        let first = self.first();
        !self.is_empty() && self.iter().skip(1).all(|c| c.shares_vertex(first))
    }
}
