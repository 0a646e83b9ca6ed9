//! Text files that are too much of something, or that end in the middle.

use super::{NO_FILE, assert_refused, zeros};
use crate::common::{Folder, SCENE, VERTICES, scene_with_path};

/// The scene with something in the place of its vertices.
fn vertices(list: &str) -> String {
    SCENE.replacen(VERTICES, &format!("vertices = {list}"), 1)
}

/// The scene with something behind its surfaces.
fn behind(rest: &str) -> String {
    SCENE.replacen("[hand]", &format!("{rest}\n[hand]"), 1)
}

/// So many points on a line.
fn points(count: usize) -> String {
    (0..count).map(|k| format!("[0.{k},1],")).collect()
}

#[test]
fn scenes_made_to_harm_are_refused() {
    let many = |count: usize, section: &dyn Fn(usize) -> String| -> String {
        (0..count).map(section).collect()
    };
    let surface = |_: usize| "[[surface]]\nnormal=[0,1]\noffset=-9\n".to_owned();
    let pin = |k: usize| format!("[[obstacle]]\nvertices=[[{k},9]]\n");
    let keyframes = "[0,0,0,0],".repeat(50_000);
    let utf_16: Vec<u8> = (SCENE.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    #[rustfmt::skip]
    let cases: &[(&str, Vec<u8>, &[&str])] = &[
        ("20 000 vertices", vertices(&format!("[{}]", points(20_000))).into(), &["line 3", "20000 vertices long, allowed: 1 to 64"]),
        ("100 000 surfaces", behind(&many(100_000, &surface)).into(), &["bytes long, allowed: at most 1048576"]),
        ("20 000 surfaces", behind(&many(20_000, &surface)).into(), &["given 20002 times, allowed: 0 to 16"]),
        ("20 000 obstacles", behind(&many(20_000, &pin)).into(), &["given 20000 times, allowed: 0 to 32"]),
        ("obstacle of 20 000 corners", behind(&format!("[[obstacle]]\nvertices=[{}]\n", points(20_000))).into(), &["20000 corners in all, allowed: at most 128"]),
        ("50 000 keyframes at one time", SCENE.replace("keyframes = [", &format!("keyframes = [{keyframes}")).into(), &["hand.keyframes[1]", "later"]),
        ("arrays in arrays", vertices(&"[".repeat(500_000)).into(), &["scene.toml, line 3"]),
        ("tables in tables", SCENE.replacen("0.5\n", &("{a=".repeat(200_000) + "\n"), 1).into(), &["scene.toml, line"]),
        ("dotted key", ("a.".repeat(200_000) + "a = 1\n" + SCENE).into(), &["scene.toml"]),
        ("dotted section", (format!("[{}a]\n", "a.".repeat(200_000)) + SCENE).into(), &["scene.toml"]),
        ("long key", (format!("{} = 1\n", "k".repeat(900_000)) + SCENE).into(), &["scene.toml, line 1"]),
        ("100 000 keys", (many(100_000, &|k| format!("k{k}=1\n")) + SCENE).into(), &["scene.toml, line 1", "unknown key"]),
        ("number of many digits", SCENE.replace("500.0", &"9".repeat(900_000)).into(), &["scene.toml, line 12"]),
        ("text for a number", SCENE.replace("500.0", &format!("\"{}\"", "x".repeat(900_000))).into(), &["scene.toml, line 12"]),
        ("text without end", SCENE.replace("500.0", &format!("\"{}", "x".repeat(900_000))).into(), &["scene.toml, line 12"]),
        ("long name twice", SCENE.replace("floor", &"n".repeat(400_000)).replace("wall", &"n".repeat(400_000)).into(), &["surface[1].name"]),
        ("line breaks", "\n".repeat(1_000_000).into(), &["scene.toml", "body"]),
        ("comments", "#\n".repeat(500_000).into(), &["scene.toml", "body"]),
        ("zeros", vec![0; 1_000_000], &["scene.toml, line 1"]),
        ("zero in a text", SCENE.replace("floor", "flo\0or").into(), &["scene.toml, line 20"]),
        ("UTF-16", utf_16, &["scene.toml"]),
        ("no text", vec![0xff; 1_000_000], &["line 1 is not UTF-8 text"]),
        ("orders for the terminal", SCENE.replace("weight", "\"\\u001b[31m\\u0007\"").into(), &["scene.toml, line 5"]),
        ("orders for the terminal in a line", SCENE.replace("weight = 0.0", "weight = -1.0 # \u{9b}31m").into(), &["line 5"]),
        ("infinite rate", SCENE.replace("rate = 10.0", "rate = 1e30").into(), &["line 30", "allowed: at most 1000000000"]),
    ];
    for (name, scene, expected) in cases {
        let folder = Folder::new();
        folder.write("scene.toml", scene);
        assert_refused(name, &folder, "run scene.toml", expected);
        let check = "check trace.jsonl --scene scene.toml";
        folder.write("trace.jsonl", "");
        assert_refused(&format!("{name}, judged"), &folder, check, &[]);
    }
}

#[test]
fn recorded_paths_made_to_harm_are_refused() {
    let long = |line: String| format!("t,x,y,phi\n{line}\n");
    let rows = |count: usize| -> String { (0..count).map(|k| format!("{k},0,0.14,0\n")).collect() };
    let too_long = "is longer than 4096 bytes, allowed: at most 4096 in a line";
    #[rustfmt::skip]
    let cases: &[(&str, String, &[&str])] = &[
        ("line of 2 MB", long("0".repeat(2_000_000)), &["line 2", too_long]),
        ("header of 2 MB", "t,".repeat(1_000_000), &["line 1", too_long]),
        ("2000 columns", long("0,".repeat(2000)), &["line 2", "2001 values, allowed: 4"]),
        ("number of 4000 digits", long(format!("{},0,0,0", "9".repeat(4000))), &["line 2", "`t` is inf"]),
        ("comments alone", "#\n".repeat(1_000_000), &["is empty"]),
        ("line breaks", "\n".repeat(1_000_000), &["is empty"]),
        ("fault at the end", long(rows(200_000) + "0,0,0,0"), &["line 200002", "allowed: times that increase"]),
        ("frames without end", long("0,0,0.14,0\n1e300,0,0.14,0".to_owned()), &["line 3", "allowed: at most 1000000000"]),
        ("orders for the terminal", long("0,0,\u{1b}[2J,0".to_owned()), &["line 2", "`y`"]),
    ];
    for (name, path, expected) in cases {
        let folder = Folder::new();
        folder.write("scene.toml", scene_with_path("hand.csv", "rate = 10.0"));
        folder.write("hand.csv", path);
        assert_refused(name, &folder, "run scene.toml", expected);
    }
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    zeros(&folder, "hand.csv", 200 << 20);
    let line = "run scene.toml --hand hand.csv";
    assert_refused("line of 200 MB", &folder, line, &["line 1", too_long]);
}

#[test]
fn traces_made_to_harm_are_refused() {
    let header = "t,hand_x,hand_y,hand_phi,held,pose_x,pose_y,pose_theta,state,wrench_x,wrench_y,wrench_moment,slips,events,status\n";
    let too_long = "is longer than 1048576 bytes";
    #[rustfmt::skip]
    let cases: &[(&str, &str, String, &[&str])] = &[
        ("line of 2 MB", "trace.jsonl", "1".repeat(2_000_000), &["line 1", too_long]),
        ("arrays in arrays", "trace.jsonl", format!("{{\"hand\":{}", "[".repeat(500_000)), &["line 1"]),
        ("text without end", "trace.jsonl", format!("{{\"state\":\"{}", "x".repeat(900_000)), &["line 1"]),
        ("line breaks", "trace.jsonl", "\n".repeat(1_000_000), &["no record in it"]),
        ("row of 2 MB", "trace.csv", format!("{header}{}", "1".repeat(2_000_000)), &[too_long]),
        ("quote without end", "trace.csv", format!("{header}\"{}", "1,\n".repeat(1_000_000)), &[too_long]),
        ("header of 2 MB", "trace.csv", "t,".repeat(1_000_000), &[too_long]),
    ];
    for (name, file, trace, expected) in cases {
        let folder = Folder::new();
        folder.write("scene.toml", SCENE);
        folder.write(file, trace);
        let line = format!("check {file} --scene scene.toml");
        assert_refused(name, &folder, &line, expected);
    }
}

#[test]
fn recordings_made_to_harm_are_refused() {
    // A scene of at most 1 MiB, each byte of which JSON writes with at most six, and a piece.
    let too_long = "is longer than 6356992 bytes, allowed: at most 6356992 in a line";
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.done("run scene.toml --record recording.jsonl --quiet");
    let recording = folder.read("recording.jsonl");
    let (head, first) = recording.split_once('\n').expect("a head");
    let first = first.lines().next().expect("a sample");
    let after = |line: String| format!("{head}\n{first}\n{line}\n");
    #[rustfmt::skip]
    let cases: &[(&str, String, &[&str])] = &[
        ("line of 20 MB", after("1".repeat(20_000_000)), &["line 3", too_long]),
        ("head of 20 MB", "1".repeat(20_000_000), &["line 1", too_long]),
        ("arrays in arrays", after(format!("{{\"sample\":{}", "[".repeat(500_000))), &["line 3"]),
        ("text without end", format!("{{\"scene\":\"{}", "x".repeat(900_000)), &["line 1"]),
        ("line breaks", "\n".repeat(1_000_000), &["line 1"]),
        ("orders for the terminal", after("{\"sample\":{\"\u{1b}[2J\":0}}".to_owned()), &["line 3"]),
    ];
    for (name, recording, expected) in cases {
        let folder = Folder::new();
        folder.write("bad.jsonl", recording);
        let replay = "replay bad.jsonl --out trace.jsonl";
        let expected = [&["bad.jsonl"], *expected].concat();
        assert_refused(name, &folder, replay, &expected);
        assert_eq!(folder.names(), ["bad.jsonl"], "{name}");
    }
}

#[test]
fn sweeps_made_to_harm_are_refused() {
    let axes = |count: usize| -> String {
        (0..count)
            .map(|k| {
                format!("\"hand.keyframes.{k}.1\" = {{ from = 0.0, to = 1.0, steps = 1000 }}\n")
            })
            .collect()
    };
    #[rustfmt::skip]
    let cases: &[(&str, String, &[&str])] = &[
        ("100 000 scenes", format!("scenes = [{}]", "\"a\",".repeat(100_000)), &["line 1", "there is no scene \"a\""]),
        ("points without end", format!("scenes = [\"scene.toml\"]\n[vary]\n{}", axes(1000)), &["the points are more than can be counted"]),
        ("device as a scene", "scenes = [\"/dev/zero\"]".to_owned(), &[NO_FILE]),
        ("arrays in arrays", format!("scenes = {}", "[".repeat(500_000)), &["line 1"]),
    ];
    for (name, sweep, expected) in cases {
        let folder = Folder::new();
        folder.write("scene.toml", SCENE);
        folder.write("sweep.toml", sweep);
        assert_refused(name, &folder, "sweep sweep.toml --quiet", expected);
    }
}
