//! A client written from FRAME.md alone, `board_client.py`, and this crate understand each other.

use crate::examples::examples;
use crate::random::{Random, Store};
use crate::said::Said;
use crate::{bare, encoded};
use std::io::{Read, Write};
use std::net::TcpListener;
use std::path::Path;
use std::process::{Command, Stdio};
use stiction_core::{Axis, Event, Evolution};
use stiction_wire::{
    Decoder, EventSet, Frame, Info, Mode, NumberType, Pose, Report, Sequence, Stepping, Text,
};

/// The client's command, without its arguments.
fn python() -> Command {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../host-sim/examples/board_client.py");
    let mut command = Command::new("python3");
    command.arg("-B").arg(script);
    command
}

/// The client's answers to these lines; `None` without Python.
fn client(option: &str, lines: Vec<String>) -> Option<Vec<String>> {
    let mut command = python();
    command.arg(option);
    let spawned = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let Ok(mut child) = spawned else {
        println!("skipped: no python3");
        return None;
    };
    let mut input = child.stdin.take().expect("piped");
    let writer = std::thread::spawn(move || input.write_all(lines.join("\n").as_bytes()));
    let output = child.wait_with_output().expect("it ends");
    writer.join().expect("no panic").expect("it reads all");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("text");
    Some(text.lines().map(str::to_owned).collect())
}

fn hex(bytes: &[u8]) -> String {
    let bytes = bytes.iter().map(|byte| format!("{byte:02x}"));
    bytes.collect::<Vec<_>>().join(" ")
}

const AXIS: Axis = Axis {
    index: 0,
    negative: false,
};
const INFO: Info<'_> = Info {
    version: [0, 1, 0],
    number: NumberType::F32,
    vertices: 4,
    surfaces: 1,
    corners: 0,
    friction: true,
    weight: true,
    actuators: false,
    longest_frame: 64,
    fastest_tick: 1000,
    budget: u32::MAX,
    stiffest: [f32::INFINITY; 2],
    stiffness: [500.0, 0.5],
    friction_now: [0.5, 0.3],
    memory_now: None,
    mode: Mode {
        evolution: Evolution::Path,
        stepping: Stepping::PerSample,
        plane: [AXIS, Axis { index: 1, ..AXIS }],
        events: false,
        tick_rate: 1000,
        pose_every: 1,
        forces_every: 0,
        health_every: 0,
    },
    name: Text::new("a socket"),
};

/// A board behind a socket: it answers hello, and every sample with the pose of a free body, until the client disconnects.
/// Returns the number of samples received and the number of frames lost.
fn board(listener: &TcpListener) -> (u32, u32) {
    let (mut line, _) = listener.accept().expect("a client");
    let (mut decoder, mut order) = (Decoder::<64>::new(), Sequence::new());
    let (mut sequence, mut samples, mut lost) = (0_u8, 0, 0);
    let mut bytes = [0; 256];
    while let Ok(n @ 1..) = line.read(&mut bytes) {
        for &byte in &bytes[..n] {
            let Some(frame) = decoder.push::<stiction_wire::Command>(byte) else {
                continue;
            };
            let frame = frame.expect("an undamaged frame");
            lost += u32::from(order.lost_before(frame.sequence));
            let message = match frame.message {
                stiction_wire::Command::Hand(hand) => {
                    samples += 1;
                    let events = EventSet::of(if samples == 1 { &[Event::Touch] } else { &[] });
                    let (position, sample) = (hand.position, frame.sequence);
                    Report::Pose(Pose {
                        position,
                        events,
                        sample,
                        ..Pose::default()
                    })
                }
                stiction_wire::Command::Hello => Report::Info(INFO),
                other => panic!("{other:?}"),
            };
            // The client may have disconnected.
            let _ = line.write_all(&encoded(&Frame {
                sequence,
                time: frame.time,
                message,
            }));
            sequence = sequence.wrapping_add(1);
        }
    }
    (samples, lost)
}

#[test]
fn client_talks_with_a_board_behind_a_socket() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = format!("tcp:{}", listener.local_addr().expect("bound"));
    let mut command = python();
    let spawned = command
        .args([&address, "0.5"])
        .stdout(Stdio::piped())
        .spawn();
    let Ok(child) = spawned else {
        return;
    };
    let (samples, lost) = board(&listener);
    let output = child.wait_with_output().expect("it ends");
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(
        output.status.success() && text.ends_with("faults: none\n"),
        "{text}"
    );
    assert!(
        text.contains("'name': 'a socket'") && text.contains("non-contact touch"),
        "{text}"
    );
    assert!(samples > 20 && lost == 0, "{samples} samples, {lost} lost");
}

/// Frames and their content: the examples, and random ones.
fn frames() -> (Vec<String>, Vec<Said>) {
    let mut random = Random(4);
    let mut frames: Vec<_> = examples()
        .into_iter()
        .map(|(wire, said)| (hex(&wire), said))
        .collect();
    for i in 0..4000 {
        let store = Store::fill(&mut random, if i % 50 == 0 { 255 } else { 12 });
        let frame = store.frame(&mut random);
        frames.push((hex(&frame.encoded()), Said::of(&frame)));
    }
    frames.into_iter().unzip()
}

#[test]
fn client_reads_what_this_crate_sends() {
    let (lines, said) = frames();
    let Some(answers) = client("--decode", lines) else {
        return;
    };
    assert_eq!(answers.len(), said.len());
    for (answer, said) in answers.iter().zip(&said) {
        let answer: serde_json::Value = serde_json::from_str(answer).expect("JSON");
        let messages = answer["messages"].as_array().expect("a list");
        let [message] = messages.as_slice() else {
            panic!("{said:?}: {answer}");
        };
        assert_eq!(
            &Said::from_json(message.as_object().expect("an object")),
            said
        );
    }
}

#[test]
fn client_sends_what_this_crate_sends() {
    let (lines, said) = frames();
    let json = said.iter().map(|said| said.to_json().to_string()).collect();
    if let Some(answers) = client("--encode", json) {
        // If a frame ends with a block of 254 bytes, COBS may end it with or without a code byte.
        let same =
            |a: &str, b: &str| a == b || a.replace(" 01 00", " 00") == b.replace(" 01 00", " 00");
        assert_eq!(answers.len(), lines.len());
        for (answer, line) in answers.iter().zip(&lines) {
            assert!(same(answer, line), "{answer}\n{line}");
        }
    }
}

#[test]
fn client_finds_the_same_faults() {
    let mut random = Random(5);
    let mut lines = Vec::new();
    let mut faults = Vec::new();
    for i in 0..20_000 {
        let store = Store::fill(&mut random, 4);
        let frame = store.frame(&mut random);
        if frame.to_board() {
            continue;
        }
        let wire = frame.encoded();
        let mut raw = bare(&wire);
        let place = random.below(raw.len());
        match i % 3 {
            0 => raw.truncate(place),
            1 => raw[place] = random.byte(),
            _ => raw.insert(place, random.byte()),
        }
        // A message type of the other direction is a fault in a board's reports, but not for this client.
        if raw.get(1).is_some_and(|kind| *kind < 0x80) || raw.is_empty() {
            continue;
        }
        let wire = crate::sealed(&raw);
        let fault = crate::decoded(&wire, false, |received| {
            received.err().map(|fault| fault.kind.name())
        });
        lines.push(hex(&wire));
        faults.push(fault);
    }
    let Some(answers) = client("--decode", lines) else {
        return;
    };
    for (answer, fault) in answers.iter().zip(faults) {
        let answer: serde_json::Value = serde_json::from_str(answer).expect("JSON");
        let found = answer["faults"]
            .as_object()
            .expect("an object")
            .keys()
            .next();
        assert_eq!(found.map(String::as_str), fault, "{answer}");
    }
}
