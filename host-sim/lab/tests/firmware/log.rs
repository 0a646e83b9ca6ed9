//! The log of a board as a user sees it, against `golden/BOARD.log`: power-up, a hand that presses once and is silent, damaged
//! frames, a reset.
//!
//! Values that depend on the speed of this machine are left out: in counts, ticks, times and unsent frames are `#`; and counts
//! are reported only where the client waits for them. A hand presses with one sample: its force is on until silence ends it.

use crate::chip::{Chip, F405, MICROBIT};
use crate::session::Session;
use std::fs;
use std::path::Path;
use stiction_core::Hand;
use stiction_tests::station::client::Client;
use stiction_wire::{Command, Reset};

/// The counts of a second.
const COUNTS: &str = "ticks: ";
/// The text before each number in them that depends on the speed of this machine.
const TIMED: [&str; 4] = [
    "ticks: ",
    " missed, longest ",
    " longest turn ",
    " faulty, ",
];

struct Transcript {
    session: Session,
    client: Client,
    text: String,
}

impl Transcript {
    fn note(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Sends bytes; the transcript says what they are.
    fn act(&mut self, what: &str, bytes: &[u8]) {
        self.note(&format!("> {what}"));
        self.session.send(bytes);
    }

    /// The log up to a line, without counts.
    fn events(&mut self, last: &str) {
        loop {
            let line = self.session.line();
            if line.starts_with(COUNTS) {
                continue;
            }
            self.note(&line);
            if line == last {
                return;
            }
        }
    }

    /// The next line, which is one of counts.
    fn counts(&mut self) {
        let line = self.session.line();
        assert!(line.starts_with(COUNTS), "{line}");
        self.note(&untimed(&line));
    }

    fn press(&mut self) -> Vec<u8> {
        self.client
            .encode(Command::Hand(Hand::new(0.0, 0.045, 0.0)))
    }
}

/// Counts with `#` in place of each number that depends on the speed of this machine.
fn untimed(line: &str) -> String {
    let mut text = line.to_owned();
    for before in TIMED {
        let (head, rest) = text.split_once(before).expect("a line of counts");
        let rest = rest.trim_start_matches(|c: char| c.is_ascii_digit());
        text = format!("{head}{before}#{rest}");
    }
    text
}

fn whole_session(chip: &Chip) -> Option<String> {
    let mut transcript = Transcript {
        session: Session::start(chip)?,
        client: Client::default(),
        text: String::new(),
    };
    transcript.events("force: off");
    transcript.counts();

    let bytes = [transcript.client.encode(Command::Hello), transcript.press()].concat();
    transcript.act("hello, a sample of the hand", &bytes);
    transcript.events("force: off");
    transcript.counts();

    let mut bytes = Vec::new();
    for _ in 0..3 {
        let mut frame = transcript.press();
        // A bit of the sample; no byte of it becomes the end of a frame.
        frame[8] ^= if frame[8] == 1 { 2 } else { 1 };
        bytes.extend(frame);
    }
    bytes.extend(transcript.press());
    transcript.act("three damaged samples, a good one", &bytes);
    transcript.events("force: off");
    transcript.counts();

    let bytes = transcript.client.encode(Command::Reset(Reset::Everything));
    transcript.act("reset of everything", &bytes);
    transcript.events("everything reset");
    transcript.counts();
    Some(transcript.text)
}

fn log_is_golden(chip: &Chip) {
    let Some(text) = whole_session(chip) else {
        return;
    };
    let golden = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/firmware/golden")
        .join(chip.name())
        .with_extension("log");
    let golden = fs::read_to_string(golden).unwrap();
    assert_eq!(text, golden, "{}:\n{text}", chip.name());
}

#[test]
fn the_f405_logs_what_happens() {
    log_is_golden(&F405);
}

#[test]
fn the_microbit_logs_what_happens() {
    log_is_golden(&MICROBIT);
}
