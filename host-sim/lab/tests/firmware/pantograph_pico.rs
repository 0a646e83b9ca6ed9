//! A pantograph at the pins of the emulated Pico, by the drawing of its wiring: the hand moves the drawn encoders, and the drawn motors
//! push back by the force of the statics.

use crate::bench::Bench;
use crate::chip::PICO_PANTOGRAPH;
use crate::wiring::{Driver, Pins, Tracks, turn};
use std::f64::consts::TAU;
use stiction_firmware::devices::pantograph::{GEOMETRY, LIMITS, MOTORS, TURN_PICO_US, passivity};
use stiction_tests::pantograph::{reference, transposed};
use stiction_tests::station::client::Said;
use stiction_wire::{Command, Mode};

const JOINTS: [&str; 3] = ["Left", "Right", "Handle"];
/// The hand holds the box of the scene so high above the floor (m), with so many N/m and N·m/rad.
const HELD: f64 = 0.05;
const STIFFNESS: f64 = 120.0;
const STIFFNESS_ROTATION: f64 = 0.12;

/// The joints by what their encoders show (rad).
fn angles(tracks: &[Tracks; 3]) -> [f64; 3] {
    std::array::from_fn(|joint| {
        let encoder = &GEOMETRY.encoders[joint];
        let turns = f64::from(tracks[joint].count) / f64::from(encoder.counts_per_turn);
        f64::from(encoder.offset) + turns * TAU
    })
}

#[test]
fn a_pantograph_at_the_drawn_pins_gives_the_force_of_the_statics() {
    let Some(mut bench) = Bench::start(&PICO_PANTOGRAPH) else {
        return;
    };
    let passivity = passivity(TURN_PICO_US).at_period(LIMITS.period_us);
    let [passive, _] = passivity.bounds();
    assert!(STIFFNESS < f64::from(passive), "the board starts");
    let pins = Pins::drawn("pantograph.svg");
    let mut tracks = JOINTS.map(|joint| Tracks::new(&pins, &format!("{joint} encoder")));
    let drivers = JOINTS.map(|joint| Driver::new(&pins, &format!("{joint} driver")));
    let hold = 1 << pins.of("Hold switch", "hold");
    bench.done(Command::Mode(Mode {
        forces_every: 10,
        ..Mode::DEFAULT
    }));
    // Straight down; to the side; the handle, too. Flat on the floor, the box bears all that presses and turns.
    for to in [[-320, 320, 0], [-340, 300, 0], [-320, 320, 40]] {
        turn(&mut bench, &mut tracks, &to);
        let wrench = bench.wait(|said| match said {
            Said::Forces { feedback, .. } => Some(*feedback),
            _ => None,
        });
        let q = angles(&tracks);
        let [_, y, phi] = reference(&GEOMETRY, q);
        let wanted = transposed(&GEOMETRY, q, &wrench);
        for (joint, driver) in drivers.iter().enumerate() {
            let full = f64::from(MOTORS[joint].full_torque());
            let (duty, step) = (driver.duty(&mut bench), driver.step(&mut bench));
            assert!(
                (duty * full - wanted[joint]).abs() < 1.5 * step * full + 1e-5,
                "{to:?} {joint}: {duty} {wanted:?}"
            );
        }
        let (up, moment) = (f64::from(wrench.force[1]), f64::from(wrench.moment));
        let pressed = STIFFNESS * (HELD - y);
        assert!(pressed > 0.3 && up < f64::from(LIMITS.force));
        assert!((up / pressed - 1.0).abs() < 1e-3, "{up} N of {pressed} N");
        assert!((moment + STIFFNESS_ROTATION * phi).abs() < 1e-4, "{moment}");
    }
    // Let go, no motor drives.
    bench.chip.set_pins(hold, hold);
    turn(&mut bench, &mut tracks, &[-320, 320, 40]);
    let duties = drivers.each_ref().map(|driver| driver.duty(&mut bench));
    assert_eq!(duties.map(f64::abs), [0.0; 3]);
}
