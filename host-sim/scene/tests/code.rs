//! A scene file as the code of a board: its numbers keep their bits, its solver has what the scene needs, and unusable input
//! is reported with file, line and key.

use std::fs;
use std::path::{Path, PathBuf};

use stiction_scene::{NumberType, SceneModel, code};
use tempfile::TempDir;

const ROD: &str = r#"[body]
vertices = [[-0.1, 0.0], [0.1, 0.0]]
start = [0.0, 0.5, 0.0]
weight = 2.0

[spring]
translation = 500.0
rotation = 0.5

[[surface]]
name = "floor"
normal = [0.0, 1.0]
offset = 0.0
static = 0.5
dynamic = 0.3
"#;

/// A folder with the rod's scene file, changed.
fn changed(from: &str, to: &str) -> (TempDir, PathBuf) {
    assert!(ROD.contains(from), "{from}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rod.toml");
    fs::write(&file, ROD.replacen(from, to, 1)).unwrap();
    (folder, file)
}

fn code_with(from: &str, to: &str) -> String {
    let (_folder, file) = changed(from, to);
    code(&file, NumberType::F32, None).unwrap()
}

#[test]
fn the_solver_has_what_the_scene_needs() {
    let pin = "dynamic = 0.3\n[[obstacle]]\nvertices = [[1.0, 1.0]]\nstatic = 0.5\ndynamic = 0.3\n";
    for ((from, to), expected) in [
        (("", ""), "Scene<f32, 2, 1, 0>"),
        (
            ("[-0.1, 0.0], [0.1, 0.0]", "[0.0, 0.0]"),
            "Scene<f32, 1, 1, 0>",
        ),
        (("dynamic = 0.3\n", pin), "Scene<f32, 2, 1, 1>"),
    ] {
        let code = code_with(from, to);
        assert!(code.contains(expected), "{expected}: {code}");
    }
}

#[test]
fn a_solver_for_other_scenes_too_has_at_least_what_it_is_given() {
    let (_folder, file) = changed("", "");
    for (vertices, surfaces, expected) in [(8, 4, "Fixed, 8, 4"), (1, 0, "Fixed, 2, 1")] {
        let room = SceneModel {
            vertices,
            surfaces,
            corners: 0,
        };
        let code = code(&file, NumberType::Fixed, Some(room)).unwrap();
        let expected = format!("{expected}, 0>");
        assert!(code.contains(&expected), "{expected}: {code}");
    }
}

#[test]
fn numbers_are_those_that_the_solver_of_a_computer_gets() {
    // An f64 halfway between two f32, so that it is rounded to the even one, 1; its decimals are slightly above the middle.
    let halfway = 1.000_000_059_604_644_8_f64;
    assert_eq!(
        (halfway as f32, "1.0000000596046448".parse()),
        (1.0, Ok(1.000_000_1_f32))
    );
    let code = code_with("offset = 0.0", "offset = -1.0000000596046448");
    assert!(code.contains("offset: -1.0,"), "{code}");
    // f32 has 9 digits.
    let code = code_with("500.0", "333.33333333333331");
    assert!(code.contains("stiffness_translation: 333.33334,"), "{code}");
}

#[test]
fn a_memory_length_is_that_of_the_file_or_none() {
    let dynamic = "dynamic = 0.3\n";
    for (to, expected) in [
        (dynamic, "memory: None"),
        ("dynamic = 0.3\nmemory = 3e-5\n", "memory: Some(3e-5)"),
        (
            "dynamic = 0.3\n[friction]\nmemory = 0.0\n",
            "memory: Some(0.0)",
        ),
    ] {
        let code = code_with(dynamic, to);
        assert!(code.contains(expected), "{expected}: {code}");
    }
}

#[test]
fn what_cannot_be_used_is_reported_with_file_line_and_key() {
    for (from, to, expected) in [
        (
            "500.0",
            "-500.0",
            ", line 7: `spring.translation` is -500.0, allowed: more than 0\n     7 | translation = -500.0",
        ),
        (
            "weight",
            "wieght",
            ", line 4: unknown key `wieght`, did you mean `weight`?",
        ),
        (
            "500.0",
            "1e300",
            ", line 7: `spring.translation` is 1e300, allowed: finite numbers up to 3.40e38",
        ),
        (
            "dynamic = 0.3",
            "memory = -1e-5\ndynamic = 0.3",
            ", line 15: `surface[0].memory` is -1e-5, allowed: 0 or more\n    15 | memory = -1e-5",
        ),
        (
            "0.5, 0.0]",
            "-0.5, 0.0]",
            ", line 3: `body.start` puts vertex 0 5.000e-1 m inside surface \"floor\"",
        ),
    ] {
        let (_folder, file) = changed(from, to);
        let message = code(&file, NumberType::F32, None).unwrap_err().to_string();
        let expected = format!("{}{expected}", file.display());
        assert!(message.starts_with(&expected), "{expected}\n{message}");
    }
    let message = code(Path::new("absent.toml"), NumberType::F32, None).unwrap_err();
    assert!(
        message
            .to_string()
            .starts_with("absent.toml: cannot be read: ")
    );
}

#[test]
fn a_scene_beyond_the_number_type_of_the_board_is_refused() {
    let (_folder, file) = changed("rotation = 0.5", "rotation = 500000.0");
    assert!(code(&file, NumberType::F32, None).is_ok());
    let message = code(&file, NumberType::Fixed, None)
        .unwrap_err()
        .to_string();
    assert!(message.contains("line 8: `spring.rotation`"), "{message}");
}
