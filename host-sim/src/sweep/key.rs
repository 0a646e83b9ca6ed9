//! The keys that a sweep may vary: the keys of a scene file, and `run.` with the options of `stiction run`. From a key and a
//! value to the scene's TOML and the settings of the run.

use std::path::Path;

use toml::{Table, Value};

use crate::options::{parse_budget, parse_rate};
use crate::settings::Settings;
use stiction_live::number::{parse_evolution, parse_number};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Number,
    Numbers,
    Text,
}

/// Keys of a scene file; those of a surface follow `surface.NAME.`, those of an obstacle `obstacle.NAME.`.
const SCENE: [(&str, Kind); 17] = [
    ("body.vertices", Kind::Numbers),
    ("body.rectangle", Kind::Numbers),
    ("body.start", Kind::Numbers),
    ("body.weight", Kind::Number),
    ("grasp.point", Kind::Numbers),
    ("grasp.reach", Kind::Number),
    ("spring.translation", Kind::Number),
    ("spring.rotation", Kind::Number),
    ("friction.static", Kind::Number),
    ("friction.dynamic", Kind::Number),
    ("friction.memory", Kind::Number),
    ("hand.rate", Kind::Number),
    ("hand.keyframes", Kind::Numbers),
    ("hand.plane", Kind::Text),
    ("hand.scale", Kind::Number),
    ("hand.origin", Kind::Numbers),
    ("hand.angle", Kind::Text),
];
const SURFACE: [(&str, Kind); 5] = [
    ("normal", Kind::Numbers),
    ("offset", Kind::Number),
    ("static", Kind::Number),
    ("dynamic", Kind::Number),
    ("memory", Kind::Number),
];
const OBSTACLE: [(&str, Kind); 4] = [
    ("vertices", Kind::Numbers),
    ("static", Kind::Number),
    ("dynamic", Kind::Number),
    ("memory", Kind::Number),
];
/// Sections that may occur several times in a file, and their keys.
const NAMED: [(&str, &[(&str, Kind)]); 2] = [("surface", &SURFACE), ("obstacle", &OBSTACLE)];
const RUN: [(&str, Dial); 5] = [
    ("run.hand", Dial::Hand),
    ("run.number", Dial::Number),
    ("run.evolution", Dial::Evolution),
    ("run.rate", Dial::Rate),
    ("run.budget", Dial::Budget),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Dial {
    Hand,
    Number,
    Evolution,
    Rate,
    Budget,
}

#[derive(Clone, Debug)]
pub(super) struct Key {
    name: String,
    place: KeyPlace,
}

#[derive(Clone, Debug)]
enum KeyPlace {
    Run(Dial),
    /// Names of tables, names or indices of surfaces and obstacles, indices into arrays.
    Scene(Vec<String>, Kind),
}

/// All keys that may be varied, for messages.
pub(super) fn all() -> String {
    let run = RUN.iter().map(|(name, _)| (*name).to_owned());
    let scene = SCENE.iter().map(|(name, _)| (*name).to_owned());
    let named = NAMED.iter().flat_map(|(section, keys)| {
        (keys.iter()).map(move |(name, _)| format!("{section}.NAME.{name}"))
    });
    let names: Vec<String> = scene.chain(named).chain(run).collect();
    format!("{}, and .0, .1, ... behind arrays", names.join(", "))
}

impl Key {
    /// The key of a name; `None` if there is none.
    pub(super) fn parse(name: &str) -> Option<Self> {
        let place = match RUN.iter().find(|(known, _)| *known == name) {
            Some((_, dial)) => KeyPlace::Run(*dial),
            None => scene_place(name)?,
        };
        let name = name.to_owned();
        Some(Self { name, place })
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// Converts a value to the type of this key: whole numbers become floating-point numbers if it needs these.
    pub(super) fn value(&self, value: Value) -> Result<Value, String> {
        let whole = matches!(self.place, KeyPlace::Run(Dial::Budget));
        let value = match value {
            Value::Integer(number) if !whole => Value::Float(number as f64),
            value => value,
        };
        match &self.place {
            KeyPlace::Run(dial) => {
                set_dial(*dial, &value, Path::new(""), &mut Settings::default())?
            }
            KeyPlace::Scene(_, kind) => {
                let (fits, allowed) = match kind {
                    Kind::Number => (
                        value.as_float().is_some_and(f64::is_finite),
                        "finite numbers",
                    ),
                    Kind::Numbers => (value.is_array(), "arrays of numbers"),
                    Kind::Text => (value.is_str(), "texts"),
                };
                if !fits {
                    return Err(allowed.to_owned());
                }
            }
        }
        Ok(value)
    }

    /// Returns whether the values are numbers from a continuous range.
    pub(super) fn is_continuous(&self) -> bool {
        match self.place {
            KeyPlace::Run(dial) => matches!(dial, Dial::Rate),
            KeyPlace::Scene(_, kind) => kind == Kind::Number,
        }
    }

    /// Whether the values are files of recorded paths of the hand.
    pub(super) fn is_hand(&self) -> bool {
        matches!(self.place, KeyPlace::Run(Dial::Hand))
    }

    /// Writes a value to its place; files of the run are relative to `folder`.
    pub(super) fn set(
        &self,
        value: &Value,
        folder: &Path,
        scene: &mut Table,
        settings: &mut Settings,
    ) -> Result<(), String> {
        match &self.place {
            KeyPlace::Run(dial) => set_dial(*dial, value, folder, settings),
            KeyPlace::Scene(path, _) => match path.split_first() {
                Some((section, rest)) => {
                    let new = || Value::Table(Table::new());
                    set_in(
                        scene.entry(section).or_insert_with(new),
                        section,
                        rest,
                        value,
                    )
                }
                None => Ok(()),
            },
        }
    }
}

/// The place of a key of the scene file, with or without trailing indices into arrays.
fn scene_place(name: &str) -> Option<KeyPlace> {
    let mut base = name;
    let mut indices = Vec::new();
    loop {
        if let Some((path, kind)) = whole_place(base) {
            let kind = match (kind, indices.len()) {
                (kind, 0) => kind,
                (Kind::Numbers, _) => Kind::Number,
                _ => return None,
            };
            let path = path.into_iter().chain(indices.into_iter().rev());
            return Some(KeyPlace::Scene(path.map(str::to_owned).collect(), kind));
        }
        let (rest, index) = base.rsplit_once('.')?;
        index.parse::<usize>().ok()?;
        indices.push(index);
        base = rest;
    }
}

fn whole_place(name: &str) -> Option<(Vec<&str>, Kind)> {
    for (section, keys) in NAMED {
        let rest = name.strip_prefix(section);
        if let Some(rest) = rest.and_then(|rest| rest.strip_prefix('.')) {
            let (one, key) = rest.rsplit_once('.')?;
            let (_, kind) = keys.iter().find(|(known, _)| *known == key)?;
            return Some((vec![section, one, key], *kind));
        }
    }
    let (_, kind) = SCENE.iter().find(|(known, _)| *known == name)?;
    Some((name.split('.').collect(), *kind))
}

/// Writes a value below `node`, which is called `name`.
fn set_in(node: &mut Value, name: &str, path: &[String], value: &Value) -> Result<(), String> {
    let Some((step, rest)) = path.split_first() else {
        *node = value.clone();
        return Ok(());
    };
    match node {
        Value::Table(table) => {
            let new = || value.clone();
            set_in(table.entry(step).or_insert_with(new), step, rest, value)
        }
        Value::Array(array) => {
            let index = array.iter().position(|entry| is_called(entry, step));
            let index = index.or_else(|| step.parse().ok());
            match index.and_then(|index| array.get_mut(index)) {
                Some(entry) => set_in(entry, step, rest, value),
                None => Err(format!("has no {name} {step:?}, allowed: {}", steps(array))),
            }
        }
        _ => Err(format!(
            "has no {step:?} in `{name}`, allowed: a scene that has it"
        )),
    }
}

/// The names of the tables in an array, or its indices.
fn steps(array: &[Value]) -> String {
    let named = |(i, entry): (usize, &Value)| match entry.get("name").and_then(Value::as_str) {
        Some(name) => name.to_owned(),
        None => i.to_string(),
    };
    match array {
        [] => "a scene that has one".to_owned(),
        [Value::Table(_), ..] => {
            let names: Vec<String> = array.iter().enumerate().map(named).collect();
            names.join(", ")
        }
        _ => format!("0 to {}", array.len() - 1),
    }
}

fn is_called(entry: &Value, name: &str) -> bool {
    entry.get("name").and_then(Value::as_str) == Some(name)
}

/// Parses a value as `stiction run` parses its option.
fn set_dial(
    dial: Dial,
    value: &Value,
    folder: &Path,
    settings: &mut Settings,
) -> Result<(), String> {
    let text = match value {
        Value::String(text) => text.clone(),
        Value::Float(number) => format!("{number:?}"),
        other => other.to_string(),
    };
    match dial {
        Dial::Hand if value.is_str() => settings.hand = Some(folder.join(text)),
        Dial::Hand => return Err("texts, each the name of a file".to_owned()),
        Dial::Number => {
            settings.number = parse_number(&text).map_err(bare)?;
        }
        Dial::Evolution => {
            settings.evolution = parse_evolution(&text).map_err(bare)?;
        }
        Dial::Rate => settings.rate = Some(parse_rate(&text).map_err(bare)?),
        Dial::Budget => settings.budget = Some(parse_budget(&text).map_err(bare)?),
    }
    Ok(())
}

/// The allowed values, without the word.
fn bare(message: String) -> String {
    message.trim_start_matches("allowed: ").to_owned()
}
