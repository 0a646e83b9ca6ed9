//! Adds suggestions to a message of clap: what was probably meant, and what to type.

use std::path::Path;

use clap::Error;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use stiction_scene::text::nearest;

use crate::command::described;
use stiction_live::scenes;

pub(crate) fn explained(mut error: Error) -> Error {
    let tips = match error.kind() {
        ErrorKind::InvalidSubcommand => of_command(&error),
        ErrorKind::UnknownArgument => of_word(&error),
        ErrorKind::InvalidValue => of_value(&error),
        ErrorKind::MissingRequiredArgument => of_missing(&error),
        _ => Vec::new(),
    };
    if !tips.is_empty() {
        // A tip of clap's own would be misleading.
        for other in [ContextKind::SuggestedSubcommand, ContextKind::SuggestedArg] {
            error.remove(other);
        }
        let tips = tips.into_iter().map(Into::into).collect();
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
    }
    error
}

fn context(error: &Error, kind: ContextKind) -> &str {
    match error.get(kind) {
        Some(ContextValue::String(text)) => text,
        _ => "",
    }
}

/// A word that names a scene: a bundled one, or a file.
fn is_scene(word: &str) -> bool {
    let path = Path::new(word);
    scenes::find(path).is_some() || path.is_file() || word.ends_with(".toml")
}

/// A scene, or a similar word, in the place of a command.
fn of_command(error: &Error) -> Vec<String> {
    let word = context(error, ContextKind::InvalidSubcommand);
    if word.ends_with(".toml") && !Path::new(word).is_file() {
        let write = format!("to write a scene of this name: stiction new {word}");
        return vec![format!("there is no file '{word}'"), write];
    }
    if is_scene(word) {
        return vec![
            format!("'{word}' is a scene; to run it: stiction run {word}"),
            format!("to hold it with the mouse: stiction view {word}"),
        ];
    }
    if error.get(ContextKind::SuggestedSubcommand).is_some() {
        return Vec::new();
    }
    let program = described();
    let commands = program.get_subcommands().map(clap::Command::get_name);
    if let Some(command) = nearest(word, commands) {
        return vec![format!("a similar command exists: stiction {command}")];
    }
    match nearest(word, scenes::ALL.iter().map(|(name, _)| *name)) {
        Some(scene) => vec![format!("a scene has a similar name: stiction view {scene}")],
        None => vec!["all commands: stiction --help".to_owned()],
    }
}

/// A word too many.
fn of_word(error: &Error) -> Vec<String> {
    let word = context(error, ContextKind::InvalidArg);
    match is_scene(word) {
        true => vec![format!(
            "one scene at a time; '{word}' needs a command of its own"
        )],
        false => Vec::new(),
    }
}

/// A scene in the place of a board.
fn of_value(error: &Error) -> Vec<String> {
    let option = context(error, ContextKind::InvalidArg);
    let value = context(error, ContextKind::InvalidValue);
    match option.starts_with("--emulate") && is_scene(value) {
        true => vec![format!(
            "'{value}' is a scene, which stands before the option: {value} --emulate"
        )],
        false => Vec::new(),
    }
}

/// A required argument is missing.
fn of_missing(error: &Error) -> Vec<String> {
    let Some(ContextValue::Strings(missing)) = error.get(ContextKind::InvalidArg) else {
        return Vec::new();
    };
    let lacks = |name: &str| missing.iter().any(|argument| argument.contains(name));
    if lacks("SCENE") || lacks("--scene") {
        return vec![
            "names of scenes: stiction scenes; a file of your own: stiction new NAME".to_owned(),
        ];
    }
    if lacks("--emulate") {
        return vec!["without a board at hand: --emulate".to_owned()];
    }
    Vec::new()
}
