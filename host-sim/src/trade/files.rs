//! A folder of results: none appears before all are written to the disk; then they appear one after the other, each in one
//! operation.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::files::whole::part;

/// The destination of the results.
#[derive(Debug)]
pub(super) struct Folder(PathBuf);

impl Folder {
    /// The folder, created if it is missing; from here on, it is known whether it can be written to.
    pub(super) fn open(place: &Path) -> io::Result<Self> {
        fs::create_dir_all(place)?;
        part(&place.join("result"))?.close()?;
        Ok(Self(place.to_owned()))
    }

    /// Writes files of these names and contents to the folder. Returns their paths.
    pub(super) fn write(self, files: &[(String, Vec<u8>)]) -> io::Result<Vec<PathBuf>> {
        let written = files.iter().map(|(name, content)| {
            let place = self.0.join(name);
            let mut file = part(&place)?;
            file.write_all(content)?;
            Ok((file, place))
        });
        let written: Vec<_> = written.collect::<io::Result<_>>()?;
        let moved = written.into_iter().map(|(file, place)| {
            file.persist(&place)?;
            Ok(place)
        });
        moved.collect()
    }
}
