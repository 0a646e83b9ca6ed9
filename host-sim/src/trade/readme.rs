//! The results in Markdown files: the complete ones in the section `trade`, a short table in the section `settings`.

use std::io;
use std::path::{Path, PathBuf};

use stiction_tools::readme::Section;

use super::TradeError;
use super::report::Report;

/// A file with one of the sections or both.
#[derive(Debug)]
pub(super) struct Readme {
    file: PathBuf,
    whole: Option<Section>,
    short: Option<Section>,
}

impl Readme {
    /// The sections of `file`.
    pub(super) fn find(file: &Path) -> Result<Self, TradeError> {
        let (whole, short) = (
            Section::find(file, "trade"),
            Section::find(file, "settings"),
        );
        if let (Err(error), Err(_)) = (&whole, &short) {
            let error = io::Error::new(error.kind(), error.to_string());
            return Err(TradeError::write(file)(error));
        }
        Ok(Self {
            file: file.to_owned(),
            whole: whole.ok(),
            short: short.ok(),
        })
    }

    /// The folder of the pictures relative to that of the file; the short section has no pictures.
    pub(super) fn pictures(&self, out: &Path) -> Result<PathBuf, TradeError> {
        if self.whole.is_none() {
            return Ok(PathBuf::new());
        }
        let whole = |path: &Path| path.canonicalize().map_err(TradeError::write(path));
        let (folder, file) = (whole(out)?, whole(&self.file)?);
        let base = file.parent().unwrap_or(Path::new(""));
        let below = folder.strip_prefix(base).map(Path::to_owned);
        below.map_err(|_| TradeError::Elsewhere {
            out: out.to_owned(),
            readme: self.file.clone(),
        })
    }

    /// Writes the sections that the file has.
    pub(super) fn write(&self, report: &Report, pictures: &Path) -> Result<(), TradeError> {
        let texts = [
            (&self.whole, report.markdown(pictures)),
            (&self.short, report.short()),
        ];
        for (section, text) in texts {
            if let Some(section) = section {
                section
                    .write(&text)
                    .map_err(TradeError::write(&self.file))?;
            }
        }
        Ok(())
    }
}
