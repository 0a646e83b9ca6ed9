//! Endpoints a recording, which is then offered, and offers one from before the program was started.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio::sync::mpsc::Sender;

use super::archive::Archive;
use super::engine::{Closing, Engine};
use super::orders::Order;
use super::recording::LiveRecording;
use crate::report;

/// A board answers the last sample of a recording within this time, or not at all.
const LAST_ANSWER: Duration = Duration::from_millis(500);
/// Maximum number of earlier recordings to examine until one can be used.
const TRIED: usize = 4;

/// Finds recordings from before this program was started, however it ended: their number and size, and the newest one that can be
/// used.
pub(super) fn look_back(archive: &Archive, orders: &Sender<Order>) {
    if let Some(stock) = archive.stock() {
        report::print(&format!("{stock}\n"));
    }
    for place in archive.newest_first().into_iter().take(TRIED) {
        match LiveRecording::read(&place) {
            Ok(recording) => {
                // If the program ends meanwhile, nobody needs to know.
                let _ = orders.blocking_send(Order::Earlier(Box::new(recording)));
                return;
            }
            Err(problem) => report::tell(format_args!(
                "{} cannot be replayed: {problem}",
                place.display()
            )),
        }
    }
}

impl Engine {
    /// Records no more ticks; a board's answer to the last one is still recorded.
    pub(super) fn close_recording(&mut self, now: Instant) {
        match self.recording.take() {
            Some(recording) if self.board.is_some() => {
                let until = now + LAST_ANSWER;
                self.closing = Some(Closing { recording, until });
                self.live.changed = true;
            }
            recording => {
                self.recording = recording;
                self.end_recording();
            }
        }
    }

    /// Offers a recording for download.
    pub(super) fn end_recording(&mut self) {
        let closing = self.closing.take().map(|closing| closing.recording);
        if let Some(mut recording) = self.recording.take().or(closing) {
            recording.finish();
            self.tell(recording.farewell());
            let recording = Arc::new(recording);
            self.recorded = Some(Arc::clone(&recording));
            self.offered = Some(recording);
            self.live.changed = true;
        }
    }

    /// Offers an earlier recording, unless there is something newer.
    pub(super) fn offer(&mut self, recording: LiveRecording) {
        if self.recorded.is_some() || self.recording.is_some() || self.closing.is_some() {
            return;
        }
        let (seconds, place) = (recording.seconds(), recording.place().display());
        self.tell(format!("recorded before, {seconds:.3} s: {place}\n"));
        let recording = Arc::new(recording);
        self.recorded = Some(Arc::clone(&recording));
        self.offered = Some(recording);
        self.live.changed = true;
    }

    /// Sends a message to the terminal, for which the engine does not wait.
    pub(super) fn tell(&self, text: String) {
        let _ = self.surroundings.notes.try_send(text);
    }
}
