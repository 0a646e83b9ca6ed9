//! The device at the Olimex board, every number can be used, and the device can display the scene of the board.

use crate::with;
use stiction_core::{Angle, Real, Wrench};
use stiction_firmware::device::{Controller, Settings};
use stiction_firmware::devices::pantograph::{GEOMETRY, LIMITS, MOTORS, PASSIVITY};
use stiction_firmware::pantograph::Kinematics;
use stiction_scene::WrittenScene;

#[test]
fn every_number_can_be_used() {
    GEOMETRY.check().unwrap();
    for motor in MOTORS {
        motor.check().unwrap();
    }
    LIMITS.check().unwrap();
    let passivity = PASSIVITY.unwrap();
    passivity.check().unwrap();
    // b > K T / 2: 0.5 N·s/m and 0.0005 N·m·s/rad at 1 kHz.
    let [along, round] = with(passivity, |passivity| passivity.hold_us = 1_000).bounds();
    assert!(along == 1_000.0 && (round - 1.0).abs() < 1e-6);
    let settings = Settings {
        limits: LIMITS,
        passivity: PASSIVITY,
        ..Settings::default()
    };
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/board.toml");
    let scene = WrittenScene::read(file.as_ref(), f64::from(f32::MAX)).unwrap();
    scene.described::<f32, _>(|scene| Controller::<f32, 8, 4>::new(scene, &settings).unwrap());
}

#[test]
fn at_home_the_mechanism_gives_its_largest_force_in_every_direction() {
    let home = GEOMETRY
        .encoders
        .map(|encoder| Angle::from_radians(encoder.offset));
    let kinematics = Kinematics::new(&GEOMETRY).unwrap();
    let configuration = kinematics.solve(&home).unwrap();
    for i in 0..8u8 {
        let (sin, cos) = Real::sin_cos(core::f32::consts::FRAC_PI_4 * f32::from(i));
        let force = [LIMITS.force * cos, LIMITS.force * sin];
        let wrench = Wrench {
            force,
            moment: LIMITS.moment,
        };
        let torques = configuration.torques(&wrench).unwrap();
        for (torque, motor) in torques.into_iter().zip(MOTORS) {
            assert!(torque.abs() <= motor.torque_limit, "{force:?}: {torque}");
        }
    }
}
