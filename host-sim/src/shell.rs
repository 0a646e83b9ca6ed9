//! `stiction completions` and `stiction man`: completions for a shell, and manual pages, both from the description of the
//! commands.

use std::ffi::OsStr;
use std::io;
use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;
use clap_complete::engine::{
    ArgValueCompleter, CompletionCandidate, PathCompleter, ValueCompleter,
};
use clap_complete::env::{CompleteEnv, Shells};
use stiction_scene::story;

use crate::command::described;
use crate::files::WriteError;
use crate::report;
use stiction_live::scenes;

/// The variable in which the shell passes a line that it completes.
const VARIABLE: &str = "STICTION_COMPLETE";

/// The arguments of `stiction completions`.
#[derive(Args, Clone, Debug)]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// The arguments of `stiction man`.
#[derive(Args, Clone, Debug)]
pub struct ManArgs {
    /// Folder for the pages, such as ~/.local/share/man/man1; it is created where it is missing
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Answers a shell that completes a line, and then ends the program.
pub(crate) fn complete() {
    CompleteEnv::with_factory(described)
        .var(VARIABLE)
        .complete();
}

/// Prints the script that a shell reads at its start.
pub(crate) fn completions(args: &CompletionsArgs) -> io::Result<()> {
    let name = args.shell.to_string();
    let shells = Shells::builtins();
    let mut script = Vec::new();
    if let Some(shell) = shells.completer(&name) {
        shell.write_registration(VARIABLE, "stiction", "stiction", "stiction", &mut script)?;
    }
    report::print(&String::from_utf8_lossy(&script));
    Ok(())
}

/// Writes the manual pages.
pub(crate) fn man(args: &ManArgs) -> Result<(), WriteError> {
    let folder = &args.folder;
    std::fs::create_dir_all(folder)
        .and_then(|()| clap_mangen::generate_to(described(), folder))
        .map_err(WriteError::of(folder))?;
    let shown = folder.display();
    report::print(&format!(
        "{shown}: to read the first page: man {shown}/stiction.1\n"
    ));
    Ok(())
}

/// Completes the names of bundled scenes, with their stories, and of files.
pub(crate) fn scene_completer() -> ArgValueCompleter {
    ArgValueCompleter::new(|begun: &OsStr| {
        let begun_text = begun.to_string_lossy();
        let fits = scenes::ALL
            .iter()
            .filter(|(name, _)| name.starts_with(&*begun_text));
        let mut candidates: Vec<_> = fits
            .map(|(name, text)| {
                let story = story(text).map(|story| story.to_owned().into());
                CompletionCandidate::new(*name).help(story)
            })
            .collect();
        let files =
            PathCompleter::file().filter(|path| path.extension().is_some_and(|end| end == "toml"));
        candidates.extend(files.complete(begun));
        candidates
    })
}
