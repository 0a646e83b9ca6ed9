//! Streams without a comparison: what is lost is counted, what is refused is said, what goes away comes back.

use std::collections::BTreeSet;

use super::fake::{Seen, Tricks, behind_socket};
use super::{DRAGGED, SAMPLES, board, place, streamed, tricks};
use crate::common::{VERTICES, assert_all, assert_error, records, said, text};

/// The number at the beginning of a row of the summary.
fn counted(said: &str, row: &str) -> u64 {
    let value = |line: &str| {
        let rest = line.trim_start().strip_prefix(row)?;
        rest.starts_with(' ').then(|| rest.trim_start().to_owned())
    };
    let found = said.lines().find_map(value);
    let text = found.unwrap_or_else(|| panic!("{row} in {said}"));
    let digits: String = text.chars().take_while(char::is_ascii_digit).collect();
    digits.parse().expect("a number")
}

#[test]
fn lost_poses_are_counted_and_not_in_the_trace() {
    let faults = tricks(|t| (t.lost, t.forceless) = (vec![0, 7, 150, 300], vec![9]));
    // The last one is waited for.
    let (folder, output, seen) = streamed(faults, "--out trace.jsonl --timeout 1");
    let said = said(&output);
    assert!(output.status.success(), "{said}");
    assert_eq!(seen.samples, SAMPLES);
    assert_eq!(counted(&said, "samples"), SAMPLES, "{said}");
    assert_eq!(counted(&said, "poses"), SAMPLES - 4, "{said}");
    assert_eq!(
        (counted(&said, "lost"), counted(&said, "late")),
        (4, 0),
        "{said}"
    );
    assert_eq!(counted(&said, "incomplete"), 1, "{said}");
    let times: Vec<f64> = records(&folder.read("trace.jsonl"))
        .iter()
        .map(|record| record["t"].as_f64().expect("a time"))
        .collect();
    assert_eq!(times.len() as u64, SAMPLES - 5);
    assert!(times.is_sorted() && !times.contains(&0.009));
}

#[test]
fn a_stream_of_every_sample_leaves_the_trace_of_the_host() {
    let (folder, output, _) = streamed(Tricks::default(), "--out board.csv --quiet");
    assert!(
        output.status.success() && output.stdout.is_empty(),
        "{}",
        said(&output)
    );
    folder.done("run scene.toml --out run.csv");
    assert_eq!(folder.read("board.csv"), folder.read("run.csv"));
}

#[test]
fn a_scene_that_is_too_large_for_the_board_is_said() {
    let surface =
        |i| format!("[[surface]]\nname = \"s{i}\"\nnormal = [0.0, 1.0]\noffset = -{i}.0\n");
    let many: String = (1..=9).map(surface).collect();
    let (hand, rest) = DRAGGED.split_at(DRAGGED.find("[hand]").expect("a hand"));
    let body = &hand[..hand.find("[[surface]]").expect("a surface")];
    let (folder, socket) = place(&format!("{body}{many}{rest}"));
    let fake = behind_socket::<f32>(&socket, 1, Tricks::default());
    let output = board(&folder, "");
    assert_error(
        "surfaces",
        &output,
        &["refuses the scene", "number of surfaces is 9.0"],
    );
    assert_eq!(fake.join().expect("no panic").samples, 0);
    // A frame longer than any that the board takes would never be answered.
    let corner = |i: i32| {
        let angle = f64::from(i) * std::f64::consts::TAU / 60.0;
        format!("[{:?}, {:?}]", 0.05 * angle.cos(), 0.05 * angle.sin())
    };
    let corners: Vec<String> = (0..60).map(corner).collect();
    let vertices = format!("vertices = [{}]", corners.join(", "));
    let (folder, socket) = place(&DRAGGED.replace(VERTICES, &vertices));
    let _fake = behind_socket::<f32>(&socket, 1, Tricks::default());
    let parts = [
        "60 vertices, 2 surfaces,",
        "allowed: 16 vertices, 8 surfaces",
    ];
    assert_error("corners", &board(&folder, ""), &parts);
}

#[test]
fn a_slow_line_gets_what_it_carries() {
    for (options, tick_rate, pose_every) in [("", 1000, 3), ("--verify", 400, 1)] {
        let slow = tricks(|t| t.line_rate = Some(40_000.0));
        let (_, output, Seen { mode, .. }) = streamed(slow, options);
        assert!(output.status.success(), "{}", said(&output));
        assert_eq!(
            (mode.tick_rate, mode.pose_every, mode.forces_every),
            (tick_rate, pose_every, pose_every)
        );
        assert_all(options, &said(&output), &["the line carries"]);
    }
}

#[test]
fn a_board_that_comes_back_goes_on() {
    let (start, _) = DRAGGED.split_at(DRAGGED.find("[hand]").expect("a hand"));
    let hand = "[hand]\nrate = 100.0\nkeyframes = [[0.0, 0.2, 0.14, 0.5], [4.0, 0.2, 0.06, 0.5]]\n";
    let (folder, socket) = place(&format!("{start}{hand}"));
    let fake = behind_socket::<f32>(&socket, 2, tricks(|t| t.leaves_after = Some(30)));
    let output = board(&folder, "--out trace.jsonl");
    let said = said(&output);
    assert!(output.status.success(), "{said}");
    let seen = fake.join().expect("no panic").samples;
    for once in ["looking for the board once a second", "the board is back"] {
        assert_eq!(said.matches(once).count(), 1, "{said}");
    }
    let [samples, poses, lost] = ["samples", "poses", "lost"].map(|row| counted(&said, row));
    assert_eq!((samples, poses + lost), (401, 401), "{said}");
    assert!(seen >= poses && poses > 30, "{said}");
    // Nothing was there for 0.3 s of the path.
    assert!(lost >= 30, "{said}");
    let trace = records(&folder.read("trace.jsonl"));
    let frames: BTreeSet<u64> = trace
        .iter()
        .map(|record| (record["t"].as_f64().expect("a time") * 100.0).round() as u64)
        .collect();
    assert_eq!(frames.len() as u64, poses);
    assert!(
        frames.first() == Some(&0) && frames.last() == Some(&400),
        "{frames:?}"
    );
}

#[test]
fn a_board_that_does_not_come_back_is_an_error_and_the_trace_stays() {
    let leaves = tricks(|t| t.leaves_after = Some(100));
    let (folder, output, _) = streamed(leaves, "--out trace.jsonl --timeout 0.5");
    assert_error("it leaves", &output, &["looking for the board", "error: "]);
    let recorded = records(&folder.read("trace.jsonl")).len() as u64;
    let poses = counted(&text(&output.stdout), "poses");
    assert!(recorded < 100 && recorded == poses, "{recorded}");
}
