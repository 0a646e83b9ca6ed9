//! A folder of results: none appears before all are written to the disk, and then each at once, one after the other.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

/// Where results will stand.
#[derive(Debug)]
pub(super) struct Folder {
    place: PathBuf,
    /// Results that are being written.
    draft: TempDir,
}

impl Folder {
    /// The folder, created where it is missing; whether it can be written to is known from here on.
    pub(super) fn open(place: &Path) -> io::Result<Self> {
        fs::create_dir_all(place)?;
        Ok(Self {
            place: place.to_owned(),
            draft: tempfile::Builder::new()
                .prefix(".stiction-")
                .tempdir_in(place)?,
        })
    }

    /// Puts files of these names and contents into the folder. Their paths.
    pub(super) fn write(self, files: &[(String, Vec<u8>)]) -> io::Result<Vec<PathBuf>> {
        for (name, content) in files {
            fs::write(self.draft.path().join(name), content)?;
        }
        let moved = files.iter().map(|(name, _)| {
            let place = self.place.join(name);
            fs::rename(self.draft.path().join(name), &place)?;
            Ok(place)
        });
        moved.collect()
    }
}
