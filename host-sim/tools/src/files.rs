//! Files that are there as a whole or not at all.

use std::fs::File;
use std::io::{self, Write};
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

/// Writes a file: what was in its place before is there until all is written.
///
/// # Errors
/// Those of [`part`], or the disk is full.
pub fn write(place: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = part(place)?;
    file.write_all(bytes)?;
    file.persist(place)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_file_is_replaced_as_a_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = folder.path().join("file");
        fs::write(&place, "before").expect("a file");
        let mut reader = File::open(&place).expect("the file");
        write(&place, b"after").expect("written");
        assert_eq!(fs::read_to_string(&place).expect("the file"), "after");
        // Whoever reads the old one reads it to its end.
        assert_eq!(
            io::read_to_string(&mut reader).expect("the old one"),
            "before"
        );
        assert!(write(folder.path(), b"").is_err());
        assert_eq!(fs::read_dir(&folder).expect("the folder").count(), 1);
    }
}
