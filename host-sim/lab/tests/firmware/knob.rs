//! A knob at the pins of the emulated Pico, by the drawing of its wiring: what turns at the drawn encoder pins gives the force of the statics
//! at the drawn motor pins.

use crate::bench::Bench;
use crate::chip::KNOB;
use crate::wiring::{Driver, Pins, Tracks, turn};
use stiction_firmware::devices::knob::PASSIVITY;
use stiction_tests::station::client::Said;
use stiction_wire::{Command, Mode};

#[test]
fn a_knob_at_the_drawn_pins_gives_the_force_of_the_statics() {
    let Some(mut bench) = Bench::start(&KNOB) else {
        return;
    };
    let pins = Pins::drawn("knob.svg");
    let mut tracks = [Tracks::new(&pins, "Encoder")];
    let driver = Driver::new(&pins, "Motor driver");
    bench.done(Command::Mode(Mode {
        forces_every: 10,
        health_every: 100,
        ..Mode::DEFAULT
    }));
    for to in [40, 90, -90, 0] {
        turn(&mut bench, &mut tracks, &[to]);
        let wrench = bench.wait(|said| match said {
            Said::Forces { feedback, .. } => Some(*feedback),
            _ => None,
        });
        // r F of 0.06 N·m at full duty.
        let torque = 0.015 * f64::from(wrench.force[0]);
        let (duty, step) = (driver.duty(&mut bench), driver.step(&mut bench));
        assert!((duty * 0.06 - torque).abs() < 1.5 * 0.06 * step);
        // What turns further pulls back.
        assert!(to.abs() < 90 || torque * f64::from(to) < 0.0);
        let x = f64::from(to) / 2_400.0 * std::f64::consts::TAU * 0.015;
        if to == 40 {
            // Where the tool sticks, it pushes back by the stiffnesses of the grip and of the tilt in series: 350 N/m, and 0.5 N·m/rad
            // less the force of 5.5 mm that presses the 40 mm of the tool together, by the square of its length.
            let tilt = (0.5 - 350.0 * 0.0055 * 0.04) / (0.04 * 0.04);
            let wanted = -x / (1.0 / 350.0 + 1.0 / tilt);
            let force = f64::from(wrench.force[0]);
            // The square of the tilt, 0.02 rad, is left out.
            assert!((force / wanted - 1.0).abs() < 0.002, "{force} N at {x} m");
        }
    }
    // Turned at 0.8 m/s it slips on and on. No turn is longer than the bound of its stiffness assumes.
    for to in [1_000, -1_000, 1_000, 0] {
        turn(&mut bench, &mut tracks, &[to]);
    }
    let health = bench.health();
    println!("{health:?}");
    let longest_us = f64::from(health.worst_tick) * 1e-3;
    assert!(
        longest_us <= f64::from(PASSIVITY.turn_us),
        "{longest_us} µs"
    );
}
