//! Statuses, laws and other names counted; quantiles.

use std::collections::BTreeMap;
use std::fmt;

/// How often each name occurred.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally(BTreeMap<&'static str, u64>);

impl Tally {
    /// Once more.
    pub(crate) fn add(&mut self, name: &'static str) {
        *self.0.entry(name).or_default() += 1;
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return f.write_str("none");
        }
        let each: Vec<_> = self
            .0
            .iter()
            .map(|(name, n)| format!("{name} {n}"))
            .collect();
        f.write_str(&each.join(", "))
    }
}

/// Numbers whose quantiles are of interest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spread(Vec<f64>);

impl Spread {
    /// One more; not a number counts as larger than all others.
    pub(crate) fn add(&mut self, value: f64) {
        self.0.push(value);
    }
}

impl fmt::Display for Spread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut sorted = self.0.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let at = |part: f64| {
            let rank = (part * sorted.len() as f64).ceil() as usize;
            sorted.get(rank.max(1) - 1).copied().unwrap_or_default()
        };
        let each = [0.5, 0.9, 0.99, 0.999, 1.0].map(|part| format!("{:.1e}", at(part)));
        f.write_str(&each.join(" / "))
    }
}
