//! Which samples of the hand are new, according to the sender's count.

/// The classification of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Arrival {
    /// Newer than all before it.
    New,
    /// As old as one that came before, or older: not to be used.
    Late,
}

/// The samples that arrived: counts those that are late and lost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Arrivals {
    last: Option<u16>,
    /// A sample that would be the first of a sender that has restarted its count.
    candidate: Option<u16>,
    /// See [`super::Health`].
    pub late: u32,
    /// See [`super::Health`].
    pub lost: u32,
    /// See [`super::Health`].
    pub restarts: u32,
}

impl Arrivals {
    /// Classifies a sample by the sender's number. Of longer numbers the lower 16 bits suffice.
    ///
    /// A restarted count is accepted only in silence, and with its second sample: a single one could be an old one that
    /// was delayed for a long time.
    pub fn arrive(&mut self, number: u16, silent: bool) -> Arrival {
        let ahead = match self.last {
            None => 1,
            Some(last) => number.wrapping_sub(last),
        };
        if is_ahead(ahead) {
            self.lost = self.lost.saturating_add(u32::from(ahead.saturating_sub(1)));
        } else if silent && self.follows_candidate(number) {
            self.restarts = self.restarts.saturating_add(1);
        } else {
            self.candidate = silent.then_some(number);
            self.late = self.late.saturating_add(1);
            return Arrival::Late;
        }
        self.last = Some(number);
        self.candidate = None;
        Arrival::New
    }

    fn follows_candidate(&self, number: u16) -> bool {
        self.candidate
            .is_some_and(|first| is_ahead(number.wrapping_sub(first)))
    }
}

/// Returns whether a difference of two numbers lies in the future: 1 to 32 767.
fn is_ahead(difference: u16) -> bool {
    (1..0x8000).contains(&difference)
}
