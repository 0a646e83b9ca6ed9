//! Poses by OSC and OpenTrack, and the hand from them: decoded and encoded by a Python program of its own.

use std::io::{BufRead, BufReader, Lines, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

use super::program::View;
use crate::common::numbers;

/// The other end of the UDP.
struct Other {
    child: Child,
    input: ChildStdin,
    lines: Lines<BufReader<ChildStdout>>,
    port: u64,
}

impl Other {
    fn start(format: &str) -> Self {
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/program/view/udp.py");
        let mut child = Command::new("python3")
            .args([script, format])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("python3");
        let input = child.stdin.take().expect("its input");
        let output = child.stdout.take().expect("its output");
        let mut other = Self {
            child,
            input,
            lines: BufReader::new(output).lines(),
            port: 0,
        };
        other.port = other.next()["port"].as_u64().expect("a port");
        other
    }

    fn next(&mut self) -> Value {
        let line = self.lines.next().expect("a line").expect("text");
        serde_json::from_str(&line).expect("JSON")
    }

    /// The first it received that `pick` takes.
    fn until(&mut self, mut pick: impl FnMut(&Value) -> bool) -> Value {
        for _ in 0..100_000 {
            let received = self.next();
            if pick(&received) {
                return received;
            }
        }
        panic!("what was waited for did not come")
    }

    fn send(&mut self, message: &Value) {
        writeln!(self.input, "{message}").expect("it is taken");
    }
}

impl Drop for Other {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A port that was free a moment ago.
fn free_port() -> u16 {
    let socket = std::net::UdpSocket::bind("127.0.0.1:0").expect("a socket");
    socket.local_addr().expect("its address").port()
}

/// A view whose poses are sent to a program, `osc` or `opentrack`.
fn sent_to(program: &str, options: &str) -> (Other, View) {
    let other = Other::start(program);
    let to = format!("127.0.0.1:{}", other.port);
    let view = View::start(&format!("box-flat --{program} {to} {options}"));
    (other, view)
}

/// A view whose hand is led by a program, `osc` or `opentrack`, at a port.
fn led_by(program: &str) -> (Other, u16, View) {
    let port = free_port();
    let view = View::start(&format!("box-flat --number f64 --{program}-in {port}"));
    (Other::start(program), port, view)
}

#[test]
fn osc_carries_pose_forces_contacts_and_events() {
    let (mut other, view) = sent_to("osc", "--osc-rate 500");
    let mut client = view.client();
    client.lead([0.0, 0.07, 0.0], [0.0, 0.04, 0.0], 20);
    let land = other.until(|received| received["/stiction/event"] == json!([["land"]]));
    assert_eq!(land["/stiction/state"][0][0], "edge");
    let rest = other.until(|received| {
        let normal = |contact: &Value| {
            contact[4]
                .as_f64()
                .is_some_and(|normal| (normal - 2.5).abs() < 1e-3)
        };
        received["/stiction/contact"]
            .as_array()
            .is_some_and(|all| all.iter().all(normal) && all.len() == 2)
    });
    let [pose, wrench, depth] =
        ["pose", "wrench", "depth"].map(|name| numbers(&rest[format!("/stiction/{name}")][0]));
    assert!(pose.len() == 3 && (pose[1] - 0.03).abs() < 1e-6, "{pose:?}");
    assert!(
        wrench.len() == 3 && (wrench[1] + 5.0).abs() < 1e-3,
        "{wrench:?}"
    );
    assert_eq!(depth, [0.0]);
    assert_eq!(rest["/stiction/contact"][0][1], "floor");
    assert_eq!(rest["/stiction/contact"][0][6], 0, "it sticks");
    let (left, right) = (
        &rest["/stiction/contact"][0][2],
        &rest["/stiction/contact"][1][2],
    );
    let width = (left.as_f64().expect("x") - right.as_f64().expect("x")).abs();
    assert!((width - 0.1).abs() < 1e-6, "{width}");
}

#[test]
fn open_track_carries_the_pose_in_centimetres_and_degrees() {
    let (mut other, view) = sent_to("opentrack", "--number f64");
    let mut client = view.client();
    client.lead([0.0, 0.07, 0.0], [0.1, 0.2, 0.5], 20);
    let roll = |received: &Value| received["pose"][5].as_f64().expect("a number");
    let received = other.until(|received| (roll(received) - 0.5_f64.to_degrees()).abs() < 1e-9);
    let frame = client.frame(|frame| frame["frame"]["hand"][2] == json!(0.5));
    let (sent, pose) = (numbers(&received["pose"]), numbers(&frame["frame"]["pose"]));
    let expected = [
        pose[0] * 100.0,
        pose[1] * 100.0,
        0.0,
        0.0,
        0.0,
        pose[2].to_degrees(),
    ];
    for (a, b) in sent.iter().zip(expected) {
        assert!((a - b).abs() < 1e-9, "{sent:?} {expected:?}");
    }
}

#[test]
fn the_hand_comes_by_osc() {
    let (mut other, port) = (Other::start("osc"), free_port());
    let view = View::start(&format!("box-flat --osc-in {port}"));
    let mut client = view.client();
    other.send(&json!({"port": port, "hand": [0.01, 0.08, 0.1]}));
    client.state(|state| state["hand"] == json!({"by": "osc", "client": null}));
    client.frame(|frame| frame["frame"]["hand"] == json!([0.01, 0.08, 0.1]));
    let refusal = client.ask(json!({"type": "hand", "pose": [0, 0, 0], "held": true}));
    assert!(refusal.is_err_and(|text| text.contains("osc")));
    other.send(&json!({"port": port, "raw": "00ff"}));
    other.send(&json!({"port": port, "held": 0}));
    client.frame(|frame| frame["frame"]["held"] == false);
}

/// Numbers are numbers: JavaScript sends 0 and 1 as integers, Max and Rust send doubles.
#[test]
fn the_hand_comes_by_osc_in_numbers_of_every_type() {
    let (mut other, port, view) = led_by("osc");
    let mut client = view.client();
    let hand = "/stiction/hand";
    for (types, values) in [
        ("ddd", json!([0.012, 0.08, 0.25])),
        ("iff", json!([0, 0.125, 0.5])),
        ("hdi", json!([0, 0.25, 1])),
        ("iii", json!([0, 1, 0])),
    ] {
        other.send(&json!({"port": port, "address": hand, "types": types, "values": values}));
        let expected = numbers(&values);
        client.frame(|frame| numbers(&frame["frame"]["hand"]) == expected);
    }
    for (types, values, held) in [("F", json!([0]), false), ("d", json!([1.0]), true)] {
        let address = "/stiction/held";
        other.send(&json!({"port": port, "address": address, "types": types, "values": values}));
        if !held {
            client.frame(|frame| frame["frame"]["held"] == false);
        }
    }
}

/// A tracker sends angles of atan2, which jump by a turn at pi.
#[test]
fn the_angle_by_osc_is_unwrapped() {
    let (mut other, port, view) = led_by("osc");
    let mut client = view.client();
    let phi = |angle: f64| angle.sin().atan2(angle.cos());
    for k in 0..=20 {
        let angle = 0.5 * f64::from(k);
        let values = json!([0.0, 0.2, phi(angle)]);
        let sample =
            json!({"port": port, "address": "/stiction/hand", "types": "ddd", "values": values});
        other.send(&sample);
        client.frame(|frame| (numbers(&frame["frame"]["hand"])[2] - angle).abs() < 1e-9);
    }
}

#[test]
fn what_is_dropped_is_reported_once_with_its_reason() {
    let (mut other, port) = (Other::start("osc"), free_port());
    let view = View::with_errors(&format!("box-flat --osc-in {port}"));
    let mut client = view.client();
    let sent = |address: &str, types: &str, values: Value| json!({"port": port, "address": address, "types": types, "values": values});
    for _ in 0..3 {
        other.send(&sent("/stiction/hand", "ff", json!([0.1, 0.2])));
        other.send(&sent("/stiction/hand", "ffff", json!([0.1, 0.2, 0.3, 9.0])));
        other.send(&sent("/stiction/h*", "fff", json!([0.1, 0.2, 0.3])));
        other.send(&sent("/stiction/hand", "ddd", json!([1e30, 0.2, 0.3])));
        other.send(&json!({"port": port, "raw": "00ff"}));
    }
    // The last one is taken: everything before it has been read.
    other.send(&json!({"port": port, "hand": [0.01, 0.08, 0.1]}));
    client.frame(|frame| frame["frame"]["hand"] == json!([0.01, 0.08, 0.1]));
    let errors = view.folder().read("errors.txt");
    for reason in [
        "`/stiction/hand` with the types `ff`, allowed: three numbers",
        "`/stiction/hand` with the types `ffff`",
        "`/stiction/h*`, which is not known",
        "not finite or beyond 1e6",
        "no whole OSC message",
    ] {
        let count = errors.matches(reason).count();
        assert_eq!(count, 1, "{reason}: {errors}");
    }
    assert_eq!(errors.lines().count(), 5, "{errors}");
}

#[test]
fn a_seventh_double_of_open_track_grasps_and_releases() {
    let (mut other, port, view) = led_by("opentrack");
    let mut client = view.client();
    for (switch, held) in [(1.0, true), (0.0, false), (1.0, true)] {
        other.send(&json!({"port": port, "pose": [0.0, 5.0, 0.0, 0.0, 0.0, 0.0, switch]}));
        client.frame(|frame| frame["frame"]["held"] == held);
    }
}

#[test]
fn the_hand_comes_from_open_track() {
    let (mut other, port, view) = led_by("opentrack");
    let mut client = view.client();
    other.send(&json!({"port": port, "pose": [1.0, 8.0, 3.0, 0.0, 0.0, 90.0]}));
    client.state(|state| state["hand"]["by"] == "opentrack");
    let frame = client.frame(|frame| frame["frame"]["depth"] == 0.03);
    let hand = numbers(&frame["frame"]["hand"]);
    let expected = [0.01, 0.08, std::f64::consts::FRAC_PI_2];
    assert!(
        hand.iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-12),
        "{hand:?}"
    );
}
