//! Scenes and traces that cannot be judged: the message names the line, the problem there and what is allowed.

use std::path::Path;

use stiction_judge::{Evolution, Scene, Source};

use crate::drag::{SCENE, drag, drag_scene};
use crate::write::{FORMATS, judged, lines};

/// The message about a trace in which one line was changed; lines are counted from 1, without the header.
fn message(format: &str, record: usize, change: impl Fn(&str) -> String) -> String {
    let scene = drag_scene();
    let mut lines = lines(format, &scene, &drag(false));
    let line = record - usize::from(format == "jsonl");
    lines[line] = change(&lines[line]);
    let text = lines.join("\n");
    let error = judged(&scene, Evolution::Path, format, &text).expect_err("an error");
    let error = error.to_string();
    let place = format!("trace.{format}, line {}: ", line + 1);
    assert!(error.contains(&place), "{error}");
    error
}

#[test]
fn unknown_names_are_reported_with_the_known_ones() {
    for format in FORMATS {
        for (known, wrong, expected) in [
            (
                "floor",
                "flor",
                "the `surface` of contact 0 is \"flor\", allowed: floor, wall",
            ),
            (
                "edge",
                "ege",
                "`state` is \"ege\", allowed: non-contact, single-vertex",
            ),
            (
                "ok",
                "fine",
                "`status` is \"fine\", allowed: ok, event-limit",
            ),
        ] {
            let error = message(format, 7, |line| line.replacen(known, wrong, 1));
            assert!(error.contains(expected), "{error}");
        }
    }
    let error = message("jsonl", 7, |line| line.replace("[]", r#"["glide"]"#));
    assert!(
        error.contains("one of `events` is \"glide\", allowed: touch, lift"),
        "{error}"
    );
}

#[test]
fn slide_that_is_none() {
    let scene = drag_scene();
    let mut frames = drag(false);
    for contact in frames.iter_mut().flat_map(|frame| &mut frame.contacts) {
        contact.sliding = Some(0);
    }
    frames[2].contacts[1].sliding = Some(2);
    for format in FORMATS {
        let text = lines(format, &scene, &frames).join("\n");
        let error = judged(&scene, Evolution::Path, format, &text).expect_err("an error");
        let expected = "`sliding` of contact 1 is 2, allowed: -1, 0, 1";
        assert!(error.to_string().contains(expected), "{error}");
    }
}

#[test]
fn line_that_is_cut_in_half() {
    for format in FORMATS {
        for part in [2, 3, 5, 40] {
            let error = message(format, 9, |line| line[..line.len() / part].to_owned());
            assert!(error.contains("allowed: "), "{error}");
        }
    }
}

#[test]
fn what_is_wrong_in_a_line_is_reported_by_its_key_with_what_is_allowed() {
    #[rustfmt::skip]
    let cases = [
        ("jsonl", 4, "true", "1", &["expected a boolean", "near `held`"][..]),
        ("jsonl", 4, "\"pose\"", "\"pos\"", &["missing field `pose`"]),
        ("csv", 4, "true", "yes", &["`held` is \"yes\", allowed: true, false"]),
        ("jsonl", 3, "\"vertex\":1", "\"vertex\":4", &["the `vertex` of contact 1 is 4, allowed: 0 to 3"]),
        ("csv", 3, ",0,floor", ",-1,floor", &["\"-1\", allowed: a whole number"]),
        ("csv", 0, "pose_theta", "theta", &["the header has no column `pose_theta`, allowed: t, "]),
    ];
    for (format, line, from, to, expected) in cases {
        let error = message(format, line, |line| line.replacen(from, to, 1));
        assert!(expected.iter().all(|part| error.contains(part)), "{error}");
    }
}

#[test]
fn trace_that_is_not_there_or_not_a_trace() {
    let scene = drag_scene();
    for (name, expected) in [
        ("absent.jsonl", "absent.jsonl: cannot be read"),
        (
            "trace.txt",
            "trace.txt: allowed: a trace whose name ends in .jsonl or .csv",
        ),
    ] {
        let error = stiction_judge::Trace::open(Path::new(name), &scene).err();
        let error = error.expect("an error").to_string();
        assert!(error.contains(expected), "{error}");
    }
}

/// The reader and the numbers that it refuses are those of `stiction run`; only the body may start inside something.
#[test]
fn scene_that_is_none_is_refused_with_key_and_line() {
    let changed = |from: &str, to: &str| {
        let text = SCENE.replacen(from, to, 1);
        assert_ne!(text, SCENE);
        Scene::parse(Source::new("scene.toml", text))
    };
    for (from, to, expected) in [
        (
            "start = [0.0, 0.0, 0.0]",
            "",
            "scene.toml, line 3: missing field `start`",
        ),
        (
            "translation = 500.0",
            "translation = 0.0",
            "line 2: `spring.translation` is 0.0, allowed: ",
        ),
        (
            "[[surface]]\nname = \"wall\"",
            "[[obstacle]]\nvertices = [[2.0, 0.0], [3.0, 0.5], [3.0, 0.0]]\n[[surface]]\nname = \"wall\"",
            "line 17: `obstacle[0].vertices` is in clockwise order, allowed: ",
        ),
    ] {
        let error = changed(from, to).expect_err("an error").to_string();
        assert!(error.contains(expected), "{error}");
    }
    let sunk = changed("start = [0.0, 0.0,", "start = [0.0, -0.01,");
    assert_eq!(sunk.expect("a scene").start, [0.0, -0.01, 0.0]);
}
