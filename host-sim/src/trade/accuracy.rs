//! The deviation of a setting's frames from the reference: from poses, states and slips of whole runs to percentiles and counts.

use stiction_core::Status;

use super::reference::Truth;
use crate::balance::Imbalance;
use stiction_live::record::Frame;

/// The bounds that given fractions of the frames satisfy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spread {
    pub(super) p50: f64,
    pub(super) p90: f64,
    pub(super) p99: f64,
    pub(super) max: f64,
}

impl Spread {
    fn of(values: &mut [f32]) -> Self {
        let Some(last) = values.len().checked_sub(1) else {
            return Self::default();
        };
        let mut at = |part: f64| {
            let place = (part * last as f64).ceil() as usize;
            let (_, value, _) = values.select_nth_unstable_by(place, f32::total_cmp);
            f64::from(*value)
        };
        Self {
            p50: at(0.5),
            p90: at(0.9),
            p99: at(0.99),
            max: at(1.0),
        }
    }

    /// Each with its name in files.
    pub(super) const fn parts(&self) -> [(&'static str, f64); 4] {
        [
            ("p50", self.p50),
            ("p90", self.p90),
            ("p99", self.p99),
            ("max", self.max),
        ]
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Accuracy {
    /// Frames that were compared.
    pub(super) frames: usize,
    /// Distance of the body's origin from that of the reference (µm).
    pub(super) position: Spread,
    /// Angle between the body and that of the reference (mrad).
    pub(super) angle: Spread,
    /// The largest unbalanced force of a scene / its largest force, or moment / (that force · L).
    pub(super) residual: f64,
    /// Frames in a different contact state.
    pub(super) other_state: usize,
    pub(super) reference_slips: u64,
    /// Slips in excess of the reference, summed over the scenes that have more.
    pub(super) slips_too_many: u64,
    /// Missing slips, summed likewise.
    pub(super) slips_too_few: u64,
    pub(super) not_ok: usize,
}

impl Accuracy {
    pub(super) fn percent(&self, count: usize) -> f64 {
        100.0 * count as f64 / self.frames.max(1) as f64
    }
}

/// The data from which an [`Accuracy`] is computed.
#[derive(Clone, Debug, Default)]
pub(super) struct Errors {
    /// µm
    positions: Vec<f32>,
    /// mrad
    angles: Vec<f32>,
    counts: Accuracy,
}

impl Errors {
    pub(super) fn add(&mut self, frame: &Frame, truth: &Truth) {
        let [dx, dy, turn] = [0, 1, 2].map(|k| frame.pose[k] - truth.pose[k]);
        let (position, angle) = ((1e6 * dx.hypot(dy)) as f32, (1e3 * turn.abs()) as f32);
        self.positions.push(position);
        self.angles.push(angle);
        self.counts.other_state += usize::from(frame.state != truth.state);
        self.counts.not_ok += usize::from(frame.status != Status::Ok);
    }

    /// Adds the results at the end of a scene.
    pub(super) fn end_scene(&mut self, slips: u64, reference: u64, residual: Imbalance) {
        let counts = &mut self.counts;
        counts.reference_slips += reference;
        counts.slips_too_many += slips.saturating_sub(reference);
        counts.slips_too_few += reference.saturating_sub(slips);
        counts.residual = counts.residual.max(residual.force).max(residual.moment);
    }

    pub(super) fn merge(&mut self, other: &Self) {
        self.positions.extend(&other.positions);
        self.angles.extend(&other.angles);
        let (sum, more) = (&mut self.counts, &other.counts);
        sum.other_state += more.other_state;
        sum.reference_slips += more.reference_slips;
        sum.slips_too_many += more.slips_too_many;
        sum.slips_too_few += more.slips_too_few;
        sum.not_ok += more.not_ok;
        sum.residual = sum.residual.max(more.residual);
    }

    pub(super) fn finish(mut self) -> Accuracy {
        Accuracy {
            frames: self.positions.len(),
            position: Spread::of(&mut self.positions),
            angle: Spread::of(&mut self.angles),
            ..self.counts
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_is_that_of_the_sorted_values() {
        let mut values: Vec<f32> = (0..=1000_u16).rev().map(f32::from).collect();
        let spread = Spread {
            p50: 500.0,
            p90: 900.0,
            p99: 990.0,
            max: 1000.0,
        };
        assert_eq!(Spread::of(&mut values), spread);
        assert_eq!(Spread::of(&mut []), Spread::default());
    }
}
