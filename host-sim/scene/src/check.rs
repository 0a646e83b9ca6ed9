//! Checks the numbers of a scene file: finite, within the number type, and as many as the key requires.

use crate::document::{Number, Numbers};
use crate::source::{InputError, Source, excerpt};

/// Checks values of one file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Check<'a> {
    source: &'a Source,
    /// The largest magnitude of a number.
    limit: f64,
}

impl<'a> Check<'a> {
    /// Checks values of `source` with magnitudes up to `limit`.
    pub(crate) const fn new(source: &'a Source, limit: f64) -> Self {
        Self { source, limit }
    }

    pub(crate) const fn source(&self) -> &'a Source {
        self.source
    }

    /// The largest magnitude of a number.
    pub(crate) const fn limit(&self) -> f64 {
        self.limit
    }

    pub(crate) fn number(&self, key: &str, given: &Number) -> Result<f64, InputError> {
        let value = *given.get_ref();
        self.finite(value)
            .map_err(|allowed| self.error(key, given, &allowed))?;
        Ok(value)
    }

    pub(crate) fn number_or(
        &self,
        key: &str,
        given: Option<&Number>,
        default: f64,
    ) -> Result<f64, InputError> {
        given.map_or(Ok(default), |given| self.number(key, given))
    }

    pub(crate) fn positive(&self, key: &str, given: &Number) -> Result<f64, InputError> {
        let value = self.number(key, given)?;
        if value > 0.0 {
            Ok(value)
        } else {
            Err(self.error(key, given, "more than 0"))
        }
    }

    /// N numbers; `names` lists their meanings.
    pub(crate) fn numbers<const N: usize>(
        &self,
        key: &str,
        given: &Numbers,
        names: &str,
    ) -> Result<[f64; N], InputError> {
        let values = <[f64; N]>::try_from(given.get_ref().as_slice())
            .map_err(|_| self.error(key, given, &format!("{N} numbers, {names}")))?;
        for value in values {
            self.finite(value)
                .map_err(|allowed| self.error(key, given, &allowed))?;
        }
        Ok(values)
    }

    /// If `value` is not allowed, the error states what is.
    fn finite(&self, value: f64) -> Result<(), String> {
        if value.abs() <= self.limit {
            Ok(())
        } else {
            Err(format!("finite numbers up to {:.2e}", self.limit))
        }
    }

    /// The message "`key` is value, allowed: ...", with the line.
    pub(crate) fn error<T: std::fmt::Debug>(
        &self,
        key: &str,
        given: &toml::Spanned<T>,
        allowed: &str,
    ) -> InputError {
        let value = excerpt(&format!("{:?}", given.get_ref()));
        let problem = format!("`{key}` is {value}, allowed: {allowed}");
        self.source.error_at(given.span().start, problem)
    }
}
