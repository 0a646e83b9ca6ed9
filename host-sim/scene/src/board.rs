//! The build script of a board: which scene is compiled in, where the linker finds flash and RAM, what it must know of the log.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use stiction_core::frame::NumberType;

use crate::compile::{OwnScene, compile};
use crate::model::{ObstacleRoom, SceneModel};
use crate::source::InputError;

/// In what one board differs from another.
#[derive(Clone, Debug)]
pub struct BoardBuild {
    /// For another target there is nothing to do.
    pub target: &'static str,
    /// What its solver computes with.
    pub number: NumberType,
    /// What the solver of the board's own scene has, as any scene may come over the wire: obstacles with the feature `obstacles`
    /// alone. That of a scene file which is named by STICTION_SCENE has what this scene needs.
    pub room: SceneModel,
    /// The file of the scene that is compiled in where none is named, in the folder of the package or by a path from there.
    pub scene: &'static str,
    /// Where flash and RAM are, as the linker is to read it: a file likewise. None: the crates of the chip know it, and what else the
    /// linker must be given.
    pub memory: Option<&'static str>,
}

impl BoardBuild {
    /// Does all that the script of a board's package has to do: `scene.rs` in the folder of the build, and what the linker needs.
    pub fn run(&self) -> ExitCode {
        println!("cargo::rerun-if-changed=build.rs");
        match self.built() {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("{error}");
                ExitCode::FAILURE
            }
        }
    }

    /// The room that the package's features ask for.
    fn room_of_features(&self) -> SceneModel {
        match env::var_os("CARGO_FEATURE_OBSTACLES") {
            Some(_) => self.room,
            None => SceneModel {
                obstacles: ObstacleRoom::default(),
                ..self.room
            },
        }
    }

    fn built(&self) -> Result<(), InputError> {
        if variable("TARGET")? != self.target {
            return Ok(());
        }
        let package = PathBuf::from(variable("CARGO_MANIFEST_DIR")?);
        let folder = PathBuf::from(variable("OUT_DIR")?);
        let own = OwnScene {
            file: package.join(self.scene),
            room: self.room_of_features(),
        };
        compile(&own, self.number, &folder)?;
        if let Some(memory) = self.memory {
            link(&package.join(memory), &folder)?;
        }
        let logs = ["CARGO_FEATURE_RTT", "CARGO_FEATURE_SEMIHOSTING"];
        if logs.into_iter().any(|log| env::var_os(log).is_some()) {
            println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
        }
        Ok(())
    }
}

/// The linker finds flash and RAM by a copy of this file in the folder of the build.
fn link(memory: &Path, folder: &Path) -> Result<(), InputError> {
    println!("cargo::rerun-if-changed={}", memory.display());
    fs::copy(memory, folder.join("memory.x"))
        .map_err(|error| InputError::of_file(memory, error))?;
    println!("cargo::rustc-link-search={}", folder.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
    Ok(())
}

/// What cargo sets for every build script.
fn variable(name: &str) -> Result<String, InputError> {
    env::var(name).map_err(|error| InputError::of_file(Path::new(name), error))
}
