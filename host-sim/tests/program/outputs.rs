//! Nothing that is read is written, and no two outputs go to one place: refused before anything is written.

use std::fs;

use crate::common::{Folder, SCENE, scene_with_path, text};

/// What is read and what is written are compared as the files that the names lead to.
#[test]
fn outputs_in_the_place_of_an_input_or_of_another_output_are_refused() {
    let folder = Folder::new();
    let path = "t,x,y,phi\n0,0.2,0.14,0.5\n1,0.2,0.06,0.5\n";
    folder.write("keyframes.toml", SCENE);
    folder.write("scene.toml", scene_with_path("hand.csv", ""));
    folder.write("hand.csv", path);
    folder.write("other.csv", path);
    folder.write("forces.svg", scene_with_path("hand.csv", ""));
    folder.write("study.sweep", "scenes = [\"scene.toml\"]\n");
    folder.write(
        "hands.toml",
        "scenes = [\"keyframes.toml\"]\nvary.run.hand = [\"hands.csv\"]\n",
    );
    folder.write("hands.csv", path);
    folder.write("trade.csv", path);
    folder.write("README.md", "<!-- trade: begin --><!-- trade: end -->");
    fs::create_dir(folder.file("below")).expect("a folder");
    let output = folder.stiction(&["run", "scene.toml", "--record", "old.jsonl"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    // Nobody is looked for there.
    let board = "board scene.toml --socket absent --verify";
    let contents = || folder.names().into_iter().filter(|name| name != "below");
    let contents = || contents().map(|name| (folder.read(&name), name));
    let before: Vec<_> = contents().collect();
    let read = |option| format!("is read and would be written by {option}, allowed: another name");
    for (arguments, file, expected) in [
        (
            "run scene.toml --record scene.toml",
            "scene.toml",
            read("--record"),
        ),
        (
            "run below/../scene.toml --record ./scene.toml",
            "scene.toml",
            read("--record"),
        ),
        ("run scene.toml --out hand.csv", "hand.csv", read("--out")),
        (
            "run scene.toml --record hand.csv",
            "hand.csv",
            read("--record"),
        ),
        (
            "run keyframes.toml --hand other.csv --out other.csv",
            "other.csv",
            read("--out"),
        ),
        // The path of the scene, though another one stands in for it.
        (
            "run scene.toml --hand other.csv --record hand.csv",
            "hand.csv",
            read("--record"),
        ),
        ("run forces.svg --plot .", "forces.svg", read("--plot")),
        (
            "replay old.jsonl --out old.jsonl",
            "old.jsonl",
            read("--out"),
        ),
        (
            "replay old.jsonl --record below/../old.jsonl",
            "old.jsonl",
            read("--record"),
        ),
        (
            &format!("{board} --record scene.toml"),
            "scene.toml",
            read("--record"),
        ),
        (
            &format!("{board} --out hand.csv"),
            "hand.csv",
            read("--out"),
        ),
        (
            &format!("{board} --hand other.csv --out other.csv"),
            "other.csv",
            read("--out"),
        ),
        (
            "sweep study.sweep --out study",
            "study.sweep",
            read("--out"),
        ),
        (
            "sweep study.sweep --out study.sweep",
            "study.sweep",
            read("--out"),
        ),
        (
            "sweep study.sweep --out scene.toml",
            "scene.toml",
            read("--out"),
        ),
        (
            "sweep study.sweep --out below/../hand.csv",
            "hand.csv",
            read("--out"),
        ),
        ("sweep hands.toml", "hands.csv", read("--out")),
        ("trade --hand trade.csv --out .", "trade.csv", read("--out")),
        (
            "run scene.toml --out new.jsonl --record below/../new.jsonl",
            "new.jsonl",
            "would be written by --out and by --record, allowed: a name for each".to_owned(),
        ),
        (
            "run scene.toml --record new/strip.png --plot new",
            "strip.png",
            "would be written by --record and by --plot, allowed: a name for each".to_owned(),
        ),
        (
            "replay old.jsonl --out new.jsonl --record new.jsonl",
            "new.jsonl",
            "would be written by --out and by --record".to_owned(),
        ),
    ] {
        let words: Vec<&str> = arguments.split(' ').collect();
        let output = folder.stiction(&words);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {message}");
        let expected = format!("{file}: {expected}");
        assert!(message.contains(&expected), "{arguments}: {message}");
        assert_eq!(contents().collect::<Vec<_>>(), before, "{arguments}");
    }
}

#[cfg(unix)]
#[test]
fn outputs_behind_a_link_to_an_input_are_refused() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    std::os::unix::fs::symlink("scene.toml", folder.file("link.toml")).expect("a link");
    for arguments in [
        ["run", "scene.toml", "--record", "link.toml"],
        ["run", "link.toml", "--record", "scene.toml"],
    ] {
        let output = folder.stiction(&arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(
            message.contains("is read and would be written"),
            "{message}"
        );
        assert_eq!(folder.read("scene.toml"), SCENE);
    }
}
