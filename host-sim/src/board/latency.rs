//! The latency from a sample to the pose that follows it: a histogram of fixed size, independent of the duration.

use std::time::Duration;

/// Bins of a 50th of a millisecond, up to 2 s.
const BINS: usize = 100_000;
const PER_SECOND: f64 = 50_000.0;

#[derive(Clone, Debug)]
pub(super) struct Latency {
    bins: Vec<u32>,
    count: u64,
    worst: Duration,
}

impl Default for Latency {
    fn default() -> Self {
        Self {
            bins: vec![0; BINS],
            count: 0,
            worst: Duration::ZERO,
        }
    }
}

impl Latency {
    pub(super) fn add(&mut self, latency: Duration) {
        let bin = (latency.as_secs_f64() * PER_SECOND) as usize;
        self.bins[bin.min(BINS - 1)] += 1;
        self.count += 1;
        self.worst = self.worst.max(latency);
    }

    /// The latency (ms) that bounds this fraction of all samples: the upper end of its bin. Nothing without any samples.
    pub(super) fn quantile(&self, part: f64) -> Option<f64> {
        let wanted = (part * self.count as f64).ceil() as u64;
        let mut below = 0;
        let bin = self.bins.iter().position(|count| {
            below += u64::from(*count);
            below >= wanted.max(1)
        })?;
        Some(1e3 * (bin + 1) as f64 / PER_SECOND)
    }

    /// The largest latency (ms).
    pub(super) fn worst(&self) -> f64 {
        1e3 * self.worst.as_secs_f64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_within_a_bin() {
        let mut latency = Latency::default();
        assert_eq!(latency.quantile(0.5), None);
        for tenths in 1..=1000_u64 {
            latency.add(Duration::from_micros(100 * tenths));
        }
        for (part, expected) in [(0.5, 50.0), (0.99, 99.0), (1.0, 100.0)] {
            let found = latency.quantile(part).expect("some");
            assert!((found - expected).abs() <= 0.021, "{part}: {found}");
        }
        assert_eq!(latency.worst(), 100.0);
        // What is beyond the bins counts as the last one.
        latency.add(Duration::from_secs(7));
        assert_eq!(latency.quantile(1.0), Some(2000.0));
        assert_eq!(latency.worst(), 7000.0);
    }
}
