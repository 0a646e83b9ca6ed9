//! Changes the board's settings while samples are sent to it.

use super::audience::Audience;
use super::error::BoardError;
use super::session::Session;
use super::setup::Setup;
use super::steps::Steps;
use super::stream::Stream;

/// A request to change the board's settings.
#[derive(Debug)]
pub(super) struct Wish {
    pub(super) setup: Setup,
    /// The body begins at its start.
    pub(super) anew: bool,
}

impl<A: Audience> Stream<'_, A> {
    /// The board changes its settings, or refuses to. Its earlier messages are reported before the answer, its later ones after
    /// it.
    pub(super) fn grant(&mut self, session: &mut Session, wish: Wish) -> Result<(), BoardError> {
        let Wish { setup, anew } = wish;
        let with = (&self.about, &mut self.mail);
        let result = setup.change(&self.setup, anew, session, with);
        for heard in std::mem::take(&mut session.before_answer) {
            self.take(session, heard)?;
        }
        if result.is_ok() {
            self.indices = setup.indices(&self.about);
            self.setup = setup;
            if anew {
                self.feed.drop_waiting();
                // They belong to the previous run.
                self.flight.give_up();
                self.steps = Steps::default();
            }
        }
        self.audience.answer(result)?;
        for heard in std::mem::take(&mut session.after_answer) {
            self.take(session, heard)?;
        }
        Ok(())
    }
}
