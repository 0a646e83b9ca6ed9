//! Contacts with obstacles in traces: what is accepted, and what is refused, with a message that names it and what is allowed.

use stiction_judge::{Bounds, Contact, Evolution, Frame, Judge, Scene, Source, State, Touch, law};

use crate::drag::SCENE;
use crate::write::{FORMATS, corner, frame, judged, lines, side};

const OBSTACLES: &str = r#"
[[obstacle]]
name = "step"
vertices = [[1.0, 0.0], [2.0, 0.0], [2.0, 0.5]]
static = 0.8
dynamic = 0.6
memory = 0.001

[[obstacle]]
vertices = [[3.0, 1.0]]

[[obstacle]]
name = "fence"
vertices = [[3.0, 2.0], [4.0, 2.0]]
"#;

fn text() -> String {
    format!("{SCENE}{OBSTACLES}")
}

fn scene() -> Scene {
    Scene::parse(Source::new("scene.toml", text())).expect("a sound scene")
}

fn touching(touch: Touch) -> Frame {
    let contact = Contact {
        touch,
        point: [0.0, 0.0],
        direction: Some([0.0, 1.0]),
        normal: 1.0,
        friction: 0.0,
        sliding: Some(0),
    };
    Frame {
        state: State::SingleVertex,
        contacts: vec![contact],
        ..frame(0.0, [0.0; 3], [0.0; 3])
    }
}

/// The message about a contact in one format after a change.
fn message(format: &str, touch: Touch, from: &str, to: &str) -> String {
    let line = lines(format, &scene(), &[touching(touch)]).join("\n");
    let changed = line.replacen(from, to, 1);
    assert_ne!(changed, line);
    let error = judged(&scene(), Evolution::Path, format, &changed).expect_err("an error");
    error.to_string()
}

const SIDE: Touch = side(1, 2, 1);
const CORNER: Touch = corner(1, 0, 3);

#[test]
fn contacts_that_cannot_be_are_refused() {
    for (touch, from, to, expected) in [
        (
            SIDE,
            r#""fence""#,
            r#""pence""#,
            "the `obstacle` of contact 0 is \"pence\", allowed: step, 1, fence",
        ),
        (
            SIDE,
            r#""side":1"#,
            r#""side":2"#,
            "the `side` of contact 0 is 2, allowed: 0 to 1",
        ),
        (
            SIDE,
            r#""fence""#,
            r#""1""#,
            "the `side` of contact 0 is 1, but there is none",
        ),
        (
            CORNER,
            r#""corner":0"#,
            r#""corner":1"#,
            "the `corner` of contact 0 is 1, allowed: 0 to 0",
        ),
        (
            CORNER,
            r#""body_side":3"#,
            r#""body_side":4"#,
            "the `body_side` of contact 0 is 4, allowed: 0 to 3",
        ),
        (
            CORNER,
            r#""corner":0,"#,
            "",
            "contact 0: allowed: `vertex` and `surface`",
        ),
        (
            SIDE,
            r#""side":1"#,
            r#""side":1,"corner":1"#,
            "contact 0: allowed: ",
        ),
    ] {
        let error = message("jsonl", touch, from, to);
        assert!(error.contains(expected), "{error}");
    }
    let error = message("csv", SIDE, ",1,,fence,1,,,", ",1,,fence,9,,,");
    assert!(
        error.contains("the `side` of contact 0 is 9, allowed: 0 to 1"),
        "{error}"
    );
    let error = message("csv", CORNER, ",,,1,,0,3,", ",,floor,1,,0,3,");
    assert!(error.contains("contact 0: allowed: "), "{error}");
}

/// A contact without a vertex is read in a row as it is in a line.
#[test]
fn contacts_with_obstacles_are_read_in_both_formats() {
    for touch in [SIDE, CORNER] {
        let laws = FORMATS.map(|format| {
            let text = lines(format, &scene(), &[touching(touch)]).join("\n");
            let survey = judged(&scene(), Evolution::Path, format, &text).expect("a trace");
            let laws = survey.laws.into_iter();
            laws.map(|(name, law)| (name, law.worst.0.residual))
                .collect::<Vec<_>>()
        });
        assert_eq!(laws[0], laws[1]);
        assert!(laws[0].iter().any(|(name, _)| *name == law::ON_SIDE));
    }
}

/// Frames that do not come from a file may refer to any feature.
#[test]
fn contact_of_what_there_is_not_is_found() {
    let side_of_a_pin = side(0, 1, 0);
    let no_vertex = Touch::Surface {
        vertex: 4,
        surface: 0,
    };
    for touch in [side_of_a_pin, no_vertex] {
        let judge = Judge::new(scene(), Bounds::DOUBLE, Evolution::Path);
        for findings in [
            judge.clone().next(touching(touch)),
            judge.alone(&touching(touch)),
        ] {
            let broken = findings.iter().filter(|finding| !finding.holds());
            let laws: Vec<_> = broken.map(|finding| finding.law).collect();
            assert_eq!(laws, [law::EXISTS]);
        }
    }
}
