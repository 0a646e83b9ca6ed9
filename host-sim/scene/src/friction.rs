//! Friction in a file: `[friction]` for all, and the flat keys of a surface or an obstacle, which take precedence.

use std::ops::Range;

use toml::Spanned;

use crate::check::Check;
use crate::document::{Document, Number};
use crate::source::InputError;

/// The allowed range of static friction.
const STATIC_FRICTION: &str = "not less than the dynamic friction";

/// mu_s, mu_d and the memory length of `[friction]`, as far as given.
#[derive(Clone, Copy)]
pub(crate) struct Fallback {
    stick: Option<f64>,
    slip: Option<f64>,
    memory: Option<f64>,
}

pub(crate) struct Coefficients {
    pub(crate) stick: f64,
    pub(crate) slip: f64,
    /// Memory length (m); `None` if the file gives none.
    pub(crate) memory: Option<f64>,
}

/// The owner of a name and of friction keys: `surface` or `obstacle` with its number, its position in the text, and its keys.
pub(crate) struct Owner<'a> {
    pub(crate) kind: &'static str,
    pub(crate) index: usize,
    pub(crate) span: Range<usize>,
    pub(crate) name: Option<&'a Spanned<String>>,
    pub(crate) stick: Option<&'a Number>,
    pub(crate) slip: Option<&'a Number>,
    pub(crate) memory: Option<&'a Number>,
}

impl Fallback {
    pub(crate) fn new(check: Check<'_>, document: &Document) -> Result<Self, InputError> {
        let default = &document.friction;
        let fallback = Self {
            stick: coefficient(check, "friction.static", default.stick.as_ref())?,
            slip: coefficient(check, "friction.dynamic", default.slip.as_ref())?,
            memory: coefficient(check, "friction.memory", default.memory.as_ref())?,
        };
        match (fallback.stick, fallback.slip, &default.stick) {
            (Some(stick), Some(slip), Some(given)) if stick < slip => {
                Err(check.error("friction.static", given, STATIC_FRICTION))
            }
            _ => Ok(fallback),
        }
    }

    /// The friction of an owner that may have its own.
    pub(crate) fn of(
        self,
        check: Check<'_>,
        owner: &Owner<'_>,
    ) -> Result<Coefficients, InputError> {
        let (kind, index) = (owner.kind, owner.index);
        let own = |name: &str, given| coefficient(check, &format!("{kind}[{index}].{name}"), given);
        let needed = |name: &str, given, default: Option<f64>| {
            own(name, given)?.or(default).ok_or_else(|| {
                let problem = format!(
                    "{kind} {index} has no `{name}` friction, allowed: `{name}` here or in [friction]"
                );
                check.source().error_at(owner.span.start, problem)
            })
        };
        Ok(Coefficients {
            stick: needed("static", owner.stick, self.stick)?,
            slip: needed("dynamic", owner.slip, self.slip)?,
            memory: own("memory", owner.memory)?.or(self.memory),
        })
    }
}

/// A number of 0 or more.
fn coefficient(
    check: Check<'_>,
    key: &str,
    given: Option<&Number>,
) -> Result<Option<f64>, InputError> {
    let Some(given) = given else {
        return Ok(None);
    };
    let value = check.number(key, given)?;
    if value < 0.0 {
        return Err(check.error(key, given, "0 or more"));
    }
    Ok(Some(value))
}
