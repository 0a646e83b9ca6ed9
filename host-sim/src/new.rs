//! `stiction new`: a scene file to start from, a bundled scene or one of the user's, with a comment on every key.

use std::collections::BTreeSet;
use std::error::Error;
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use clap::Args;

use crate::files::WriteError;
use crate::input::open_scene;
use crate::report;
use crate::shell::scene_completer;
use stiction_live::number::Number;

/// The arguments of `stiction new`.
#[derive(Args, Clone, Debug)]
pub struct NewArgs {
    /// File to write: NAME.toml; never over one that is there
    #[arg(value_name = "NAME")]
    name: PathBuf,
    /// Scene to start from: a bundled scene, or a scene file
    #[arg(long, value_name = "SCENE", default_value = "box-flat", add = scene_completer())]
    like: PathBuf,
}

/// Writes the file and prints the next commands to type.
pub(crate) fn new(args: &NewArgs) -> Result<(), Box<dyn Error>> {
    let like = open_scene(&args.like, Number::F32)?;
    let file = file(&args.name);
    let text = explained(like.source().text(), &file);
    let mut created = File::create_new(&file).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => WriteError::Exists(file.clone()),
        _ => WriteError::of(&file)(error),
    })?;
    created
        .write_all(text.as_bytes())
        .map_err(WriteError::of(&file))?;
    let name = file.display();
    report::print(&format!(
        "{name}: written\n  to run it:                  stiction run {name} --plot plots\n  \
         to hold it with the mouse:  stiction view {name}\n"
    ));
    Ok(())
}

fn file(name: &Path) -> PathBuf {
    let mut file = name.as_os_str().to_owned();
    if name.extension().is_none_or(|end| end != "toml") {
        file.push(".toml");
    }
    file.into()
}

/// A key of a section, its meaning, and the value of the line that offers it to a scene without it; none for keys that a scene
/// requires or for which it has another key.
struct KnownKey(
    &'static str,
    &'static str,
    &'static str,
    Option<&'static str>,
);

#[rustfmt::skip]
const KEYS: &[KnownKey] = &[
    KnownKey("body", "vertices", "corners in the body's own frame [m], convex, counter-clockwise; two: a rod, one: a point", None),
    KnownKey("body", "rectangle", "width, height [m], centred on the body's origin", None),
    KnownKey("body", "start", "x, y [m] and angle theta [rad] of the body at the beginning", None),
    KnownKey("body", "weight", "[N], downwards at the centroid", Some("2.0")),
    KnownKey("grasp", "point", "where the hand holds, in the body's own frame [m]", None),
    KnownKey("grasp", "reach", "how far outside the body the hand may be and still take hold [m]", Some("0.01")),
    KnownKey("spring", "translation", "stiffness between hand and body [N/m]", None),
    KnownKey("spring", "rotation", "the same of the angle [N·m/rad]; 0: the hand does not turn the body", None),
    KnownKey("friction", "static", "mu_s: a contact sticks up to this ratio of friction to normal force", None),
    KnownKey("friction", "dynamic", "mu_d: a slip ends at this ratio; as large as mu_s: it slides without jerks", None),
    KnownKey("surface", "name", "in traces and plots", None),
    KnownKey("surface", "normal", "direction to the free side", None),
    KnownKey("surface", "offset", "distance from the world's origin along the normal [m]", None),
    KnownKey("surface", "static", "mu_s of this surface alone", Some("0.8")),
    KnownKey("surface", "dynamic", "mu_d of this surface alone", Some("0.6")),
    KnownKey("obstacle", "name", "in traces and plots", None),
    KnownKey("obstacle", "vertices", "corners in the world [m], convex, counter-clockwise; two: a thin wall, one: a pin", None),
    KnownKey("obstacle", "static", "mu_s of this obstacle alone", Some("0.8")),
    KnownKey("obstacle", "dynamic", "mu_d of this obstacle alone", Some("0.6")),
    KnownKey("hand", "rate", "frames per second", None),
    KnownKey("hand", "keyframes", "the hand's path: t [s], x, y [m], phi [rad]; straight lines between", None),
    KnownKey("hand", "path", "instead of keyframes: a recorded path with the columns t,x,y,phi", Some("\"hand.csv\"")),
];

/// The column at which comments begin (characters).
const COLUMN: usize = 36;

/// A scene with a comment on every key of the first section of each name, and with the keys that it could have.
fn explained(text: &str, file: &Path) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut known = BTreeSet::new();
    let mut sections = sections(text).into_iter();
    lines.extend(sections.next().into_iter().flatten().map(str::to_owned));
    let name = file.display();
    lines.push("#".to_owned());
    lines.push(format!(
        "# Change the numbers, then: stiction run {name} --plot plots, or: stiction view {name}"
    ));
    lines.push("# x points to the right, y upwards; angles grow counter-clockwise.".to_owned());
    for section in sections {
        lines.push(String::new());
        let name = section[0].trim_matches(['[', ']', ' ']);
        match known.insert(name) {
            true => lines.extend(commented(name, &section)),
            false => lines.extend(section.into_iter().map(str::to_owned)),
        }
    }
    lines.join("\n") + "\n"
}

/// The text before the first section, then the sections, without the empty lines around them.
fn sections(text: &str) -> Vec<Vec<&str>> {
    let mut sections = vec![Vec::new()];
    for line in text.lines() {
        if line.starts_with('[') {
            sections.push(Vec::new());
        }
        if let Some(section) = sections.last_mut() {
            section.push(line.trim_end());
        }
    }
    for section in &mut sections {
        while section.last().is_some_and(|line| line.is_empty()) {
            section.pop();
        }
    }
    sections
}

/// A section with a comment on each key that has none, and the keys that it could have as comments.
fn commented(name: &str, section: &[&str]) -> Vec<String> {
    let keys = || KEYS.iter().filter(|KnownKey(section, ..)| *section == name);
    let key_of = |line: &str| line.split_once('=').map(|(key, _)| key.trim().to_owned());
    let line = |line: &&str| {
        let key = key_of(line).filter(|_| !line.contains('#') && !line.starts_with(' '));
        let meaning = keys().find(|KnownKey(_, known, ..)| key.as_deref() == Some(known));
        match meaning {
            Some(KnownKey(_, _, meaning, _)) => with_comment(line, meaning),
            None => (*line).to_owned(),
        }
    };
    let mut lines: Vec<String> = section.iter().map(line).collect();
    for KnownKey(_, key, meaning, offered) in keys() {
        let is_there = section
            .iter()
            .any(|line| key_of(line).as_deref() == Some(key));
        if let (Some(value), false) = (offered, is_there) {
            let offer = format!("# {key} = {value}");
            lines.push(with_comment(&offer, meaning));
        }
    }
    lines
}

fn with_comment(line: &str, meaning: &str) -> String {
    let begin = format!("{line}  ");
    format!("{begin:<COLUMN$}# {meaning}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiction_live::scenes;
    use stiction_scene::{SceneFile, Source};

    /// The comments change nothing: the scene has the same values, key by key, also with every key that is offered.
    #[test]
    fn a_new_scene_is_the_one_that_it_is_like() {
        let values = |text: &str| text.parse::<toml::Table>().expect("TOML");
        for (name, text) in scenes::ALL {
            let explained = explained(text, Path::new("mine.toml"));
            assert_eq!(values(&explained), values(text), "{name}");
            let source = Source::new("mine.toml", explained.as_str());
            assert_eq!(source.story(), Source::new(*name, *text).story());
            let limit = Number::F32.limit();
            // The path replaces keyframes.
            let offered = explained.replace("# path = \"hand.csv\"", "#");
            let mut lines = offered.lines().map(|line| match line.strip_prefix("# ") {
                Some(rest) if rest.contains(" = ") && rest.contains('#') => rest,
                _ => line,
            });
            let all: String = lines.by_ref().flat_map(|line| [line, "\n"]).collect();
            assert_ne!(values(&all), values(text), "{name}");
            let read = SceneFile::parse(Source::new("mine.toml", all), limit);
            assert!(read.is_ok(), "{name}: {read:?}");
        }
    }
}
