//! Input that cannot be used: exit status 2, a message that names the key, column or line, and no output file.

#[cfg(target_os = "linux")]
mod hostile;
mod obstacles;

use std::fs;

use crate::common::{Folder, SCENE, VERTICES, assert_error, said, scene_with_path, text};
use stiction_scene::NumberType;

/// A scene file with one mistake: its name, the text that is replaced, by what, and what the message must hold.
type Mistake = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
);

#[rustfmt::skip]
const IN_SCENES: &[Mistake] = &[
    // Syntax, sections, keys, types.
    ("not TOML", "[body]", "[body", &["line 2"]),
    ("empty file", SCENE, "", &["scene.toml", "body"]),
    ("unknown section", "[grasp]", "[grip]", &["line 7", "grip"]),
    ("unknown key", "weight", "wieght", &["line 5", "wieght", "weight"]),
    ("unknown key of a surface", "name = \"wall\"", "nome = \"wall\"", &["nome", "name"]),
    ("key twice", "weight = 0.0", "weight = 0.0\nweight = 1.0", &["line 6", "duplicate key"]),
    ("body missing", "[body]", "[grasp]", &["grasp"]),
    ("spring missing", "[spring]\ntranslation = 500.0\nrotation = 0.5\n", "", &["missing field `spring`"]),
    ("start missing", "start = [0.2, 0.12, 0.5]", "", &["line 2", "start"]),
    ("stiffness missing", "translation = 500.0", "", &["line 11", "translation"]),
    ("offset missing", "normal = [1.0, 0.0]\noffset = 0.0", "normal = [1.0, 0.0]", &["offset"]),
    ("friction missing", "[friction]\nstatic = 0.5\ndynamic = 0.3\n", "", &["surface 0", "static", "[friction]"]),
    ("dynamic friction missing", "dynamic = 0.3\n", "", &["surface 0", "dynamic"]),
    ("text for a number", "500.0", "\"500\"", &["line 12", "`spring.translation` is string \"500\", allowed: a number"]),
    ("number for a text", "\"floor\"", "1", &["line 20", "`surface[0].name` is integer `1`, allowed: a text"]),
    ("table for an array", "[0.2, 0.12, 0.5]", "{ x = 0.2 }", &["line 4", "`body.start` is map, allowed: an array"]),
    ("boolean for a number", "reach = 0.01", "reach = true", &["line 9", "`grasp.reach` is boolean `true`, allowed: a number"]),
    ("text for a friction", "static = 0.5", "static = \"high\"", &["line 16", "`friction.static` is string \"high\", allowed: a number"]),
    ("text in an array", "[0.05, 0.03]", "[0.05, \"up\"]", &["line 3", "`body.vertices[2][1]` is string \"up\", allowed: a number"]),
    // The body.
    ("start of two numbers", "[0.2, 0.12, 0.5]\nweight", "[0.2, 0.12]\nweight", &["body.start", "3 numbers"]),
    ("vertex of three numbers", "[0.05, 0.03]", "[0.05, 0.03, 0.0]", &["body.vertices[2]", "2 numbers"]),
    ("vertices and rectangle", "weight", "rectangle = [0.1, 0.06]\nweight", &["line 5", "body.rectangle"]),
    ("neither vertices nor rectangle", "vertices = [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]]", "", &["vertices", "rectangle"]),
    ("flat rectangle", "vertices = [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]]", "rectangle = [0.1, 0.0]", &["body.rectangle", "more than 0"]),
    ("no vertices", "[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]]", "[]", &["line 3", "body.vertices"]),
    ("clockwise vertices", "[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03]", "[[0.05, 0.03], [0.05, -0.03], [-0.05, -0.03]", &["line 3", "`body.vertices` is in clockwise order, allowed: counter-clockwise", "`body.repair = true`"]),
    ("dent", "[0.05, 0.03]", "[-0.03, -0.02]", &["line 3", "`body.vertices[2]` is in a dent, allowed: a convex polygon", "`body.repair = true`"]),
    ("three vertices in line", "[0.05, -0.03], [0.05, 0.03]", "[0.05, -0.03], [0.05, 0.0], [0.05, 0.03]", &["line 3", "`body.vertices[2]` is in line with the corners before and after it", "strictly convex", "`body.repair = true`"]),
    ("bow-tie", "[0.05, -0.03], [0.05, 0.03]", "[0.05, 0.03], [0.05, -0.03]", &["line 3", "the sides that begin at `body.vertices[0]` and at `body.vertices[2]` cross", "`body.repair = true`"]),
    ("vertex twice", "[0.05, 0.03]", "[0.05, -0.03]", &["`body.vertices[2]` is at the place of `body.vertices[1]`", "`body.repair = true`"]),
    ("repair neither true nor false", "weight = 0.0", "repair = 1", &["line 5", "body.repair", "boolean"]),
    ("nan in a vertex", "[0.05, 0.03]", "[nan, 0.03]", &["body.vertices[2]", "NaN"]),
    ("inf at the start", "[0.2, 0.12, 0.5]\nweight", "[0.2, inf, 0.5]\nweight", &["body.start", "inf"]),
    ("negative weight", "weight = 0.0", "weight = -1.0", &["line 5", "body.weight", "-1.0"]),
    ("nan weight", "weight = 0.0", "weight = nan", &["line 5", "body.weight", "NaN"]),
    ("weight beyond f32", "weight = 0.0", "weight = 1e300", &["line 5", "body.weight", "1e300", "3.40e38"]),
    ("start within a surface", "[0.2, 0.12, 0.5]\nweight", "[0.2, 0.01, 0.5]\nweight", &["line 4", "body.start", "floor"]),
    ("start far away", "[0.2, 0.12, 0.5]\nweight", "[0.2, 1e30, 0.5]\nweight", &["line 4", "body.start"]),
    // Grasp, springs, friction, surfaces.
    ("holding point of one number", "point = [0.0, 0.02]", "point = [0.0]", &["grasp.point", "2 numbers"]),
    ("negative reach", "reach = 0.01", "reach = -0.01", &["line 9", "grasp.reach", "-0.01"]),
    ("stiffness 0", "500.0", "0.0", &["line 12", "spring.translation", "more than 0"]),
    ("negative stiffness", "500.0", "-500.0", &["line 12", "spring.translation", "-500.0"]),
    ("infinite stiffness", "500.0", "inf", &["line 12", "spring.translation", "inf"]),
    ("stiffness beyond f32", "500.0", "1e300", &["line 12", "spring.translation", "1e300"]),
    ("stiffness below f32", "500.0", "1e-300", &["line 12", "spring.translation", "1e-300"]),
    ("negative rotational stiffness", "rotation = 0.5", "rotation = -0.5", &["line 13", "spring.rotation", "-0.5"]),
    ("dynamic above static", "static = 0.5", "static = 0.2", &["line 16", "friction.static", "0.2"]),
    ("negative friction", "dynamic = 0.3", "dynamic = -0.3", &["line 17", "friction.dynamic", "-0.3"]),
    ("nan friction", "static = 0.5", "static = nan", &["friction.static", "NaN"]),
    ("negative memory", "dynamic = 0.3", "dynamic = 0.3\nmemory = -1e-5", &["line 18", "friction.memory", "-1e-5", "0 or more"]),
    ("infinite memory", "dynamic = 0.3", "dynamic = 0.3\nmemory = inf", &["line 18", "friction.memory", "inf", "finite"]),
    ("negative memory of a surface", "name = \"wall\"", "name = \"wall\"\nmemory = -1.0", &["surface[1].memory", "-1.0", "0 or more"]),
    ("memory that is no number", "dynamic = 0.3", "dynamic = 0.3\nmemory = \"short\"", &["line 18", "friction.memory", "a number"]),
    ("dynamic above static on a surface", "name = \"wall\"", "name = \"wall\"\ndynamic = 0.6", &["friction.static", "line 16"]),
    ("negative friction of a surface", "name = \"wall\"", "name = \"wall\"\nstatic = -0.6", &["surface[1].static", "-0.6"]),
    ("zero normal", "[1.0, 0.0]", "[0.0, 0.0]", &["line 26", "surface[1].normal", "0.0"]),
    ("nan normal", "[1.0, 0.0]", "[nan, 0.0]", &["surface[1].normal", "NaN"]),
    ("normal of three numbers", "[1.0, 0.0]", "[1.0, 0.0, 0.0]", &["surface[1].normal", "2 numbers"]),
    ("infinite offset", "[1.0, 0.0]\noffset = 0.0", "[1.0, 0.0]\noffset = -inf", &["surface[1].offset", "-inf"]),
    ("name twice", "\"wall\"", "\"floor\"", &["line 25", "surface[1].name", "floor"]),
    ("name of an unnamed surface", "name = \"floor\"\nnormal = [0.0, 1.0]\noffset = 0.0\n\n[[surface]]\nname = \"wall\"", "normal = [0.0, 1.0]\noffset = 0.0\n\n[[surface]]\nname = \"0\"", &["surface[1].name"]),
    ("surface as one table", "[[surface]]\nname = \"floor\"\nnormal = [0.0, 1.0]\noffset = 0.0\n\n[[surface]]", "[surface]", &["surface"]),
    // The hand.
    ("neither keyframes nor path", "keyframes = [\n  [0.0, 0.2, 0.14, 0.5],\n  [1.0, 0.2, 0.06, 0.5],\n]", "", &["keyframes", "path"]),
    ("keyframes and path", "rate = 10.0", "rate = 10.0\npath = \"hand.csv\"", &["hand.path", "hand.keyframes"]),
    ("path without a name", "keyframes = [\n  [0.0, 0.2, 0.14, 0.5],\n  [1.0, 0.2, 0.06, 0.5],\n]", "path = \"\"", &["hand.path"]),
    ("path not there", "keyframes = [\n  [0.0, 0.2, 0.14, 0.5],\n  [1.0, 0.2, 0.06, 0.5],\n]", "path = \"absent.csv\"", &["absent.csv"]),
    ("no keyframes", "keyframes = [\n  [0.0, 0.2, 0.14, 0.5],\n  [1.0, 0.2, 0.06, 0.5],\n]", "keyframes = []", &["hand.keyframes"]),
    ("no rate", "rate = 10.0\n", "", &["rate"]),
    ("rate 0", "rate = 10.0", "rate = 0.0", &["line 30", "hand.rate", "more than 0"]),
    ("negative rate", "rate = 10.0", "rate = -10.0", &["line 30", "hand.rate", "-10.0"]),
    ("nan rate", "rate = 10.0", "rate = nan", &["line 30", "hand.rate", "NaN"]),
    ("too many frames", "rate = 10.0", "rate = 1e12", &["line 30", "1000000000000.0 Hz of `hand.rate` and a path of 1.0 s give 1000000000001 frames", "allowed: at most 1000000000"]),
    ("keyframe of three numbers", "[1.0, 0.2, 0.06, 0.5]", "[1.0, 0.2, 0.06]", &["line 33", "hand.keyframes[1]", "4 numbers"]),
    ("keyframe of six numbers", "[1.0, 0.2, 0.06, 0.5]", "[1.0, 0.2, 0.06, 0.5, 1, 1]", &["line 33", "hand.keyframes[1]"]),
    ("held neither 0 nor 1", "0.06, 0.5]", "0.06, 0.5, 0.5]", &["line 33", "hand.keyframes[1]", "held"]),
    ("nan in a keyframe", "[1.0, 0.2, 0.06,", "[1.0, nan, 0.06,", &["line 33", "hand.keyframes[1]", "NaN"]),
    ("inf in a keyframe", "[1.0, 0.2, 0.06,", "[1.0, 0.2, inf,", &["line 33", "hand.keyframes[1]", "inf"]),
    ("keyframe beyond f32", "[1.0, 0.2, 0.06,", "[1.0, 1e300, 0.06,", &["line 33", "hand.keyframes[1]", "1e300"]),
    ("angle out of range", "0.06, 0.5]", "0.06, 1e20]", &["line 33", "rad"]),
    ("keyframe times equal", "[1.0, 0.2, 0.06,", "[0.0, 0.2, 0.06,", &["line 33", "hand.keyframes[1]", "later"]),
    ("keyframe times decreasing", "[1.0, 0.2, 0.06,", "[-1.0, 0.2, 0.06,", &["line 33", "hand.keyframes[1]", "later"]),
    ("plane of one axis twice", "rate = 10.0", "rate = 10.0\nplane = \"xx\"", &["line 31", "hand.plane", "xx"]),
    ("plane of no axis", "rate = 10.0", "rate = 10.0\nplane = \"xw\"", &["line 31", "hand.plane", "xw"]),
    ("plane of three axes", "rate = 10.0", "rate = 10.0\nplane = \"xyz\"", &["line 31", "hand.plane", "xyz"]),
    ("plane with two minuses", "rate = 10.0", "rate = 10.0\nplane = \"--xy\"", &["line 31", "hand.plane"]),
    ("scale 0", "rate = 10.0", "rate = 10.0\nscale = 0.0", &["line 31", "hand.scale"]),
    ("nan scale", "rate = 10.0", "rate = 10.0\nscale = nan", &["line 31", "hand.scale", "NaN"]),
    ("scale beyond the range", "rate = 10.0", "rate = 10.0\nscale = 3e38\norigin = [3e38, 0.0, 0.0]", &["line 34", "range"]),
    ("angle in an unknown unit", "rate = 10.0", "rate = 10.0\nangle = \"grad\"", &["line 31", "hand.angle", "grad", "\"radians\" or \"degrees\""]),
    ("unwrap neither true nor false", "rate = 10.0", "rate = 10.0\nunwrap = \"yes\"", &["line 31", "hand.unwrap", "boolean"]),
    ("origin of two numbers", "rate = 10.0", "rate = 10.0\norigin = [0.0, 0.0]", &["line 31", "hand.origin", "3 numbers"]),
];

/// A recorded path with a mistake: its name, the file's name, its content, and what the message must hold.
type BadPath = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
);

#[rustfmt::skip]
const IN_PATHS: &[BadPath] = &[
    ("empty file", "hand.csv", "", &["hand.csv", "empty"]),
    ("header alone", "hand.csv", "t,x,y,phi\n", &["hand.csv", "record"]),
    ("no header", "hand.csv", "0,0,0.14,0\n", &["line 1", "header", "t,x,y,phi"]),
    ("unknown header", "hand.csv", "t,x,y,angle\n0,0,0.14,0\n", &["line 1", "header"]),
    ("header of three columns", "hand.csv", "t,x,y\n0,0,0.14\n", &["line 1", "header"]),
    ("short row", "hand.csv", "t,x,y,phi\n0,0,0.14,0\n1,0,0.14\n", &["line 3", "3 values", "4"]),
    ("long row", "hand.csv", "t,x,y,phi\n0,0,0.14,0,1\n", &["line 2", "5 values"]),
    ("text for a number", "hand.csv", "t,x,y,phi\n0,0,zero,0\n", &["line 2", "`y`", "zero"]),
    ("no pose in the first record", "hand.csv", "t,x,y,phi\n0,,0.14,0\n", &["line 2", "first pose", "no value"]),
    ("no time", "hand.csv", "t,x,y,phi\n0,0,0.14,0\n,0,0.14,0\n", &["line 3", "`t` is \"\""]),
    ("no phi", "hand.csv", "t,x,y,roll\n0,0,0.14,0\n", &["line 1", "the header has no `phi`"]),
    ("a comment is no header", "hand.csv", "#a,b\n0,0,0.14,0\n", &["line 2", "the header is not known", "line 1 begins with # and was skipped"]),
    ("two hands", "hand.csv", "t,left_pos_x,right_pos_x,pos_y,phi\n0,0,0,0.14,0\n", &["line 1", "`x` twice", "left_pos_x", "right_pos_x"]),
    ("unknown unit", "hand.csv", "t,x [inch],y,phi\n0,0,0.14,0\n", &["line 1", "x [inch]", "m, cm, mm"]),
    ("held neither 0 nor 1", "hand.csv", "t,x,y,phi,held\n0,0,0.14,0,2\n", &["line 2", "`held` is 2.0, allowed: 0 or 1"]),
    ("held a word", "hand.csv", "t,x,y,phi,held\n0,0,0.14,0,yes\n", &["line 2", "`held` is \"yes\", allowed: 0 or 1"]),
    ("held nan", "hand.csv", "t,x,y,phi,held\n0,0,0.14,0,nan\n", &["line 2", "`held`"]),
    ("times equal", "hand.csv", "t,x,y,phi\n0,0,0.14,0\n0,0,0.14,0\n", &["line 3", "`t`"]),
    ("times decreasing", "hand.csv", "t,x,y,phi\n\n2,0,0.14,0\n# back\n1,0,0.14,0\n", &["line 5", "`t`"]),
    ("time not finite", "hand.csv", "t,x,y,phi\n0,0,0.14,0\nnan,0,0.14,0\n", &["line 3", "`t`", "NaN"]),
    ("first pose not finite", "hand.csv", "t,x,y,phi\n0,nan,0.14,0\n1,0,0.14,0\n", &["line 2", "first"]),
    ("pose beyond f32", "hand.csv", "t,x,y,phi\n0,0,0.14,0\n1,1e300,0.14,0\n", &["line 3", "range"]),
    ("quaternion 0", "hand.csv", "t,x,y,z,qx,qy,qz,qw\n0,0,0.14,0,0,0,0,0\n", &["line 2", "quaternion"]),
    ("empty TUM file", "hand.tum", "# nothing\n", &["hand.tum", "record"]),
    ("short TUM row", "hand.tum", "0 0 0.14 0 0 0 0 1\n1 0 0.14 0 0 0 0\n", &["line 2", "7 values", "8"]),
    ("text in a TUM row", "hand.txt", "0 0 0.14 zero 0 0 0 1\n", &["line 1", "`z`", "zero"]),
    ("TUM quaternion 0", "hand.txt", "# t\n0 0 0.14 0 0 0 0 0\n", &["line 2", "quaternion"]),
    ("unknown extension", "hand.dat", "0 0 0.14 0\n", &["hand.dat", "csv"]),
    ("no extension", "hand", "0 0 0.14 0\n", &["hand", "csv"]),
];

/// Runs the scene in the folder: status 2, the message holds `expected`, and nothing is written.
fn assert_refused(name: &str, folder: &Folder, options: &str, expected: &[&str]) {
    folder.write("trace.jsonl", "the trace of before");
    let before = folder.names();
    let output = folder.stiction(&format!("run scene.toml --out trace.jsonl {options}"));
    assert_error(name, &output, expected);
    let all = said(&output);
    assert!(
        output.stdout.is_empty() && !all.contains("panicked"),
        "{name}: {all}"
    );
    assert_eq!(folder.read("trace.jsonl"), "the trace of before", "{name}");
    assert_eq!(folder.names(), before, "{name}");
}

#[test]
fn mistakes_in_scene_files_are_refused() {
    for &(name, from, to, expected) in IN_SCENES {
        assert!(SCENE.contains(from), "{name}");
        let folder = Folder::new();
        folder.write("scene.toml", SCENE.replacen(from, to, 1));
        assert_refused(name, &folder, "", expected);
    }
}

/// The build of a board looks at all but the values of `[hand]`.
#[test]
fn mistakes_in_scene_files_are_refused_with_the_same_words_in_the_build_of_a_board() {
    let hand = SCENE.find("[hand]").unwrap();
    for &(name, from, to, _) in IN_SCENES {
        let folder = Folder::new();
        folder.write("scene.toml", SCENE.replacen(from, to, 1));
        let code = stiction_scene::code(&folder.file("scene.toml"), NumberType::F32, None);
        match code {
            Ok(_) => assert!(SCENE.find(from) > Some(hand), "{name}"),
            Err(error) => {
                let printed = text(&folder.stiction("run scene.toml").stderr);
                let words = error.to_string();
                let (_, words) = words.split_once("scene.toml").unwrap();
                assert!(printed.contains(words), "{name}: {words}\n{printed}");
            }
        }
    }
}

#[test]
fn scenes_beyond_the_range_of_fixed_point_are_refused_in_fixed_point_alone() {
    #[rustfmt::skip]
    let cases: &[(&str, &str, &[&str])] = &[
        ("[0.2, 0.12, 0.5]\nweight", "[0.2, 12.0, 0.5]\nweight", &["surface[0].offset", "at most 16 body sizes from where the body starts"]),
        ("normal = [1.0, 0.0]\noffset = 0.0", "normal = [1.0, 0.0]\noffset = -12.0", &["line 27", "surface[1].offset", "at most 16 body sizes"]),
        ("rotation = 0.5", "rotation = 5000.0", &["line 13", "spring.rotation", "at most 16 k_h L^2"]),
    ];
    for &(from, to, expected) in cases {
        assert!(SCENE.contains(from), "{from}");
        let folder = Folder::new();
        let scene = SCENE.replacen(from, to, 1);
        assert_eq!(folder.trace(&scene, "").len(), 11);
        assert_refused(to, &folder, "--number fixed", expected);
    }
}

#[test]
fn mistakes_in_recorded_paths_are_refused() {
    for &(name, file, content, expected) in IN_PATHS {
        let folder = Folder::new();
        folder.write("scene.toml", scene_with_path(file, ""));
        folder.write(file, content);
        assert_refused(name, &folder, "", expected);
    }
}

/// If a path is given separately from the scene, the message names the path.
#[test]
fn paths_that_last_too_long_for_the_rate_are_refused_with_their_last_line() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.write(
        "long.csv",
        "t,x,y,phi\n0,0.2,0.14,0.5\n1e12,0.2,0.14,0.5\n# the end\n",
    );
    for (rate, by) in [
        ("", "10.0 Hz of `hand.rate`"),
        ("--rate 5", "5.0 Hz of `--rate`"),
    ] {
        let options = format!("--hand long.csv {rate}");
        let end = "and a path of 1000000000000.0 s give ";
        let expected = ["long.csv, line 3: ", by, end, "at most 1000000000"];
        assert_refused(by, &folder, &options, &expected);
    }
}

#[test]
fn bytes_that_are_not_text_are_refused() {
    let folder = Folder::new();
    folder.write("scene.toml", b"[body]\nstart = \"\xff\"\n");
    assert_refused("scene", &folder, "", &["scene.toml", "line 2", "UTF-8"]);
    folder.write("scene.toml", scene_with_path("hand.csv", ""));
    folder.write("hand.csv", b"t,x,y,phi\n0,0,\xff,0\n");
    assert_refused("path", &folder, "", &["hand.csv", "line 2", "UTF-8"]);
}

#[test]
fn more_vertices_or_surfaces_than_there_is_room_for_are_refused() {
    let circle: Vec<String> = (0..65)
        .map(|k| f64::from(k) * std::f64::consts::TAU / 65.0)
        .map(|angle| format!("[{}, {}]", 0.05 * angle.cos(), 0.05 * angle.sin()))
        .collect();
    let folder = Folder::new();
    let vertices = format!("vertices = [{}]", circle.join(", "));
    folder.write("scene.toml", SCENE.replacen(VERTICES, &vertices, 1));
    let expected = [
        "line 3",
        "`body.vertices` is 65 vertices long, allowed: 1 to 64",
    ];
    assert_refused("vertices", &folder, "", &expected);
    let surfaces = "\n[[surface]]\nnormal = [0.0, 1.0]\noffset = -1.0\n".repeat(15);
    folder.write("scene.toml", format!("{SCENE}{surfaces}"));
    let expected = ["`surface` is given 17 times, allowed: 0 to 16"];
    assert_refused("surfaces", &folder, "", &expected);
}

#[test]
fn arguments_that_mean_nothing_are_refused() {
    #[rustfmt::skip]
    let cases: &[(&str, &[&str])] = &[
        ("--number f16", &["f16", "f32"]),
        ("--evolution time", &["time", "path", "frame"]),
        ("--rate 0", &["--rate", "0"]),
        ("--rate nan", &["--rate", "nan"]),
        ("--rate fast", &["--rate", "fast"]),
        ("--rate 1e12", &["1000000000000.0 Hz of `--rate` and a path of 1.0 s give 1000000000001 frames", "allowed: at most 1000000000"]),
        ("--tolerance 0.001", &["--tolerance"]),
        ("--events 8", &["--events"]),
        ("--budget 0", &["--budget", "1 to 4294967295"]),
        ("--budget 1.5", &["--budget", "whole number"]),
        ("--hand absent.csv", &["absent.csv"]),
        ("--speed 2", &["--speed"]),
    ];
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    for &(options, expected) in cases {
        assert_refused(options, &folder, options, expected);
    }
}

#[test]
fn places_where_nothing_can_be_written_are_refused() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    fs::create_dir(folder.file("folder.csv")).expect("a folder");
    for (out, expected) in [
        ("trace.txt", ".jsonl or .csv"),
        ("trace", ".jsonl or .csv"),
        ("absent/trace.jsonl", "absent/trace.jsonl"),
        ("folder.csv", "folder.csv"),
    ] {
        folder.refused(&format!("run scene.toml --out {out}"), &[expected]);
        assert_eq!(folder.names(), ["folder.csv", "scene.toml"], "{out}");
    }
}

#[test]
fn a_scene_that_is_not_there_is_refused_with_the_names_of_the_bundled_ones() {
    let folder = Folder::new();
    for command in ["run", "code"] {
        folder.refused(
            &format!("{command} absent.toml"),
            &["absent.toml", "ladder"],
        );
        folder.refused(command, &[]);
    }
}
