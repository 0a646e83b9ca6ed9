//! The drawings of what is wired to a Pico, and their parts at the pins of the emulated one: encoders that are turned, motors that are
//! looked at.

use crate::bench::{Bench, MS};
use regex::Regex;
use std::collections::BTreeMap;
use std::fs;
use stiction_host_sim::firmware::workspace;

const OUTPUTS: u32 = 0xD000_0010;

/// The pins of a drawing: of a part and its wire, the number behind GP.
pub(crate) struct Pins(BTreeMap<(String, String), u32>);

impl Pins {
    /// Every wire ends at the pin by whose name it is called.
    pub(crate) fn drawn(name: &str) -> Self {
        let text = fs::read_to_string(workspace().join("firmware/wiring").join(name)).unwrap();
        let pin =
            Regex::new(r#"<text class="pin[^"]*" x="(\d+)" y="(\d+)"[^>]*>(\w+)</text>"#).unwrap();
        let places: Vec<(u32, u32, String)> = pin
            .captures_iter(&text)
            .map(|c| {
                (
                    c[1].parse().unwrap(),
                    c[2].parse().unwrap(),
                    c[3].to_owned(),
                )
            })
            .collect();
        assert_eq!(places.len(), 40);
        let wire = Regex::new(
            r#"<path class="wire"[^>]* V(\d+) H(\d+)"/>\s*<text [^>]*data-of="([^"]+)">([^—]+) — (\w+)</text>"#,
        )
        .unwrap();
        let mut pins = BTreeMap::new();
        for c in wire.captures_iter(&text) {
            let (y, x): (u32, u32) = (c[1].parse().unwrap(), c[2].parse().unwrap());
            // A label is next to its pin.
            let end = places
                .iter()
                .find(|p| p.0.abs_diff(x) == 10 && p.1 == y + 4);
            let (_, _, name) = end.unwrap_or_else(|| panic!("{}: no pin at its end", &c[0]));
            assert_eq!(name, &c[5], "{}", &c[0]);
            if let Some(number) = name.strip_prefix("GP") {
                let key = (c[3].to_owned(), c[4].to_owned());
                pins.insert(key, number.parse().unwrap());
            }
        }
        Self(pins)
    }

    pub(crate) fn of(&self, part: &str, wire: &str) -> u32 {
        self.0[&(part.to_owned(), wire.to_owned())]
    }
}

pub(crate) struct Tracks {
    a: u32,
    b: u32,
    pub(crate) count: i32,
}

impl Tracks {
    pub(crate) fn new(pins: &Pins, part: &str) -> Self {
        let [a, b] = ["A", "B"].map(|wire| pins.of(part, wire));
        Self { a, b, count: 0 }
    }

    /// Goes one step nearer to a count: of the tracks, which are a quarter of a line apart, one changes. Where A leads, it counts down.
    fn step(&mut self, bench: &mut Bench, to: i32) {
        const STATES: [(u32, u32); 4] = [(0, 0), (0, 1), (1, 1), (1, 0)];
        self.count += (to - self.count).signum();
        let (a, b) = STATES[self.count.rem_euclid(4) as usize];
        let mask = 1 << self.a | 1 << self.b;
        bench.chip.set_pins(mask, a << self.a | b << self.b);
    }
}

/// Turns encoders to counts, a step of each every 50 µs, and lets the force come: 5 N take 50 ms, and the solver may be behind.
pub(crate) fn turn(bench: &mut Bench, tracks: &mut [Tracks], to: &[i32]) {
    while tracks.iter().zip(to).any(|(one, &to)| one.count != to) {
        for (one, &to) in tracks.iter_mut().zip(to) {
            one.step(bench, to);
        }
        bench.chip.run(MS / 20);
    }
    for _ in 0..200 {
        bench.pass();
    }
    bench.client.inbox.clear();
}

pub(crate) struct Driver {
    pwm: u32,
    direction: u32,
}

impl Driver {
    pub(crate) fn new(pins: &Pins, part: &str) -> Self {
        let [pwm, direction] = ["PWM", "direction"].map(|wire| pins.of(part, wire));
        // Even pins are the first channels of their slices (RP2040 datasheet, 4.5.2).
        assert_eq!(pwm % 2, 0);
        Self { pwm, direction }
    }

    /// Of the slice of the PWM pin, the duty of the first channel (CC) and the counts of a period, less one (TOP).
    fn register(&self, bench: &mut Bench, offset: u32) -> u32 {
        bench
            .chip
            .word(0x4005_0000 + 0x14 * (self.pwm / 2 % 8) + offset)
    }

    /// A step of the duty, in parts of full duty.
    pub(crate) fn step(&self, bench: &mut Bench) -> f64 {
        1.0 / f64::from(self.register(bench, 0x10) + 1)
    }

    /// The duty, negative where the direction is high.
    pub(crate) fn duty(&self, bench: &mut Bench) -> f64 {
        let duty = f64::from(self.register(bench, 0xC) & 0xFFFF) * self.step(bench);
        let is_high = bench.chip.word(OUTPUTS) >> self.direction & 1 != 0;
        if is_high { -duty } else { duty }
    }
}
