//! Torques to duties and directions.

use crate::bench::Bench;
use stiction_firmware::pantograph::{Motor, MotorConstants, MotorFault, Motors};

pub(crate) const MOTOR: MotorConstants = MotorConstants {
    torque_constant: 0.05,
    full_current: 4.0, // 0.2 N·m at full duty
    torque_limit: 0.1,
    reversed: false,
};

pub(crate) fn motor() -> (Bench, Motor<Bench, Bench>) {
    let bench = Bench::default();
    (
        bench.clone(),
        Motor::new(bench.clone(), bench, MOTOR).unwrap(),
    )
}

#[test]
pub(crate) fn a_torque_is_a_duty_and_a_direction() {
    let (bench, mut motor) = motor();
    let mut given = |torque| {
        motor.turn(torque).unwrap();
        (*bench.duty.borrow(), *bench.high.borrow())
    };
    assert_eq!(given(0.05), (2_100, false));
    assert_eq!(given(-0.05), (2_100, true));
    assert_eq!(given(-5.0), (4_200, true)); // the limit
    assert_eq!(given(f32::MIN), (4_200, true));
    assert_eq!(given(0.1), (4_200, false));
    assert_eq!(given(-0.0), (0, false));
    for bad in [f32::NAN, f32::INFINITY] {
        motor.turn(0.05).unwrap();
        assert_eq!(motor.turn(bad), Err(MotorFault::NotFinite));
        assert_eq!(*bench.duty.borrow(), 0);
    }
    motor.turn(0.05).unwrap();
    *bench.broken.borrow_mut() = true;
    assert_eq!(motor.turn(0.01), Err(MotorFault::Pwm));
    assert_eq!(*bench.duty.borrow(), 0);
}

#[test]
pub(crate) fn motors_beyond_their_limit_keep_the_direction_of_the_torques() {
    let ((a, left), (b, right), (c, handle)) = (motor(), motor(), motor());
    let mut motors = (left, right, handle);
    motors.turn([0.2, -0.05, 0.02]).unwrap();
    let duties = [&a, &b, &c].map(|bench| *bench.duty.borrow());
    assert_eq!(duties, [4_200, 1_050, 420]);
    assert!(!*a.high.borrow() && *b.high.borrow());
    // One that fails turns off the others.
    *b.broken.borrow_mut() = true;
    assert_eq!(motors.turn([0.1, -0.05, 0.02]), Err(MotorFault::Pwm));
    assert_eq!([&a, &b, &c].map(|bench| *bench.duty.borrow()), [0, 0, 0]);
    assert_eq!(
        motors.turn([f32::NAN, 0.0, 0.0]),
        Err(MotorFault::NotFinite)
    );
    *b.broken.borrow_mut() = false;
    motors.turn([0.1, 0.1, 0.1]).unwrap();
    Motors::off(&mut motors);
    assert_eq!([&a, &b, &c].map(|bench| *bench.duty.borrow()), [0, 0, 0]);
}
