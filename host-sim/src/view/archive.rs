//! The folder of recordings: a new one receives a free name; when the program starts, it finds the newest one and reports their
//! number.

use std::ffi::OsStr;
use std::fs::{self, Metadata};
use std::io;
use std::path::PathBuf;
use std::time::SystemTime;

use etcetera::base_strategy::{BaseStrategy, choose_native_strategy};

use crate::recording::{Head, LiveWriter, is_being_written};
use stiction_live::record::Run;

/// The longest part of a file name that comes from the scene, in characters.
const TITLE: usize = 60;

#[derive(Clone, Debug)]
pub(super) struct Archive(PathBuf);

impl Archive {
    /// Returns the given folder, or that of this program in the system's folder for application data; if there is none, the
    /// folder in which the program was started. A given folder that cannot be written is refused.
    pub(super) fn new(given: Option<PathBuf>) -> Result<Self, String> {
        let is_given = given.is_some();
        let folder = given.unwrap_or_else(|| match choose_native_strategy() {
            Ok(place) => place.data_dir().join("stiction").join("recordings"),
            Err(_) => PathBuf::from("."),
        });
        let archive = Self(std::path::absolute(&folder).unwrap_or(folder));
        if is_given {
            archive.check()?;
        }
        Ok(archive)
    }

    fn refused(&self, error: &io::Error) -> String {
        format!(
            "{}: cannot be written: {error}, allowed: a folder for recordings, --recordings FOLDER",
            self.0.display()
        )
    }

    /// Makes the folder, and a file without a name in it, which shows that recordings can be written there.
    fn check(&self) -> Result<(), String> {
        let tried = fs::create_dir_all(&self.0).and_then(|()| tempfile::tempfile_in(&self.0));
        tried.map(drop).map_err(|error| self.refused(&error))
    }

    /// Begins a recording of a scene under a name that is free.
    pub(super) fn begin(&self, head: &Head, run: &Run) -> Result<LiveWriter, String> {
        fs::create_dir_all(&self.0).map_err(|error| self.refused(&error))?;
        let title = named(&run.scene.title);
        let mut names = (1_u32..).map(|n| self.0.join(format!("{title}-{n}.jsonl")));
        let tried = names.find_map(|place| match LiveWriter::live(&place, head, run) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => None,
            begun => Some(begun),
        });
        let begun = tried.ok_or_else(|| self.refused(&io::ErrorKind::AlreadyExists.into()))?;
        begun.map_err(|error| self.refused(&error))
    }

    fn files(&self) -> impl Iterator<Item = (PathBuf, Metadata)> {
        let entries = fs::read_dir(&self.0).into_iter().flatten().flatten();
        let places = entries.map(|entry| entry.path());
        let named = places.filter(|place| place.extension() == Some(OsStr::new("jsonl")));
        let there = named.filter_map(|place| Some((fs::metadata(&place).ok()?, place)));
        let files = there.filter(|(about, _)| about.is_file());
        files.map(|(about, place)| (place, about))
    }

    /// Describes the recordings, if there are any: this program never deletes one.
    pub(super) fn stock(&self) -> Option<String> {
        let lengths = self.files().map(|(_, about)| about.len());
        let (count, bytes) = lengths.fold((0, 0), |(n, sum), length| (n + 1, sum + length));
        let (megabytes, folder) = (bytes as f64 / 1e6, self.0.display());
        (count > 0).then(|| {
            format!("recordings so far: {count}, {megabytes:.1} MB in {folder}; the program deletes none")
        })
    }

    /// The recordings, the last written one first; without those that are being written.
    pub(super) fn newest_first(&self) -> Vec<PathBuf> {
        let dated = self.files().map(|(place, about)| {
            let written = about.modified();
            (written.unwrap_or(SystemTime::UNIX_EPOCH), place)
        });
        let mut free: Vec<_> = dated
            .filter(|(_, place)| !is_being_written(place))
            .collect();
        free.sort_by(|a, b| b.cmp(a));
        free.into_iter().map(|(_, place)| place).collect()
    }
}

/// Converts a title to a part of a file name.
fn named(title: &str) -> String {
    let plain = |c: char| {
        if c.is_alphanumeric() || c == '-' || c == '_' {
            c
        } else {
            '-'
        }
    };
    title.chars().take(TITLE).map(plain).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use std::time::Duration;

    use crate::settings::Settings;
    use stiction_core::Evolution;
    use stiction_live::number::Number;
    use stiction_live::scenes;
    use stiction_scene::SceneFile;

    #[test]
    fn nothing_is_written_over_and_the_newest_is_found() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = folder.path().join("new").join("folder");
        let archive = Archive::new(Some(place)).expect("a folder");
        assert!(archive.newest_first().is_empty() && archive.stock().is_none());
        let source = scenes::find(Path::new("box-flat")).expect("a scene");
        let scene = SceneFile::parse(source, Number::F32.limit()).expect("a scene");
        let run = Run::of(&scene, Number::F32, Evolution::Path);
        let head = Head::new(&scene, &Settings::default());
        let begin = || archive.begin(&head, &run).expect("a recording");
        let (first, second) = (begin(), begin());
        let [a, b] = [&first, &second].map(|recording| recording.place().to_owned());
        assert_eq!(b.file_name(), Some(OsStr::new("box-flat-2.jsonl")));
        assert!(archive.newest_first().is_empty(), "both are being written");
        first.finish_live().expect("written");
        assert_eq!(archive.newest_first(), [a.as_path()]);
        drop(second);
        let later = SystemTime::now() + Duration::from_secs(1);
        let file = fs::File::options().append(true).open(&b).expect("there");
        file.set_modified(later).expect("a time");
        drop(file);
        assert_eq!(archive.newest_first(), [b, a]);
        assert_eq!(named("../a b\u{e4}"), "---a-b\u{e4}");
    }
}
