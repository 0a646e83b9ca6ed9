//! A scene file with the motion of its hand: from TOML to a checked [`Scene`] of the solver and a path.

use std::ops::Deref;
use std::path::Path;

use stiction_core::{Scene, Solver};
use toml::Spanned;

use crate::check::Check;
use crate::hand_section::HandSection;
use crate::source::{InputError, Source};
use crate::written::{CORNERS, SURFACES, VERTICES, WrittenScene};

/// A scene with the capacities of the host.
pub type HostScene<R> = Scene<R, VERTICES, SURFACES, CORNERS>;

/// A solver for any scene file.
pub type HostSolver<R> = Solver<R, VERTICES, SURFACES, CORNERS>;

/// A scene file whose numbers, including those of its hand, are finite, in range and complete. [`WrittenScene::scene`]
/// checks whether they make a scene.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// Everything except the hand's motion.
    pub written: WrittenScene,
    /// The hand's motion.
    pub hand: HandSection,
}

impl SceneFile {
    /// Reads a scene file for a number type whose largest number is `limit`.
    ///
    /// # Errors
    /// The file cannot be read, is not TOML, or a key is unknown, missing, of the wrong type or out of range.
    pub fn read(file: &Path, limit: f64) -> Result<Self, InputError> {
        Self::parse(Source::read(file)?, limit)
    }

    /// Reads a scene from text.
    ///
    /// # Errors
    /// As for [`SceneFile::read`].
    pub fn parse(source: Source, limit: f64) -> Result<Self, InputError> {
        let written = WrittenScene::parse(source, limit)?;
        let check = Check::new(written.source(), limit);
        let hand = HandSection::new(check, &written.document.hand)?;
        Ok(Self { written, hand })
    }

    /// A problem with `hand.rate`, reported in its line if it is given.
    pub fn error_at_rate(&self, problem: &str) -> InputError {
        match &self.written.document.hand.rate {
            Some(rate) => self.source().error_at(rate.span().start, problem),
            None => self.source().error(problem),
        }
    }

    /// `[hand]` as the file has it, value by value, but with this origin of its path: x, y (m), phi (rad).
    pub fn hand_text(&self, origin: &[f64; 3]) -> String {
        let (hand, text) = (&self.written.document.hand, self.source().text());
        let spans = [
            ("rate", hand.rate.as_ref().map(Spanned::span)),
            ("keyframes", hand.keyframes.as_ref().map(Spanned::span)),
            ("path", hand.path.as_ref().map(Spanned::span)),
            ("plane", hand.plane.as_ref().map(Spanned::span)),
            ("scale", hand.scale.as_ref().map(Spanned::span)),
            ("angle", hand.angle.as_ref().map(Spanned::span)),
            ("unwrap", hand.unwrap.as_ref().map(Spanned::span)),
        ];
        let mut section = "[hand]\n".to_owned();
        for (key, span) in spans {
            let value = span.and_then(|span| text.get(span));
            if let Some(value) = value {
                section += &format!("{key} = {value}\n");
            }
        }
        if hand.origin.is_some() || *origin != [0.0; 3] {
            section += &format!("origin = {origin:?}\n");
        }
        section
    }
}

impl Deref for SceneFile {
    type Target = WrittenScene;

    fn deref(&self) -> &WrittenScene {
        &self.written
    }
}
