//! A board with the example device on this machine: the inverse kinematics from a hand to the encoders, and the torques of the motors.

use super::rig::{Rig, setup};
use crate::bench::Bench;
use std::cell::RefCell;
use std::f64::consts::TAU;
use std::rc::Rc;
use stiction_core::Wrench;
use stiction_firmware::devices::pantograph::{GEOMETRY, LIMITS, MOTORS, passivity};
use stiction_firmware::pantograph::{Counters, Motor, Pantograph};

/// The values of encoders and switch.
#[derive(Clone, Debug)]
pub(crate) struct Shown {
    pub(crate) counts: Option<[u16; 3]>,
    pub(crate) held: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Encoders(Rc<RefCell<Shown>>);

impl Counters for Encoders {
    fn counts(&mut self) -> Option<[u16; 3]> {
        self.0.borrow().counts
    }
    fn held(&mut self) -> bool {
        self.0.borrow().held
    }
}

pub(crate) type Motors = (
    Motor<Bench, Bench>,
    Motor<Bench, Bench>,
    Motor<Bench, Bench>,
);
pub(crate) type Device = Pantograph<Encoders, Motors>;

/// A hand at the handle of a mechanism at a board.
pub(crate) struct Bed {
    pub(crate) rig: Rig<f32, 0, Device>,
    pub(crate) shown: Rc<RefCell<Shown>>,
    pub(crate) motors: [Bench; 3],
    /// Counts of the joints since home.
    joints: [i32; 3],
}

impl Bed {
    /// Switched on in the home position.
    pub(crate) fn new() -> Self {
        let shown = Rc::new(RefCell::new(Shown {
            counts: Some([65_000, 0, 7]),
            held: true,
        }));
        let motors: [Bench; 3] = Default::default();
        let [a, b, c] = [0, 1, 2].map(|i| {
            let (pwm, pin) = (motors[i].clone(), motors[i].clone());
            Motor::new(pwm, pin, MOTORS[i]).unwrap()
        });
        let device = Pantograph::new(&GEOMETRY, Encoders(shown.clone()), (a, b, c)).unwrap();
        let setup = stiction_firmware::station::Setup {
            limits: LIMITS,
            // Turns take no time here.
            passivity: Some(passivity(0)),
            ..setup()
        };
        Self {
            rig: Rig::with(setup, device),
            shown,
            motors,
            joints: [0; 3],
        }
    }

    /// The hand moves the handle there, by the inverse kinematics: elbows outwards.
    pub(crate) fn place(&mut self, [x, y, phi]: [f64; 3]) {
        let g = &GEOMETRY;
        let [ox, oy] = g.origin.map(f64::from);
        let half = f64::from(g.base) / 2.0;
        let arm = |i: usize, side: f64| {
            let (dx, dy) = (x - (ox - side * half), y - oy);
            let (l, r, far) = (
                f64::from(g.proximal[i]),
                f64::from(g.distal[i]),
                dx.hypot(dy),
            );
            dy.atan2(dx) + side * ((l * l + far * far - r * r) / (2.0 * l * far)).acos()
        };
        let angles = [arm(0, 1.0), arm(1, -1.0), phi];
        let mut counts = [65_000, 0, 7];
        for i in 0..3 {
            let encoder = &g.encoders[i];
            let turns = (angles[i] - f64::from(encoder.offset)) / TAU;
            self.joints[i] = (turns * f64::from(encoder.counts_per_turn)).round() as i32;
            let sign = if encoder.reversed { -1 } else { 1 };
            counts[i] += sign * self.joints[i];
        }
        // A counter has 16 bits.
        self.shown.borrow_mut().counts = Some(counts.map(|count| count as u16));
    }

    pub(crate) fn at(&mut self, hand: [f64; 3]) -> Wrench<f32> {
        self.place(hand);
        self.rig.tick()
    }

    pub(crate) fn stay(&mut self, hand: [f64; 3], ticks: u32) -> Wrench<f32> {
        for _ in 0..ticks {
            self.at(hand);
        }
        self.rig.force
    }

    /// The joint angles according to the encoders.
    pub(crate) fn angles(&self) -> [f64; 3] {
        std::array::from_fn(|i| {
            let encoder = &GEOMETRY.encoders[i];
            f64::from(encoder.offset)
                + f64::from(self.joints[i]) / f64::from(encoder.counts_per_turn) * TAU
        })
    }

    /// The torques of the motors, from duty and direction (N·m).
    pub(crate) fn torques(&self) -> [f64; 3] {
        std::array::from_fn(|i| {
            let duty = f64::from(*self.motors[i].duty.borrow()) / 8_400.0;
            let clockwise = *self.motors[i].high.borrow() != MOTORS[i].reversed;
            let size = duty * f64::from(MOTORS[i].full_torque());
            if clockwise { -size } else { size }
        })
    }

    pub(crate) fn is_off(&self) -> bool {
        self.torques() == [0.0; 3]
    }
}
