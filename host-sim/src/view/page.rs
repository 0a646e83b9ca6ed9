//! The files of the page, built into the program.

use std::borrow::Cow;

use stiction_tools::script::without_comments;

/// Path, type and bytes.
type File = (&'static str, &'static str, &'static [u8]);

macro_rules! files {
    ($($name:literal: $kind:ident),* $(,)?) => {
        &[$((concat!("/", $name), $kind, include_bytes!(concat!("../../web/", $name)))),*]
    };
}

const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";
const PICTURE: &str = "image/svg+xml";
const TEXT: &str = "text/plain; charset=utf-8";

const FILES: &[File] = files![
    "address.js": SCRIPT,
    "alone.js": SCRIPT,
    "board-model.js": SCRIPT,
    "board.js": SCRIPT,
    "charts.js": SCRIPT,
    "controls.js": SCRIPT,
    "diagram.js": SCRIPT,
    "dom.js": SCRIPT,
    "editor-card.js": SCRIPT,
    "editor-handles.js": SCRIPT,
    "editor-model.js": SCRIPT,
    "editor-pen.js": SCRIPT,
    "editor.css": CSS,
    "editor.js": SCRIPT,
    "events.js": SCRIPT,
    "files.js": SCRIPT,
    "forces.js": SCRIPT,
    "frame.js": SCRIPT,
    "grip.js": SCRIPT,
    "ground.js": SCRIPT,
    "icon.svg": PICTURE,
    "index.html": HTML,
    "insertion.css": CSS,
    "insertion.js": SCRIPT,
    "keys.js": SCRIPT,
    "link.js": SCRIPT,
    "main.js": SCRIPT,
    "object.js": SCRIPT,
    "obstacles.js": SCRIPT,
    "panels.css": CSS,
    "pointer.js": SCRIPT,
    "readout.js": SCRIPT,
    "samples.js": SCRIPT,
    "stage.js": SCRIPT,
    "strip.js": SCRIPT,
    "style.css": CSS,
    "talk.js": SCRIPT,
    "theme.js": SCRIPT,
    "trails.js": SCRIPT,
    "transport.js": SCRIPT,
    "uplot/LICENSE": TEXT,
    "uplot/uplot.min.css": CSS,
    "uplot/uplot.min.js": SCRIPT,
    "view.js": SCRIPT,
];

/// Type and bytes of the file at a path; scripts of the page without their comments.
pub(super) fn find(path: &str) -> Option<(&'static str, Cow<'static, [u8]>)> {
    let path = match path {
        "/" => "/index.html",
        path => path,
    };
    let (name, kind, bytes) = FILES.iter().find(|(known, ..)| *known == path)?;
    let bytes = match str::from_utf8(bytes) {
        Ok(script) if *kind == SCRIPT && !name.starts_with("/uplot/") => {
            without_comments(script).into_bytes().into()
        }
        _ => Cow::Borrowed(*bytes),
    };
    Some((kind, bytes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// The files of a folder that a browser asks for.
    fn asked_for(folder: &Path, into: &mut Vec<String>) {
        for entry in folder.read_dir().expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if path.is_dir() && name != "node_modules" {
                asked_for(&path, into);
            }
            if [".html", ".css", ".js", ".svg"]
                .iter()
                .any(|end| name.ends_with(end))
            {
                into.push(path.to_string_lossy().into_owned());
            }
        }
    }

    #[test]
    fn every_file_of_the_page_is_served() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("web");
        let mut files = Vec::new();
        asked_for(&folder, &mut files);
        assert!(files.len() > 1);
        for file in files {
            let path = file
                .strip_prefix(&*folder.to_string_lossy())
                .expect("a file in it");
            assert!(find(path).is_some(), "{path}");
        }
    }
}
