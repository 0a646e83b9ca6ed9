//! The scene file as TOML: sections, keys and types, each value with its position in the text; nothing else is checked.

use serde::Deserialize;
use toml::Spanned;

/// A number with its position.
pub(crate) type Number = Spanned<f64>;
/// An array of numbers with its position.
pub(crate) type Numbers = Spanned<Vec<f64>>;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Document {
    pub(crate) body: Body,
    #[serde(default)]
    pub(crate) grasp: Grasp,
    pub(crate) spring: Spring,
    #[serde(default)]
    pub(crate) friction: Friction,
    #[serde(default)]
    pub(crate) surface: Vec<Spanned<Surface>>,
    #[serde(default)]
    pub(crate) obstacle: Vec<Spanned<Obstacle>>,
    #[serde(default)]
    pub(crate) hand: Hand,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Body {
    pub(crate) vertices: Option<Spanned<Vec<Numbers>>>,
    pub(crate) rectangle: Option<Numbers>,
    pub(crate) start: Numbers,
    pub(crate) weight: Option<Number>,
    /// Whether corners that make no convex polygon are mended.
    pub(crate) repair: Option<bool>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Grasp {
    pub(crate) point: Option<Numbers>,
    pub(crate) reach: Option<Number>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Spring {
    pub(crate) translation: Number,
    pub(crate) rotation: Number,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Friction {
    #[serde(rename = "static")]
    pub(crate) stick: Option<Number>,
    #[serde(rename = "dynamic")]
    pub(crate) slip: Option<Number>,
    pub(crate) memory: Option<Number>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Surface {
    pub(crate) name: Option<Spanned<String>>,
    pub(crate) normal: Numbers,
    pub(crate) offset: Number,
    #[serde(rename = "static")]
    pub(crate) stick: Option<Number>,
    #[serde(rename = "dynamic")]
    pub(crate) slip: Option<Number>,
    pub(crate) memory: Option<Number>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Obstacle {
    pub(crate) name: Option<Spanned<String>>,
    pub(crate) vertices: Spanned<Vec<Numbers>>,
    #[serde(rename = "static")]
    pub(crate) stick: Option<Number>,
    #[serde(rename = "dynamic")]
    pub(crate) slip: Option<Number>,
    pub(crate) memory: Option<Number>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Hand {
    /// Frames per second (Hz).
    pub(crate) rate: Option<Number>,
    /// t (s), x, y (m), phi (rad) and whether the hand holds, for each keyframe.
    pub(crate) keyframes: Option<Spanned<Vec<Numbers>>>,
    /// A file with a recorded path.
    pub(crate) path: Option<Spanned<String>>,
    /// The axes of the path that become x and y.
    pub(crate) plane: Option<Spanned<String>>,
    /// Factor on positions.
    pub(crate) scale: Option<Number>,
    /// Added after scaling: x, y (m), phi (rad).
    pub(crate) origin: Option<Numbers>,
    /// The unit of phi: "radians" or "degrees".
    pub(crate) angle: Option<Spanned<String>>,
    /// Whether phi was wrapped to a turn.
    pub(crate) unwrap: Option<Spanned<bool>>,
}
