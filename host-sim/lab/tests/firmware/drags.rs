//! Random drags of ordinary use.

use stiction_host_sim::trade::{self, Case};

/// Drags without end.
pub(crate) fn random() -> impl Iterator<Item = Case> {
    trade::drags().map(Result::unwrap)
}
