//! Nothing that is read is written, and no two outputs go to one place: refused before anything is written.

use std::fs;

use crate::common::{Folder, SCENE, scene_with_path};

/// What is typed; the file; the option that would write what is read, or the two that would write one file.
const REFUSED: &str = "
run scene.toml --record scene.toml | scene.toml | --record
run below/../scene.toml --record ./scene.toml | scene.toml | --record
run scene.toml --out hand.csv | hand.csv | --out
run scene.toml --record hand.csv | hand.csv | --record
run keyframes.toml --hand other.csv --out other.csv | other.csv | --out
run scene.toml --hand other.csv --record hand.csv | hand.csv | --record
run forces.svg --plot . | forces.svg | --plot
replay old.jsonl --out old.jsonl | old.jsonl | --out
replay old.jsonl --record below/../old.jsonl | old.jsonl | --record
BOARD --record scene.toml | scene.toml | --record
BOARD --out hand.csv | hand.csv | --out
BOARD --hand other.csv --out other.csv | other.csv | --out
sweep study.sweep --out study | study.sweep | --out
sweep study.sweep --out study.sweep | study.sweep | --out
sweep study.sweep --out scene.toml | scene.toml | --out
sweep study.sweep --out below/../hand.csv | hand.csv | --out
sweep hands.toml | hands.csv | --out
trade --hand trade.csv --out . | trade.csv | --out
run scene.toml --out new.jsonl --record below/../new.jsonl | new.jsonl | --out --record, allowed: a name for each
run scene.toml --record new/strip.png --plot new | strip.png | --record --plot, allowed: a name for each
replay old.jsonl --out new.jsonl --record new.jsonl | new.jsonl | --out --record
";

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
    fs::create_dir(folder.file("below")).expect("a folder");
    folder.done("run scene.toml --record old.jsonl");
    // Nobody is looked for there.
    let board = "board scene.toml --socket absent --verify";
    let contents = || folder.names().into_iter().filter(|name| name != "below");
    let contents = || contents().map(|name| (folder.read(&name), name));
    let before: Vec<_> = contents().collect();
    let read = |option| format!("is read and would be written by {option}, allowed: another name");
    for line in REFUSED.trim().lines() {
        let cells: Vec<&str> = line.split(" | ").map(str::trim).collect();
        let (typed, file) = (cells[0].replace("BOARD", board), cells[1]);
        let expected = match cells[2].split_once(' ') {
            None => read(cells[2]),
            Some((one, other)) => format!("would be written by {one} and by {other}"),
        };
        folder.refused(&typed, &[&format!("{file}: {expected}")]);
        assert_eq!(contents().collect::<Vec<_>>(), before, "{line}");
    }
}

#[cfg(unix)]
#[test]
fn outputs_behind_a_link_to_an_input_are_refused() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    std::os::unix::fs::symlink("scene.toml", folder.file("link.toml")).expect("a link");
    for typed in [
        "run scene.toml --record link.toml",
        "run link.toml --record scene.toml",
    ] {
        folder.refused(typed, &["is read and would be written"]);
        assert_eq!(folder.read("scene.toml"), SCENE);
    }
}
