//! Files that exist completely or not at all.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// Prefix and suffix of the names of incomplete files.
const PART: [&str; 2] = [".stiction-", ".part"];

/// The incomplete files that this program has created. Completed ones have other names by now.
static BEGUN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn begun() -> MutexGuard<'static, Vec<PathBuf>> {
    BEGUN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file next to a path, to be moved there when it is complete. Files left there by programs that were killed are removed.
pub(crate) fn part(place: &Path) -> io::Result<NamedTempFile> {
    let folder = match place.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if place.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    remove_abandoned(folder);
    let [begin, end] = PART;
    // Locked until the file is listed: a request to end in between would leave it.
    let mut list = begun();
    // tempfile's default permissions would let nobody else read the file.
    let file = tempfile::Builder::new()
        .prefix(begin)
        .suffix(end)
        .make_in(folder, create)?;
    list.push(file.path().to_owned());
    Ok(file)
}

/// Removes incomplete files: for a program that exits immediately.
pub(crate) fn discard() {
    let mut list = begun();
    for file in list.drain(..) {
        // Completed files no longer exist under this name.
        let _ = fs::remove_file(file);
    }
    // Locked for good: nobody begins another file before the program has ended.
    std::mem::forget(list);
}

/// A file that is locked while it is written, which distinguishes it from a file whose program has ended.
fn create(path: &Path) -> io::Result<File> {
    let file = File::create_new(path)?;
    // If this file system has no locks, nobody removes the file.
    let _ = fs4::FileExt::lock(&file);
    // Another program may have removed it before it was locked; then another name is tried.
    match path.exists() {
        true => Ok(file),
        false => Err(ErrorKind::AlreadyExists.into()),
    }
}

/// Removes incomplete files that nobody writes any more.
fn remove_abandoned(folder: &Path) {
    let entries = folder.read_dir().into_iter().flatten().flatten();
    for entry in entries.filter(is_part) {
        let path = entry.path();
        let file = File::options().write(true).open(&path);
        if file.is_ok_and(|file| fs4::FileExt::try_lock(&file).is_ok()) {
            let _ = fs::remove_file(path);
        }
    }
}

fn is_part(entry: &fs::DirEntry) -> bool {
    let (name, [begin, end]) = (entry.file_name(), PART.map(str::as_bytes));
    let name = name.as_encoded_bytes();
    name.starts_with(begin)
        && name.ends_with(end)
        && entry.file_type().is_ok_and(|kind| kind.is_file())
}

/// Writes a file: the previous file at its path exists until everything is written.
pub(crate) fn write(place: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = part(place)?;
    file.write_all(bytes)?;
    file.persist(place)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(folder: &Path) -> usize {
        fs::read_dir(folder).expect("the folder").count()
    }

    #[test]
    fn a_file_is_replaced_as_a_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = folder.path().join("file");
        fs::write(&place, "before").expect("a file");
        let mut reader = File::open(&place).expect("the file");
        write(&place, b"after").expect("written");
        assert_eq!(fs::read_to_string(&place).expect("the file"), "after");
        // A reader of the old file can read it to its end.
        assert_eq!(
            io::read_to_string(&mut reader).expect("the old one"),
            "before"
        );
        assert!(write(folder.path(), b"").is_err());
        assert_eq!(count(folder.path()), 1);
    }

    #[test]
    fn what_a_killed_program_left_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = |name: &str| folder.path().join(name);
        for name in [".stiction-dead.part", ".stiction-notes", "my.part"] {
            fs::write(place(name), "left").expect("a file");
        }
        let living = part(&place("one")).expect("a part");
        let _second = part(&place("two")).expect("a part");
        assert!(!place(".stiction-dead.part").exists());
        assert!(place(".stiction-notes").exists() && place("my.part").exists());
        assert_eq!(count(folder.path()), 4);
        living.persist(place("one")).expect("it is moved");
        assert!(place("one").exists());
    }
}
