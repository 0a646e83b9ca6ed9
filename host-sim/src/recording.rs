//! A recording: a scene, the settings of its run, every sample of the hand and every answer, so that a run can be repeated bit
//! for bit and distinguished from one that differs. A text file of JSON Lines, with numbers printed such that they read back to
//! the same value:
//!
//! ```text
//! {"recording":3,"build":"...","number":"f32","evolution":"path",
//!  "name":"box.toml","scene":"[body]\n..."}
//! {"sample":{"t":0.0,"position":[x,y],"turns":0,"rest":0.1,"depth":0.0,"held":true},"answer":{record of the trace}}
//! {"samples":1}
//! ```
//!
//! A number that is not finite is null in a sample. A missing answer is null. A `budget` follows the evolution if a frame had one (pieces of
//! work). The first sample starts the scene. The last line counts the samples; a recording without it was cut. In version 2 `friction` and
//! `weight` followed, and a budget counted smaller units.
//!
//! Between two samples there may be a change: from there on, the body continues where it is, under another setting.
//!
//! ```text
//! {"change":{"number":"f64","evolution":"path","scene":"[body]\n..."}}
//! ```

mod line;
mod reader;
mod writer;

use std::path::PathBuf;
use std::sync::Arc;

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use stiction_core::Evolution;
use stiction_scene::{SceneFile, Source};

use crate::settings::Settings;
use stiction_live::body::Setting;
use stiction_live::number::{Number, parse_kind};

pub(crate) use reader::{Recording, RecordingLine};
pub(crate) use writer::{LiveWriter, RecordingWriter, is_being_written};

const VERSION: u32 = 3;
/// The earliest version that is read.
const EARLIEST: u32 = 2;
/// Size of the buffer for a line that is being written (bytes); a longer one is written in pieces.
const PIECE: usize = 64 << 10;

/// The settings of the run, and the maker of the recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Head {
    pub(crate) recording: u32,
    /// The program, or the board, its version and the machine.
    pub(crate) build: String,
    /// As on the command line.
    pub(crate) number: String,
    pub(crate) evolution: String,
    /// The pieces of work that a frame may use; absent: unlimited.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) budget: Option<u32>,
    /// Of version 2: the solver had friction, and weight.
    #[serde(default, skip_serializing)]
    pub(crate) friction: IgnoredAny,
    #[serde(default, skip_serializing)]
    pub(crate) weight: IgnoredAny,
    /// The name of the scene file.
    pub(crate) name: String,
    /// Its text.
    pub(crate) scene: String,
}

pub(crate) fn this_build() -> String {
    let version = env!("CARGO_PKG_VERSION");
    let (arch, os) = (std::env::consts::ARCH, std::env::consts::OS);
    format!("stiction {version}, {arch}, {os}")
}

/// The maker of a recording: a program or a board, with the solver that it has.
#[derive(Clone, Debug)]
pub(crate) struct Maker {
    pub(crate) build: String,
    /// The pieces of work that a frame may use, if they are limited.
    pub(crate) budget: Option<u32>,
}

impl Maker {
    /// This program.
    pub(crate) fn this_program() -> Self {
        Self {
            build: this_build(),
            budget: None,
        }
    }
}

impl Head {
    pub(crate) fn new(scene: &SceneFile, settings: &Settings) -> Self {
        let maker = Maker {
            budget: settings.budget,
            ..Maker::this_program()
        };
        Self::of(scene, settings.number, settings.evolution, &maker)
    }

    /// The head for a scene that is run by `maker`.
    pub(crate) fn of(
        scene: &SceneFile,
        number: Number,
        evolution: Evolution,
        maker: &Maker,
    ) -> Self {
        let (file, text) = (scene.source().file(), scene.source().text());
        Self {
            recording: VERSION,
            build: maker.build.clone(),
            number: number.name().to_owned(),
            evolution: evolution.name().to_owned(),
            budget: maker.budget,
            friction: IgnoredAny,
            weight: IgnoredAny,
            name: file
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
            scene: text.to_owned(),
        }
    }
}

/// A setting under which the body continues.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Change {
    pub(crate) number: String,
    pub(crate) evolution: String,
    /// The text of the scene file.
    pub(crate) scene: String,
}

impl Change {
    /// The setting with these names and this text; `name`: of the scene.
    pub(crate) fn setting(&self, name: PathBuf) -> Result<Setting, String> {
        let (number, evolution) = parse_kind(&self.number, &self.evolution)?;
        let source = Source::new(name, self.scene.as_str());
        let scene = SceneFile::parse(source, number.limit()).map_err(|error| error.to_string())?;
        Ok(Setting {
            scene: Arc::new(scene),
            number,
            evolution,
        })
    }
}
