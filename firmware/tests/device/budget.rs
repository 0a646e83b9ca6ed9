//! A budget of work: the body falls behind the hand, and continues to follow it in ticks without a new sample. That it comes to the hand is
//! tested with a station.

use super::{Bench, Device, deep};
use crate::with;
use stiction_core::{Hand, Wrench};
use stiction_firmware::device::{Settings, Turn};
use stiction_tests::station::BOX;

/// The box is dragged far in one sample, while it is pressed down; it arrives before silence is noticed.
fn far() -> Hand<f32> {
    Hand::new(0.08, 0.045, 0.0)
}

/// One piece of work in a tick.
fn least() -> Settings {
    with(Settings::default(), |s| s.budget = 1)
}

/// Pressed down and dragged.
fn dragged() -> (Bench<f32>, Turn) {
    let mut bench = Bench::with(&BOX, &least());
    bench.pressed(deep());
    let tick = bench.sample(far());
    (bench, tick)
}

/// While the body is behind, the springs pull at the hand's present position on its path, so that the force is that of a balance.
#[test]
fn the_force_of_a_body_behind_the_hand_is_that_of_its_springs() {
    let (mut bench, _) = dragged();
    let mut before = bench.tick(None);
    while before.output.is_some() {
        let after = bench.tick(None);
        let state = bench.controller.state().unwrap();
        let wrench = bench.controller.solver().wrench(state);
        let [x, y] = wrench.force;
        // 5 mm deep: N = 2.5 N, and |T| up to 1.25 N.
        assert!((y + 2.5).abs() < 1e-3 && x.abs() < 1.3, "{wrench:?}");
        before = after;
    }
}

#[test]
fn in_silence_it_comes_to_the_hand_as_well_without_a_force() {
    let farther = Hand::new(0.5, 0.045, 0.0);
    // One piece of work in every step takes longer than silence may last.
    let piecewise = with(least(), |settings| settings.budget = 0);
    let settings = [Settings::default(), piecewise];
    let [mut at_once, mut bench] = settings.map(|settings| Bench::<f32>::with(&BOX, &settings));
    at_once.pressed(deep());
    bench.pressed(deep());
    let expected = at_once.sample(farther).pose;
    let mut tick = bench.sample(farther);
    while tick.output.is_some() {
        tick = bench.tick(None);
    }
    assert!(tick.flags.silent && tick.force == Wrench::default());
    assert_eq!(tick.pose, expected);
    let [once, piecewise] = [&at_once, &bench].map(|bench| bench.controller.health().samples);
    assert_eq!(piecewise, once);
}

#[test]
fn a_sample_that_cannot_be_used_holds_a_body_behind_the_hand() {
    let (mut bench, before) = dragged();
    let lost = Hand::new(f32::NAN, 0.0, 0.0);
    for tick in [bench.sample(lost), bench.tick(None)] {
        assert!(tick.flags.held_last && tick.pose == before.pose);
    }
    let mut tick = bench.sample(far());
    assert!(!tick.flags.is_safe_state());
    while tick.output.is_some() {
        tick = bench.tick(None);
    }
    assert!(tick.pose.position[0] > before.pose.position[0]);
}

#[test]
fn a_reset_forgets_that_the_body_was_behind() {
    let (mut bench, _) = dragged();
    let controller: &mut Device = &mut bench.controller;
    controller.reset();
    assert_eq!(bench.tick(None).output, None);
}
