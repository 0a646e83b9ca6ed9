//! The tracker of the paper, a Logitech 3-D mouse or head tracker: from the bytes of its serial line to position and
//! orientation. 19200 baud, 8 data bits; a client asks for a record by [`REQUEST`].
//!
//! A record has 16 bytes of 7 bits each. Bit 7 is set in the first byte only, which marks the start of a record; there is no checksum, so a
//! flipped bit within a record goes unnoticed.
//!
//! ```text
//!  0      bit 7: 1, bit 6: fringe of the range, bit 5: out of range, bits 4 to 0: buttons
//!  1.. 9  x, y, z: 21 bits each, signed, the high ones first, in 1/1000 inch
//! 10..15  pitch, yaw, roll: 14 bits each, the high ones first, in 1/40 degree; R = R_y(yaw) R_x(pitch) R_z(roll)
//! ```

use crate::field::Fields;
use stiction_core::{Real, TrackerSample};

/// Asks the tracker for one record.
pub const REQUEST: [u8; 2] = *b"*d";

const START: u8 = 1 << 7;
const FRINGE: u8 = 1 << 6;
const OUT_OF_RANGE: u8 = 1 << 5;
const BUTTONS: u8 = OUT_OF_RANGE - 1;
/// 1/1000 inch (m).
const UNIT: f32 = 2.54e-5;
/// Half of 1/40 degree (rad).
const HALF_ANGLE: f32 = core::f32::consts::PI / (180.0 * 80.0);

/// A record of the tracker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogitechRecord {
    /// x, y, z in the transmitter's frame (m).
    pub position: [f32; 3],
    /// The unit quaternion x, y, z, w.
    pub orientation: [f32; 4],
    /// Bits of the buttons that are pressed: right 1, middle 2, left 4, suspend 8; bit 4 is reserved.
    pub buttons: u8,
    /// The receiver is at the fringe of the range: the pose is less accurate.
    pub at_fringe: bool,
    /// The receiver is out of range: position and orientation are meaningless.
    pub out_of_range: bool,
}

impl LogitechRecord {
    /// The sample for a [`Projection`](stiction_core::Projection); the hand holds while one of the buttons of `hold` is pressed. `None` if the
    /// tracker is out of range.
    pub fn sample(&self, hold: u8) -> Option<TrackerSample<f32>> {
        (!self.out_of_range).then_some(TrackerSample {
            position: self.position,
            orientation: self.orientation,
            held: self.buttons & hold != 0,
        })
    }

    /// Decodes a record (FRAME 9): position in m, orientation as a unit quaternion, flags from the first byte.
    fn of(record: &[u8; 16]) -> Self {
        let mut fields = Fields::new(record);
        let [flags] = fields.take();
        let position = [(); 3].map(|()| length(fields.take()));
        let halves = [(); 3].map(|()| half_angle(fields.take()));
        Self {
            position,
            orientation: quaternion(halves),
            buttons: flags & BUTTONS,
            at_fringe: flags & FRINGE != 0,
            out_of_range: flags & OUT_OF_RANGE != 0,
        }
    }
}

/// The number made of bytes of 7 bits each, the high ones first.
fn number(sevens: &[u8]) -> i32 {
    sevens
        .iter()
        .fold(0, |sum, b| (sum << 7) | i32::from(b & 0x7f))
}

/// 21 bits, signed, to metres.
fn length(sevens: [u8; 3]) -> f32 {
    // The sign is bit 20.
    f32::from_int((number(&sevens) << 11) >> 11) * UNIT
}

/// Sine and cosine of half an angle of 14 bits.
fn half_angle(sevens: [u8; 2]) -> (f32, f32) {
    Real::sin_cos(f32::from_int(number(&sevens)) * HALF_ANGLE)
}

/// q = q_y(yaw) q_x(pitch) q_z(roll), from sine and cosine of half of pitch, yaw and roll.
fn quaternion([(sx, cx), (sy, cy), (sz, cz)]: [(f32, f32); 3]) -> [f32; 4] {
    [
        cy * sx * cz + sy * cx * sz,
        sy * cx * cz - cy * sx * sz,
        cy * cx * sz - sy * sx * cz,
        cy * cx * cz + sy * sx * sz,
    ]
}

/// Finds the records in the bytes of a tracker. Total: whatever came before, a record is found at the next start byte.
///
/// ```
/// use stiction_wire::LogitechDecoder;
///
/// let record = [0x84, 0, 7, 0x68, 0, 0, 0, 0x7f, 0x7f, 0x7f, 0, 0, 0, 0, 0x1c, 0x10];
/// let mut decoder = LogitechDecoder::new();
/// let record = record.iter().find_map(|&byte| decoder.push(byte)).unwrap();
/// assert!((record.position[0] - 0.0254).abs() < 1e-9, "1000 thousandths of an inch");
/// assert!((record.position[2] + 2.54e-5).abs() < 1e-12, "-1 of them");
/// assert!(record.sample(4).is_some_and(|hand| hand.held));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LogitechDecoder {
    record: [u8; 16],
    length: usize,
    faults: u32,
}

impl LogitechDecoder {
    /// A decoder that waits for the start of a record.
    pub const fn new() -> Self {
        Self {
            record: [0; 16],
            length: 0,
            faults: 0,
        }
    }

    /// Records that ended too early because a start byte came within one. A record whose first byte is lost is skipped and not counted.
    pub const fn faults(&self) -> u32 {
        self.faults
    }

    /// Takes the next byte of the line; with the last byte of a record, returns the record.
    pub fn push(&mut self, byte: u8) -> Option<LogitechRecord> {
        if byte & START != 0 {
            if self.length != 0 {
                self.faults = self.faults.saturating_add(1);
            }
            self.length = 0;
        } else if self.length == 0 {
            return None;
        }
        let place = self.record.get_mut(self.length)?;
        *place = byte;
        self.length = self.length.saturating_add(1);
        if self.length < self.record.len() {
            return None;
        }
        self.length = 0;
        Some(LogitechRecord::of(&self.record))
    }
}
