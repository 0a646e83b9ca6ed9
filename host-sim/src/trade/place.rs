//! The places where a cost is counted: this computer, in ns, and the emulated chips, in instructions or cycles.

use super::chip::Chip;
use super::cost::Cost;
use super::measure::Row;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// On this computer, ns.
    Host,
    /// On an emulated chip (of [`Chip::ALL`]), in its [`unit`](Chip::unit).
    Chip(usize),
}

impl Place {
    pub(super) fn all() -> impl Iterator<Item = Self> {
        let chips = (0..Chip::ALL.len()).map(Self::Chip);
        std::iter::once(Self::Host).chain(chips)
    }

    /// All places for which rows have a cost.
    pub(super) fn of(rows: &[Row]) -> Vec<Self> {
        let counted = |place: &Self| rows.iter().any(|row| place.cost(&row.cost).is_some());
        Self::all().filter(counted).collect()
    }

    /// The name for a reader.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Host => "this computer",
            Self::Chip(k) => Chip::ALL[k].name(),
        }
    }

    pub(super) fn stem(self) -> &'static str {
        match self {
            Self::Host => "host",
            Self::Chip(k) => Chip::ALL[k].key(),
        }
    }

    pub(super) fn pictures(self) -> [String; 2] {
        ["svg", "png"].map(|extension| format!("{}.{extension}", self.stem()))
    }

    pub(super) fn unit(self) -> &'static str {
        match self {
            Self::Host => "ns",
            Self::Chip(k) => Chip::ALL[k].unit(),
        }
    }

    /// Per frame, mean.
    pub(super) fn cost(self, cost: &Cost) -> Option<f64> {
        match self {
            Self::Host => Some(cost.host),
            Self::Chip(k) => cost.emulated[k].map(|counted| counted.mean),
        }
    }

    /// Of the worst frame, if known.
    pub(super) fn worst(self, cost: &Cost) -> Option<u32> {
        match self {
            Self::Host => None,
            Self::Chip(k) => cost.emulated[k].map(|counted| counted.worst),
        }
    }
}
