//! `stiction scenes`: the bundled scenes with their stories, as a list, or as files in a folder, with a small picture of each.

use std::error::Error;
use std::fs;
use std::io::{self, ErrorKind, IsTerminal};
use std::path::{Path, PathBuf};

use crate::files::whole::write;
use clap::Args;
use stiction_live::thumbnail::thumbnail;
use stiction_scene::{Source, story};

use crate::files::WriteError;
use crate::report;
use stiction_live::scenes;

/// The arguments of `stiction scenes`.
#[derive(Args, Clone, Debug)]
pub struct ScenesArgs {
    /// Folder to write all scene files into, and a small picture (SVG) of each; a scene file there that is not the bundled one stays
    /// as it is, and is an error
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Prints the list, or writes the files.
pub(crate) fn scenes(args: &ScenesArgs) -> Result<(), Box<dyn Error>> {
    match &args.out {
        Some(folder) => written(folder),
        None => {
            let width = io::stdout().is_terminal().then(textwrap::termwidth);
            report::print(&list(width));
            Ok(())
        }
    }
}

/// Names and stories in two columns, wrapped to a width (characters); in a pipe, each scene is one line.
fn list(width: Option<usize>) -> String {
    let names = scenes::ALL.iter().map(|(name, _)| name.len());
    let column = names.max().unwrap_or(0) + 2;
    let mut text = String::new();
    for (name, source) in scenes::ALL {
        let story = story(source).unwrap_or_default();
        let begin = format!("{name:<column$}");
        let indent = " ".repeat(column);
        let options = textwrap::Options::new(width.unwrap_or(usize::MAX))
            .initial_indent(&begin)
            .subsequent_indent(&indent);
        text += &textwrap::fill(story, options);
        text.push('\n');
    }
    text + "\nto hold one with the mouse: stiction view NAME; to run it: stiction run NAME; to change it: stiction new FILE --like NAME\n"
}

/// Writes every scene to a folder, or nothing if a file there differs.
fn written(folder: &Path) -> Result<(), Box<dyn Error>> {
    let files: Vec<(PathBuf, &str)> = (scenes::ALL.iter())
        .map(|(name, text)| (folder.join(name).with_extension("toml"), *text))
        .collect();
    for (file, text) in &files {
        match fs::read(file) {
            Ok(bytes) if bytes != text.as_bytes() => {
                return Err(WriteError::Exists(file.clone()).into());
            }
            Err(error) if error.kind() != ErrorKind::NotFound => {
                return Err(WriteError::of(file)(error).into());
            }
            _ => {}
        }
    }
    fs::create_dir_all(folder).map_err(WriteError::of(folder))?;
    let mut printed = String::new();
    for (file, text) in &files {
        write(file, text.as_bytes()).map_err(WriteError::of(file))?;
        let picture = file.with_extension("svg");
        let svg = thumbnail(&Source::new(file, *text))?;
        write(&picture, svg.as_bytes()).map_err(WriteError::of(&picture))?;
        printed += &format!("{}\n", picture.display());
    }
    report::print(&printed);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The width of a narrow terminal.
    const NARROW: usize = 60;

    #[test]
    fn the_list_fits_a_narrow_terminal_and_is_a_line_each_in_a_pipe() {
        let narrow = list(Some(NARROW));
        let (scenes, _) = narrow.split_once("\n\n").expect("a hint below the list");
        assert!(
            scenes.lines().all(|line| line.chars().count() <= NARROW),
            "{narrow}"
        );
        let wide = list(None);
        let (scenes, _) = wide.split_once("\n\n").expect("a hint below the list");
        assert_eq!(scenes.lines().count(), scenes::ALL.len(), "{wide}");
        // The stories are aligned.
        let begins = |line: &str| line.find(|c: char| c.is_ascii_uppercase());
        let first = scenes.lines().next().and_then(begins);
        assert!(scenes.lines().all(|line| begins(line) == first), "{wide}");
    }
}
