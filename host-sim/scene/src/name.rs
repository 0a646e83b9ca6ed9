//! The names of surfaces and obstacles: each is unique.

use crate::check::Check;
use crate::friction::Owner;
use crate::source::{InputError, excerpt};

/// The names so far.
#[derive(Debug, Default)]
pub(crate) struct Names(Vec<(&'static str, usize, String)>);

impl Names {
    /// Registers and returns the name of an item: the given name, or else its number.
    pub(crate) fn take(
        &mut self,
        check: Check<'_>,
        owner: &Owner<'_>,
    ) -> Result<String, InputError> {
        let (kind, index) = (owner.kind, owner.index);
        let (name, place) = match owner.name {
            Some(name) => (name.get_ref().clone(), name.span().start),
            None => (index.to_string(), owner.span.start),
        };
        if let Some((other, first, _)) = self.0.iter().find(|(.., known)| *known == name) {
            let name = excerpt(&name);
            let problem = format!(
                "`{kind}[{index}].name` is {name:?}, as that of {other} {first}, allowed: a name of its own"
            );
            return Err(check.source().error_at(place, problem));
        }
        self.0.push((kind, index, name.clone()));
        Ok(name)
    }
}
