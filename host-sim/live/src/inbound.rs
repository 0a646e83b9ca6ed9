//! Messages from clients: one JSON object per text message, with a type and optionally an id.

use serde::de::Error;
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Number as JsonNumber, Value};
use stiction_core::Evolution;

use crate::number::{Number, parse_evolution, parse_number};

/// Longest message that is read (bytes).
pub const LONGEST: usize = 4096;
/// Largest coordinate of the hand (m) and largest angle (rad).
pub const FARTHEST: f64 = 1e6;

/// A message from a client.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Message {
    /// A sample of the hand.
    Hand {
        /// x, y (m), phi (rad).
        pose: [f64; 3],
        /// The hold switch.
        held: bool,
        /// Value to return with the frame that contains the sample.
        sent: Option<JsonNumber>,
    },
    /// Releases the hand, so that another client may hold it.
    LetGo {},
    /// Changes the scene.
    Scene {
        /// Its name.
        name: String,
    },
    /// Changes parameters.
    Set {
        /// Those that change.
        parameters: Parameters,
    },
    /// Changes the number type.
    Number {
        /// The new number type.
        #[serde(deserialize_with = "number")]
        value: Number,
    },
    /// Changes the evolution.
    Evolution {
        /// The new evolution.
        #[serde(deserialize_with = "evolution")]
        value: Evolution,
    },
    /// Stops or resumes time.
    Pause {
        /// True: stops.
        value: bool,
    },
    /// Makes ticks while paused.
    Step {
        /// Number of ticks.
        ticks: u32,
    },
    /// Slow motion.
    Speed {
        /// Speed relative to real time.
        value: f64,
    },
    /// Returns body and hand to their start.
    Reset {
        /// Whether to reset the parameters, too.
        #[serde(default)]
        parameters: bool,
    },
    /// Restores the parameters of the scene's file.
    Defaults {},
    /// Begins or ends a recording.
    Record {
        /// True: begins.
        value: bool,
    },
    /// Makes the hand follow a path, or live again.
    Replay {
        /// The path; none: the hand is live.
        what: Option<Path>,
        /// Repeated until somebody takes the hand; for the path of the scene only.
        #[serde(default)]
        demonstration: bool,
    },
    /// Jumps to a time of the path.
    Seek {
        /// Time from its beginning (s).
        seconds: f64,
    },
    /// Sets the frame rate.
    Rate {
        /// Frames a second.
        value: f64,
    },
}

impl Message {
    /// Returns whether the message concerns the body, and so must wait while the body is being changed.
    pub const fn is_of_body(&self) -> bool {
        !matches!(
            self,
            Self::Hand { .. }
                | Self::LetGo {}
                | Self::Pause { .. }
                | Self::Step { .. }
                | Self::Speed { .. }
                | Self::Rate { .. }
        )
    }
}

fn number<'de, D: Deserializer<'de>>(value: D) -> Result<Number, D::Error> {
    named(value, parse_number)
}

fn evolution<'de, D: Deserializer<'de>>(value: D) -> Result<Evolution, D::Error> {
    named(value, parse_evolution)
}

/// Parses a name; `parse` returns the allowed ones in its error.
fn named<'de, D: Deserializer<'de>, T>(
    value: D,
    parse: impl FnOnce(&str) -> Result<T, String>,
) -> Result<T, D::Error> {
    let value = Value::deserialize(value)?;
    parse(value.as_str().unwrap_or_default())
        .map_err(|allowed| D::Error::custom(format!("`value` is {value}, {allowed}")))
}

/// The parameters to change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    /// k_h (N/m).
    pub stiffness_translation: Option<f64>,
    /// k_theta (N·m/rad).
    pub stiffness_rotation: Option<f64>,
    /// mu_s.
    #[serde(rename = "static")]
    pub friction_static: Option<f64>,
    /// mu_d.
    #[serde(rename = "dynamic")]
    pub friction_dynamic: Option<f64>,
    /// Null stands for the default length of a scene without one.
    #[serde(default, deserialize_with = "given")]
    pub memory: Option<Option<f64>>,
    /// Weight of the body (N).
    pub weight: Option<f64>,
}

/// Keeps a value that is present, including null.
fn given<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Option<f64>>, D::Error> {
    Option::deserialize(value).map(Some)
}

/// A path that can be replayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Path {
    /// The path of the scene.
    Scene,
    /// The newest recording.
    Recording,
    /// The uploaded path.
    Upload,
}

/// A message, and the id for its answer.
#[derive(Clone, Debug)]
pub struct Incoming {
    /// The id for the answer, if there is one.
    pub id: Option<i64>,
    /// The message, or what is wrong with it.
    pub message: Result<Message, String>,
}

/// Reads a message.
pub fn read(text: &str) -> Incoming {
    if text.len() > LONGEST {
        return refused(None, format!("{} bytes, allowed: {LONGEST}", text.len()));
    }
    let mut object: Map<String, Value> = match serde_json::from_str(text) {
        Ok(object) => object,
        Err(error) => return refused(None, format!("not a JSON object: {error}")),
    };
    let id = match object.remove("id") {
        None => None,
        Some(id) => match id.as_i64() {
            Some(id) => Some(id),
            None => return refused(None, format!("`id` is {id}, allowed: a whole number")),
        },
    };
    let message = Message::deserialize(Value::Object(object));
    let message = message.map_err(|error| error.to_string()).and_then(within);
    Incoming { id, message }
}

fn refused(id: Option<i64>, problem: String) -> Incoming {
    Incoming {
        id,
        message: Err(problem),
    }
}

/// Returns the message if its numbers are in range.
fn within(message: Message) -> Result<Message, String> {
    let check = |name: &str, value: f64, least: f64, most: f64| {
        if (least..=most).contains(&value) {
            Ok(())
        } else {
            Err(format!("`{name}` is {value}, allowed: {least} to {most}"))
        }
    };
    match &message {
        Message::Hand { pose, .. } => pose
            .iter()
            .try_for_each(|&value| check("pose", value, -FARTHEST, FARTHEST))?,
        Message::Step { ticks } => check("ticks", f64::from(*ticks), 1.0, 1000.0)?,
        Message::Speed { value } => check("value", *value, 0.001, 1.0)?,
        Message::Rate { value } => check("value", *value, 1.0, 1000.0)?,
        Message::Seek { seconds } => check("seconds", *seconds, 0.0, f64::MAX)?,
        Message::Set { parameters } if *parameters == Parameters::default() => {
            return Err(
                "`parameters` is empty, allowed: stiffness_translation, stiffness_rotation, static, dynamic, memory".to_owned(),
            );
        }
        Message::LetGo {}
        | Message::Scene { .. }
        | Message::Set { .. }
        | Message::Number { .. }
        | Message::Evolution { .. }
        | Message::Pause { .. }
        | Message::Reset { .. }
        | Message::Defaults {}
        | Message::Record { .. }
        | Message::Replay { .. } => {}
    }
    Ok(message)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> Result<Message, String> {
        read(text).message
    }

    #[test]
    fn messages_of_the_specification_are_read() {
        for text in [
            r#"{"type": "hand", "pose": [0.1, 0.2, 0.3], "held": true, "sent": 12.5}"#,
            r#"{"type": "hand", "pose": [0, 0, 0], "held": false, "id": 3}"#,
            r#"{"type": "let-go"}"#,
            r#"{"type": "scene", "name": "ladder"}"#,
            r#"{"type": "set", "parameters": {"static": 0.5, "dynamic": 0.3}}"#,
            r#"{"type": "set", "parameters": {"memory": 1e-5}}"#,
            r#"{"type": "set", "parameters": {"memory": null}}"#,
            r#"{"type": "set", "parameters": {"weight": 2}}"#,
            r#"{"type": "number", "value": "fixed"}"#,
            r#"{"type": "evolution", "value": "frame"}"#,
            r#"{"type": "pause", "value": true}"#,
            r#"{"type": "step", "ticks": 1000}"#,
            r#"{"type": "speed", "value": 0.001}"#,
            r#"{"type": "reset"}"#,
            r#"{"type": "reset", "parameters": true}"#,
            r#"{"type": "defaults"}"#,
            r#"{"type": "record", "value": false}"#,
            r#"{"type": "replay", "what": "upload"}"#,
            r#"{"type": "replay", "what": "scene", "demonstration": true}"#,
            r#"{"type": "replay", "what": null}"#,
            r#"{"type": "seek", "seconds": 1.5}"#,
            r#"{"type": "rate", "value": 1000}"#,
        ] {
            assert!(message(text).is_ok(), "{text}: {:?}", message(text));
        }
    }

    #[test]
    fn a_name_that_stands_for_nothing_is_refused_with_those_that_are_allowed() {
        for (text, problem) in [
            (
                r#"{"type": "number", "value": "f16"}"#,
                "`value` is \"f16\", allowed: f64, f32, fixed",
            ),
            (
                r#"{"type": "number", "value": 32}"#,
                "`value` is 32, allowed: f64, f32, fixed",
            ),
            (
                r#"{"type": "evolution", "value": "leap"}"#,
                "`value` is \"leap\", allowed: path, frame",
            ),
        ] {
            assert_eq!(message(text), Err(problem.to_owned()), "{text}");
        }
    }

    #[test]
    fn what_is_malformed_or_out_of_range_is_refused() {
        let long = format!(r#"{{"type": "scene", "name": "{}"}}"#, "x".repeat(LONGEST));
        for text in [
            "",
            "[]",
            "null",
            r#"{"type": "fly"}"#,
            r#"{"type": "reset", "really": true}"#,
            r#"{"type": "hand", "pose": [0, 0], "held": true}"#,
            r#"{"type": "hand", "pose": [0, 0, 1e999], "held": true}"#,
            r#"{"type": "hand", "pose": [0, 1e7, 0], "held": true}"#,
            r#"{"type": "hand", "pose": [0, 0, 0], "held": 1}"#,
            r#"{"type": "hand", "pose": [0, 0, 0], "held": true, "sent": "now"}"#,
            r#"{"type": "set", "parameters": {}}"#,
            r#"{"type": "set", "parameters": {"mass": 1}}"#,
            r#"{"type": "step", "ticks": 0}"#,
            r#"{"type": "step", "ticks": 1001}"#,
            r#"{"type": "speed", "value": 2}"#,
            r#"{"type": "rate", "value": 0}"#,
            r#"{"type": "seek", "seconds": -1}"#,
            r#"{"type": "reset", "id": "one"}"#,
            &long,
        ] {
            assert!(message(text).is_err(), "{text}");
        }
        assert_eq!(read(r#"{"type": "fly", "id": 7}"#).id, Some(7));
    }
}
