//! Compiles `stiction-wasm` and runs wasm-bindgen on it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use wasm_bindgen_cli_support::Bindgen;

use crate::{Built, of};

const TARGET: &str = "wasm32-unknown-unknown";
/// A profile of the workspace.
const PROFILE: &str = "wasm";

#[derive(Debug)]
pub(crate) struct Module {
    file: PathBuf,
}

/// The environment it is for; the code is the same for both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum For {
    /// A classic script of a worker.
    Worker,
    /// A module, with types.
    Package,
}

pub(crate) fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..")
}

impl Module {
    pub(crate) fn compile() -> Built<Self> {
        let target = std::env::var_os("CARGO_TARGET_DIR")
            .map_or_else(|| workspace().join("target"), PathBuf::from);
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let done = Command::new(cargo)
            .args(["build", "--locked", "--package", "stiction-wasm"])
            .args(["--target", TARGET, "--profile", PROFILE, "--target-dir"])
            .arg(&target)
            .current_dir(workspace())
            .status();
        if !done.is_ok_and(|status| status.success()) {
            let problem =
                "cargo failed; if the target is missing: rustup target add wasm32-unknown-unknown";
            return Err(problem.into());
        }
        let file = target.join(TARGET).join(PROFILE).join("stiction_wasm.wasm");
        Ok(Self { file })
    }

    /// The files that wasm-bindgen writes for an environment: names and bytes.
    pub(crate) fn bound(&self, whom: For) -> Built<Vec<(String, Vec<u8>)>> {
        let refused = |error: &dyn std::fmt::Display| format!("wasm-bindgen: {error}");
        let mut bindgen = Bindgen::new();
        bindgen
            .input_path(&self.file)
            .out_name("stiction")
            .remove_name_section(true)
            .remove_producers_section(true)
            .typescript(whom == For::Package);
        let kind = match whom {
            For::Worker => bindgen.no_modules(true),
            For::Package => bindgen.web(true),
        };
        kind.map_err(|error| refused(&error))?;
        let folder = self.file.with_extension(match whom {
            For::Worker => "worker",
            For::Package => "package",
        });
        // Files of an earlier version would be taken for new ones.
        let _ = fs::remove_dir_all(&folder);
        bindgen
            .generate(&folder)
            .map_err(|error| refused(&format!("{error:#}")))?;
        let entries = fs::read_dir(&folder).map_err(of(&folder))?;
        let mut files = Vec::new();
        for entry in entries {
            let place = entry.map_err(of(&folder))?.path();
            let name = place.file_name().unwrap_or_default().to_string_lossy();
            files.push((name.into_owned(), fs::read(&place).map_err(of(&place))?));
        }
        files.sort();
        Ok(files)
    }
}
