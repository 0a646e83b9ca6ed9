//! Changes the board's settings while samples are sent to it.

use super::audience::Audience;
use super::error::BoardError;
use super::session::Session;
use super::setup::Setup;
use super::steps::Steps;
use super::stream::Stream;

#[derive(Debug)]
pub(super) struct Request {
    pub(super) setup: Setup,
    /// The body begins at its start.
    pub(super) anew: bool,
}

impl<A: Audience> Stream<'_, A> {
    /// The board changes its settings, or refuses to. Its earlier messages are reported before the answer, its later ones after
    /// it.
    pub(super) fn grant(
        &mut self,
        session: &mut Session,
        request: Request,
    ) -> Result<(), BoardError> {
        let Request { setup, anew } = request;
        let (about, inbox, before) = (&self.about, &mut self.inbox, &self.setup);
        let result = match anew {
            true => setup.send_scene(session, about, inbox),
            false => setup.send_parameters(before, session, inbox),
        };
        let result = result.and_then(|()| setup.send_evolution(before, session, about, inbox));
        for received in std::mem::take(&mut session.before_answer) {
            self.take(session, received)?;
        }
        if result.is_ok() {
            self.indices = setup.indices(&self.about);
            self.setup = setup;
            if anew {
                self.feed.drop_waiting();
                // They belong to the previous run.
                self.pending.give_up();
                self.steps = Steps::of(&self.about.mode);
            }
        }
        self.audience.answer(result)?;
        for received in std::mem::take(&mut session.after_answer) {
            self.take(session, received)?;
        }
        Ok(())
    }
}
