//! Which samples of the hand are new, by the sender's count.

/// What a sample is.
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
    /// A sample that would be the first of a sender that counts anew.
    candidate: Option<u16>,
    /// See [`super::Health`].
    pub late: u32,
    /// See [`super::Health`].
    pub lost: u32,
    /// See [`super::Health`].
    pub restarts: u32,
}

impl Arrivals {
    /// A sample with the sender's number has come. Of longer numbers the lower 16 bits will do.
    ///
    /// A sender that counts anew is believed in silence only, and with its second sample: one alone could be an old one
    /// that was long under way.
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

/// A difference of two numbers that is of the future: 1 to 32 767.
fn is_ahead(difference: u16) -> bool {
    (1..0x8000).contains(&difference)
}
