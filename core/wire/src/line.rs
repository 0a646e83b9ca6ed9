//! Frames on the line: head, payload and checksum, COBS-framed, ended by a 0 byte (FRAME 2); and back, byte by byte.

use crate::fault::{Fault, FaultKind, Faults};
use crate::field::{Field, Fields, Sink};
use crate::message::Message;
use crate::{Frame, Reference, VERSION};
use cobs::{DecodeResult, DecoderState, EncoderState, PushResult};
use crc::{CRC_32_ISO_HDLC, Crc, Digest};

/// Bytes of the head of a frame: version, type, sequence number and time (FRAME 2).
pub const HEAD_BYTES: usize = 7;
/// Bytes of the checksum, a CRC-32 (FRAME 2).
pub const CRC_BYTES: usize = 4;

static CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// The bytes before COBS of a frame whose payload has this many bytes: the room that a [`Decoder`] needs.
pub const fn frame_bytes(payload: usize) -> usize {
    payload.saturating_add(HEAD_BYTES + CRC_BYTES)
}

/// The bytes of a frame on the wire, including the delimiter; an upper bound if it is longer than 253 before COBS.
pub const fn wire_bytes(payload: usize) -> usize {
    let frame = frame_bytes(payload);
    frame.saturating_add(2).saturating_add(frame / 254)
}

impl<'a, M: Message<'a>> Frame<M> {
    /// Which frame this is, for the answer to it.
    pub fn reference(&self) -> Reference {
        Reference {
            code: self.message.code(),
            sequence: self.sequence,
        }
    }

    /// Writes the frame as it is sent over the wire, including its delimiter, and returns the part of `out` that it occupies; see
    /// [`wire_bytes`]. `None` if it does not fit, or if a list of the message has more than 255 items.
    pub fn encode<'o>(&self, out: &'o mut [u8]) -> Option<&'o [u8]> {
        let mut line = Line::new(out);
        line.put(&[VERSION, self.message.code(), self.sequence]);
        self.time.put(&mut line);
        self.message.write(&mut line);
        line.end()
    }
}

/// A frame being written. The first byte, and every one in place of a 0 of the frame, is a code byte that is filled in later.
struct Line<'o> {
    out: &'o mut [u8],
    length: usize,
    cobs: EncoderState,
    crc: Digest<'static, u32>,
    fits: bool,
}

impl<'o> Line<'o> {
    fn new(out: &'o mut [u8]) -> Self {
        Self {
            out,
            length: 1,
            cobs: EncoderState::default(),
            crc: CRC.digest(),
            fits: true,
        }
    }
    fn set(&mut self, place: usize, byte: u8) {
        match self.out.get_mut(place) {
            Some(at) => *at = byte,
            None => self.fits = false,
        }
    }
    fn append(&mut self, byte: u8) {
        self.set(self.length, byte);
        self.length = self.length.saturating_add(1);
    }
    /// Stuffs one byte of the frame (COBS): fills in a pending code byte if the byte is 0 or the block is full, and appends the byte.
    fn stuff(&mut self, byte: u8) {
        match self.cobs.push(byte) {
            PushResult::AddSingle(byte) => self.append(byte),
            PushResult::ModifyFromStartAndSkip((place, code)) => {
                self.set(place, code);
                self.append(0);
            }
            PushResult::ModifyFromStartAndPushAndSkip((place, code, byte)) => {
                self.set(place, code);
                self.append(byte);
                self.append(0);
            }
        }
    }
    fn end(mut self) -> Option<&'o [u8]> {
        for byte in self.crc.clone().finalize().to_le_bytes() {
            self.stuff(byte);
        }
        let (place, code) = self.cobs.clone().finalize();
        self.set(place, code);
        self.append(0);
        let Self {
            out, length, fits, ..
        } = self;
        out.get(..length).filter(|_| fits)
    }
}

impl Sink for Line<'_> {
    // Inlined at every field it would need about four times the flash.
    #[inline(never)]
    fn put(&mut self, bytes: &[u8]) {
        self.crc.update(bytes);
        for &byte in bytes {
            self.stuff(byte);
        }
    }
    fn refuse(&mut self) {
        self.fits = false;
    }
}

/// Finds the frames in a stream of bytes. Total: any bytes yield messages or counted faults, and whatever came before, the frame after the
/// next delimiter is found. It has room for frames of N bytes before COBS, see [`frame_bytes`].
///
/// ```
/// use stiction_wire::{Command, Decoder, FaultKind, Frame};
///
/// let mut wire = [0; 32];
/// let ping = Frame { sequence: 7, time: 1_000_000, message: Command::Ping };
/// let wire = ping.encode(&mut wire).unwrap();
///
/// let mut decoder = Decoder::<64>::new();
/// let mut received = None;
/// for &byte in [9, 2, 3, 0].iter().chain(wire) {
///     if let Some(Ok(frame)) = decoder.push::<Command>(byte) {
///         received = Some(frame.sequence);
///     }
/// }
/// assert_eq!(received, Some(7));
/// assert_eq!(decoder.faults().of(FaultKind::Cobs), 1);
/// ```
#[derive(Debug)]
pub struct Decoder<const N: usize> {
    bytes: [u8; N],
    length: usize,
    cobs: DecoderState,
    too_long: bool,
    faults: Faults,
}

impl<const N: usize> Default for Decoder<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Decoder<N> {
    /// A decoder that begins with a frame.
    pub const fn new() -> Self {
        Self {
            bytes: [0; N],
            length: 0,
            cobs: DecoderState::Idle,
            too_long: false,
            faults: Faults::new(),
        }
    }

    /// The frames that have not been accepted so far.
    pub const fn faults(&self) -> &Faults {
        &self.faults
    }

    /// Takes the next byte of the line; at the end of a frame, returns the message in it, or its fault. What the message borrows is in the
    /// decoder's buffer. Extra delimiters between frames are ignored.
    pub fn push<'a, M: Message<'a>>(&'a mut self, byte: u8) -> Option<Result<Frame<M>, Fault>> {
        let end = match self.cobs.feed(byte) {
            Ok(DecodeResult::NoData) => return None,
            Ok(DecodeResult::DataStart) => {
                self.length = 0;
                self.too_long = false;
                return None;
            }
            Ok(DecodeResult::DataContinue(byte)) => {
                self.append(byte);
                return None;
            }
            Ok(DecodeResult::DataComplete) => Ok(()),
            Err(_) => Err(FaultKind::Cobs),
        };
        let Self {
            bytes,
            length,
            too_long,
            faults,
            ..
        } = self;
        let end = if *too_long {
            Err(FaultKind::TooLong)
        } else {
            end
        };
        let frame = bytes.get(..*length).unwrap_or_default();
        let received = match end {
            Ok(()) => read(frame),
            Err(kind) => Err(Fault { kind, frame: None }),
        };
        if let Err(fault) = &received {
            faults.count(fault.kind);
        }
        Some(received)
    }

    fn append(&mut self, byte: u8) {
        match self.bytes.get_mut(self.length) {
            Some(place) => {
                *place = byte;
                self.length = self.length.saturating_add(1);
            }
            None => self.too_long = true,
        }
    }
}

/// The message of a frame, tested in the order of [`FaultKind::ALL`].
fn read<'a, M: Message<'a>>(frame: &'a [u8]) -> Result<Frame<M>, Fault> {
    let garbled = Fault {
        kind: FaultKind::Crc,
        frame: None,
    };
    let (body, crc) = frame.split_last_chunk().ok_or(garbled)?;
    if CRC.checksum(body) != u32::from_le_bytes(*crc) {
        return Err(garbled);
    }
    let short = Fault {
        kind: FaultKind::Length,
        frame: None,
    };
    // These three keep their positions in every version.
    let (&[version, code, sequence], body) = body.split_first_chunk().ok_or(short)?;
    let fault = |kind| Fault {
        kind,
        frame: Some(Reference { code, sequence }),
    };
    if version != VERSION {
        return Err(fault(FaultKind::Version));
    }
    let (time, payload) = body.split_first_chunk().ok_or(fault(FaultKind::Length))?;
    let message = M::read(code, Fields::new(payload)).map_err(fault)?;
    Ok(Frame {
        sequence,
        time: u32::from_le_bytes(*time),
        message,
    })
}
