//! Tables in Markdown, and the sections of documents that have them: the text between `<!-- NAME: begin -->` and `<!-- NAME: end -->`.

use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use stiction_host_sim::columns::aligned;
use stiction_host_sim::firmware::workspace;

/// A table. A column of numbers is aligned to the right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    header: Vec<String>,
    is_number: Vec<bool>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows. The names of its columns are separated by `|`; the name of a column of numbers ends with a colon, which is
    /// left out: `"scene | steps: | most (µs):"`.
    pub fn new(columns: &str) -> Self {
        let names = columns.split('|').map(str::trim);
        let (header, is_number) = names
            .map(|name| match name.strip_suffix(':') {
                Some(name) => (name.to_owned(), true),
                None => (name.to_owned(), false),
            })
            .unzip();
        Self {
            header,
            is_number,
            rows: Vec::new(),
        }
    }

    /// A table of these cells, with so many columns of words on its left; the others have numbers.
    pub fn of(header: Vec<String>, rows: Vec<Vec<String>>, words: usize) -> Self {
        Self {
            is_number: (0..header.len()).map(|k| k >= words).collect(),
            header,
            rows,
        }
    }

    /// Adds a row.
    pub fn row<C: ToString>(&mut self, cells: impl IntoIterator<Item = C>) {
        let cells = cells.into_iter().map(|cell| cell.to_string());
        self.rows.push(cells.collect());
    }

    /// Whether it has no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}

/// With `#`, the columns are padded to a width, which suits a terminal.
impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines = std::iter::once(&self.header).chain(&self.rows);
        let mut lines: Vec<Vec<String>> = lines.cloned().collect();
        if f.alternate() {
            let words = self.is_number.iter().take_while(|is| !**is).count();
            lines = aligned(&lines, words);
        }
        for (i, cells) in lines.iter().enumerate() {
            writeln!(f, "| {} |", cells.join(" | "))?;
            if i == 0 {
                let rule = cells.iter().zip(&self.is_number).map(|(cell, is_number)| {
                    let width = if f.alternate() {
                        cell.chars().count() + 1
                    } else {
                        2
                    };
                    let end = if *is_number { ":" } else { "-" };
                    format!("{}{end}|", "-".repeat(width))
                });
                writeln!(f, "|{}", rule.collect::<String>())?;
            }
        }
        Ok(())
    }
}

/// What becomes of a text that was measured.
#[derive(Clone, Copy, Debug)]
pub struct Destination {
    /// It is written into its document.
    pub write: bool,
}

impl Destination {
    /// Prints a text, and writes it into a section of a document of the workspace if asked to.
    ///
    /// # Errors
    /// The document cannot be written, or has no such section.
    pub fn put(self, document: &str, section: &str, text: &str) -> io::Result<()> {
        print!("{text}");
        match self.write {
            true => Section::find(&workspace().join(document), section)?.write(text),
            false => Ok(()),
        }
    }
}

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
                "{} has no section between {} and {}",
                self.file.display(),
                self.begin,
                self.end
            ))),
        }
    }

    /// Replaces the section by `text`.
    ///
    /// # Errors
    /// The file cannot be read or replaced, or no longer has such a section.
    pub fn write(&self, text: &str) -> io::Result<()> {
        let (head, tail) = self.parts()?;
        let whole = format!("{head}\n{}\n{tail}", text.trim_end());
        fs::write(&self.file, whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_a_rule_below_its_header() {
        let mut table = Table::new("scene | steps: | state");
        table.row(["flat", "12", "edge"]);
        let text = "| scene | steps | state |\n|---|--:|---|\n| flat | 12 | edge |\n";
        assert_eq!(table.to_string(), text);
        let padded = format!("{table:#}");
        let widths: Vec<usize> = padded.lines().map(|line| line.chars().count()).collect();
        assert_eq!(widths, [widths[0]; 3], "{padded}");
    }

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
