//! Turns that take longer than a tick: the servo loop goes on, whatever the solver does.

use super::rig::{Nothing, Rig};
use crate::{change, size};
use stiction_core::{Hand, Wrench};
use stiction_firmware::device::{LockServo, Servo};
use stiction_wire::{Command, Drive};

/// After a safe state the force grows by no more than this in a tick (N): 100 N/s at 1 kHz, and a rounding.
const STEP: f32 = 0.1 + 1e-5;

fn deep() -> Hand<f32> {
    Hand::new(0.0, 0.045, 0.0)
}

/// A turn that some ticks interrupt before it ends.
struct Interrupted<'a> {
    servo: &'a mut Servo<Nothing>,
    now_us: &'a mut u32,
    /// Ticks until the end of the turn.
    ticks: u32,
    has_begun: bool,
    /// The force at the end of each tick.
    forces: Vec<Wrench<f32>>,
}

impl LockServo<Nothing> for Interrupted<'_> {
    fn lock<T>(&mut self, used: impl FnOnce(&mut Servo<Nothing>) -> T) -> T {
        if self.has_begun {
            for _ in 0..self.ticks {
                self.forces.push(self.servo.force());
                self.servo.tick(*self.now_us);
                *self.now_us = self.now_us.wrapping_add(1_000);
            }
        }
        self.has_begun = true;
        used(self.servo)
    }
}

impl Rig<f32> {
    /// A turn with the hand there, interrupted by a number of ticks; then the next tick. Returns the force at the end of each tick.
    fn late(&mut self, hand: Hand<f32>, ticks: u32) -> Vec<Wrench<f32>> {
        self.send(Command::Hand(hand));
        let mut servo = Interrupted {
            servo: &mut self.servo,
            now_us: &mut self.now_us,
            ticks,
            has_begun: false,
            forces: Vec::new(),
        };
        self.force = self.station.turn(&mut self.line, &mut servo);
        let mut forces = servo.forces;
        forces.push(self.force);
        self.servo.tick(self.now_us);
        self.now_us = self.now_us.wrapping_add(1_000);
        let bytes = std::mem::take(&mut self.line.from_board);
        self.client.listen(&bytes);
        forces
    }
}

/// A hand that presses, drags, and leaves the floor.
fn hand(i: u32) -> Hand<f32> {
    let t = i as f32 * 1e-3;
    Hand::new(0.02 * (5.0 * t).sin(), 0.05 - 0.01 * (7.0 * t).sin(), 0.0)
}

#[test]
fn the_force_grows_by_one_step_in_a_tick_and_no_tick_is_missed() {
    let mut rig = Rig::<f32>::new();
    rig.tick();
    let (mut before, mut ticks, mut grows) = (Wrench::default(), 0, true);
    for i in 0..2_000 {
        // Of the first sample the hand is 10 mm deep; it is there while the force grows.
        let deepest = Hand::new(0.0, 0.04, 0.0);
        let to = if grows { deepest } else { hand(i) };
        for force in rig.late(to, i * i % 7) {
            let grown = size(&force) - size(&before);
            assert!(!grows || grown <= STEP, "{i}: {before:?} {force:?}");
            (before, ticks) = (force, ticks + 1);
        }
        grows &= size(&before) < 3.1;
    }
    assert!(!grows && size(&before) > 1.0, "it pushes");
    let health = rig.health();
    assert_eq!((health.missed_ticks, health.samples), (0, 2_000));
    assert!(health.ticks.abs_diff(ticks) <= 1, "{ticks} {health:?}");
}

#[test]
fn poses_are_those_of_turns_in_time() {
    let (mut late, mut rig) = (Rig::<f32>::new(), Rig::<f32>::new());
    for i in 0..2_000 {
        late.late(hand(i), i % 5);
        rig.hand(hand(i));
        assert_eq!(late.pose(), rig.pose());
    }
}

#[test]
fn during_a_long_turn_the_last_force_is_given_on() {
    let mut rig = Rig::<f32>::new();
    rig.stay(deep(), 50);
    let force = rig.force;
    let given = rig.late(Hand::new(0.001, 0.045, 0.0), 10);
    assert!(given[..10].iter().all(|given| *given == force));
    assert_ne!(rig.force, force);
}

#[test]
fn a_turn_that_does_not_end_is_silence_and_the_way_back_is_slow() {
    let mut rig = Rig::<f32>::new();
    rig.stay(deep(), 50);
    let full = size(&rig.force);
    // Its sample is an old one when it comes to an end.
    let forces = rig.late(deep(), 30);
    let off = forces.iter().position(|force| *force == Wrench::default());
    // From the tick after the last sample on: 20 of them.
    let off = off.expect("zero force");
    assert!((15..=20).contains(&off), "{off} ms");
    let rest = &forces[off..];
    assert!(rest.iter().all(|force| size(force) <= STEP));
    assert_eq!(rig.health().drive, Drive::Silent);
    let mut before = Wrench::default();
    for _ in 0..100 {
        for force in rig.late(deep(), 0) {
            assert!(change(&before, &force) <= STEP);
            before = force;
        }
    }
    assert!((size(&before) - full).abs() < 1e-3);
    assert_eq!(rig.health().drive, Drive::On);
}
