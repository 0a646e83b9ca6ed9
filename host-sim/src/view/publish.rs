//! What the engine shows with a tick: the newest record, and the state where it is another one.

use std::sync::Arc;

use super::engine::Engine;
use super::feed::Latest;
use super::recording::Recording;
use super::replay::Replay;
use super::say::{self, By, Recorded, Replayed, Status};

impl Engine {
    /// Shows what is new, and answers whoever waits for that.
    pub(super) fn publish(&mut self) {
        if self.changed {
            let message = say::state(&self.stage, &self.pair, &self.status());
            self.pending.state(message);
            self.changed = false;
        }
        let pair = &self.pair;
        self.feed.show(&mut self.pending, || Latest {
            tick: self.tick,
            frame: Arc::clone(&pair.frame),
            scene: Arc::clone(&pair.setting.scene),
            meter: pair.meter.clone(),
            single: pair.setting.number.is_single(),
            echo: self.echoes.shown().clone(),
            reference: pair.comparison,
            counts: pair.counts,
            slips: Arc::clone(&pair.slips),
            step: self.board.is_none().then(|| self.times.summary()),
            board: self.board.as_ref().map(|board| board.fares),
            position: self.replay.as_ref().map(Replay::position),
        });
        if self.pending.is_shown() {
            for (reply, result) in self.answers.drain(..) {
                reply.send(result);
            }
        }
    }

    fn status(&self) -> Status {
        let hand = match (&self.replay, self.holder.source()) {
            (Some(_), _) => By {
                by: Some("replay"),
                client: None,
            },
            (None, source) => By {
                by: source.map(|source| source.name()),
                client: source.and_then(|source| source.client()),
            },
        };
        let recorded = self.recorded.as_ref().map(|recording| Recorded {
            seconds: recording.seconds(),
            frames: recording.len(),
            file: recording.place().display().to_string(),
            earlier: recording.is_earlier,
            problem: recording.problem.clone(),
        });
        let file = self.recording.as_ref().map(Recording::place);
        let file = file.map(|place| place.display().to_string());
        let replay = self.replay.as_ref().map(|replay| Replayed {
            what: replay.what.clone(),
            seconds: replay.seconds(),
        });
        Status {
            paused: self.paused,
            speed: self.speed,
            recording: self.recording.as_ref().map(Recording::seconds),
            recording_file: file,
            recorded,
            replay,
            hand,
            clients: self.clients,
        }
    }
}
