//! The hand's motion over time: samples from keyframes or from a recorded file, unchanged or resampled.

mod doubt;
mod header;
mod placement;
mod recorded;
mod seen;

pub use doubt::{doubts, fitted};
pub(crate) use placement::Placed;
pub(crate) use placement::parse_plane;
pub use placement::{AngleUnit, LivePlacement, Placement};
pub(crate) use recorded::{Row, RowPose};

use std::io::{BufRead, BufReader};
use std::path::Path;

use stiction_core::{Angle, Hand};

use crate::source::{InputError, Source};

/// The planar hand at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time (s).
    pub t: f64,
    /// The hand, world frame of the scene; a pose that was not finite in the input is not finite here either.
    pub hand: Hand<f64>,
}

/// Samples ordered by time.
#[derive(Clone, Debug, PartialEq)]
pub struct HandPath {
    samples: Vec<Sample>,
    /// What was skipped or assumed when it was read from a file.
    notes: Vec<String>,
    /// The file has six degrees of freedom.
    is_spatial: bool,
}

impl HandPath {
    /// The largest magnitude of a hand's angle (rad): beyond it, the resolution of an f64 is coarser than 1e-7 rad.
    pub(crate) const LARGEST_ANGLE: f64 = 1e9;
    /// The largest size of a recorded path (bytes): an hour at 1000 Hz, 3.6 million records of 74 bytes each. A record takes 56
    /// bytes of memory.
    pub const LONGEST: u64 = 1 << 28;
    /// The most frames that a path can be resampled to.
    pub const LARGEST_COUNT: usize = 1_000_000_000;

    /// A path of samples whose times increase.
    pub fn new(samples: Vec<Sample>) -> Self {
        Self {
            samples,
            notes: Vec::new(),
            is_spatial: false,
        }
    }

    /// Reads a recorded path line by line: `.csv`, or `.tum` and `.txt` in the TUM format.
    ///
    /// # Errors
    /// The file cannot be read, is longer than [`Self::LONGEST`], its format is unknown, or a record is unusable.
    pub fn read(file: &Path, placement: &Placement) -> Result<Self, InputError> {
        // A file without the extension of a path is not opened.
        recorded::Format::of(file)?;
        Self::of_reader(file, open(file)?, placement)
    }

    /// A recorded path from text; the extension of its name determines the format.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(source: &Source, placement: &Placement) -> Result<Self, InputError> {
        Self::of_reader(source.file(), source.text().as_bytes(), placement)
    }

    fn of_reader(
        file: &Path,
        reader: impl BufRead,
        placement: &Placement,
    ) -> Result<Self, InputError> {
        let format = recorded::Format::of(file)?;
        let mut records = recorded::Records::new(file, reader, format);
        let mut placed = Placed::new(placement).map_err(|p| InputError::of_file(file, p))?;
        while let Some((row, line)) = records.next()? {
            let added = placed.add(&row);
            added.map_err(|problem| InputError::in_line(file, (row.line, line), problem))?;
        }
        let (is_spatial, mut notes) = (records.is_spatial(), records.notes);
        let (lost, count) = (placed.lost, placed.samples.len());
        if lost > 0 {
            notes.push(format!(
                "records without a pose: {lost} of {count}; the hand keeps the pose before them (status `held-last`)"
            ));
        }
        Ok(Self {
            samples: placed.samples,
            notes,
            is_spatial,
        })
    }

    /// What was skipped or assumed when it was read from a file: sentences for its user.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// A problem with the last record of a recorded path.
    pub fn error_at_end(file: &Path, problem: &str) -> InputError {
        match open(file) {
            Ok(reader) => at_end(file, reader, problem),
            Err(error) => error,
        }
    }

    /// Reads a path whose text is already loaded.
    pub fn error_at_end_of(source: &Source, problem: &str) -> InputError {
        at_end(source.file(), source.text().as_bytes(), problem)
    }

    /// The number of samples.
    pub fn count(&self) -> usize {
        self.samples.len()
    }

    /// The time from the first sample to the last (s).
    pub fn seconds(&self) -> f64 {
        match self.samples.as_slice() {
            [first, .., last] => last.t - first.t,
            _ => 0.0,
        }
    }

    /// The number of frames that [`Self::frames`] returns; more than [`Self::LARGEST_COUNT`] if the rate is too high.
    pub fn frame_count(&self, rate: Option<f64>) -> usize {
        match (rate, self.samples.as_slice()) {
            (Some(rate), [first, .., last]) => {
                // A millionth of a frame counts as rounding; both ends are frames.
                let steps = ((last.t - first.t) * rate - 1e-6).ceil().max(1.0);
                (steps as usize).saturating_add(1)
            }
            _ => self.samples.len(),
        }
    }

    /// The frames: every sample, or, with a `rate` (Hz), one every 1/rate from the first sample to the last. Poses in
    /// between are interpolated in straight lines (the angle unwrapped); a pose next to one that is not finite is not
    /// finite either. The switch is that of the last sample reached.
    pub fn frames(&self, rate: Option<f64>) -> impl ExactSizeIterator<Item = Sample> + '_ {
        let mut reached = 0;
        (0..self.frame_count(rate)).map(move |k| match rate {
            None => self.samples[k],
            Some(rate) => self.resampled(k, rate, &mut reached),
        })
    }

    /// Frame `k` of [`Self::frames`] at a rate (Hz), computed without the frames before it.
    pub fn sample(&self, k: usize, rate: f64) -> Option<Sample> {
        if k >= self.frame_count(Some(rate)) {
            return None;
        }
        let until = self.time(k, rate) + 1e-6 / rate;
        let reached = self.samples.partition_point(|sample| sample.t <= until);
        Some(self.resampled(k, rate, &mut reached.saturating_sub(1)))
    }

    /// The time of frame `k` (s).
    fn time(&self, k: usize, rate: f64) -> f64 {
        if k + 1 == self.frame_count(Some(rate)) {
            return self.samples[self.samples.len() - 1].t;
        }
        self.samples[0].t + k as f64 / rate
    }

    fn resampled(&self, k: usize, rate: f64, reached: &mut usize) -> Sample {
        if k == 0 {
            return self.samples[0];
        }
        let t = self.time(k, rate);
        let rounding = 1e-6 / rate;
        while (self.samples.get(*reached + 1)).is_some_and(|next| next.t <= t + rounding) {
            *reached += 1;
        }
        self.after(*reached, t)
    }

    /// The hand at a time (s), interpolated as in [`Self::frames`]; `None` before the first sample and after the last one. Times that differ by
    /// `rounding` (s) are the same.
    pub fn at(&self, t: f64, rounding: f64) -> Option<Sample> {
        let (first, last) = (self.samples.first()?, self.samples.last()?);
        if !(first.t - rounding..=last.t + rounding).contains(&t) {
            return None;
        }
        let reached = self
            .samples
            .partition_point(|sample| sample.t <= t + rounding);
        Some(self.after(reached.saturating_sub(1), t))
    }

    /// The hand at a time after sample `reached` and not after the next one.
    fn after(&self, reached: usize, t: f64) -> Sample {
        let from = self.samples[reached];
        let hand = match self.samples.get(reached + 1) {
            Some(to) if t > from.t => between(&from.hand, &to.hand, (t - from.t) / (to.t - from.t)),
            _ => from.hand,
        };
        Sample { t, hand }
    }
}

fn open(file: &Path) -> Result<impl BufRead, InputError> {
    let opened = crate::text::open(file, HandPath::LONGEST);
    let opened = opened.map_err(|problem| InputError::of_file(file, problem))?;
    Ok(BufReader::new(opened))
}

/// A problem with the last record.
fn at_end(file: &Path, reader: impl BufRead, problem: &str) -> InputError {
    let (number, line) = recorded::last_line(reader);
    InputError::in_line(file, (number, &line), problem)
}

/// The hand at a fraction `part` of the path.
fn between(from: &Hand<f64>, to: &Hand<f64>, part: f64) -> Hand<f64> {
    let lerp = |a: f64, b: f64| a + (b - a) * part;
    let ([x, y], [to_x, to_y]) = (from.position, to.position);
    let turn: f64 = to.angle.minus(from.angle) * part;
    Hand {
        position: [lerp(x, to_x), lerp(y, to_y)],
        angle: turned(from.angle, turn),
        depth: lerp(from.depth, to.depth),
        held: from.held,
        tilted: from.tilted,
    }
}

/// `angle` turned by `by`; exact if that is 0.
fn turned(angle: Angle<f64>, by: f64) -> Angle<f64> {
    if by == 0.0 { angle } else { angle.plus(by) }
}
