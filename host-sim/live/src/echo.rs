//! Values that a client sent with its samples, returned with the frame that contains them: immediately, or when a board has
//! answered.

use std::collections::VecDeque;

use serde_json::Number as JsonNumber;

/// Largest number of samples that a board has not answered.
const MOST_MOVED: usize = 64;

/// A client, and the value it sent with a sample.
pub type Echo = (u32, JsonNumber);

/// The echoes not yet returned.
#[derive(Clone, Debug, Default)]
pub struct Echoes {
    /// Of the newest sample, which has not moved the hand yet.
    said: Option<Echo>,
    /// Echoes and times (s) of movements of the hand that the board has not answered.
    moved: VecDeque<(Echo, f64)>,
    shown: Option<Echo>,
}

impl Echoes {
    /// Takes the echo of a sample; none if its client does not want one.
    pub fn say(&mut self, echo: Option<Echo>) {
        self.said = echo;
    }

    /// Notes that the hand and the body have moved to the newest sample.
    pub fn move_now(&mut self) {
        self.shown = self.said.take().or(self.shown.take());
    }

    /// Notes that the hand moves at a time (s), which a board will answer.
    pub fn move_at(&mut self, t: f64) {
        if let Some(echo) = self.said.take()
            && self.moved.len() < MOST_MOVED
        {
            self.moved.push_back((echo, t));
        }
    }

    /// Notes that the board has answered the hand of a time (s).
    pub fn answer(&mut self, answered: f64) {
        while let Some((_, t)) = self.moved.front()
            && *t <= answered
        {
            self.shown = self.moved.pop_front().map(|(echo, _)| echo);
        }
    }

    /// Returns the echo in the newest frame.
    pub const fn shown(&self) -> &Option<Echo> {
        &self.shown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn echo(n: u32) -> Echo {
        (1, n.into())
    }

    #[test]
    fn an_echo_waits_for_the_answer_to_its_hand() {
        let mut echoes = Echoes::default();
        for (n, t) in [(1, 0.001), (2, 0.002), (3, 0.004)] {
            echoes.say(Some(echo(n)));
            assert_eq!(*echoes.shown(), None);
            echoes.move_at(t);
        }
        echoes.answer(0.0005);
        assert_eq!(*echoes.shown(), None);
        echoes.answer(0.003);
        assert_eq!(*echoes.shown(), Some(echo(2)));
        echoes.answer(0.004);
        assert_eq!(*echoes.shown(), Some(echo(3)));
    }

    #[test]
    fn without_a_board_an_echo_waits_for_the_tick() {
        let mut echoes = Echoes::default();
        echoes.say(Some(echo(1)));
        assert_eq!(*echoes.shown(), None);
        echoes.move_now();
        echoes.move_now();
        assert_eq!(*echoes.shown(), Some(echo(1)));
    }
}
