//! TUTORIAL.md as its reader follows it: what is to be written is written, what is to be typed is run, and what it says to come of it
//! comes of it.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

use crate::common::Folder;

/// What runs the program in the text.
const PROGRAM: &str = "cargo run --release -- ";

/// The fenced blocks of the text: language and content, in order.
fn blocks(text: &str) -> Vec<(&str, String)> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let inside = lines.by_ref().take_while(|line| *line != "```");
            let content: String = inside.map(|line| format!("{line}\n")).collect();
            blocks.push((language, content));
        }
    }
    blocks
}

/// A file with a block written into it: in the place of the section of its name, or at the end. `[[...]]` are added.
fn with(file: &str, block: &str) -> String {
    let header = block.lines().next().expect("a section");
    let Some(start) = file.find(header).filter(|_| !header.starts_with("[[")) else {
        return format!("{file}\n{block}");
    };
    let rest = &file[start + header.len()..];
    let end = rest.find("\n[").map_or("", |end| &rest[end..]);
    format!("{}{block}{end}", &file[..start])
}

/// Text without the widths of its gaps.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Starts the page, waits until it is served, and ends it; not by SIGINT, which programs in the background of a shell do not hear.
fn page(folder: &Folder, line: &str) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(line.split_whitespace())
        .args(["--listen", "127.0.0.1:0", "--recordings", "recordings"])
        .current_dir(folder.file(""))
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut line = String::new();
    let mut output = BufReader::new(child.stdout.take().expect("its output"));
    output.read_line(&mut line).expect("a line of text");
    assert!(line.starts_with("http://127.0.0.1:"), "{line}");
    #[cfg(unix)]
    crate::common::send(crate::common::Signal::SIGTERM, &child);
    #[cfg(not(unix))]
    child.kill().expect("it runs");
    let status = child.wait().expect("it ends");
    assert!(cfg!(not(unix)) || status.success(), "{status}");
}

#[test]
fn the_tutorial_does_what_it_says() {
    let tutorial = include_str!("../../TUTORIAL.md");
    let folder = Folder::new();
    let (mut scene, mut said) = (String::new(), String::new());
    let mut counts = [0; 3];
    for (language, block) in blocks(tutorial) {
        match language {
            "toml" if block.starts_with("scenes") => folder.write("rough.toml", block),
            "toml" => {
                counts[0] += 1;
                scene = with(&scene, &block);
                folder.write("wedge.toml", &scene);
            }
            "sh" => {
                counts[1] += 1;
                let command = block.trim().strip_prefix(PROGRAM);
                let line = command.expect(PROGRAM);
                if line.starts_with("view") {
                    page(&folder, line);
                    continue;
                }
                said = words(&folder.done(line));
            }
            "text" => {
                for line in block.lines() {
                    counts[2] += 1;
                    assert!(said.contains(&words(line)), "{line}\n{said}");
                }
            }
            other => panic!("a block of {other:?}"),
        }
    }
    assert_eq!(counts, [5, 6, 5], "blocks of the scene, commands, lines");
    for file in ["plots/strip.png", "plots/forces.svg", "rough.csv"] {
        assert!(folder.file(file).exists(), "{file}");
    }
    assert_eq!(folder.read("rough.csv").lines().count(), 4);
}
