//! A board that receives arbitrary bytes: its force stays finite and within its limits and becomes zero after silence, and
//! a client accepts everything that it sends.

use std::collections::VecDeque;

use stiction_core::{Description, Fixed, Real};
use stiction_firmware::device::{FromLine, NoActuators, Servo};
use stiction_firmware::safety::Limits;
use stiction_firmware::station::{Link, Setup, Station};
use stiction_tests::station::BOX;
use stiction_wire::{Decoder, Mode, NumberType, Report, Sequence, frame_bytes, scene_bytes};

const V: usize = 8;
const S: usize = 2;
const ROOM: usize = frame_bytes(scene_bytes([V, S, 0, 0]));
/// For a board with capacity for obstacles.
const ROOM_AMONG: usize = frame_bytes(scene_bytes([V, S, CORNERS, CORNERS]));
const CORNERS: usize = 9;
/// Further bytes are ignored.
const LONGEST_TRAFFIC: usize = 8192;

const fn board(number: NumberType) -> Setup {
    Setup {
        name: "fuzzed",
        number,
        line_rate: 1_000_000,
        fastest_tick: 1_000,
        // Too little for the most expensive steps: bodies lag behind their hands.
        work_rate: 400_000,
        limits: Limits::DEFAULT,
        passivity: None,
        mode: Mode::DEFAULT,
        scene: Description { reach: 0.0, ..BOX },
        knob: None,
    }
}

static SINGLE: Setup = board(NumberType::F32);
static FIXED: Setup = board(NumberType::Fixed);

/// A board that computes in f32, or else in fixed point, with room for obstacles or without.
pub(crate) fn receives(traffic: &[u8], is_single: bool, is_among: bool) {
    match (is_single, is_among) {
        (true, false) => follow::<f32, 0, ROOM>(&SINGLE, traffic),
        (true, true) => follow::<f32, CORNERS, ROOM_AMONG>(&SINGLE, traffic),
        (false, false) => follow::<Fixed, 0, ROOM>(&FIXED, traffic),
        (false, true) => follow::<Fixed, CORNERS, ROOM_AMONG>(&FIXED, traffic),
    }
}

fn follow<R: Real<Si = f32>, const C: usize, const N: usize>(
    setup: &'static Setup,
    traffic: &[u8],
) {
    let station = Station::<R, V, S, C, N>::new(setup);
    let mut station = station.expect("a sound setup");
    let mut line = Line::new(traffic);
    let (mut now_us, limits) = (0u32, &setup.limits);
    let (mut tick, mut servo) = (0u32, Servo::new((FromLine, NoActuators)));
    // Until everything is received, and then for as long as the longest silence in which a force may remain.
    let mut left = 1 + limits.silence_us / limits.period_us;
    while left > 0 {
        now_us = now_us.wrapping_add(limits.period_us);
        tick += 1;
        let wrench = station.tick(now_us, &mut line, &mut servo);
        let [x, y] = wrench.force;
        // Rounding errors are allowed.
        let within = |size: f32, limit: f32| size <= limit * (1.0 + 1e-6);
        assert!(within(x.hypot(y), limits.force), "{wrench:?} at {tick}");
        assert!(
            within(wrench.moment.abs(), limits.moment),
            "{wrench:?} at {tick}"
        );
        if line.came.is_empty() {
            left -= 1;
            assert!(
                left > 0 || (wrench.force, wrench.moment) == ([0.0; 2], 0.0),
                "a force in silence: {wrench:?}"
            );
        }
        line.hear();
    }
}

/// The line of a board: the bytes still to come, and the client at its other end.
struct Line {
    came: VecDeque<u8>,
    said: Vec<u8>,
    client: Decoder<512>,
    sequence: Sequence,
}

impl Line {
    fn new(traffic: &[u8]) -> Self {
        let traffic = &traffic[..traffic.len().min(LONGEST_TRAFFIC)];
        Self {
            came: traffic.iter().copied().collect(),
            said: Vec::new(),
            client: Decoder::new(),
            sequence: Sequence::new(),
        }
    }

    /// The client receives what the board has sent: whole frames, none lost.
    fn hear(&mut self) {
        for byte in self.said.drain(..) {
            let Some(received) = self.client.push::<Report>(byte) else {
                continue;
            };
            let frame = received.expect("a client accepts what a board sends");
            assert_eq!(self.sequence.lost_before(frame.sequence), 0);
        }
    }
}

impl Link for Line {
    fn take(&mut self) -> Option<u8> {
        self.came.pop_front()
    }

    fn send(&mut self, frame: &[u8]) -> bool {
        self.said.extend_from_slice(frame);
        true
    }

    fn now_ns(&mut self) -> u32 {
        0
    }
}
