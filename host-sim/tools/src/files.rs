//! Files that are there as a whole or not at all.

use std::fs::File;
use std::io;
use std::path::Path;

use tempfile::NamedTempFile;

/// A file beside a place, to be moved there when it is whole.
///
/// # Errors
/// The place is a folder, or the folder around it cannot be written to.
pub fn part(place: &Path) -> io::Result<NamedTempFile> {
    let folder = match place.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if place.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    // Not tempfile's own way of creating, which lets nobody else read the file.
    tempfile::Builder::new()
        .prefix(".stiction-")
        .suffix(".part")
        .make_in(folder, |path| File::create_new(path))
}
