//! Sections of a Markdown file that a command writes: the text between `<!-- NAME: begin -->` and `<!-- NAME: end -->`.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::files;

/// A file with a section that is to be written.
#[derive(Clone, Debug)]
pub struct Section {
    file: PathBuf,
    begin: String,
    end: String,
}

impl Section {
    /// The section with this name in a file.
    ///
    /// # Errors
    /// The file cannot be read, or has no such section.
    pub fn find(file: &Path, name: &str) -> io::Result<Self> {
        let section = Self {
            file: file.to_owned(),
            begin: format!("<!-- {name}: begin -->"),
            end: format!("<!-- {name}: end -->"),
        };
        section.parts().map(|_| section)
    }

    /// The text before and after the section, with its markers.
    fn parts(&self) -> io::Result<(String, String)> {
        let text = fs::read_to_string(&self.file)?;
        let begin = text.find(&self.begin).map(|at| at + self.begin.len());
        let end = begin.and_then(|from| Some(from + text[from..].find(&self.end)?));
        match (begin, end) {
            (Some(begin), Some(end)) => Ok((text[..begin].to_owned(), text[end..].to_owned())),
            _ => Err(io::Error::other(format!(
                "has no section between {} and {}",
                self.begin, self.end
            ))),
        }
    }

    /// Replaces the section by `text`; the file is replaced atomically.
    ///
    /// # Errors
    /// The file cannot be read or replaced, or no longer has such a section.
    pub fn write(&self, text: &str) -> io::Result<()> {
        let (head, tail) = self.parts()?;
        let whole = format!("{head}\n{}\n{tail}", text.trim_end());
        files::write(&self.file, whole.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_is_replaced_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("README.md");
        let text =
            |inside| format!("before\n<!-- a: begin -->\n{inside}\n<!-- a: end -->\nafter\n");
        fs::write(&file, text("old")).expect("a file");
        Section::find(&file, "a")
            .expect("a section")
            .write("new\n")
            .expect("written");
        assert_eq!(fs::read_to_string(&file).expect("a file"), text("new"));
    }

    #[test]
    fn a_file_without_the_section_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("README.md");
        fs::write(&file, "<!-- a: end --><!-- a: begin -->").expect("a file");
        let error = Section::find(&file, "a")
            .expect_err("no section")
            .to_string();
        assert!(error.contains("<!-- a: begin -->"), "{error}");
    }
}
