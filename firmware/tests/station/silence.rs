//! Safety through the wire: silence, missed ticks, actuators that fail, and the way back.

use super::rig::{Rig, driven};
use crate::{size, with};
use stiction_core::{Hand, Status, Wrench};
use stiction_firmware::device::{Actuators, FromLine, Outage};
use stiction_wire::Drive;

/// 5 mm deep: 2.5 N.
fn deep() -> Hand<f32> {
    with(Hand::new(0.0, 0.045, 0.0), |hand| hand.depth = 0.25)
}

#[test]
fn silence_of_20_ms_makes_the_force_zero_and_the_way_back_is_slow() {
    for tick_rate in [100, 500, 1_000, 3_000, 5_000] {
        let mut rig = Rig::<f32>::new();
        rig.mode(|mode| (mode.tick_rate, mode.pose_every) = (tick_rate, 2));
        let force = rig.stay(deep(), u32::from(tick_rate) / 5);
        assert!((size(&force) - 2.5).abs() < 1e-3, "{force:?}");
        let last_sample_us = rig.now_us.wrapping_sub(1_000_000 / u32::from(tick_rate));
        rig.received();
        let off_us = loop {
            let now_us = rig.now_us;
            if rig.tick() == Wrench::default() {
                break now_us.wrapping_sub(last_sample_us);
            }
        };
        assert!(
            (9_001..=20_000).contains(&off_us),
            "{tick_rate} Hz: {off_us}"
        );
        rig.received();
        rig.tick();
        rig.tick();
        let pose = rig.pose();
        assert!(pose.force_off && pose.held);
        assert_eq!((pose.status, pose.depth), (Status::HeldLast, 0.25));
        assert_eq!(rig.health().drive, Drive::Silent);
        // Back: at most 100 N/s.
        let step = 100.0 / f32::from(tick_rate);
        let mut before = 0.0;
        for _ in 0..tick_rate / 5 {
            let now = size(&rig.hand(deep()));
            assert!((now - before).abs() <= step * 1.001);
            before = now;
        }
        assert!((before - 2.5).abs() < 1e-3);
        let pose = rig.pose();
        assert!(!pose.force_off && pose.status == Status::Ok);
        assert_eq!(rig.health().drive, Drive::On);
    }
}

#[test]
fn before_the_first_sample_the_body_is_at_its_start_and_there_is_no_force() {
    let mut rig = Rig::<f32>::new();
    for _ in 0..30 {
        assert_eq!(rig.tick(), Wrench::default());
        let pose = rig.pose();
        assert!(pose.force_off && !pose.held);
        assert_eq!(pose.status, Status::HeldLast);
        assert!((pose.position[1] - 0.03).abs() < 1e-7 && pose.rest == 0.0);
        // It stands on the floor.
        assert_eq!(pose.state, stiction_core::StateKind::Edge);
    }
}

/// Actuators that record their inputs, and fail on request.
#[derive(Default)]
struct Motors {
    broken: Option<Outage>,
    given: Wrench<f32>,
}

impl Actuators for Motors {
    type Fault = Outage;

    fn give(&mut self, wrench: &Wrench<f32>) -> Result<(), Outage> {
        self.given = *wrench;
        self.broken.map_or(Ok(()), Err)
    }
    fn off(&mut self) {
        self.given = Wrench::default();
    }
}

fn with_motors() -> Rig<f32, 0, (FromLine, Motors)> {
    let mut rig = Rig::with(driven(), (FromLine, Motors::default()));
    rig.stay(deep(), 50);
    assert!(size(&rig.force) > 2.0 && rig.servo.device.1.given == rig.force);
    rig
}

#[test]
fn a_force_that_cannot_be_given_for_once_is_none_and_grows_again() {
    let mut rig = with_motors();
    rig.servo.device.1.broken = Some(Outage::Passing);
    for _ in 0..5 {
        assert_eq!(rig.hand(deep()), Wrench::default());
        assert_eq!(rig.servo.device.1.given, Wrench::default());
        assert!(rig.pose().force_off);
        assert_eq!(rig.health().drive, Drive::Silent);
    }
    rig.servo.device.1.broken = None;
    assert!(size(&rig.hand(deep())) <= 0.1 + 1e-5);
    rig.stay(deep(), 50);
    assert!(size(&rig.servo.device.1.given) > 2.0);
    assert_eq!(rig.health().drive, Drive::On);
}

#[test]
fn in_the_safe_state_the_actuators_are_off() {
    let mut rig = with_motors();
    for _ in 0..20 {
        rig.tick();
    }
    assert_eq!(rig.health().drive, Drive::Silent);
    assert_eq!(rig.servo.device.1.given, Wrench::default());
}

#[test]
fn missed_ticks_are_counted_and_cost_the_force_of_one_tick() {
    let mut rig = Rig::<f32>::new();
    rig.stay(deep(), 50);
    rig.now_us = rig.now_us.wrapping_add(3_000);
    assert_eq!(rig.hand(deep()), Wrench::default());
    assert!(rig.pose().force_off);
    assert_eq!(rig.health().missed_ticks, 3);
    rig.hand(deep());
    assert!(!rig.pose().force_off);
}
