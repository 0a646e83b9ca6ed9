//! The build script of a board: which scene is compiled in, where the linker finds flash and RAM, and the linker's settings for the log.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use stiction_wire::NumberType;

use crate::compile::compile;
use crate::model::SceneModel;
use crate::source::InputError;

/// The properties in which boards differ.
#[derive(Clone, Debug)]
pub struct BoardBuild {
    /// For any other target, there is nothing to do.
    pub target: &'static str,
    /// The number type of its solver.
    pub number: NumberType,
    /// The capacity of the solver for the board's own scene, since any scene may arrive over the wire. For a scene file named by
    /// STICTION_SCENE, the solver has the capacity that this scene needs.
    pub room: SceneModel,
    /// The file of the scene that is compiled in by default, in the folder of the package or as a path from there.
    pub scene: &'static str,
    /// The linker script with the location of flash and RAM, also a file in the package. `None`: the crates of the chip provide it,
    /// together with the other linker settings.
    pub memory: Option<&'static str>,
}

impl BoardBuild {
    /// Runs the build script of a board's package: writes `scene.rs` in the build folder, and what the linker needs.
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

    fn built(&self) -> Result<(), InputError> {
        if variable("TARGET")? != self.target {
            return Ok(());
        }
        let package = PathBuf::from(variable("CARGO_MANIFEST_DIR")?);
        let folder = PathBuf::from(variable("OUT_DIR")?);
        let own = package.join(self.scene);
        compile(&own, self.room, self.number, &folder)?;
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

/// Copies this file to the build folder, where the linker reads the location of flash and RAM.
fn link(memory: &Path, folder: &Path) -> Result<(), InputError> {
    println!("cargo::rerun-if-changed={}", memory.display());
    fs::copy(memory, folder.join("memory.x"))
        .map_err(|error| InputError::of_file(memory, error))?;
    println!("cargo::rustc-link-search={}", folder.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
    Ok(())
}

/// An environment variable that cargo sets for every build script.
fn variable(name: &str) -> Result<String, InputError> {
    env::var(name).map_err(|error| InputError::of_file(Path::new(name), error))
}
