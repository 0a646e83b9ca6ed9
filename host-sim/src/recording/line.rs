//! The lines of a recording below its head: a sample with its answer, a change of the setting, and the count of the samples.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use stiction_core::{Angle, Hand};
use stiction_scene::Sample;

use crate::trace::Record;

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenSample {
    t: f64,
    position: [Option<f64>; 2],
    turns: i32,
    rest: Option<f64>,
    depth: Option<f64>,
    held: bool,
    /// Omitted for hands that are not, which almost all are.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    tilted: bool,
}

impl WrittenSample {
    pub(super) fn new(sample: &Sample) -> Self {
        let finite = |value: f64| value.is_finite().then_some(value);
        let hand = &sample.hand;
        Self {
            t: sample.t,
            position: hand.position.map(finite),
            turns: hand.angle.turns,
            rest: finite(hand.angle.rest),
            depth: finite(hand.depth),
            held: hand.held,
            tilted: hand.tilted,
        }
    }

    pub(super) fn sample(self) -> Sample {
        let value = |given: Option<f64>| given.unwrap_or(f64::NAN);
        Sample {
            t: self.t,
            hand: Hand {
                position: self.position.map(value),
                angle: Angle {
                    turns: self.turns,
                    rest: value(self.rest),
                },
                depth: value(self.depth),
                held: self.held,
                tilted: self.tilted,
            },
        }
    }
}

/// A line with a sample, for writing.
#[derive(Serialize)]
pub(super) struct LineOut<'a> {
    pub(super) sample: WrittenSample,
    pub(super) answer: Option<Record<'a>>,
}

/// A line with a sample, for reading.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LineIn {
    pub(super) sample: WrittenSample,
    pub(super) answer: Option<Box<RawValue>>,
}

/// The last line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct End {
    pub(super) samples: u64,
}

/// A line with a change, whose content is C.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ChangeLine<C> {
    pub(super) change: C,
}
