//! Recordings: what is run again gives the same bits, what does not is named; every fault that was found is stored as one.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::common::{Folder, SCENE, assert_all, said, scene_with_path};

/// The exit status of `stiction replay`, and all that it says.
fn replayed(folder: &Folder, arguments: &str) -> (Option<i32>, String) {
    let output = folder.stiction(&format!("replay {arguments}"));
    (output.status.code(), said(&output))
}

fn recorded(options: &str) -> Folder {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.done(&format!(
        "run scene.toml --record recording.jsonl --out trace.jsonl {options}"
    ));
    folder
}

#[test]
fn a_recording_gives_the_same_bits_again() {
    for number in ["f64", "f32", "fixed"] {
        for evolution in ["path", "frame"] {
            let dials = format!("--number {number} --evolution {evolution}");
            let folder = recorded(&format!("{dials} --rate 777 --budget 1"));
            let again = "recording.jsonl --out again.jsonl --record again-recording.jsonl";
            let (status, message) = replayed(&folder, again);
            assert_eq!(status, Some(0), "{message}");
            let compared = "778 of 778 frames compared, the same bits";
            assert!(message.contains(compared), "{message}");
            assert_eq!(folder.read("trace.jsonl"), folder.read("again.jsonl"));
            assert_eq!(
                folder.read("recording.jsonl"),
                folder.read("again-recording.jsonl")
            );
        }
    }
}

/// A sample that is not finite, and a hand that lets go.
#[test]
fn a_recording_keeps_what_a_tracker_lost() {
    let folder = Folder::new();
    folder.write("scene.toml", scene_with_path("hand.csv", ""));
    let hand =
        "t,x,y,phi,held\n0,0.2,0.14,0.5,1\n1,nan,0.1,inf,1\n2,0.2,0.1,0.5,0\n3,0.2,0.1,0.5,1\n";
    folder.write("hand.csv", hand);
    folder.done("run scene.toml --record recording.jsonl");
    let recording = folder.read("recording.jsonl");
    assert_all(
        "the recording",
        &recording,
        &[r#""position":[null,0.1]"#, "held-last"],
    );
    // A recording needs no other file.
    fs::remove_file(folder.file("hand.csv")).expect("the path");
    folder.done("replay recording.jsonl");
}

#[test]
fn the_first_frame_that_differs_is_named() {
    let folder = recorded("");
    let recording = folder.read("recording.jsonl");
    let lines: Vec<&str> = recording.lines().collect();
    // The sample that the hand has moved by a last digit, and the answer that was something else.
    let changes = [
        (
            4,
            r#""position":[0.2,"#,
            r#""position":[0.20000002,"#,
            "hand: recorded [0.2,",
        ),
        (
            5,
            r#""status":"ok""#,
            r#""status":"ambiguous""#,
            r#"status: recorded "ambiguous", now "ok""#,
        ),
    ];
    for (line, from, to, difference) in changes {
        let mut changed: Vec<String> = lines.iter().map(ToString::to_string).collect();
        changed[line - 1] = changed[line - 1].replacen(from, to, 1);
        folder.write("changed.jsonl", changed.join("\n") + "\n");
        let (status, message) = replayed(&folder, "changed.jsonl");
        assert_eq!(status, Some(1), "{message}");
        let place = format!("frame {} differs (line {line}, t = ", line - 2);
        assert!(
            message.starts_with(&place) && message.contains(difference),
            "{message}"
        );
    }
    // An answer that did not come is not compared.
    let lost = recording.replacen(lines[3], &without_answer(lines[3]), 1);
    folder.write("lost.jsonl", lost);
    let (status, message) = replayed(&folder, "lost.jsonl");
    assert_eq!(status, Some(0), "{message}");
    assert!(message.contains("10 of 11 frames compared"), "{message}");
}

/// The last line counts the samples, so that lines which are lost are missed.
#[test]
fn a_recording_that_lost_whole_lines_is_not_good() {
    let folder = recorded("");
    let recording = folder.read("recording.jsonl");
    let lines: Vec<&str> = recording.lines().collect();
    assert_eq!((lines.len(), lines[12]), (13, r#"{"samples":11}"#));
    let replayed = |part: &[&str], options: &str| {
        folder.write("lost.jsonl", part.join("\n") + "\n");
        replayed(&folder, &format!("lost.jsonl {options}"))
    };
    // Its end is lost: what is there is replayed, and what is missing is said.
    for options in ["", "--quiet"] {
        for (part, last) in [(&lines[..12], 12), (&lines[..5], 5)] {
            let (status, message) = replayed(part, options);
            assert_eq!(status, Some(1), "{message}");
            let place = format!("lost.jsonl: ends after line {last} without the count");
            assert!(message.contains(&place), "{message}");
            let compared = format!("{0} of {0} frames compared, the same bits", last - 1);
            assert_eq!(message.contains(&compared), options.is_empty(), "{message}");
        }
    }
    // Lines are lost in between, or there are more than were recorded.
    let lost = [&lines[..11], &lines[12..]].concat();
    let twice = [&lines[..12], &lines[11..]].concat();
    for (part, place, there) in [(lost, "line 12", 10), (twice, "line 14", 12)] {
        let (status, message) = replayed(&part, "--out again.jsonl");
        assert_eq!(status, Some(2), "{message}");
        let counts = format!("{place}: `samples` is 11, but {there} are there, allowed: ");
        assert!(message.contains(&counts), "{message}");
        assert!(!folder.names().contains(&"again.jsonl".to_owned()));
    }
    let more = [&lines[..], &lines[11..]].concat();
    let (status, message) = replayed(&more, "");
    assert_eq!(status, Some(2), "{message}");
    assert!(message.contains("line 14: follows the count"), "{message}");
}

/// A line of a recording whose answer did not come.
fn without_answer(line: &str) -> String {
    let end = line.find(r#","answer":"#).expect("an answer");
    format!(r#"{},"answer":null}}"#, &line[..end])
}

/// What was being written when its program was killed is left out, wherever it was cut; the rest is replayed.
#[test]
fn a_recording_that_was_cut_in_a_line_is_replayed_as_far_as_it_is_whole() {
    let folder = recorded("");
    let recording = folder.read("recording.jsonl");
    let starts: Vec<usize> = recording
        .match_indices('\n')
        .map(|(end, _)| end + 1)
        .collect();
    for (line, cut) in [
        (13, starts[11] + 1),
        (12, starts[11] - 2),
        (12, starts[10] + 1),
        (7, (starts[5] + starts[6]) / 2),
    ] {
        folder.write("cut.jsonl", &recording[..cut]);
        let (status, message) = replayed(&folder, "cut.jsonl --out again.jsonl");
        assert_eq!(status, Some(1), "{message}");
        let place = format!("cut.jsonl: ends in the middle of line {line}, which is left out");
        assert!(message.contains(&place), "{message}");
        let compared = format!("{0} of {0} frames compared, the same bits", line - 2);
        assert!(message.contains(&compared), "{message}");
        let whole = folder.read("trace.jsonl");
        let replayed = folder.read("again.jsonl");
        assert_eq!(replayed.lines().count(), line - 2);
        assert!(whole.starts_with(&replayed));
    }
    // Between two bytes of a letter.
    folder.write(
        "cut.jsonl",
        [&recording.as_bytes()[..starts[3]], b"{\"\xc3"].concat(),
    );
    let (status, message) = replayed(&folder, "cut.jsonl");
    assert_eq!(status, Some(1), "{message}");
    // A last line without its end is whole all the same.
    folder.write("cut.jsonl", recording.trim_end());
    let (status, message) = replayed(&folder, "cut.jsonl");
    assert_eq!(status, Some(0), "{message}");
}

/// What is said of a trace.
const TRACE: &str = "line 1: this is a trace; use `stiction check`";

#[test]
fn what_is_no_recording_is_refused_with_its_line() {
    let folder = recorded("");
    folder.done("run scene.toml --out trace.csv --quiet");
    let recording = folder.read("recording.jsonl");
    let head = recording.lines().next().expect("a head").to_owned();
    let other = |from: &str, to: &str| recording.replacen(from, to, 1);
    let version = r#""recording":1,"tolerance":0.0"#;
    let tolerance = r#""tolerance":0.0,"evolution""#;
    let stiffness = other("translation = 500.0", "translation = 0.0");
    let cases = [
        (String::new(), "line 1: "),
        ("nonsense\n".to_owned(), "line 1: "),
        (folder.read("trace.jsonl"), TRACE),
        (folder.read("trace.csv"), TRACE),
        (head.clone() + "\n", "line 1: no sample follows the head"),
        (
            other(r#""recording":3"#, r#""recording":4"#),
            "allowed: 2 to 3, the versions",
        ),
        (
            other(r#""recording":3"#, version),
            "with a `tolerance`, which the solver does not have any more), allowed: 2 to 3",
        ),
        (
            other(r#""evolution""#, tolerance),
            "line 1: unknown field `tolerance`",
        ),
        (
            other(r#""number":"f32""#, r#""number":"f16""#),
            "`number` is \"f16\", allowed: ",
        ),
        (
            other(r#""evolution":"path""#, r#""evolution":"way""#),
            "`evolution` is \"way\", allowed: ",
        ),
        (stiffness, "`spring.translation` is 0.0, allowed: "),
        (recording[..40].to_owned(), "line 1: "),
        (
            other(r#""sample""#, r#""simple""#),
            "line 2: unknown field `simple`",
        ),
        (other(r#""turns":0"#, r#""turns":0.5"#), "line 2: "),
    ];
    for (content, expected) in cases {
        folder.write("bad.jsonl", content);
        folder.refused(
            "replay bad.jsonl --out bad-trace.jsonl",
            &["bad.jsonl", expected],
        );
        assert!(!folder.names().contains(&"bad-trace.jsonl".to_owned()));
    }
    folder.refused("replay absent.jsonl", &["absent.jsonl: cannot be read"]);
}

/// `tests/recordings`: faults that fuzzing, a board or a user found.
fn stored() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/recordings");
    let entries = fs::read_dir(folder).expect("the folder of recordings");
    let mut files: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    assert!(!files.is_empty(), "no recordings");
    files
}

/// All that is wrong with the stored recordings, by the first line of what is said.
fn none_is_wrong(wrong: impl Fn(&Path) -> Option<String>) {
    let wrong: Vec<String> = (stored().iter())
        .filter_map(|file| Some(format!("{}: {}", file.display(), wrong(file)?)))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// They give the bits of now.
#[test]
fn stored_faults_give_the_same_bits() {
    none_is_wrong(|file| {
        let (status, message) = replayed(&Folder::new(), &file.to_string_lossy());
        (status != Some(0)).then_some(message)
    });
}

/// The answers of now are lawful, whatever was recorded: a recording that is made anew still shows that the fault is mended.
#[test]
fn stored_faults_are_lawful() {
    none_is_wrong(|file| {
        let folder = Folder::new();
        let replay = format!("{} --out trace.jsonl", file.display());
        let (_, message) = replayed(&folder, &replay);
        let recording = fs::read_to_string(file).expect("a recording");
        let head = recording.lines().next().expect("a head");
        let head: Value = serde_json::from_str(head).expect("JSON");
        let [scene, number, evolution] =
            ["scene", "number", "evolution"].map(|key| head[key].as_str().expect("a text"));
        folder.write("scene.toml", scene);
        let dials = format!("--number {number} --evolution {evolution}");
        let output = folder.stiction(&format!("check trace.jsonl --scene scene.toml {dials}"));
        (!output.status.success()).then(|| message + &said(&output))
    });
}
