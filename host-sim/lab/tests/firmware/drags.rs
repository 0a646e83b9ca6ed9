//! Random drags of ordinary use, again and again.

use stiction_host_sim::trade::{Case, Group, Suite};

/// The random cases of the trade, for ever.
pub(crate) fn random() -> impl Iterator<Item = Case> {
    let cases = Suite::new(None, false).unwrap().cases.into_iter();
    let random: Vec<_> = cases.filter(|case| case.group == Group::Random).collect();
    random.into_iter().cycle()
}
