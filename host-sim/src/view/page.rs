//! The files of the page, built into the program.

use std::borrow::Cow;
use std::io::{self, Write as _};
use std::sync::{LazyLock, OnceLock};

use flate2::{Compression, write::GzEncoder};
use stiction_live::script::without_comments;

struct File {
    path: &'static str,
    source: &'static [u8],
    /// The content as sent to browsers; created at the first request.
    served: OnceLock<PageContent>,
}

/// The content that browsers receive: scripts of the page without their comments.
struct PageContent {
    plain: Cow<'static, [u8]>,
    /// Gzip-compressed, if that is shorter.
    packed: Option<Vec<u8>>,
}

#[derive(Clone, Copy)]
pub(super) struct Found {
    pub(super) kind: &'static str,
    pub(super) bytes: &'static [u8],
    /// Whether the bytes are gzip-compressed.
    pub(super) is_packed: bool,
}

macro_rules! files {
    ($($name:literal)*) => {
        vec![$(File {
            path: concat!("/", $name),
            source: include_bytes!(concat!("../../web/", $name)),
            served: OnceLock::new(),
        }),*]
    };
}

static FILES: LazyLock<Vec<File>> = LazyLock::new(|| {
    files! {
        "address.js" "alone.js" "away.js" "board-model.js" "board.js" "charts.js" "controls.js"
        "demonstration.js" "diagram.js" "dom.js" "editor-card.js" "editor-handles.js"
        "editor-model.js" "editor-pen.js" "editor.css" "editor.js" "events.js" "felt.js" "files.js"
        "first.css" "forces.js" "frame.js" "gallery.js" "gifenc/LICENSE" "gifenc/gifenc.js" "grip.js" "ground.js" "handle.js" "icon.svg"
        "index.html" "insertion.css" "insertion.js" "keys.js" "labels.js" "link.js" "main.js"
        "object.js" "obstacles.js" "panels.css" "panels.js" "pointer.js" "reach.js" "readout.js" "samples.js"
        "shown.js" "sizes.js" "stage.js" "strip.js" "style.css" "talk.js" "theme.js" "tips.js"
        "trails.js" "transport.js" "uplot/LICENSE" "uplot/uplot.min.css" "uplot/uplot.min.js"
        "view.js"
    }
});

/// The media type of a file.
fn kind(path: &str) -> &'static str {
    match path.rsplit_once('.').map(|(_, end)| end) {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "text/plain; charset=utf-8",
    }
}

/// The file at a path, gzip-compressed if the browser accepts that and it is shorter.
pub(super) fn find(path: &str, takes_gzip: bool) -> Option<Found> {
    let path = match path {
        "/" => "/index.html",
        path => path,
    };
    let file = FILES.iter().find(|file| file.path == path)?;
    let served = file.served.get_or_init(|| file.serve());
    let packed = served.packed.as_deref().filter(|_| takes_gzip);
    Some(Found {
        kind: kind(file.path),
        bytes: packed.unwrap_or(&served.plain),
        is_packed: packed.is_some(),
    })
}

impl File {
    fn serve(&self) -> PageContent {
        let plain = match str::from_utf8(self.source) {
            // A library, which has a folder of its own, is served as it came.
            Ok(script) if self.path.ends_with(".js") && self.path.rfind('/') == Some(0) => {
                without_comments(script).into_bytes().into()
            }
            _ => Cow::Borrowed(self.source),
        };
        let packed = pack(&plain)
            .ok()
            .filter(|packed| packed.len() < plain.len());
        PageContent { plain, packed }
    }
}

fn pack(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// Returns whether a browser that sends `accepted` (Accept-Encoding, RFC 9110, 12.5.3) accepts gzip.
pub(super) fn takes_gzip(accepted: &str) -> bool {
    // A value for gzip itself has precedence over one for all encodings.
    let weight_of = |names: &[&str]| {
        accepted.split(',').find_map(|item| {
            let (name, weight) = item.split_once(';').unwrap_or((item, "q=1"));
            let is_one = names
                .iter()
                .any(|known| name.trim().eq_ignore_ascii_case(known));
            let (_, weight) = weight.split_once('=')?;
            is_one.then(|| weight.trim().parse().unwrap_or(0.0))
        })
    };
    let weight: f32 = weight_of(&["gzip", "x-gzip"])
        .or_else(|| weight_of(&["*"]))
        .unwrap_or(0.0);
    weight > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::GzDecoder;
    use std::io::Read as _;
    use std::path::Path;

    /// The files of a folder that a browser requests.
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
            let plain = find(path, false).expect("a file of the page");
            assert!(!plain.is_packed, "{path}");
            let packed = find(path, true).expect("the same file");
            assert!(packed.bytes.len() <= plain.bytes.len(), "{path}");
            let mut unpacked = Vec::new();
            if packed.is_packed {
                let mut decoder = GzDecoder::new(packed.bytes);
                decoder.read_to_end(&mut unpacked).expect("gzip");
                assert!(unpacked == plain.bytes, "{path}");
            }
        }
    }

    #[test]
    fn gzip_is_for_browsers_that_take_it() {
        for accepted in [
            "gzip",
            "gzip, deflate, br, zstd",
            "br;q=1.0, GZIP;q=0.8",
            "*",
        ] {
            assert!(takes_gzip(accepted), "{accepted}");
        }
        for accepted in ["", "identity", "br", "gzip;q=0", "*, gzip; q=0.0", "*;q=0"] {
            assert!(!takes_gzip(accepted), "{accepted}");
        }
    }
}
