//! Compares the hand of a trace with the path that it followed: sample by sample, to the rounding of the printed numbers. The
//! hand's motion is the only thing that a trace cannot prove by itself.

use std::path::{Path, PathBuf};

use stiction_core::SiFloat;
use stiction_judge::{Bounds, Finding, Frame, Status, law};
use stiction_scene::{HandPath, InputError, Sample};

use crate::input;
use stiction_live::input::open_path;
use stiction_live::number::Number;

/// The allowed deviation of a number of the hand, in roundings: that of the solver's type, and that of the trace.
const ROUNDINGS: f64 = 2.0;

/// The hand for the comparison: its path and the rate (Hz) to which it is resampled, or why there is none.
pub(super) type Given = Result<(HandPath, Option<f64>), String>;

/// Selects it by `--hand`, `--rate` and the scene.
pub(super) fn given(
    name: &Path,
    number: Number,
    hand: Option<&PathBuf>,
    rate: Option<f64>,
) -> Result<Given, InputError> {
    if hand.is_some_and(|hand| hand.as_os_str() == "none") {
        return Ok(Err("--hand none".to_owned()));
    }
    let scene = match input::open_scene(name, number) {
        Ok(scene) => scene,
        Err(error) if hand.is_some() => return Err(error),
        // The judge accepts scenes that the solver does not.
        Err(error) => return Ok(Err(error.to_string())),
    };
    if hand.is_none() && scene.hand.motion.is_none() {
        return Ok(Err(
            "the scene has no path, and there is no --hand".to_owned()
        ));
    }
    let rate = rate.map(|rate| ("--rate", rate));
    open_path(&scene, hand.map(PathBuf::as_path), rate).map(Ok)
}

/// The law for a frame and the sample that it answers; `None`: the path had ended.
pub(super) fn finding(sample: Option<Sample>, frame: &Frame, bounds: &Bounds) -> Finding {
    let off = sample.map_or(f64::INFINITY, |sample| off(&sample, frame));
    Finding {
        law: law::HAND,
        residual: off,
        bound: ROUNDINGS * bounds.rounding,
    }
}

/// The deviation of a frame's hand from a sample, relative to the size of its numbers.
fn off(sample: &Sample, frame: &Frame) -> f64 {
    let hand = &sample.hand;
    let is_dropped = !hand.is_finite();
    if is_dropped != (frame.status == Status::HeldLast) || (frame.held && !hand.held) {
        return f64::INFINITY;
    }
    let time = (frame.t - sample.t).abs() / sample.t.abs().max(1.0);
    if is_dropped || frame.status == Status::Saturated {
        return time;
    }
    let [x, y] = hand.position;
    let size = x.abs().max(y.abs()).max(f64::MIN_POSITIVE);
    let turn = hand.angle.radians();
    let away = (frame.hand[0] - x).abs().max((frame.hand[1] - y).abs()) / size;
    let turned = (frame.hand[2] - turn.widen()).abs() / turn.abs().max(f64::MIN_POSITIVE);
    time.max(away).max(turned)
}
