//! What several commands take as an option: from its text to its value, or to what is allowed.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::builder::{OsStringValueParser, PossibleValuesParser, TypedValueParser};
use stiction_core::Evolution;

pub use stiction_live::number::{parse_evolution, parse_number};

use crate::trace::Format;

/// One of the evolutions.
pub(crate) fn evolution_parser() -> impl TypedValueParser<Value = Evolution> {
    PossibleValuesParser::new(Evolution::ALL.map(Evolution::name))
        .map(|name| parse_evolution(&name).unwrap_or_default())
}

/// A rate (Hz).
pub(crate) fn parse_rate(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(rate) if rate > 0.0 && f64::is_finite(rate) => Ok(rate),
        _ => Err("allowed: a finite number above 0".to_owned()),
    }
}

/// A trace that is to be written; its name need not be text.
pub(crate) fn trace_parser() -> impl TypedValueParser<Value = (PathBuf, Format)> {
    OsStringValueParser::new().try_map(trace)
}

fn trace(name: OsString) -> Result<(PathBuf, Format), String> {
    let file = PathBuf::from(name);
    match Format::of(&file) {
        Some(format) => Ok((file, format)),
        None => Err("allowed: a file name that ends in .jsonl or .csv".to_owned()),
    }
}

/// A budget of a frame (units of work).
pub(crate) fn parse_budget(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(units) if units > 0 => Ok(units),
        _ => Err(format!("allowed: a whole number from 1 to {}", u32::MAX)),
    }
}
