//! The bundled scenes, built into the program.

use std::path::Path;

use stiction_scene::text::nearest;
use stiction_scene::{Source, story};

/// The scene of `stiction board` if none is named.
pub const DEFAULT: &str = "vertex-stick-slip";

macro_rules! bundled {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../scenes/", $name, ".toml")))),*]
    };
}

/// Name and text of every bundled scene.
pub const ALL: &[(&str, &str)] = bundled![
    "drag",
    "vertex-stick-slip",
    "box-flat",
    "corner-stick-slip",
    "edge-about-to-slip",
    "ladder",
    "snap",
    "locked",
    "parallel-walls",
    "point-stick-slip",
    "point-frictionless",
    "rod-on-floor",
    "slide",
    "burst",
    "table-edge",
    "step",
    "peg-in-hole",
    "plank-on-posts",
    "hook",
];

/// Returns those without obstacles.
pub fn without_obstacles() -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    ALL.iter().filter(|scene| !has_obstacles(scene))
}

/// Returns whether a bundled scene has obstacles.
pub fn has_obstacles((_, text): &(&str, &str)) -> bool {
    text.contains("\n[[obstacle]]")
}

/// A scene that can be shown: its name and what there is to see in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// Its name.
    pub name: String,
    /// Its story, if it has one.
    pub story: Option<String>,
}

impl Offer {
    /// Returns the scene file with this text under a name.
    pub fn new(name: impl Into<String>, text: &str) -> Self {
        Self {
            name: name.into(),
            story: story(text).map(str::to_owned),
        }
    }

    /// Returns all bundled scenes, or those without obstacles.
    pub fn bundled(with_obstacles: bool) -> impl Iterator<Item = Self> {
        let shown = move |scene: &&(&str, &str)| with_obstacles || !has_obstacles(scene);
        let scenes = ALL.iter().filter(shown);
        scenes.map(|&(name, text)| Self::new(name, text))
    }
}

/// Returns the bundled scene with this name.
pub fn find(name: &Path) -> Option<Source> {
    let (name, text) = ALL.iter().find(|(known, _)| Path::new(known) == name)?;
    Some(Source::new(format!("{name}.toml"), *text))
}

/// Returns the names of all bundled scenes.
pub fn names() -> String {
    let names: Vec<&str> = ALL.iter().map(|(name, _)| *name).collect();
    names.join(", ")
}

/// Returns the error message for a name that is neither a file nor a bundled scene.
pub fn unknown(name: &Path) -> String {
    // A name with an extension may mean a bundled scene, too.
    let stem = name.file_stem().unwrap_or_default().to_string_lossy();
    match nearest(&stem, ALL.iter().map(|(name, _)| *name)) {
        Some(scene) => format!("no such file or bundled scene, did you mean `{scene}`?"),
        None => format!("no such file, allowed: a scene file, or one of {}", names()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Width of a gallery card or a terminal line, into which a story has to fit.
    const LONGEST: usize = 120;

    #[test]
    fn every_scene_has_a_story_of_one_sentence() {
        for (name, _) in ALL {
            let source = find(Path::new(name)).expect("a bundled scene");
            let story = source.story().expect("a comment in the first line");
            assert!(story.len() <= LONGEST, "{name}: {story}");
            assert!(
                story.ends_with('.') && !story.contains(". "),
                "{name}: {story}"
            );
        }
    }
}
