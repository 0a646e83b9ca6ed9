//! The wire: FRAME.md and the code say the same, and no line makes a wrong message of a right one.

mod examples;
mod faulty_line;
mod logitech;
mod malformed;
mod meanings;
mod names;
#[cfg(not(miri))] // It starts another program.
mod other_client;
mod random;
mod round_trip;
mod said;
mod solver_bits;

use stiction_core::frame::{Command, Decoder, Fault, Frame, Message, Report};

/// Room for every frame that there can be: 255 vertices and 255 surfaces.
const LONGEST: usize =
    stiction_core::frame::frame_bytes(stiction_core::frame::scene_bytes(255, 255));
const WIRE: usize = stiction_core::frame::wire_bytes(stiction_core::frame::scene_bytes(255, 255));

/// How often something is tried: so many times, or, in the slow interpreter, a few.
const fn times(count: u32) -> u32 {
    if cfg!(miri) { count / 500 } else { count }
}

/// Of many cases every one, or, in the slow interpreter, one in `of`.
fn sampled<I: Iterator>(all: I, of: usize) -> impl Iterator<Item = I::Item> {
    all.step_by(if cfg!(miri) { of } else { 1 })
}

/// A frame of either direction.
enum Either<'a> {
    Command(Frame<Command<'a>>),
    Report(Frame<Report<'a>>),
}

/// The bytes of a frame on the wire.
fn encoded<'a, M: Message<'a>>(frame: &Frame<M>) -> Vec<u8> {
    let mut wire = [0; WIRE];
    frame.encode(&mut wire).expect("there is room").to_vec()
}

/// What `look` makes of the only frame in these bytes.
fn decoded<T>(wire: &[u8], to_board: bool, look: impl FnOnce(Result<Either<'_>, Fault>) -> T) -> T {
    let (&last, bytes) = wire.split_last().expect("a frame has bytes");
    let mut decoder = Decoder::<LONGEST>::new();
    for &byte in bytes {
        assert!(
            decoder.push::<Command>(byte).is_none(),
            "a frame ends at its delimiter"
        );
    }
    look(if to_board {
        decoder
            .push(last)
            .expect("a delimiter ends a frame")
            .map(Either::Command)
    } else {
        decoder
            .push(last)
            .expect("a delimiter ends a frame")
            .map(Either::Report)
    })
}

/// A raw frame: any head, any payload, a right checksum.
fn sealed(bytes: &[u8]) -> Vec<u8> {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(bytes);
    let frame = [bytes, &crc.to_le_bytes()].concat();
    let mut wire = vec![0; cobs::max_encoding_length(frame.len())];
    let length = cobs::encode(&frame, &mut wire);
    wire.truncate(length);
    wire.push(0);
    wire
}
