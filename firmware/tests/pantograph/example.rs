//! The example device: every number can be used, and it can display its scene on every board.

use stiction_core::{Angle, Real, Wrench};
use stiction_firmware::device::{Controller, Settings};
use stiction_firmware::devices::pantograph::{
    GEOMETRY, LIMITS, MOTORS, TURN_F405_US, TURN_PICO_2_US, TURN_PICO_US, passivity,
};
use stiction_firmware::pantograph::Kinematics;
use stiction_scene::WrittenScene;

#[test]
fn every_number_can_be_used() {
    GEOMETRY.check().unwrap();
    for motor in MOTORS {
        motor.check().unwrap();
    }
    LIMITS.check().unwrap();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/pantograph.toml");
    let scene = WrittenScene::read(file.as_ref(), f64::from(f32::MAX)).unwrap();
    for turn_us in [TURN_F405_US, TURN_PICO_US, TURN_PICO_2_US] {
        let passivity = passivity(turn_us);
        passivity.check().unwrap();
        let settings = Settings {
            limits: LIMITS,
            passivity: Some(passivity.at_period(LIMITS.period_us)),
            ..Settings::default()
        };
        scene.described::<f32, _>(|scene| Controller::<f32, 8, 4>::new(scene, &settings).unwrap());
    }
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
