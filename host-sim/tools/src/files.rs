//! Files that are there as a whole or not at all.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// How the names of files begin and end that are not whole.
const PART: [&str; 2] = [".stiction-", ".part"];

/// Those that this program has begun. The ones that are whole have other names since.
static BEGUN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn begun() -> MutexGuard<'static, Vec<PathBuf>> {
    BEGUN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file beside a place, to be moved there when it is whole. What programs left there that were killed is removed.
///
/// # Errors
/// The place is a folder, or the folder around it cannot be written to.
pub fn part(place: &Path) -> io::Result<NamedTempFile> {
    let folder = match place.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if place.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    remove_abandoned(folder);
    let [begin, end] = PART;
    // Not tempfile's own way of creating, which lets nobody else read the file.
    let file = tempfile::Builder::new()
        .prefix(begin)
        .suffix(end)
        .make_in(folder, create)?;
    begun().push(file.path().to_owned());
    Ok(file)
}

/// Removes what is begun and not whole: for a program that ends at once.
pub fn discard() {
    for file in begun().drain(..) {
        // What is whole is not there under this name.
        let _ = fs::remove_file(file);
    }
}

/// A file that is locked as long as it is written, which tells it from one whose program is gone.
fn create(path: &Path) -> io::Result<File> {
    let file = File::create_new(path)?;
    // Without locks on this file system nobody removes it.
    let _ = fs4::FileExt::lock(&file);
    // Somebody may have removed it before it was locked; then another name is tried.
    match path.exists() {
        true => Ok(file),
        false => Err(ErrorKind::AlreadyExists.into()),
    }
}

/// Removes files that are not whole and that nobody writes.
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
        // Whoever reads the old one reads it to its end.
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
