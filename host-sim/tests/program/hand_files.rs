//! One motion of a hand as other programs write it: in their units, frames, columns, with their gaps. Each file is read right, or the
//! message says which key or which change of the file makes it right; `--fit` does it by itself.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::common::{Folder, SCENE, assert_all, assert_error, numbers, records, text};

/// The number of samples and their distance (s).
const COUNT: usize = 101;
const STEP: f64 = 0.02;
/// A time of day (ns): stamps since 1970.
const STAMP: u64 = 1_403_715_273_262_142_976;

/// x, y (m) and phi (rad) of sample k: down to the floor and along it, turning slowly.
fn pose(k: usize) -> [f64; 3] {
    let s = k as f64 / (COUNT - 1) as f64;
    [
        0.2 + 0.1 * s,
        0.14 - 0.08 * (2.0 * s).min(1.0),
        0.5 + 0.4 * s,
    ]
}

/// That motion with many turns.
fn turning(k: usize) -> [f64; 3] {
    let [x, y, _] = pose(k);
    [x, y, 0.5 + 0.1 * k as f64]
}

/// The quaternion x, y, z, w of a turn about z.
fn about_z(phi: f64) -> [f64; 4] {
    [0.0, 0.0, (phi / 2.0).sin(), (phi / 2.0).cos()]
}

/// A file with a line for each sample after a header.
fn file(header: &str, line: impl Fn(usize) -> String) -> String {
    let mut text = header.to_owned();
    for k in 0..COUNT {
        let _ = writeln!(text, "{}", line(k));
    }
    text
}

fn t(k: usize) -> f64 {
    STEP * k as f64
}

fn stamp(k: usize) -> u64 {
    STAMP + 20_000_000 * k as u64
}

/// t, x, y, z and a quaternion in the order x, y, z, w, with a separator.
fn spatial(time: &str, k: usize, separator: &str) -> String {
    let [x, y, phi] = pose(k);
    let [qx, qy, qz, qw] = about_z(phi);
    [time.to_owned()]
        .into_iter()
        .chain([x, y, 0.0, qx, qy, qz, qw].map(|v| v.to_string()))
        .collect::<Vec<_>>()
        .join(separator)
}

/// The quaternion first w, as EuRoC and many others have it.
fn w_first(time: &str, k: usize, separator: &str) -> String {
    let [x, y, phi] = pose(k);
    let [qx, qy, qz, qw] = about_z(phi);
    [time.to_owned()]
        .into_iter()
        .chain([x, y, 0.0, qw, qx, qy, qz].map(|v| v.to_string()))
        .collect::<Vec<_>>()
        .join(separator)
}

fn planar(k: usize, [x, y, phi]: [f64; 3]) -> String {
    format!("{},{x},{y},{phi}", t(k))
}

/// Runs the scene over a file; the trace's hand in each frame, and what was said.
fn run(name: &str, content: &[u8], options: &str) -> (Vec<Vec<f64>>, Vec<f64>, String) {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE.replacen("rate = 10.0\n", "", 1));
    folder.write(name, content);
    let line = format!("run scene.toml --number f64 --hand {name} --out trace.jsonl {options}");
    let output = folder.stiction(&line);
    let said = text(&output.stderr);
    assert!(output.status.success(), "{name}: {said}");
    let trace = records(&folder.read("trace.jsonl"));
    let hands = trace.iter().map(|record| numbers(&record["hand"]));
    let times = trace
        .iter()
        .map(|record| record["t"].as_f64().expect("a time"));
    (hands.collect(), times.collect(), said)
}

/// The hand is that of `expected` in every frame, and so is the time from the first frame on.
fn assert_read(
    name: &str,
    content: &[u8],
    options: &str,
    expected: fn(usize) -> [f64; 3],
) -> String {
    let (hands, times, said) = run(name, content, options);
    assert_eq!(hands.len(), COUNT, "{name}: {said}");
    for (k, (hand, time)) in hands.iter().zip(&times).enumerate() {
        let close = hand
            .iter()
            .zip(expected(k))
            .all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(
            close,
            "{name}, sample {k}: {hand:?} is not {:?}",
            expected(k)
        );
        // A stamp since 1970 has a resolution of 0.24 us.
        assert!(
            (time - times[0] - t(k)).abs() < 1e-6,
            "{name}, sample {k}: {time}"
        );
    }
    said
}

/// Without a word about what would be wrong.
fn assert_read_silently(name: &str, content: &[u8]) {
    let said = assert_read(name, content, "", pose);
    assert!(!said.contains("note: "), "{name}: {said}");
}

/// The notes of a run have all of this; with `options`, the hand moves as `expected`, from wherever it begins.
fn assert_mended(name: &str, content: &[u8], notes: &[&str], expected: fn(usize) -> [f64; 3]) {
    let (_, _, said) = run(name, content, "");
    assert_all(name, &said, notes);
    let (hands, _, said) = run(name, content, "--fit");
    assert_all(
        name,
        &said,
        &["placed over the scene, as by these keys:\n[hand]\n"],
    );
    let begin: Vec<f64> = hands[0]
        .iter()
        .zip(expected(0))
        .map(|(a, b)| a - b)
        .collect();
    for (k, hand) in hands.iter().enumerate() {
        let moved = hand.iter().zip(expected(k)).zip(&begin);
        let close = moved
            .into_iter()
            .all(|((a, b), begin)| (a - b - begin).abs() < 1e-6);
        assert!(
            close,
            "{name}, sample {k}: {hand:?} is not {:?}\n{said}",
            expected(k)
        );
    }
    // A scene with the keys that were printed does it, too.
    let (_, keys) = said.split_once("[hand]\n").expect("the keys");
    let keys: Vec<&str> = keys
        .lines()
        .take_while(|line| line.contains(" = "))
        .collect();
    let folder = Folder::new();
    let keys = format!("[hand]\n{}", keys.join("\n"));
    folder.write(
        "scene.toml",
        SCENE.replacen("[hand]\nrate = 10.0", &keys, 1),
    );
    folder.write(name, content);
    folder.done(&format!(
        "run scene.toml --number f64 --hand {name} --out trace.jsonl"
    ));
    let again = records(&folder.read("trace.jsonl"));
    let again: Vec<Vec<f64>> = again
        .iter()
        .map(|record| numbers(&record["hand"]))
        .collect();
    assert_eq!(again, hands, "{name}: {keys}");
}

// 1 to 3: spreadsheets.

#[test]
fn csv_of_a_spreadsheet_has_a_byte_order_mark_and_quotes() {
    let plain = file("t,x,y,phi\n", |k| planar(k, pose(k)));
    assert_read_silently("plain.csv", plain.as_bytes());
    let marked = format!(
        "\u{feff}{}",
        plain.replacen("t,x,y,phi", "\"t\",\"x\",\"y\",\"phi\"", 1)
    )
    .replace('\n', "\r\n");
    assert_read_silently("excel.csv", marked.as_bytes());
}

#[test]
fn semicolons_and_tabs_separate_and_commas_in_numbers_are_refused() {
    let plain = file("t,x,y,phi\n", |k| planar(k, pose(k)));
    for separator in [";", "\t"] {
        assert_read_silently("export.csv", plain.replace(',', separator).as_bytes());
    }
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.write("german.csv", "t;x;y;phi\n0,0;0,2;0,14;0,5\n");
    let line = "run scene.toml --hand german.csv";
    folder.refused(
        line,
        &[
            "line 2",
            "`t` is \"0,0\", allowed: a number with a decimal point",
        ],
    );
}

#[test]
fn spaces_separate_too_as_savetxt_of_numpy_writes_them() {
    let content = file("# t x y phi\n", |k| planar(k, pose(k)).replace(',', " "));
    for name in ["savetxt.csv", "savetxt.txt"] {
        assert_read_silently(name, content.as_bytes());
    }
    let content = content.replacen("# t x y phi", "t [s]  x [m]  y [m]  phi [rad]", 1);
    assert_read_silently("units.csv", content.as_bytes());
}

#[test]
fn a_header_that_is_missing_or_has_other_names_says_so() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    let rows = file("", |k| planar(k, pose(k)));
    folder.write("bare.csv", &rows);
    folder.write("theta.csv", format!("t,x,y,theta\n{rows}"));
    folder.write("old.csv", format!("t,x,y,phi\n{rows}").replace('\n', "\r"));
    let expected = [
        "line 1",
        "the line has numbers, not names, and a header is to be before it",
    ];
    folder.refused("run scene.toml --hand bare.csv", &expected);
    let expected = ["line 1", "no `phi`", "not known: theta"];
    folder.refused("run scene.toml --hand theta.csv", &expected);
    let expected = [
        "line 1",
        "has carriage returns, allowed: lines that end with LF or CR LF",
    ];
    folder.refused("run scene.toml --hand old.csv", &expected);
}

// 4, 5: columns by their names.

#[test]
fn columns_may_be_in_any_order_with_others_among_them() {
    let content = file("frame,phi,y,x,confidence,t\n", |k| {
        let [x, y, phi] = pose(k);
        format!("{k},{phi},{y},{x},0.9,{}", t(k))
    });
    let said = assert_read("columns.csv", content.as_bytes(), "", pose);
    let skipped = "columns that are skipped: frame, confidence";
    assert_eq!(said.matches(skipped).count(), 1, "{said}");
}

// 6 to 9: visual odometry and its ground truth.

#[test]
fn euroc_has_nanoseconds_and_its_header_behind_a_number_sign() {
    let header = "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";
    let content = file(header, |k| w_first(&stamp(k).to_string(), k, ","));
    assert_read_silently("euroc.csv", content.as_bytes());
    // The ground truth has velocities and biases, and no unit of its stamps.
    let header = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1], b_w_RS_S_x [rad s^-1]\n";
    let content = file(header, |k| {
        w_first(&stamp(k).to_string(), k, ",") + ",0.1,0.2"
    });
    let said = assert_read("truth.csv", content.as_bytes(), "", pose);
    assert_all(
        "truth.csv",
        &said,
        &[
            "skipped: v_RS_R_x [m s^-1], b_w_RS_S_x",
            "the times are read as ns",
        ],
    );
}

#[test]
fn tum_files_have_seconds_or_nanoseconds_and_spaces_or_commas() {
    let content = file("# timestamp tx ty tz qx qy qz qw\n", |k| {
        spatial(&t(k).to_string(), k, " ")
    });
    assert_read_silently("groundtruth.txt", content.as_bytes());
    let content = file("", |k| spatial(&stamp(k).to_string(), k, " "));
    let said = assert_read("stamps.tum", content.as_bytes(), "", pose);
    assert_all("stamps.tum", &said, &["the times are read as ns"]);
    let content = file("", |k| spatial(&t(k).to_string(), k, ", "));
    assert_read_silently("commas.txt", content.as_bytes());
}

#[test]
fn a_comment_that_has_all_names_tells_the_order_of_a_quaternion() {
    let content = file("# time x y z qw qx qy qz\n", |k| {
        w_first(&t(k).to_string(), k, " ")
    });
    assert_read_silently("poses.txt", content.as_bytes());
}

// 10, 11: ROS.

#[test]
fn topics_of_ros_are_read_by_their_fields() {
    let pose_of = "field.pose.position.x,field.pose.position.y,field.pose.position.z,field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,field.pose.orientation.w";
    let content = file(&format!("%time,{pose_of}\n"), |k| {
        spatial(&stamp(k).to_string(), k, ",")
    });
    let said = assert_read("echo.csv", content.as_bytes(), "", pose);
    assert_all("echo.csv", &said, &["the times are read as ns"]);
    let pose_of = pose_of.replace("field.", "/hand/").replace('.', "/");
    let content = file(&format!("__time,{pose_of}\n"), |k| {
        spatial(&t(k).to_string(), k, ",")
    });
    assert_read_silently("plotjuggler.csv", content.as_bytes());
}

// 12 to 14: motion capture.

#[test]
fn units_in_the_header_are_applied() {
    let content = file(
        "Time (ms),Position X (mm),Position Y (mm),phi (deg)\n",
        |k| {
            let [x, y, phi] = pose(k);
            format!(
                "{},{},{},{}",
                1e3 * t(k),
                1e3 * x,
                1e3 * y,
                phi.to_degrees()
            )
        },
    );
    assert_read_silently("mocap.csv", content.as_bytes());
}

#[test]
fn lines_before_the_header_are_refused_with_what_to_do() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.write(
        "take.csv",
        "Format Version,1.23,Take Name,Hand\n\n,,Rotation,Rotation\nFrame,Time (Seconds),X,Y\n",
    );
    let expected = [
        "line 1",
        "lines before it, or without names, are to be deleted",
        "t,x,y,z,qx,qy,qz,qw",
    ];
    folder.refused("run scene.toml --hand take.csv", &expected);
}

#[test]
fn lost_samples_are_held_and_counted() {
    for (header, lost) in [
        ("t,x,y,phi\n", ",,"),
        ("t,x,y,phi\n", "null,null,null"),
        ("t,x,y,phi\n", "nan,0.2,0.1"),
        ("t,x,y,z,qx,qy,qz,qw\n", "0,0,0,0,0,0,0"),
    ] {
        let content = file(header, |k| match (k, header.contains("qw")) {
            (7 | 8, _) => format!("{},{lost}", t(k)),
            (_, true) => spatial(&t(k).to_string(), k, ","),
            (_, false) => planar(k, pose(k)),
        });
        let (hands, _, said) = run("gaps.csv", content.as_bytes(), "");
        assert_all(lost, &said, &["records without a pose: 2 of 101"]);
        assert_eq!(
            (hands.len(), &hands[7], &hands[8]),
            (COUNT, &hands[6], &hands[6]),
            "{lost}"
        );
        assert!((hands[9][0] - pose(9)[0]).abs() < 1e-9, "{lost}");
    }
}

#[test]
fn lost_samples_that_are_zero_are_reported() {
    let content = file("t,x,y,phi\n", |k| match k {
        7 | 8 | 50 => planar(k, [0.0; 3]),
        _ => planar(k, pose(k)),
    });
    let (_, _, said) = run("zeros.csv", content.as_bytes(), "");
    let expected = [
        "the hand jumps by 0.244 m to x = y = phi = 0 at t = 0.14 s, and once more: a lost sample is to be empty",
    ];
    assert_all("zeros.csv", &said, &expected);
    // A hand that begins there, and one that passes by, have lost nothing.
    let content = file("t,x,y,phi\n", |k| planar(k, [0.002 * k as f64, 0.0, 0.0]));
    let (_, _, said) = run("begins.csv", content.as_bytes(), "");
    assert!(!said.contains("jumps"), "{said}");
}

// 15 to 20: units, angles and frames that the file does not name.

#[test]
fn millimetres_and_centimetres_are_recognised() {
    for (per_metre, key) in [
        (1000.0, "`hand.scale = 0.001`"),
        (100.0, "`hand.scale = 0.01`"),
    ] {
        let content = file("t,x,y,phi\n", |k| {
            let [x, y, phi] = pose(k);
            planar(k, [x * per_metre, y * per_metre, phi])
        });
        assert_mended(
            "units.csv",
            content.as_bytes(),
            &["note: units.csv: the hand", key],
            pose,
        );
    }
}

#[test]
fn degrees_are_recognised_also_where_they_are_wrapped() {
    let degrees = |k: usize| {
        let [x, y, phi] = turning(k);
        [x, y, phi.to_degrees()]
    };
    let content = file("t,x,y,phi\n", |k| planar(k, degrees(k)));
    let notes = [
        "note: deg.csv: the hand turns over",
        "`hand.angle = \"degrees\"`",
    ];
    assert_mended("deg.csv", content.as_bytes(), &notes, turning);
    let content = file("t,x,y,phi\n", |k| {
        let [x, y, phi] = degrees(k);
        planar(k, [x, y, (phi + 180.0).rem_euclid(360.0) - 180.0])
    });
    let notes = ["`hand.angle = \"degrees\"`"];
    assert_mended("wrapped.csv", content.as_bytes(), &notes, turning);
}

#[test]
fn angles_that_are_wrapped_are_recognised() {
    let content = file("t,x,y,phi\n", |k| {
        let [x, y, phi] = turning(k);
        planar(k, [x, y, (phi + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0])
    });
    let notes = [
        "note: wrap.csv: phi jumps by -6.183 rad between t = 0.52 s and 0.54 s",
        "`hand.unwrap = true`",
    ];
    assert_mended("wrap.csv", content.as_bytes(), &notes, turning);
}

#[test]
fn coordinates_of_a_room_with_z_upwards_are_recognised() {
    // The scene's y is the room's z; a turn in the plane x, z is about -y.
    let content = file("", |k| {
        let [x, y, phi] = pose(k);
        let (sin, cos) = (phi / 2.0).sin_cos();
        format!("{} {} 2.5 {} 0 {} 0 {cos}", t(k), x + 3.0, y + 1.1, -sin)
    });
    let notes = [
        "another plane, as `hand.plane = \"xz\"`",
        "body sizes, to where the body is held at its start: `hand.origin = [",
    ];
    assert_mended("room.tum", content.as_bytes(), &notes, pose);
}

#[test]
fn times_in_milliseconds_without_a_unit_are_reported() {
    let content = file("t,x,y,phi\n", |k| {
        let [x, y, phi] = pose(k);
        format!("{},{x},{y},{phi}", 1e3 * t(k))
    });
    let (_, _, said) = run("ms.csv", content.as_bytes(), "");
    assert_all(
        "ms.csv",
        &said,
        &["the samples are 20.000 s apart", "`t [ms]`"],
    );
    let named = content.replacen("t,", "t [ms],", 1);
    assert_read_silently("ms.csv", named.as_bytes());
}

#[test]
fn a_run_in_which_nothing_is_touched_says_how_near_the_body_came() {
    // Unloaded, the body is where the hand is: held 20 mm above its middle, its lower side 30 mm below that.
    let folder = Folder::new();
    folder.write(
        "high.csv",
        file("t,x,y,phi\n", |k| planar(k, [0.0, 0.09, 0.0])),
    );
    let said = text(&folder.stiction("run box-flat --hand high.csv").stdout);
    let expected =
        ["the body touches nothing: it is never nearer than 40.000 mm to surface \"floor\""];
    assert_all("high.csv", &said, &expected);
}

#[test]
fn samples_that_are_missing_are_reported() {
    let content = file("t,x,y,phi\n", |k| match k {
        20..=49 => String::new(),
        _ => planar(k, pose(k)),
    });
    let lines = content.lines().filter(|line| !line.is_empty());
    let content = lines.collect::<Vec<_>>().join("\n");
    let (_, _, said) = run("hole.csv", content.as_bytes(), "");
    let expected = ["hole.csv: no samples for 0.620 s from t = 0.38 s"];
    assert_all("hole.csv", &said, &expected);
}

#[test]
fn utf_16_is_refused() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    let text: Vec<u8> = "t,x,y,phi\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    folder.write("utf16.csv", [&[0xff, 0xfe], text.as_slice()].concat());
    let output = folder.stiction("run scene.toml --hand utf16.csv");
    assert_error(
        "UTF-16",
        &output,
        &["utf16.csv", "line 1 is not UTF-8 text"],
    );
}

/// A path that begins where it should is not moved; one that is fitted is checked with the same option.
#[test]
fn a_path_in_place_stays_and_a_fitted_one_is_checked() {
    let content = file("t,x,y,phi\n", |k| planar(k, pose(k)));
    let said = assert_read("plain.csv", content.as_bytes(), "--fit", pose);
    assert_all(
        "in place",
        &said,
        &["plain.csv: lies over the scene as it is"],
    );
    let folder = Folder::new();
    folder.write("scene.toml", SCENE.replacen("rate = 10.0\n", "", 1));
    let far = file("t,x,y,phi\n", |k| {
        let [x, y, phi] = pose(k);
        planar(k, [x + 5.0, y - 3.0, phi])
    });
    folder.write("far.csv", far);
    folder.done("run scene.toml --hand far.csv --fit --out trace.jsonl");
    folder.done("check trace.jsonl --scene scene.toml --hand far.csv --fit");
    let unfitted = folder.stiction("check trace.jsonl --scene scene.toml --hand far.csv");
    assert_eq!(unfitted.status.code(), Some(1));
    folder.refused("run scene.toml --fit", &["--hand"]);
}

/// The keys of a file's angle: of what a person writes, and of a run of a whole turn.
#[test]
fn degrees_and_unwrapping_are_keys_of_keyframes_too() {
    let folder = Folder::new();
    let plain = folder.trace(SCENE, "");
    let degrees = SCENE.replace(", 0.5],\n", &format!(", {}],\n", 0.5_f64.to_degrees()));
    let degrees = degrees.replacen("rate = 10.0", "rate = 10.0\nangle = \"degrees\"", 1);
    assert_ne!(degrees, SCENE);
    for (record, expected) in folder.trace(&degrees, "").iter().zip(&plain) {
        let (hand, expected) = (numbers(&record["hand"]), numbers(&expected["hand"]));
        assert!((hand[2] - expected[2]).abs() < 1e-6, "{hand:?}");
    }
}
