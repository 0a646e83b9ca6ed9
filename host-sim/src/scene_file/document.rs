//! The scene file as TOML has it: sections, keys and types, each value with its place in the text; nothing is checked
//! beyond that.

use serde::Deserialize;
use toml::Spanned;

/// A number with its place.
pub(super) type Number = Spanned<f64>;
/// An array of numbers with its place.
pub(super) type Numbers = Spanned<Vec<f64>>;

/// The whole file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document {
    pub(super) body: Body,
    #[serde(default)]
    pub(super) grasp: Grasp,
    pub(super) spring: Spring,
    #[serde(default)]
    pub(super) friction: Friction,
    #[serde(default)]
    pub(super) surface: Vec<Spanned<Surface>>,
    #[serde(default)]
    pub(super) hand: Hand,
}

/// `[body]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Body {
    pub(super) vertices: Option<Spanned<Vec<Numbers>>>,
    pub(super) rectangle: Option<Numbers>,
    pub(super) start: Numbers,
    pub(super) weight: Option<Number>,
}

/// `[grasp]`
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Grasp {
    pub(super) point: Option<Numbers>,
    pub(super) reach: Option<Number>,
}

/// `[spring]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Spring {
    pub(super) translation: Number,
    pub(super) rotation: Number,
}

/// `[friction]`
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Friction {
    #[serde(rename = "static")]
    pub(super) stick: Option<Number>,
    #[serde(rename = "dynamic")]
    pub(super) slip: Option<Number>,
}

/// `[[surface]]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Surface {
    pub(super) name: Option<Spanned<String>>,
    pub(super) normal: Numbers,
    pub(super) offset: Number,
    #[serde(rename = "static")]
    pub(super) stick: Option<Number>,
    #[serde(rename = "dynamic")]
    pub(super) slip: Option<Number>,
}

/// `[hand]`
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Hand {
    pub(super) rate: Option<Number>,
    pub(super) keyframes: Option<Spanned<Vec<Numbers>>>,
    pub(super) path: Option<Spanned<String>>,
    pub(super) plane: Option<Spanned<String>>,
    pub(super) scale: Option<Number>,
    pub(super) origin: Option<Numbers>,
}
