//! The folders of the page and of the npm package.

use std::fs;
use std::path::Path;

use stiction_live::scenes;
use stiction_live::script::without_comments;
use stiction_live::thumbnail::thumbnail;
use stiction_scene::Source;

use crate::module::{For, Module, workspace};
use crate::{Built, of};

pub(crate) type File = (String, Vec<u8>);

/// Whether a file is for the tools of the page, and not part of it.
fn is_of_tools(name: &str) -> bool {
    name.ends_with(".json") || name.ends_with(".d.ts")
}

/// A placeholder in the `package.json` of the npm package.
const NO_VERSION: &str = "\"version\": \"0.0.0\"";
/// A mark that tells the page that it contains the solver itself.
const MARK: (&str, &str) = ("<body ", "<body data-alone ");

#[derive(Debug)]
pub(crate) struct Page {
    /// The files of `host-sim/web`.
    pub(crate) web: Vec<File>,
    /// Names and pictures of the scenes.
    pub(crate) pictures: Vec<(String, String)>,
    /// The script of wasm-bindgen, and `worker.js`.
    pub(crate) worker: Vec<u8>,
    pub(crate) wasm: Vec<u8>,
}

impl Page {
    pub(crate) fn new(module: &Module) -> Built<Self> {
        let folder = workspace().join("host-sim/web");
        let mut web = Vec::new();
        gather(&folder, "", &mut web)?;
        web.retain(|(name, _)| !is_of_tools(name));
        for (name, bytes) in &mut web {
            if name.ends_with(".js") && !name.contains('/') {
                *bytes = without_comments(&String::from_utf8_lossy(bytes)).into_bytes();
            }
            if name == "index.html" {
                let text = String::from_utf8_lossy(bytes);
                if !text.contains(MARK.0) {
                    return Err(format!("index.html has no {:?}", MARK.0).into());
                }
                *bytes = text.replacen(MARK.0, MARK.1, 1).into_bytes();
            }
        }
        let (mut worker, mut wasm) = (Vec::new(), Vec::new());
        for (name, bytes) in module.bound(For::Worker)? {
            match name.ends_with(".js") {
                true => worker = bytes,
                false => wasm = bytes,
            }
        }
        let own = workspace().join("host-sim/wasm/worker.js");
        worker.extend(fs::read(&own).map_err(of(&own))?);
        Ok(Self {
            web,
            pictures: pictures()?,
            worker: without_comments(&String::from_utf8_lossy(&worker)).into_bytes(),
            wasm,
        })
    }

    /// The files of the folder.
    pub(crate) fn files(&self) -> Vec<File> {
        let mut files = self.web.clone();
        let picture = |(name, svg): &(String, String)| {
            (format!("scenes/{name}.svg"), svg.clone().into_bytes())
        };
        files.extend(self.pictures.iter().map(picture));
        files.extend([
            ("worker.js".to_owned(), self.worker.clone()),
            ("stiction.wasm".to_owned(), self.wasm.clone()),
        ]);
        files
    }
}

fn pictures() -> Built<Vec<(String, String)>> {
    let picture = |&(name, text): &(&str, &str)| {
        let svg = thumbnail(&Source::new(format!("{name}.toml"), text));
        let svg = svg.map_err(|error| error.to_string())?;
        Ok((name.to_owned(), svg))
    };
    scenes::ALL.iter().map(picture).collect()
}

fn gather(folder: &Path, before: &str, files: &mut Vec<File>) -> Built<()> {
    for entry in fs::read_dir(folder).map_err(of(folder))? {
        let place = entry.map_err(of(folder))?.path();
        let name = place.file_name().unwrap_or_default().to_string_lossy();
        let path = format!("{before}{name}");
        if place.is_dir() {
            if name != "node_modules" {
                gather(&place, &format!("{path}/"), files)?;
            }
        } else {
            files.push((path, fs::read(&place).map_err(of(&place))?));
        }
    }
    Ok(())
}

pub(crate) fn package(module: &Module) -> Built<Vec<File>> {
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
        if name == "stiction.d.ts" {
            // Code compiled for es2022 has no such symbol.
            let text = String::from_utf8_lossy(bytes);
            *bytes = text
                .replace("    [Symbol.dispose](): void;\n", "")
                .into_bytes();
        }
        if name == "package.json" {
            // The file is edited as text: the first matching condition counts, so their order has to stay.
            let text = String::from_utf8_lossy(bytes);
            let version = concat!("\"version\": \"", env!("CARGO_PKG_VERSION"), "\"");
            if !text.contains(NO_VERSION) {
                return Err(format!("package.json has no {NO_VERSION}").into());
            }
            *bytes = text.replacen(NO_VERSION, version, 1).into_bytes();
        }
    }
    Ok(files)
}

pub(crate) fn write(folder: &Path, files: &[File]) -> Built<()> {
    for (name, bytes) in files {
        let place = folder.join(name);
        let parent = place.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(of(parent))?;
        fs::write(&place, bytes).map_err(of(&place))?;
    }
    Ok(())
}
