//! Obstacles that cannot be used: the message names the key and the line, whether the reader or the solver refuses them.

use super::{Mistake, assert_refused};
use crate::common::{Folder, SCENE};

/// A table and a pin, for [`SCENE`].
const OBSTACLES: &str = r#"
[[obstacle]]
name = "table"
vertices = [[0.4, 0.0], [0.6, 0.0], [0.6, 0.1], [0.4, 0.1]]
static = 0.6
dynamic = 0.4

[[obstacle]]
name = "pin"
vertices = [[0.0, 0.5]]
"#;

/// Mistakes in [`OBSTACLES`], which begin in line 35.
#[rustfmt::skip]
const IN_OBSTACLES: &[Mistake] = &[
    ("unknown key", "static = 0.6", "statik = 0.6", &["line 39", "unknown key `statik`, did you mean `static`?", "static"]),
    ("vertices missing", "vertices = [[0.0, 0.5]]", "", &["line 42", "missing field `vertices`"]),
    ("dynamic above the static one of all", "static = 0.6\ndynamic = 0.4", "dynamic = 0.7", &["line 16", "`friction.static` is 0.5", "not less than the dynamic friction"]),
    ("text for vertices", "[[0.0, 0.5]]", "\"up\"", &["line 44", "`obstacle[1].vertices` is string \"up\", allowed: an array"]),
    ("number for a corner", "[[0.0, 0.5]]", "[0.0, 0.5]", &["line 44", "`obstacle[1].vertices[0]` is floating point `0.0`, allowed: an array"]),
    ("text for a friction", "static = 0.6", "static = \"high\"", &["line 39", "`obstacle[0].static` is string \"high\", allowed: a number"]),
    ("number for a name", "\"pin\"", "1", &["line 43", "`obstacle[1].name` is integer `1`, allowed: a text"]),
    ("corner of three numbers", "[0.0, 0.5]", "[0.0, 0.5, 0.0]", &["line 44", "obstacle[1].vertices[0]", "2 numbers, x and y"]),
    ("no corners", "[[0.0, 0.5]]", "[]", &["line 44", "`obstacle[1].vertices` is empty, allowed: at least one corner"]),
    ("nan in a corner", "[0.6, 0.1]", "[0.6, nan]", &["line 38", "obstacle[0].vertices[2]", "NaN"]),
    ("corner beyond f32", "[0.6, 0.1]", "[0.6, 1e300]", &["line 38", "obstacle[0].vertices[2]", "1e300", "3.40e38"]),
    ("name twice", "\"pin\"", "\"table\"", &["line 43", "`obstacle[1].name` is \"table\", as that of obstacle 0, allowed: a name of its own"]),
    ("name of a surface", "\"pin\"", "\"floor\"", &["line 43", "`obstacle[1].name` is \"floor\", as that of surface 0, allowed: a name of its own"]),
    ("negative friction", "dynamic = 0.4", "dynamic = -0.4", &["line 40", "obstacle[0].dynamic", "-0.4", "0 or more"]),
    ("negative memory", "dynamic = 0.4", "dynamic = 0.4\nmemory = -1.0", &["line 41", "obstacle[0].memory", "-1.0", "0 or more"]),
    ("obstacle as one table", "[[obstacle]]", "[obstacle]", &["obstacle"]),
    // What the solver refuses.
    ("dynamic above static", "static = 0.6", "static = 0.2", &["line 39", "`obstacle[0].static` is 0.2", "not less than the dynamic friction"]),
    ("dynamic above that of all", "dynamic = 0.4", "dynamic = 0.7", &["line 39", "`obstacle[0].static` is 0.6", "not less than the dynamic friction"]),
    ("clockwise", "[[0.4, 0.0], [0.6, 0.0], [0.6, 0.1]", "[[0.6, 0.1], [0.6, 0.0], [0.4, 0.0]", &["line 38", "`obstacle[0].vertices` is in clockwise order, allowed: counter-clockwise"]),
    ("dent", "[0.6, 0.1]", "[0.45, 0.02]", &["line 38", "`obstacle[0].vertices[2]` is in a dent, allowed: a convex polygon"]),
    ("corner twice", "[0.6, 0.1]", "[0.6, 0.0]", &["line 38", "`obstacle[0].vertices[2]` is at the place of `obstacle[0].vertices[1]`", "a place of its own"]),
    ("short side", "[0.6, 0.1]", "[0.6, 0.0999999], [0.5999999, 0.1]", &["line 38", "`obstacle[0].vertices[2]` begins a side of", "at least 2^-16 body sizes"]),
    ("start within", "[[0.4, 0.0], [0.6, 0.0], [0.6, 0.1], [0.4, 0.1]]", "[[0.1, 0.1], [0.3, 0.1], [0.3, 0.2], [0.1, 0.2]]", &["line 4", "`body.start` puts the body", "inside obstacle \"table\""]),
];

#[test]
fn mistakes_in_obstacles_are_refused() {
    let sound = format!("{SCENE}{OBSTACLES}");
    let folder = Folder::new();
    assert_eq!(folder.trace(&sound, "").len(), 11);
    for &(name, from, to, expected) in IN_OBSTACLES {
        assert!(OBSTACLES.contains(from), "{name}");
        let folder = Folder::new();
        let obstacles = OBSTACLES.replacen(from, to, 1);
        folder.write("scene.toml", format!("{SCENE}{obstacles}"));
        for number in ["f32", "fixed"] {
            assert_refused(name, &folder, &format!("--number {number}"), expected);
        }
    }
}

#[test]
fn more_obstacles_or_corners_than_there_is_room_for_are_refused() {
    let folder = Folder::new();
    let pins: String = (0..33)
        .map(|k| format!("[[obstacle]]\nvertices = [[0.1, {k}.5]]\nname = \"p{k}\"\n"))
        .collect();
    folder.write("scene.toml", format!("{SCENE}\n{pins}"));
    let expected = ["line 132", "`obstacle` is given 33 times, allowed: 0 to 32"];
    assert_refused("obstacles", &folder, "", &expected);
    let box_at = |k: i32| {
        format!("[[0.1, {k}.5], [0.2, {k}.5], [0.2, {k}.6], [0.15, {k}.65], [0.1, {k}.6]]")
    };
    let boxes: String = (0..26)
        .map(|k| format!("[[obstacle]]\nvertices = {}\nname = \"b{k}\"\n", box_at(k)))
        .collect();
    folder.write("scene.toml", format!("{SCENE}\n{boxes}"));
    let expected = [
        "line 111",
        "`obstacle` is given with 130 corners in all, allowed: at most 128",
    ];
    assert_refused("corners", &folder, "", &expected);
}
