//! Bytes as traffic on the wire: for any bytes, the decoders of both sides stay sound, an accepted frame can be sent
//! again and decodes to the same message, and a board ([`crate::station`]) keeps its force within limits.

use crate::station;
use stiction_core::{Axis, Projection};
use stiction_wire::{
    Command, Decoder, Fault, Frame, LogitechDecoder, Message, Report, frame_bytes, scene_bytes,
    wire_bytes,
};

/// The longest possible payload: 255 vertices, surfaces, obstacles and corners.
const PAYLOAD: usize = scene_bytes([255; 4]);
/// Capacity for every frame.
const LONGEST: usize = frame_bytes(PAYLOAD);
const WIRE: usize = wire_bytes(PAYLOAD);
/// Capacity for some frames only.
const SHORT: usize = 40;

/// The first byte selects the meaning of the others. Bit 0: they are pieces, each preceded by its length, that get a checksum and a
/// delimiter and so are valid frames; otherwise they are the raw traffic. Bit 1: the board computes in fixed point. Bit 2: it has
/// capacity for obstacles.
///
/// # Panics
/// If a property is violated.
pub fn wire(bytes: &[u8]) {
    let Some((&kind, rest)) = bytes.split_first() else {
        return;
    };
    let traffic = if kind & 1 == 0 {
        rest.to_vec()
    } else {
        sealed(rest)
    };
    hear::<LONGEST>(&traffic);
    hear::<SHORT>(&traffic);
    track(&traffic);
    station::receives(&traffic, kind & 2 == 0, kind & 4 != 0);
}

/// A board and a client receive the same traffic.
fn hear<const ROOM: usize>(traffic: &[u8]) {
    let (mut board, mut client) = (Decoder::<ROOM>::new(), Decoder::<ROOM>::new());
    let mut faults = [0; 2];
    for &byte in traffic {
        match board.push::<Command>(byte) {
            Some(Ok(frame)) => same_again(&frame, taken_by_board),
            Some(Err(_)) => faults[0] += 1,
            None => {}
        }
        match client.push::<Report>(byte) {
            Some(Ok(frame)) => same_again(&frame, taken_by_client),
            Some(Err(_)) => faults[1] += 1,
            None => {}
        }
    }
    let counted = [board, client].map(|decoder| decoder.faults().total());
    assert_eq!(counted, faults, "every fault is counted");
}

/// A frame is encoded again and decodes to the same message.
fn same_again<'a, M: Message<'a>>(
    frame: &Frame<M>,
    taken: impl Fn(&mut Decoder<LONGEST>, u8) -> Result<Vec<u8>, Fault>,
) {
    let sent = encoded(frame);
    let (&end, before) = sent.split_last().expect("a frame has bytes");
    let mut decoder = Decoder::new();
    for &byte in before {
        assert!(decoder.push::<Command>(byte).is_none(), "one frame");
    }
    let again = taken(&mut decoder, end);
    assert_eq!(again.as_ref(), Ok(&sent), "what is sent is accepted");
}

fn encoded<'a, M: Message<'a>>(frame: &Frame<M>) -> Vec<u8> {
    let mut wire = [0; WIRE];
    let said = frame.encode(&mut wire);
    said.expect("there is room for every frame").to_vec()
}

/// The frame that a board, with its last byte, would send again.
fn taken_by_board(decoder: &mut Decoder<LONGEST>, end: u8) -> Result<Vec<u8>, Fault> {
    let frame = decoder.push::<Command>(end).expect("a whole frame");
    frame.map(|frame| encoded(&frame))
}

/// As [`taken_by_board`], for a client.
fn taken_by_client(decoder: &mut Decoder<LONGEST>, end: u8) -> Result<Vec<u8>, Fault> {
    let frame = decoder.push::<Report>(end).expect("a whole frame");
    frame.map(|frame| encoded(&frame))
}

/// A tracker's records: each has a position within 27 m and a unit quaternion, and yields a planar pose.
fn track(traffic: &[u8]) {
    let mut decoder = LogitechDecoder::new();
    let axis = |index| Axis {
        index,
        negative: false,
    };
    let mut projection = Projection::<f32>::new([axis(0), axis(2)]).expect("two axes");
    for record in traffic.iter().filter_map(|&byte| decoder.push(byte)) {
        // 2^20 thousandths of an inch.
        assert!(record.position.iter().all(|x| x.abs() <= 26.634));
        let squares: f32 = record.orientation.iter().map(|q| q * q).sum();
        assert!((squares - 1.0).abs() < 1e-5, "{record:?}");
        let hand = record.sample(1).map(|sample| projection.planar(&sample));
        assert!(hand.is_none_or(|hand| hand.is_some_and(|hand| hand.is_finite())));
    }
}

/// Pieces, each preceded by its length, as frames with a valid checksum.
pub(crate) fn sealed(mut pieces: &[u8]) -> Vec<u8> {
    let mut traffic = Vec::new();
    while let Some((&length, rest)) = pieces.split_first() {
        let (piece, rest) = rest.split_at(rest.len().min(length.into()));
        let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(piece);
        let frame = [piece, &crc.to_le_bytes()].concat();
        let mut stuffed = vec![0; cobs::max_encoding_length(frame.len())];
        let length = cobs::encode(&frame, &mut stuffed);
        traffic.extend_from_slice(&stuffed[..length]);
        traffic.push(0);
        pieces = rest;
    }
    traffic
}
