//! What helps a stranger: examples in every help, scenes to list and to start from, completions, manual pages.

use std::process::Command;

use crate::common::{Folder, text};
use stiction_host_sim::command::{described, parsed};

/// Commands whose examples take no board, no build and no time.
const CHEAP: [&str; 9] = [
    "run",
    "figures",
    "scenes",
    "new",
    "replay",
    "check",
    "code",
    "completions",
    "man",
];

fn examples(command: &clap::Command) -> Vec<String> {
    let help = command.get_after_help().map(ToString::to_string);
    let help = help.unwrap_or_default();
    let lines = help.lines().skip(1).map(|line| line.trim().to_owned());
    lines.collect()
}

#[test]
fn every_example_of_the_help_works_as_it_is_typed() {
    let folder = Folder::new();
    let program = described();
    let first = examples(&program);
    assert!(first.iter().any(|line| line == "stiction"), "{first:?}");
    for command in std::iter::once(&program).chain(program.get_subcommands()) {
        let name = command.get_name();
        let lines = examples(command);
        assert!(!lines.is_empty(), "{name}");
        for line in lines {
            // What stands behind is the shell's.
            let (typed, into) = line.split_once(" > ").unwrap_or((&line, ""));
            let words: Vec<&str> = typed.split(' ').collect();
            assert!(words[0] == "stiction" && parsed(&words).is_ok(), "{line}");
            if CHEAP.contains(&name) {
                let output = folder.stiction(&words[1..].join(" "));
                let said = text(&output.stderr);
                assert!(output.status.success(), "{line}: {said}");
                assert!(into.is_empty() || !output.stdout.is_empty(), "{line}");
            }
        }
    }
    for file in [
        "ladder.jsonl",
        "plots/forces.png",
        "scenes/hook.toml",
        "mine.toml",
        "man1/stiction.1",
    ] {
        assert!(folder.file(file).exists(), "{file}");
    }
    for command in program.get_subcommands() {
        let page = format!("man1/stiction-{}.1", command.get_name());
        assert!(folder.read(&page).contains("stiction"), "{page}");
    }
}

#[test]
fn a_new_scene_runs_as_the_one_that_it_is_like_and_is_never_written_over() {
    let folder = Folder::new();
    let output = folder.stiction("new mine --like ladder");
    let said = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(
        said.contains("stiction run mine.toml --plot plots"),
        "{said}"
    );
    assert!(said.contains("stiction view mine.toml"), "{said}");
    let trace = |scene: &str| {
        folder.done(&format!("run {scene} --quiet --out trace.csv"));
        folder.read("trace.csv")
    };
    assert_eq!(trace("mine.toml"), trace("ladder"));
    folder.write("mine.toml", "my work");
    assert_eq!(folder.stiction("new mine.toml").status.code(), Some(2));
    assert_eq!(folder.read("mine.toml"), "my work");
}

/// The files are those that are bundled; one that somebody has changed stays, and then none is written.
#[test]
fn the_scenes_are_listed_and_written_as_they_are_bundled() {
    let folder = Folder::new();
    let list = text(&folder.stiction("scenes").stdout);
    let story = "A ladder leans on a wall: it stands while it is steep, and slides down when the hand flattens it.";
    let line = list.lines().find(|line| line.starts_with("ladder "));
    assert!(line.is_some_and(|line| line.ends_with(story)), "{list}");
    folder.write("ladder.toml", "my ladder");
    let output = folder.stiction("scenes --out .");
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(folder.names(), ["ladder.toml"]);
    let output = folder.stiction("scenes --out all");
    let written = text(&output.stdout);
    for picture in written.lines() {
        let scene = folder.file(picture).with_extension("toml");
        assert!(
            folder.read(picture).starts_with("<svg") && scene.exists(),
            "{picture}"
        );
    }
    let scenes = list.lines().take_while(|line| !line.is_empty());
    assert_eq!(written.lines().count(), scenes.count(), "{written}");
    let bundled = include_str!("../../scenes/ladder.toml");
    assert_eq!(folder.read("all/ladder.toml"), bundled);
    // Again, they are the same.
    assert!(folder.stiction("scenes --out all").status.success());
}

#[test]
fn a_shell_completes_scenes_files_and_options() {
    let folder = Folder::new();
    folder.write("large.toml", "");
    folder.write("large.txt", "");
    let completed = |words: &[&str]| -> Vec<String> {
        let mut command = Command::new(env!("CARGO_BIN_EXE_stiction"));
        command.current_dir(folder.file(""));
        command
            .env("STICTION_COMPLETE", "fish")
            .arg("--")
            .args(words);
        let lines = text(&command.output().expect("the program starts").stdout);
        let value = |line: &str| line.split('\t').next().unwrap_or_default().to_owned();
        lines.lines().map(value).collect()
    };
    assert_eq!(
        completed(&["stiction", "view", "la"]),
        ["ladder", "large.toml"]
    );
    assert_eq!(
        completed(&["stiction", "run", "ladder", "--number", "fi"]),
        ["fixed"]
    );
    assert_eq!(completed(&["stiction", "comp"]), ["completions"]);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = folder.stiction(&format!("completions {shell}"));
        let script = text(&output.stdout);
        assert!(
            output.status.success() && script.contains("STICTION_COMPLETE"),
            "{shell}"
        );
    }
}
