//! Processes the messages of a board in the engine: frames, the end of a change, its health, its return.

use std::time::Instant;

use super::engine::Engine;
use super::mirror::Mirror;
use super::remote::Remote;
use crate::board::Word;
use stiction_live::record::Frame;

impl Engine {
    pub(super) fn listen(&mut self, now: Instant) -> Result<(), String> {
        while let Some(word) = self.board.as_ref().and_then(Remote::hear) {
            match word {
                Word::Frame(frame) => self.answered(*frame),
                Word::Answer(result) => {
                    if let Some((change, reply)) = self.board.as_mut().and_then(Remote::answered) {
                        let result = result.and_then(|()| self.apply(change));
                        self.answers.push((reply, result));
                    }
                    while let Some((request, reply)) = self.board.as_mut().and_then(Remote::waited)
                    {
                        self.take(request, reply, now);
                    }
                }
                // The board receives the same setting as before: there is nothing to refuse.
                Word::Back => self.apply(self.live.anew(false).into())?,
                Word::Fares(fares) => {
                    if let Some(board) = &mut self.board {
                        board.fares = fares;
                    }
                    self.live.pending.touch();
                }
                Word::End(why) => return Err(why),
            }
        }
        if let Some(closing) = &self.closing
            && now > closing.until
        {
            self.end_recording();
        }
        Ok(())
    }

    fn answered(&mut self, frame: Frame) {
        let closing = self.closing.as_mut().map(|closing| &mut closing.recording);
        if let Some(recording) = self.recording.as_mut().or(closing) {
            recording.answer(&frame);
        }
        if let Some(closing) = &self.closing
            && frame.t >= closing.recording.seconds()
        {
            self.end_recording();
        }
        let live = &mut self.live;
        live.echoes.answer(frame.t);
        let mirror = Mirror::of(&frame, live.pair.present(), &live.pair.setting);
        let hand = mirror.hand;
        live.pair.answered(frame, Box::new(mirror), &hand);
        live.pending.record(&live.pair.frame);
    }
}
