//! A job of the instruction bench as bytes, and its results. Little-endian, SI units in f64 for every number type; all
//! sizes are multiples of 8.
//!
//! ```text
//! job      at  0  "stjb"                              results  at  0  "strs"
//!              4  u8  version, 5                                   4  u8  version, 5
//!              5  u8  evolution: 0 path, 1 frame                   5  3 bytes, 0
//!              6  u8  vertices n                               then one frame for every sample:
//!              7  u8  surfaces m                               at  0  u32 instructions
//!              8  u32 hand samples                                 4  i32 whole turns of theta
//!             12  u32 1: with a holding point                      8  f64 x, y (m), rest of theta (rad)
//!             16  f64 start x, y, theta                           32  u32 slips
//!             40  f64 weight                                      36  u8  state, as in StateKind::ALL
//!             48  f64 holding point x, y                          37  u8  status, as in Status::ALL
//!             64  f64 reach, k_h, k_theta                         38  2 bytes, 0
//!             88  u32 budget of a step (units)                    40  u32 units of work
//!             92  u8  obstacles o, 3 bytes, 0                     44  4 bytes, 0
//!             96  n times f64 vertex x, y                     then the totals:
//!                 m times f64 normal x, y, offset,            at  0  "done"
//!                         mu_s, mu_d, memory (m),                  4  u32 frames
//!                         NaN where none is given                  8  u32 stack (bytes)
//!                 o times f64 mu_s, mu_d, memory (m),             12  u32 size of the solver (bytes)
//!                         u8 corners c, 7 bytes, 0,               16  u32 size of its state (bytes)
//!                         c times f64 corner x, y                 20  u32 size of its output (bytes)
//!          then for every sample:
//!          at  0  f64 x, y (m), rest of phi (rad)
//!             24  i32 whole turns of phi
//!             28  u32 1: held
//! ```
//!
//! The first sample is where the solver starts. Instructions are `u32::MAX` if there were more than can be counted.

mod fields;
mod results;
mod scene;

use fields::{Fields, Record};
pub(crate) use results::FRAME_BYTES;
pub use results::{Frame, Results, Totals};
pub use scene::write_scene;
pub(crate) use scene::{HEAD_BYTES, Head};
use stiction_core::{Angle, Hand};

/// The version of the layout, in the first bytes of a job and of its results.
pub const VERSION: u8 = 5;

/// The bytes of a hand sample.
pub(crate) const SAMPLE_BYTES: usize = 32;

/// Why bytes are not a job, or not its results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormatError {
    /// They do not begin with the mark and version of this format.
    Mark,
    /// A value without a meaning.
    Value,
    /// They end too early.
    Short,
}

impl core::fmt::Display for FormatError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Mark => "not of this format and version",
            Self::Value => "a value without a meaning",
            Self::Short => "ends too early",
        })
    }
}

impl core::error::Error for FormatError {}

/// A hand sample as bytes. The depth is not included: it does not take part in the statics.
pub fn encode_sample(hand: &Hand<f64>) -> [u8; SAMPLE_BYTES] {
    let [x, y] = hand.position;
    let mut record = Record::new();
    record.f64(x).f64(y).f64(hand.angle.rest);
    record.i32(hand.angle.turns).u32(u32::from(hand.held));
    record.bytes()
}

/// The sample of these bytes.
pub(crate) fn decode_sample(bytes: &[u8; SAMPLE_BYTES]) -> Hand<f64> {
    let mut fields = Fields::new(bytes);
    let position = [fields.f64(), fields.f64()];
    let rest = fields.f64();
    let turns = fields.i32();
    Hand {
        position,
        angle: Angle { turns, rest },
        depth: 0.0,
        held: fields.u32() != 0,
        tilted: false,
    }
}
