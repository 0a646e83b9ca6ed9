//! The hand's motion: keyframes, recorded paths, resampling, projection, and records that are not finite.

use crate::common::{Folder, SCENE, numbers, scene_with_path};
use serde_json::Value;

fn hand(record: &Value) -> Vec<f64> {
    numbers(&record["hand"])
}

fn assert_near(value: &[f64], expected: &[f64]) {
    assert_eq!(value.len(), expected.len());
    for (a, b) in value.iter().zip(expected) {
        assert!((a - b).abs() < 1e-12, "{value:?} is not {expected:?}");
    }
}

/// The trace of a recorded path of this content, in f64.
fn recorded(name: &str, content: &str, rest: &str, options: &str) -> Vec<Value> {
    let folder = Folder::new();
    folder.write(name, content);
    folder.trace(
        &scene_with_path(name, rest),
        &format!("--number f64 {options}"),
    )
}

#[test]
fn keyframes_include_both_ends() {
    let folder = Folder::new();
    let trace = folder.trace(
        &SCENE.replacen("rate = 10.0", "rate = 100.0", 1),
        "--number f64",
    );
    assert_eq!(trace.len(), 101);
    assert_eq!(
        (trace[0]["t"].as_f64(), trace[100]["t"].as_f64()),
        (Some(0.0), Some(1.0))
    );
    assert_near(&hand(&trace[0]), &[0.2, 0.14, 0.5]);
    assert_near(&hand(&trace[25]), &[0.2, 0.12, 0.5]);
    assert_near(&hand(&trace[100]), &[0.2, 0.06, 0.5]);
}

#[test]
fn the_last_keyframe_is_a_frame_even_between_two_steps_of_the_rate() {
    let folder = Folder::new();
    let trace = folder.trace(SCENE, "--rate 2.5");
    let times: Vec<f64> = trace
        .iter()
        .filter_map(|record| record["t"].as_f64())
        .collect();
    assert_eq!(times, [0.0, 0.4, 0.8, 1.0]);
}

#[test]
fn counts_are_robust_to_rounding() {
    for (rate, end, count) in [
        ("10", "0.3", 4),
        ("1000", "0.7", 701),
        ("30", "0.1", 4),
        ("3", "1.0", 4),
    ] {
        let folder = Folder::new();
        let scene = SCENE.replacen("[1.0, 0.2,", &format!("[{end}, 0.2,"), 1);
        assert_eq!(
            folder.trace(&scene, &format!("--rate {rate}")).len(),
            count,
            "{rate} Hz, {end} s"
        );
    }
}

#[test]
fn the_switch_follows_the_last_keyframe_reached() {
    let folder = Folder::new();
    let frames =
        "[0.0, 0.2, 0.14, 0.0, 1],\n  [0.3, 0.2, 0.14, 0.0, 0],\n  [0.6, 0.2, 0.14, 0.0],\n";
    let scene = SCENE.replacen("[0.0, 0.2, 0.14, 0.5],\n", frames, 1);
    let trace = folder.trace(&scene, "");
    let held: Vec<bool> = trace
        .iter()
        .filter_map(|record| record["held"].as_bool())
        .collect();
    let expected: Vec<bool> = (0..=10).map(|k| !(3..6).contains(&k)).collect();
    assert_eq!(held, expected);
}

#[test]
fn every_record_is_a_frame_unless_a_rate_is_given() {
    let path = "t,x,y,phi\n5.0,0.2,0.14,0.0\n5.1,0.2,0.12,0.0\n5.5,0.24,0.10,6.4\n";
    let trace = recorded("hand.csv", path, "", "");
    assert_eq!(trace.len(), 3);
    assert_eq!(trace[1]["t"], 5.1);
    assert_near(&hand(&trace[2]), &[0.24, 0.10, 6.4]);
    for trace in [
        recorded("hand.csv", path, "rate = 5.0", ""),
        recorded("hand.csv", path, "rate = 50.0", "--rate 5"),
    ] {
        assert_eq!(trace.len(), 4);
        assert_near(&hand(&trace[2]), &[0.23, 0.105, 4.8]);
        assert_near(&hand(&trace[3]), &[0.24, 0.10, 6.4]);
    }
}

#[test]
fn another_hand_can_be_given_on_the_command_line() {
    let folder = Folder::new();
    folder.write(
        "other.csv",
        "t,x,y,phi,held\n0,0.3,0.14,0,1\n1,0.3,0.15,0,0\n",
    );
    let trace = folder.trace(&SCENE.replacen("rate = 10.0\n", "", 1), "--hand other.csv");
    assert_eq!(trace.len(), 2);
    assert_eq!(trace[1]["held"], false);
}

#[test]
fn paths_are_relative_to_the_scene_file() {
    let folder = Folder::new();
    std::fs::create_dir(folder.file("scenes")).expect("a folder");
    folder.write("scenes/hand.csv", "t,x,y,phi\n0,0.2,0.14,0\n");
    folder.write("scenes/scene.toml", scene_with_path("hand.csv", ""));
    let output = folder.stiction("run scenes/scene.toml --out trace.jsonl");
    assert!(output.status.success());
    assert_eq!(folder.read("trace.jsonl").lines().count(), 1);
}

#[test]
fn scale_and_origin_place_a_path() {
    let path = "t,x,y,phi\n0,2.0,1.4,0.5\n";
    let trace = recorded(
        "hand.csv",
        path,
        "scale = 0.1\norigin = [0.05, 0.01, -0.1]",
        "",
    );
    assert_near(&hand(&trace[0]), &[0.25, 0.15, 0.4]);
}

/// A quaternion for a turn by `angle` about one axis.
fn about(axis: usize, angle: f64) -> String {
    let mut q = [0.0; 4];
    q[axis] = (angle / 2.0).sin();
    q[3] = (angle / 2.0).cos();
    q.map(|part| part.to_string()).join(" ")
}

#[test]
fn tum_files_may_have_comments_absolute_times_and_uneven_steps() {
    let path = format!(
        "# timestamp tx ty tz qx qy qz qw\n1305031098.6659 0.2 0.14 0.7 {}\n\n1305031098.6758  0.3 0.15 0.8 {} # end\n",
        about(2, 0.3),
        about(2, 0.5)
    );
    for name in ["hand.tum", "hand.txt"] {
        let trace = recorded(name, &path, "", "");
        assert_eq!(trace.len(), 2);
        assert_eq!(trace[1]["t"], 1305031098.6758);
        assert_near(&hand(&trace[0]), &[0.2, 0.14, 0.3]);
        assert_near(&hand(&trace[1]), &[0.3, 0.15, 0.5]);
        assert_eq!(trace[1]["depth"], 0.8);
    }
}

#[test]
fn planes_name_the_axes_that_become_x_and_y() {
    // position (0.2, 0.3, 0.4): x, y, depth in the plane, and the axis whose turn is positive there.
    for (plane, pose, axis, sign) in [
        ("xy", [0.2, 0.3, 0.4], 2, 1.0),
        ("yz", [0.3, 0.4, 0.2], 0, 1.0),
        ("zx", [0.4, 0.2, 0.3], 1, 1.0),
        ("xz", [0.2, 0.4, -0.3], 1, -1.0),
        ("-xz", [-0.2, 0.4, 0.3], 1, 1.0),
        ("yx", [0.3, 0.2, -0.4], 2, -1.0),
    ] {
        let path = format!("0 0.2 0.3 0.4 {}\n", about(axis, 0.6));
        let rest = format!("plane = {plane:?}\norigin = [1.0, 1.0, 0.0]\nscale = 0.5");
        let trace = recorded("hand.tum", &path, &rest, "");
        let [x, y, depth] = pose.map(|value| value / 2.0);
        assert_near(&hand(&trace[0]), &[1.0 + x, 1.0 + y, sign * 0.6]);
        assert_near(&[trace[0]["depth"].as_f64().expect("a number")], &[depth]);
    }
}

#[test]
fn turns_of_a_6_dof_path_are_unwrapped() {
    let mut path = String::from("t,x,y,z,qx,qy,qz,qw,held\n");
    for k in 0..=30 {
        let quaternion = about(2, f64::from(k) * 0.7).replace(' ', ",");
        path += &format!("{k},0.2,0.2,0,{quaternion},1\n");
    }
    let trace = recorded("hand.csv", &path, "", "");
    assert_near(&hand(&trace[30]), &[0.2, 0.2, 21.0]);
}

#[test]
fn a_pose_that_is_not_finite_is_held() {
    let path = "t,x,y,phi\n0,0.2,0.14,0\n1,0.2,0.13,0\n2,nan,0.12,0\n3,0.2,inf,0\n4,0.2,0.10,0\n";
    let trace = recorded("hand.csv", path, "", "");
    let status: Vec<&str> = trace
        .iter()
        .filter_map(|record| record["status"].as_str())
        .collect();
    assert_eq!(status, ["ok", "ok", "held-last", "held-last", "ok"]);
    for k in [2, 3] {
        assert_near(&hand(&trace[k]), &[0.2, 0.13, 0.0]);
        assert_eq!(trace[k]["pose"], trace[1]["pose"]);
    }
    let resampled = recorded("hand.csv", path, "rate = 2.0", "");
    let status: Vec<&str> = resampled
        .iter()
        .filter_map(|record| record["status"].as_str())
        .collect();
    let expected: Vec<&str> = (0..=8)
        .map(|k| {
            if (3..8).contains(&k) {
                "held-last"
            } else {
                "ok"
            }
        })
        .collect();
    assert_eq!(status, expected);
}

#[test]
fn an_f32_run_takes_the_angle_apart_before_it_is_rounded() {
    let folder = Folder::new();
    // The body begins with the turns of the hand, so that it does not unwind on its path.
    let [far, near] = [10_000.0 * std::f64::consts::TAU, 0.0].map(|phi| {
        folder.write(
            "hand.csv",
            format!("t,x,y,phi\n0,0.2,0.2,{phi}\n1,0.2,0.2,{}\n", phi + 0.1),
        );
        let start = format!("[0.2, 0.12, {phi:?}]");
        folder.trace(
            &scene_with_path("hand.csv", "").replacen("[0.2, 0.12, 0.5]", &start, 1),
            "",
        )
    });
    for axis in 0..2 {
        let [a, b] = [&far, &near].map(|trace| numbers(&trace[1]["pose"])[axis]);
        assert!((a - b).abs() < 1e-6, "{a} is not {b}");
    }
}
