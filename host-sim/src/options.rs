//! Options that several commands share: parses their texts to values, or reports what is allowed.

use std::ffi::OsString;
use std::net::{SocketAddr, ToSocketAddrs};
use std::path::PathBuf;

use clap::builder::{OsStringValueParser, PossibleValuesParser, TypedValueParser};
use stiction_core::Evolution;
use stiction_live::number::parse_evolution;

use crate::trace::Format;

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

/// An output trace; its name need not be text.
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

/// A budget of a frame (pieces of work).
pub(crate) fn parse_budget(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(units) if units > 0 => Ok(units),
        _ => Err(format!("allowed: a whole number from 1 to {}", u32::MAX)),
    }
}

/// The address of this computer, the default if only a port is given.
const HERE: &str = "127.0.0.1";

/// HOST:PORT; a port alone refers to this computer. Whether the host exists is checked on use.
pub(crate) fn parse_end(text: &str) -> Result<String, String> {
    let port = |text: &str| text.parse::<u16>().ok();
    if let Some(port) = port(text.strip_prefix(':').unwrap_or(text)) {
        return Ok(format!("{HERE}:{port}"));
    }
    match text.rsplit_once(':') {
        Some((host, number)) if !host.is_empty() && port(number).is_some() => Ok(text.to_owned()),
        None if !text.contains(|c: char| !c.is_ascii_digit()) => {
            Err("allowed: a port from 0 to 65535, or HOST:PORT".to_owned())
        }
        None => Err(format!("the port is missing, write {text}:PORT")),
        Some(_) => Err("allowed: HOST:PORT, the port from 0 to 65535".to_owned()),
    }
}

/// The address on which this computer listens.
pub(crate) fn parse_listen(text: &str) -> Result<SocketAddr, String> {
    let end = parse_end(text)?;
    let mut places = end.to_socket_addrs().map_err(|error| error.to_string())?;
    places.next().ok_or_else(|| "no such host".to_owned())
}
