//! Tables in Markdown, and the sections of documents that have them: the text between `<!-- NAME: begin -->` and `<!-- NAME: end -->`.

use std::fmt;
use std::fs;
use std::io;
use std::path::Path;

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
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = |cells: &[String]| format!("| {} |", cells.join(" | "));
        let rule = |is_number: &bool| if *is_number { "--:|" } else { "---|" };
        writeln!(f, "{}", line(&self.header))?;
        writeln!(
            f,
            "|{}",
            self.is_number.iter().map(rule).collect::<String>()
        )?;
        self.rows
            .iter()
            .try_for_each(|row| writeln!(f, "{}", line(row)))
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
            true => replace(&workspace().join(document), section, text),
            false => Ok(()),
        }
    }
}

/// Replaces a section of a file by a text.
///
/// # Errors
/// The file cannot be read or written, or has no such section.
pub fn replace(file: &Path, section: &str, text: &str) -> io::Result<()> {
    let [begin, end] = ["begin", "end"].map(|end| format!("<!-- {section}: {end} -->"));
    let whole = fs::read_to_string(file)?;
    let parts = whole.split_once(&begin);
    let parts = parts.and_then(|(head, rest)| Some((head, rest.split_once(&end)?.1)));
    let Some((head, tail)) = parts else {
        let file = file.display();
        return Err(io::Error::other(format!(
            "{file} has no section between {begin} and {end}"
        )));
    };
    fs::write(
        file,
        format!("{head}{begin}\n{}\n{end}{tail}", text.trim_end()),
    )
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
    }

    #[test]
    fn a_section_is_replaced_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("README.md");
        let text =
            |inside| format!("before\n<!-- a: begin -->\n{inside}\n<!-- a: end -->\nafter\n");
        fs::write(&file, text("old")).expect("a file");
        replace(&file, "a", "new\n").expect("written");
        assert_eq!(fs::read_to_string(&file).expect("a file"), text("new"));
        let error = replace(&file, "b", "new").expect_err("no section");
        assert!(error.to_string().contains("<!-- b: begin -->"), "{error}");
    }
}
