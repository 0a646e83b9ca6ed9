//! What a stranger types by mistake, and what the program says then: what is wrong, and what to type, in a few lines.

use crate::common::{Folder, SCENE, assert_all, assert_error, text};

/// A message is read at a glance (lines that are not empty).
const LONGEST: usize = 6;

/// What is typed after `stiction`, and the parts of the message that help.
#[rustfmt::skip]
const COMMANDS: &[(&str, &[&str])] = &[
    // A scene or a file in the place of a command.
    ("ladder", &["'ladder' is a scene", "stiction run ladder", "stiction view ladder"]),
    ("scene.toml", &["'scene.toml' is a scene", "stiction run scene.toml"]),
    ("missing.toml", &["there is no file 'missing.toml'", "stiction new missing.toml"]),
    ("ladr", &["'ladr'", "stiction view ladder"]),
    ("rnu", &["'rnu'", "stiction run"]),
    ("vieww", &["'vieww'", "'view'"]),
    ("xyzzy", &["'xyzzy'", "stiction --help"]),
    // Scenes.
    ("run", &["<SCENE>", "stiction scenes", "stiction new NAME"]),
    ("run ladr", &["ladr: no such file", "did you mean `ladder`?"]),
    ("run ladder.tml", &["ladder.tml: no such file", "did you mean `ladder`?"]),
    ("check trace.jsonl --scene box_flat", &["box_flat", "did you mean `box-flat`?"]),
    ("run ladder box-flat", &["'box-flat'", "one scene at a time"]),
    ("new scene", &["scene.toml: is there already", "another name"]),
    ("new mine --like ladr", &["did you mean `ladder`?"]),
    // Options of a run.
    ("run ladder --rate -3", &["'-3'", "--rate", "above 0"]),
    ("run ladder --rate 0", &["'0'", "--rate", "above 0"]),
    ("run ladder --budget -1", &["'-1'", "--budget", "from 1 to"]),
    ("run ladder --number f16", &["'f16'", "f32, f64, fixed"]),
    ("run ladder --evolution Path", &["'Path'", "path, frame"]),
    ("run ladder --plot", &["--plot <DIR|FILE>", "a value is required"]),
    ("run ladder --plot ladder.jpg", &["'ladder.jpg'", "FILE.pdf, FILE.svg or FILE.png"]),
    ("run ladder --out trace.txt", &["'trace.txt'", "ends in .jsonl or .csv"]),
    ("run ladder --output t.csv", &["'--output'", "'--out'"]),
    ("run ladder --hand missing.csv", &["missing.csv: cannot be read: no such file"]),
    ("run scene.toml --out scene.jsonl --record scene.jsonl", &["scene.jsonl", "a name for each"]),
    // Places of boards and pages.
    ("board", &["--port", "--emulate", "without a board at hand: --emulate"]),
    ("board --tcp localhost", &["'localhost'", "the port is missing, write localhost:PORT"]),
    ("board --tcp localhost:many", &["'localhost:many'", "HOST:PORT"]),
    ("board --port /dev/doesnotexist", &["/dev/doesnotexist", "no such port", "--port auto"]),
    ("board --port /dev/null", &["/dev/null", "no serial port", "--port auto"]),
    ("board --port /dev/null --baud fast", &["'fast'", "115200 for the micro:bit"]),
    ("view --emulate box-flat", &["'box-flat' is a scene", "box-flat --emulate"]),
    ("board --emulate arduino", &["'arduino'", "microbit"]),
    ("view --listen 99999", &["'99999'", "--listen", "0 to 65535"]),
    ("view --osc somewhere", &["'somewhere'", "the port is missing, write somewhere:PORT"]),
    ("view --osc-rate 5000", &["'5000'", "1 to 1000"]),
    ("board --emulate --timeout -1", &["'-1'", "0.05 to 3600"]),
    ("image pic", &["'pic'", "'pico'"]),
    ("completions basch", &["'basch'", "'bash'"]),
];

/// A part of a scene file, what stands there instead, and the parts of the message that help.
#[rustfmt::skip]
const SCENES: &[(&str, &str, &[&str])] = &[
    ("weight", "wieght", &["line 5", "unknown key `wieght`", "did you mean `weight`?"]),
    ("[spring]", "[springs]", &["unknown key `springs`", "did you mean `spring`?"]),
    ("[[surface]]\nname = \"floor\"", "[surface]\nname = \"floor\"", &["line 19", "write [[surface]]"]),
    ("[body]", "[[body]]", &["line 2", "write [body]"]),
    ("[grasp]", "[body]", &["line 7", "[body] is there already, in line 2"]),
    ("[grasp]", "[[grasp]]", &["line 7", "write [grasp]"]),
    ("weight = 0.0", "weight = \"heavy\"", &["line 5", "`body.weight`", "a number"]),
    ("weight = 0.0", "weight = 0,0", &["line 5", "|"]),
    ("weight = 0.0", "weight = -1.0", &["line 5", "`body.weight`", "0 or more"]),
    ("rate = 10.0", "", &["no `rate`", "--rate"]),
];

/// The program ends with status 2 and a short message that has all parts.
fn refused(folder: &Folder, typed: &str, parts: &[&str]) {
    let output = folder.stiction(typed);
    assert_error(typed, &output, parts);
    let said = text(&output.stderr);
    let lines = said.lines().filter(|line| !line.trim().is_empty());
    assert!(
        output.stdout.is_empty() && lines.count() <= LONGEST,
        "{typed}: {said}"
    );
}

#[test]
fn every_mistake_is_named_with_what_to_type() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.write("trace.jsonl", "");
    let before = folder.names();
    for (typed, parts) in COMMANDS {
        refused(&folder, typed, parts);
    }
    assert_eq!(folder.names(), before, "nothing is written");
    for (right, wrong, parts) in SCENES {
        assert!(SCENE.contains(right), "{right}");
        folder.write("mine.toml", SCENE.replacen(right, wrong, 1));
        refused(&folder, "run mine.toml", &[&["mine.toml"], *parts].concat());
    }
}

/// A program that builds from sources, put into a folder of its own: without them it says which it needs, and finds them where it is
/// called or where it is directed; then all tools that are missing are named at once, before anything is built.
#[cfg(unix)]
#[test]
fn a_program_away_from_its_sources_says_what_it_needs() {
    let folder = Folder::new();
    let program = folder.file("stiction");
    // A compiler without targets, and no other program. Another process writes them: what a process has open for writing can be
    // open in one that another test starts meanwhile, and is then not started.
    let made = std::process::Command::new("sh")
        .arg("-c")
        .arg("cp \"$0\" stiction && mkdir tools && printf '#!/bin/sh\\necho /nowhere\\n' >tools/rustc && chmod +x tools/rustc")
        .arg(env!("CARGO_BIN_EXE_stiction"))
        .current_dir(folder.file(""))
        .status();
    assert!(made.is_ok_and(|status| status.success()));
    std::fs::create_dir_all(folder.file("checkout/firmware/boards")).expect("a folder");
    std::fs::create_dir_all(folder.file("checkout/core/src")).expect("a folder");
    let said = |typed: &str, place: &str, sources: Option<&str>| {
        let mut command = std::process::Command::new(&program);
        command
            .args(typed.split(' '))
            .current_dir(folder.file(place));
        command.env_remove("CARGO_MANIFEST_DIR").env_remove("RUSTC");
        command.env("PATH", folder.file("tools"));
        command.env_remove("STICTION_SOURCES");
        command.envs(sources.map(|place| ("STICTION_SOURCES", folder.file(place))));
        let output = command.output().expect("the program starts");
        assert_eq!(output.status.code(), Some(2), "{typed}");
        text(&output.stderr)
    };
    for typed in ["image pico", "board --emulate", "view --emulate"] {
        let nowhere = said(typed, "tools", None);
        assert_all(
            typed,
            &nowhere,
            &["the sources of stiction", "set STICTION_SOURCES"],
        );
        for there in [
            said(typed, "checkout/core/src", None),
            said(typed, "tools", Some("checkout")),
        ] {
            let target = ["missing: the target thumb", "\n  rustup target add thumb"];
            assert_all(typed, &there, &target);
            assert!(!there.contains("the sources of"), "{typed}: {there}");
            let is_image = typed == "image pico";
            let linker = "\n  cargo install flip-link";
            assert!(!is_image || there.contains(linker), "{there}");
            assert_eq!(
                there.contains("qemu-system-arm"),
                !is_image,
                "{typed}: {there}"
            );
        }
        assert_all(typed, &said(typed, "tools", Some("tools")), &["tools)"]);
    }
}
