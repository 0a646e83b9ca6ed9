//! The wire: FRAME.md and the code agree, and no line turns a valid message into a wrong one.

mod examples;
mod faulty_line;
mod logitech;
mod malformed;
mod meanings;
mod names;
mod obstacles;
#[cfg(not(miri))] // It starts a process.
mod other_client;
mod random;
mod round_trip;
mod said;

use stiction_wire::{
    Command, Decoder, Fault, Frame, Message, Report, frame_bytes, scene_bytes, wire_bytes,
};

/// The longest possible payload: 255 vertices, surfaces, obstacles and corners.
const PAYLOAD: usize = scene_bytes([255; 4]);
/// Capacity for every frame.
const LONGEST: usize = frame_bytes(PAYLOAD);
const WIRE: usize = wire_bytes(PAYLOAD);

/// The number of repetitions: `count`, or few in the slow interpreter.
const fn times(count: u32) -> u32 {
    if cfg!(miri) { count / 500 } else { count }
}

/// All cases, or, in the slow interpreter, one in `of`.
fn sampled<I: Iterator>(all: I, of: usize) -> impl Iterator<Item = I::Item> {
    all.step_by(if cfg!(miri) { of } else { 1 })
}

/// A frame in either direction.
enum Either<'a> {
    Command(Frame<Command<'a>>),
    Report(Frame<Report<'a>>),
}

impl Either<'_> {
    fn encoded(&self) -> Vec<u8> {
        match self {
            Self::Command(frame) => encoded(frame),
            Self::Report(frame) => encoded(frame),
        }
    }

    /// Whether it goes to the board.
    fn to_board(&self) -> bool {
        matches!(self, Self::Command(_))
    }
}

/// A frame with a message, the first one of a line.
const fn first<M>(message: M) -> Frame<M> {
    Frame {
        sequence: 0,
        time: 0,
        message,
    }
}

/// The bytes of a frame on the wire.
fn encoded<'a, M: Message<'a>>(frame: &Frame<M>) -> Vec<u8> {
    let mut wire = [0; WIRE];
    frame.encode(&mut wire).expect("there is room").to_vec()
}

/// Header and payload of a frame.
fn bare(wire: &[u8]) -> Vec<u8> {
    let mut raw = wire[..wire.len() - 1].to_vec();
    let length = cobs::decode_in_place(&mut raw).expect("COBS");
    raw.truncate(length - 4);
    raw
}

/// The result of `look` on the only frame in these bytes.
fn decoded<T>(wire: &[u8], to_board: bool, look: impl FnOnce(Result<Either<'_>, Fault>) -> T) -> T {
    let (&last, bytes) = wire.split_last().expect("a frame has bytes");
    let mut decoder = Decoder::<LONGEST>::new();
    for &byte in bytes {
        assert!(
            decoder.push::<Command>(byte).is_none(),
            "a frame ends at its delimiter"
        );
    }
    let end = "a delimiter ends a frame";
    look(if to_board {
        decoder.push(last).expect(end).map(Either::Command)
    } else {
        decoder.push(last).expect(end).map(Either::Report)
    })
}

/// A raw frame: any header, any payload, a valid checksum.
fn sealed(bytes: &[u8]) -> Vec<u8> {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(bytes);
    let frame = [bytes, &crc.to_le_bytes()].concat();
    let mut wire = vec![0; cobs::max_encoding_length(frame.len())];
    let length = cobs::encode(&frame, &mut wire);
    wire.truncate(length);
    wire.push(0);
    wire
}
