//! The folders: of the page, and of the npm package.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::module::{For, Module, workspace};
use crate::{BuildError, of};

/// A name and bytes.
pub(crate) type File = (String, Vec<u8>);

/// Files of `host-sim/web` that are not of the page.
const OTHERS: [&str; 2] = ["package.json", "tsconfig.json"];
/// What tells the page that it has the solver itself.
const MARK: (&str, &str) = ("<body ", "<body data-alone ");

/// The files of the page.
pub(crate) fn page(module: &Module) -> Result<Vec<File>, BuildError> {
    let web = workspace().join("host-sim/web");
    let mut files = Vec::new();
    gather(&web, "", &mut files)?;
    for (name, bytes) in &mut files {
        if name == "index.html" {
            let text = String::from_utf8_lossy(bytes);
            if !text.contains(MARK.0) {
                return Err(BuildError::Page(format!("index.html has no {:?}", MARK.0)));
            }
            *bytes = text.replacen(MARK.0, MARK.1, 1).into_bytes();
        }
    }
    let own = workspace().join("host-sim/wasm/worker.js");
    let own = fs::read(&own).map_err(of(&own))?;
    for (name, mut bytes) in module.bound(For::Worker)? {
        match name.ends_with(".js") {
            // The worker is one script: what wasm-bindgen made, and then its own.
            true => {
                bytes.extend_from_slice(&own);
                files.push(("worker.js".to_owned(), bytes));
            }
            false => files.push(("stiction.wasm".to_owned(), bytes)),
        }
    }
    files.sort();
    Ok(files)
}

fn gather(folder: &Path, before: &str, files: &mut Vec<File>) -> Result<(), BuildError> {
    for entry in fs::read_dir(folder).map_err(of(folder))? {
        let place = entry.map_err(of(folder))?.path();
        let name = place.file_name().unwrap_or_default().to_string_lossy();
        let path = format!("{before}{name}");
        if place.is_dir() {
            if name != "node_modules" {
                gather(&place, &format!("{path}/"), files)?;
            }
        } else if !OTHERS.contains(&path.as_str()) && !name.ends_with(".d.ts") {
            files.push((path, fs::read(&place).map_err(of(&place))?));
        }
    }
    Ok(())
}

/// The files of the npm package.
pub(crate) fn package(module: &Module) -> Result<Vec<File>, BuildError> {
    let wasm = workspace().join("host-sim/wasm");
    let mut files = module.bound(For::Package)?;
    gather(&wasm.join("npm"), "", &mut files)?;
    for (name, place) in [
        ("README.md", wasm.join("README.md")),
        ("CHANGELOG.md", wasm.join("CHANGELOG.md")),
        ("LICENSE-MIT", workspace().join("LICENSE-MIT")),
        ("LICENSE-APACHE", workspace().join("LICENSE-APACHE")),
    ] {
        files.push((name.to_owned(), fs::read(&place).map_err(of(&place))?));
    }
    for (name, bytes) in &mut files {
        if name == "package.json" {
            let read = serde_json::from_slice(bytes);
            let mut about: Value =
                read.map_err(|error| BuildError::Page(format!("package.json: {error}")))?;
            about["version"] = env!("CARGO_PKG_VERSION").into();
            *bytes = format!("{about:#}\n").into_bytes();
        }
    }
    Ok(files)
}

/// Writes files into a folder.
pub(crate) fn write(folder: &Path, files: &[File]) -> Result<(), BuildError> {
    for (name, bytes) in files {
        let place = folder.join(name);
        let parent = place.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(of(parent))?;
        fs::write(&place, bytes).map_err(of(&place))?;
    }
    Ok(())
}
