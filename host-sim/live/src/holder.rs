//! The holder of the hand: one at a time, the first to send a sample, until it disconnects, lets go, or is silent.

use web_time::{Duration, Instant};

/// Silence after which a holder loses the hand.
const SILENCE: Duration = Duration::from_secs(10);

/// Source of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A client of the socket, by its number.
    Client(u32),
    /// A program that sends OSC.
    Osc,
    /// OpenTrack.
    OpenTrack,
}

impl Source {
    /// Returns its name in the state.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Client(_) => "page",
            Self::Osc => "osc",
            Self::OpenTrack => "opentrack",
        }
    }

    /// Returns the number of the client, if it is one.
    pub const fn client(self) -> Option<u32> {
        match self {
            Self::Client(number) => Some(number),
            Self::Osc | Self::OpenTrack => None,
        }
    }
}

/// The holder of the hand, and the time of its last sample.
#[derive(Clone, Copy, Debug, Default)]
pub struct Holder {
    by: Option<(Source, Instant)>,
}

impl Holder {
    /// Returns the holder.
    pub fn source(&self) -> Option<Source> {
        self.by.map(|(source, _)| source)
    }

    /// Checks that `source` may move the hand: nobody else holds it.
    ///
    /// # Errors
    /// Somebody else holds it.
    pub fn may_lead(&self, source: Source) -> Result<(), String> {
        let Some(other) = self.source().filter(|other| *other != source) else {
            return Ok(());
        };
        Err(match other.client() {
            Some(number) => format!("client {number} holds the hand, allowed: when it lets go"),
            None => format!(
                "{} holds the hand, allowed: 10 s after its last sample",
                other.name()
            ),
        })
    }

    /// Takes a sample of `source` at `now`. Returns the time since its last one if it already holds the hand.
    ///
    /// # Errors
    /// Somebody else holds it.
    pub fn sample(&mut self, source: Source, now: Instant) -> Result<Duration, String> {
        self.may_lead(source)?;
        let last = self.by.replace((source, now));
        Ok(last.map_or(Duration::MAX, |(_, then)| {
            now.saturating_duration_since(then)
        }))
    }

    /// Releases the hand if `source`, which lets go or disconnects, holds it. Returns whether it did.
    pub fn leave(&mut self, source: Source) -> bool {
        let held = self.source() == Some(source);
        if held {
            self.by = None;
        }
        held
    }

    /// Releases the hand if its holder has been silent for too long. Returns whether it did.
    pub fn expire(&mut self, now: Instant) -> bool {
        let silent = |(_, then)| now.saturating_duration_since(then) >= SILENCE;
        let expired = self.by.is_some_and(silent);
        if expired {
            self.by = None;
        }
        expired
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_holds_until_it_leaves_or_is_silent_for_10_seconds() {
        let (mut holder, begun) = (Holder::default(), Instant::now());
        let after = |ms| begun + Duration::from_millis(ms);
        assert!(holder.sample(Source::Client(1), begun).is_ok());
        assert!(holder.sample(Source::Osc, after(5)).is_err());
        let since = holder.sample(Source::Client(1), after(8));
        assert_eq!(since, Ok(Duration::from_millis(8)));
        assert!(!holder.expire(after(10_007)) && holder.expire(after(10_008)));
        assert!(holder.sample(Source::Osc, after(10_009)).is_ok());
        assert!(!holder.leave(Source::Client(1)) && holder.leave(Source::Osc));
        assert_eq!(holder.source(), None);
    }
}
