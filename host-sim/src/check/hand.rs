//! Compares the hand of a trace with the path that it followed: at the time of each frame, to the rounding of the printed numbers. The
//! hand's motion is the only thing that a trace cannot prove by itself.

use stiction_core::SiFloat;
use stiction_judge::{Bounds, Finding, Frame, Status, law};
use stiction_scene::{HandPath, InputError, Motion, Sample};

use super::CheckArgs;
use crate::input;
use stiction_live::input::open_path;

/// The allowed deviation of a coordinate or a time of the hand, in roundings: that of the solver's type, and that of the trace.
const ROUNDINGS: f64 = 2.0;

/// The allowed deviation of an angle, in roundings: the solver has it as turns and a rest, of which the rest, the whole turn, their product and
/// the sum are rounded.
const ROUNDINGS_OF_ANGLE: f64 = 4.0;

/// Times that differ by this part of a frame are the same, as in the frames of a path.
const SAME: f64 = 1e-6;

/// The hand for the comparison, or why there is none.
pub(super) type Given = Result<HandComparison, String>;

/// A trace beside the path of its hand.
pub(super) struct HandComparison {
    path: HandPath,
    /// The rate (Hz) of the path's frames; `None`: its samples.
    rate: Option<f64>,
    /// The trace has these frames. Otherwise, it is compared at its own times.
    is_given: bool,
    /// The number of frames of the trace so far, the time of the last one and its distance from the one before (s).
    frames: usize,
    last: f64,
    step: f64,
}

/// Selects the path by `--hand`, `--fit`, `--rate` and the scene.
pub(super) fn given(args: &CheckArgs) -> Result<Given, InputError> {
    let hand = args.hand.as_deref();
    if hand.is_some_and(|hand| hand.as_os_str() == "none") {
        return Ok(Err("--hand none".to_owned()));
    }
    let mut scene = match input::open_scene(&args.scene, args.number) {
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
    if let Some(hand) = hand.filter(|_| args.fit) {
        input::fit(&mut scene, hand)?;
    }
    let path = match (&scene.hand.motion, hand) {
        // The times are those of the trace: no rate is needed.
        (Some(Motion::Keyframes(path)), None) if args.rate.is_none() => {
            (path.clone(), scene.hand.rate)
        }
        _ => open_path(&scene, hand, args.rate.map(|rate| ("--rate", rate)))?,
    };
    let (path, rate) = path;
    Ok(Ok(HandComparison {
        path,
        rate,
        is_given: args.rate.is_some(),
        frames: 0,
        last: f64::NAN,
        step: 0.0,
    }))
}

impl HandComparison {
    /// The law for the next frame.
    pub(super) fn finding(&mut self, frame: &Frame, bounds: &Bounds) -> Finding {
        let bound = ROUNDINGS * bounds.rounding;
        let residual = match frame.t.is_finite() {
            true => self
                .sample(frame.t)
                .map_or(f64::INFINITY, |sample| off(&sample, frame)),
            // Another law says so.
            false => 0.0,
        };
        self.frames += 1;
        Finding {
            law: law::HAND,
            residual,
            bound,
        }
    }

    /// The sample that the next frame answers; `None`: the path has none.
    fn sample(&mut self, t: f64) -> Option<Sample> {
        self.step = (t - self.last).abs();
        if self.step.is_nan() {
            self.step = 0.0;
        }
        self.last = t;
        match (self.is_given, self.rate) {
            (true, Some(rate)) => self.path.sample(self.frames, rate),
            _ => self.path.at(t, SAME * self.step),
        }
    }

    /// What the comparison did not see.
    pub(super) fn remark(&self) -> Option<String> {
        let count = self.path.frame_count(self.rate);
        let left = match self.is_given {
            true => count.saturating_sub(self.frames),
            false => {
                let end = self.last + SAME * self.step;
                self.path
                    .frames(self.rate)
                    .filter(|sample| sample.t > end)
                    .count()
            }
        };
        if left > 0 {
            return Some(format!(
                "the hand's path has {left} more samples than the trace"
            ));
        }
        (count != self.frames).then(|| {
            format!(
                "the hand's path has {count} frames, the trace {}: the hand was compared at the times of the trace",
                self.frames
            )
        })
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
    time.max(away)
        .max(turned * (ROUNDINGS / ROUNDINGS_OF_ANGLE))
}
