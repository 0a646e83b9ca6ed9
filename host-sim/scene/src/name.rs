//! The names of surfaces and obstacles: each is unique.

use crate::check::Check;
use crate::source::{InputError, excerpt};

/// The names so far.
#[derive(Debug, Default)]
pub(crate) struct Names(Vec<(&'static str, usize, String)>);

impl Names {
    /// Registers the name of item `index` of a kind: the given name, or else its number. `place` is where the file has it, or the item.
    pub(crate) fn take(
        &mut self,
        check: Check<'_>,
        (kind, index): (&'static str, usize),
        name: &str,
        place: usize,
    ) -> Result<(), InputError> {
        if let Some((other, first, _)) = self.0.iter().find(|(.., known)| known == name) {
            let name = excerpt(name);
            let problem = format!(
                "`{kind}[{index}].name` is {name:?}, as that of {other} {first}, allowed: a name of its own"
            );
            return Err(check.source().error_at(place, problem));
        }
        self.0.push((kind, index, name.to_owned()));
        Ok(())
    }
}
