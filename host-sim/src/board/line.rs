//! Frames over a link: commands out, the board's messages in, and counts of lost and garbled frames.

use std::time::Instant;

use stiction_wire::{
    Command, Decoder, FaultKind, Faults, Frame, Report, Sequence, frame_bytes, scene_bytes,
    wire_bytes,
};

use super::link::Open;
use super::message::Received;

/// Room for the longest report: forces with 255 contacts.
const LONGEST_REPORT: usize = frame_bytes(7200);
/// Room for the longest command: a scene of 255 vertices, surfaces, obstacles and corners of these.
const LONGEST_COMMAND: usize = wire_bytes(scene_bytes([255; 4]));

#[derive(Debug)]
pub(super) struct Line {
    open: Open,
    begun: Instant,
    sequence: u8,
    decoder: Box<Decoder<LONGEST_REPORT>>,
    order: Sequence,
    /// Frames of the board that did not arrive.
    pub(super) lost: u64,
    pub(super) bytes: u64,
    pub(super) frames: u64,
    /// Received frames of the other direction: the line echoes what is sent.
    pub(super) echoes: u64,
}

impl Line {
    /// `begun`: zero of the clock that is written to the frames.
    pub(super) fn new(open: Open, begun: Instant) -> Self {
        Self {
            open,
            begun,
            sequence: 0,
            decoder: Box::default(),
            order: Sequence::new(),
            lost: 0,
            bytes: 0,
            frames: 0,
            echoes: 0,
        }
    }

    pub(super) const fn link(&self) -> u32 {
        self.open.number()
    }

    /// The sequence number of the next frame.
    pub(super) const fn next_number(&self) -> u8 {
        self.sequence
    }

    pub(super) fn faults(&self) -> &Faults {
        self.decoder.faults()
    }

    /// A 0 before the first frame separates it from preceding noise.
    pub(super) fn wake(&mut self) -> Result<(), String> {
        self.open.write(&[0])
    }

    /// Sends a command; returns its sequence number.
    pub(super) fn send(&mut self, message: Command<'_>) -> Result<u8, String> {
        let number = self.sequence;
        self.sequence = number.wrapping_add(1);
        let frame = Frame {
            sequence: number,
            // Wraps as the format specifies.
            time: self.begun.elapsed().as_micros() as u32,
            message,
        };
        let mut wire = [0; LONGEST_COMMAND];
        match frame.encode(&mut wire) {
            Some(wire) => self.open.write(wire).map(|()| number),
            None => Err("a command is longer than any frame".to_owned()),
        }
    }

    pub(super) fn receive(&mut self, at: Instant, bytes: &[u8]) -> Vec<Received> {
        let mut received = Vec::new();
        self.bytes += bytes.len() as u64;
        for &byte in bytes {
            match self.decoder.push::<Report<'_>>(byte) {
                None => {}
                Some(Ok(frame)) => {
                    self.frames += 1;
                    self.lost += u64::from(self.order.lost_before(frame.sequence));
                    received.push(Received {
                        at,
                        time: frame.time,
                        said: frame.message.into(),
                    });
                }
                Some(Err(fault)) => {
                    let of_client = fault.frame.is_some_and(|frame| frame.code < 0x80);
                    let echo = of_client && fault.kind == FaultKind::UnknownType;
                    self.echoes += u64::from(echo);
                }
            }
        }
        received
    }

    /// Describes what arrived if the expected message did not.
    pub(super) fn what_came(&self) -> String {
        if self.frames > 0 {
            return format!("{} frames came, none of them that", self.frames);
        }
        if self.echoes > 0 {
            return "the line sends back what is sent to it: an echo, no board of this format"
                .to_owned();
        }
        if self.bytes == 0 {
            return "not a single byte came".to_owned();
        }
        let faults: Vec<String> = FaultKind::ALL
            .iter()
            .map(|kind| (kind.name(), self.faults().of(*kind)))
            .filter(|(_, count)| *count > 0)
            .map(|(name, count)| format!("{name} {count}"))
            .collect();
        let why = match faults.is_empty() {
            true => String::new(),
            false => format!(" ({})", faults.join(", ")),
        };
        format!(
            "{} bytes came, no frame among them{why}: perhaps at another rate (--baud), or from another program",
            self.bytes
        )
    }
}
