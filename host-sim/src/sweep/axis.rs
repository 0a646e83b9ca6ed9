//! The values of one key: a list, or a range with a step for a grid and bounds for a random design, uniform or logarithmic.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::RngCore;
use serde::Deserialize;
use toml::Value;

use super::key::Key;

#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub(super) key: Key,
    /// The position of the key in the sweep file.
    pub(super) offset: usize,
    values: Values,
}

#[derive(Clone, Debug)]
enum Values {
    List(Vec<Value>),
    Range(Range),
}

/// `{ from, to, steps, scale }`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Range {
    from: f64,
    to: f64,
    steps: Option<u32>,
    #[serde(default)]
    scale: Scale,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Scale {
    #[default]
    Linear,
    Log,
}

impl Axis {
    /// Reads the values of a key at a position in the sweep file; a grid needs `steps`.
    pub(super) fn new(
        key: Key,
        offset: usize,
        given: Value,
        is_grid: bool,
    ) -> Result<Self, String> {
        let values = match given {
            Value::Array(list) if list.is_empty() => {
                return Err("is an empty list, allowed: at least one value".to_owned());
            }
            Value::Array(list) => {
                let checked = list.into_iter().map(|value| checked(&key, value));
                Values::List(checked.collect::<Result<_, _>>()?)
            }
            Value::Table(_) => Values::Range(range(&key, given, is_grid)?),
            other => {
                let allowed = "a list or a range { from, to, steps, scale }";
                return Err(format!("is {other}, allowed: {allowed}"));
            }
        };
        Ok(Self {
            key,
            offset,
            values,
        })
    }

    pub(super) fn count(&self) -> u64 {
        match &self.values {
            Values::List(list) => list.len() as u64,
            Values::Range(range) => u64::from(range.steps.unwrap_or(0)),
        }
    }

    /// Value `k` of a grid, from 0.
    pub(super) fn at(&self, k: u64) -> Value {
        match &self.values {
            Values::List(list) => list[k as usize].clone(),
            Values::Range(range) => {
                let last = range.steps.unwrap_or(0).saturating_sub(1);
                // Both ends are exact.
                Value::Float(match k {
                    0 => range.from,
                    k if k == u64::from(last) => range.to,
                    k => range.part(k as f64 / f64::from(last)),
                })
            }
        }
    }

    /// A random value: one from the list, or one from the range.
    pub(super) fn draw(&self, random: &mut ChaCha8Rng) -> Value {
        match &self.values {
            Values::List(list) => list[one_of(list.len(), random)].clone(),
            Values::Range(range) => {
                let part = (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
                Value::Float(range.part(part))
            }
        }
    }

    pub(super) fn texts(&self) -> impl Iterator<Item = &str> {
        let list = match &self.values {
            Values::List(list) => list.as_slice(),
            Values::Range(_) => &[],
        };
        list.iter().filter_map(Value::as_str)
    }
}

/// Draws one of `count` indices, in the same manner as every random value.
pub(super) fn one_of(count: usize, random: &mut ChaCha8Rng) -> usize {
    // The upper half of a product of 64 bits by 64: below `count`.
    ((u128::from(random.next_u64()) * count as u128) >> 64) as usize
}

impl Range {
    /// The value at the fraction `part` of the range, 0 to 1. The logarithm is that of libm, whose bits are the same on every
    /// machine.
    fn part(self, part: f64) -> f64 {
        let Self { from, to, .. } = self;
        let value = match self.scale {
            Scale::Linear => from + (to - from) * part,
            Scale::Log => {
                let (low, high) = (libm::log10(from), libm::log10(to));
                libm::exp10(low + (high - low) * part)
            }
        };
        // Rounding may exceed an end.
        value.clamp(from, to)
    }
}

fn checked(key: &Key, value: Value) -> Result<Value, String> {
    let written = value.to_string();
    let value = key.value(value);
    value.map_err(|allowed| format!("holds {written}, allowed: {allowed}"))
}

fn range(key: &Key, given: Value, is_grid: bool) -> Result<Range, String> {
    if !key.is_continuous() {
        return Err("is a range, allowed: a list".to_owned());
    }
    let range: Range = given
        .try_into()
        .map_err(|error: toml::de::Error| format!("is no range: {}", error.message()))?;
    let Range { from, to, .. } = range;
    checked(key, Value::Float(from))?;
    checked(key, Value::Float(to))?;
    // Also if the difference of the ends is beyond the range of the numbers.
    if !(from < to && (to - from).is_finite()) {
        return Err(format!(
            "goes from {from:?} to {to:?}, allowed: `to` above `from`"
        ));
    }
    if range.scale == Scale::Log && from <= 0.0 {
        return Err(format!(
            "goes from {from:?} with a logarithmic scale, allowed: `from` above 0"
        ));
    }
    match range.steps {
        None if is_grid => Err(
            "has no `steps`, allowed: a number of values, at least 2, or [design] with `random`"
                .to_owned(),
        ),
        Some(steps @ (0 | 1)) => Err(format!("has {steps} steps, allowed: at least 2")),
        _ => Ok(range),
    }
}
