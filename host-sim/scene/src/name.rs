//! The names of surfaces and obstacles: each is unique.

use std::ops::Range;

use toml::Spanned;

use crate::check::Check;
use crate::source::{InputError, excerpt};

/// The names so far.
#[derive(Debug, Default)]
pub(crate) struct Names(Vec<(&'static str, usize, String)>);

impl Names {
    /// Registers the name of item `index` of a kind: the given name, or else its number.
    ///
    /// # Errors
    /// The name is taken already.
    pub(crate) fn take(
        &mut self,
        check: Check<'_>,
        (kind, index): (&'static str, usize),
        name: &str,
        (given, whole): (Option<&Spanned<String>>, Range<usize>),
    ) -> Result<(), InputError> {
        if let Some((other, first, _)) = self.0.iter().find(|(.., known)| known == name) {
            let name = excerpt(name);
            let problem = format!(
                "`{kind}[{index}].name` is {name:?}, as that of {other} {first}, allowed: a name of its own"
            );
            let place = given.map_or(whole, Spanned::span);
            return Err(check.source().error_at(place.start, problem));
        }
        self.0.push((kind, index, name.to_owned()));
        Ok(())
    }
}
