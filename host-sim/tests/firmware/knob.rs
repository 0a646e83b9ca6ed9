//! The devices at the pins of the emulated Pico, by the drawings of their wiring: what turns at the drawn encoder pins gives the force
//! of the statics at the drawn motor pins.
#![cfg(feature = "cycles")]

use crate::bench::{Bench, MS};
use crate::chip::KNOB;
use crate::client::Said;
use regex::Regex;
use std::collections::BTreeMap;
use std::fs;
use stiction_core::frame::{Command, Mode};
use stiction_tools::workspace;

/// Registers: what the pins of the program drive, and of a slice of the PWM the duty of its first channel and the counts of a period.
const OUTPUTS: u32 = 0xD000_0010;
const fn duty(slice: u32) -> u32 {
    0x4005_000C + 0x14 * slice
}
const fn top(slice: u32) -> u32 {
    0x4005_0010 + 0x14 * slice
}

/// The pins of a drawing: of a part and its wire, the number behind GP. Every wire ends at the pin by whose name it is called.
fn drawn(name: &str) -> BTreeMap<(String, String), u32> {
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
    pins
}

/// An encoder at two pins.
struct Tracks {
    a: u32,
    b: u32,
    count: i32,
}

impl Tracks {
    fn new(pins: &BTreeMap<(String, String), u32>, part: &str) -> Self {
        let pin = |wire: &str| pins[&(part.to_owned(), wire.to_owned())];
        let (a, b) = (pin("A"), pin("B"));
        Self { a, b, count: 0 }
    }

    /// Goes one step: of the tracks, which are a quarter of a line apart, one changes. Where A leads, it counts down.
    fn step(&mut self, bench: &mut Bench, up: bool) {
        const STATES: [(u32, u32); 4] = [(0, 0), (0, 1), (1, 1), (1, 0)];
        self.count += if up { 1 } else { -1 };
        let (a, b) = STATES[self.count.rem_euclid(4) as usize];
        let mask = 1 << self.a | 1 << self.b;
        bench.chip.set_pins(mask, a << self.a | b << self.b);
    }
}

/// Turns to a count, a step every 50 µs, and lets the force come: 3.3 N take 33 ms.
fn turn(bench: &mut Bench, tracks: &mut Tracks, to: i32) {
    while tracks.count != to {
        tracks.step(bench, tracks.count < to);
        bench.chip.run(MS / 20);
    }
    for _ in 0..50 {
        bench.pass();
    }
    bench.client.heard.clear();
}

#[test]
fn a_knob_at_the_drawn_pins_gives_the_force_of_the_statics() {
    let Some(mut bench) = Bench::start(&KNOB) else {
        return;
    };
    let pins = drawn("knob.svg");
    let mut tracks = Tracks::new(&pins, "Encoder");
    let pwm = pins[&("Motor driver".to_owned(), "PWM".to_owned())];
    let direction = pins[&("Motor driver".to_owned(), "direction".to_owned())];
    // GP16 is the first channel of slice 0.
    assert_eq!(pwm, 16);
    let period = f64::from(bench.chip.word(top(0)) + 1);
    bench.done(Command::Mode(Mode {
        forces_every: 10,
        ..Mode::DEFAULT
    }));
    for to in [40, 90, -90, 0] {
        turn(&mut bench, &mut tracks, to);
        let wrench = bench.wait(|said| match said {
            Said::Forces { feedback, .. } => Some(*feedback),
            _ => None,
        });
        // r F of 0.06 N·m at full duty.
        let torque = 0.015 * f64::from(wrench.force[0]);
        let duty = f64::from(bench.chip.word(duty(0)) & 0xFFFF);
        assert!((duty / period * 0.06 - torque.abs()).abs() < 1.5 * 0.06 / period);
        if duty > 0.0 {
            let is_high = bench.chip.word(OUTPUTS) >> direction & 1 != 0;
            assert_eq!(is_high, torque < 0.0);
        }
        let x = f64::from(to) / 2_400.0 * std::f64::consts::TAU * 0.015;
        if to == 40 {
            // Where the tool sticks, it pushes back by the stiffnesses of the grip and of the tilt in series: 500 N/m, and 0.5 N·m/rad
            // less the 2 N that press the 40 mm of the tool together, by the square of its length.
            let tilt = (0.5 - 2.0 * 0.04) / (0.04 * 0.04);
            let wanted = -x / (1.0 / 500.0 + 1.0 / tilt);
            let force = f64::from(wrench.force[0]);
            // The square of the tilt, 0.02 rad, is left out.
            assert!((force / wanted - 1.0).abs() < 0.002, "{force} N at {x} m");
        }
    }
}
