//! Publishes the results of a tick: the newest record, and the state if it has changed.

use stiction_live::outbound::{Downloadable, Status};
use stiction_live::replay::Recorded as _;

use super::engine::Engine;
use super::recording::LiveRecording;

impl Engine {
    /// Publishes new results, and sends the answers that wait for them.
    pub(super) fn publish(&mut self) {
        if self.live.changed {
            let status = self.status();
            self.live.tell(&status);
        }
        let board = self.board.as_ref().map(|board| board.fares);
        let mut pending = std::mem::take(&mut self.live.pending);
        let live = &self.live;
        let feed = &self.surroundings.feed;
        feed.show(&mut pending, &mut self.offered, || live.latest(board));
        self.live.pending = pending;
        if self.live.pending.is_shown() {
            for (reply, result) in self.answers.drain(..) {
                reply.send(result);
            }
        }
    }

    fn status(&self) -> Status {
        let recorded = self.recorded.as_ref().map(|recording| Downloadable {
            seconds: recording.seconds(),
            frames: recording.count(),
            file: recording.place().display().to_string(),
            earlier: recording.is_earlier,
            problem: recording.problem.clone(),
        });
        let file = self.recording.as_ref().map(LiveRecording::place);
        let file = file.map(|place| place.display().to_string());
        Status {
            recording: self.recording.as_ref().map(LiveRecording::seconds),
            recording_file: file,
            recorded,
            ..self.live.status(self.board.is_none())
        }
    }
}
