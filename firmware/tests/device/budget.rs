//! A budget of work: the body falls behind the hand, and continues to follow it in ticks without a new sample.

use super::{Bench, Device, deep};
use stiction_core::{Fixed, Hand, Real, Solver, Status, Wrench};
use stiction_firmware::device::{Settings, Turn};
use stiction_tests::station::BOX;

/// The box is dragged far in one sample, while it is pressed down; it arrives before silence is noticed.
fn far() -> Hand<f32> {
    Hand::new(0.08, 0.045, 0.0)
}

/// With room for the most expensive piece of work.
fn least() -> Settings {
    Settings {
        budget: Solver::<f32, 4, 2>::LEAST_BUDGET,
        ..Settings::default()
    }
}

/// Pressed down and dragged.
fn dragged<R: Real<Si = f32>>(settings: &Settings) -> (Bench<R>, Turn) {
    let mut bench = Bench::with(&BOX, settings);
    bench.pressed(deep());
    let tick = bench.sample(far());
    (bench, tick)
}

fn catches_up<R: Real<Si = f32>>() {
    let (at_once, expected) = dragged::<R>(&Settings::default());
    let all = expected.output.unwrap();
    assert_eq!((all.status, all.behind), (Status::Ok, 0.0));

    let (mut bench, mut tick) = dragged::<R>(&least());
    let budget = bench.controller.solver().budget();
    assert_eq!(budget, Solver::<R, 4, 2>::LEAST_BUDGET);
    let (mut ticks, mut slips, mut behind) = (0, 0, 1.0);
    while let Some(output) = tick.output.clone() {
        let is_there = output.behind == 0.0;
        let status = if is_there { Status::Ok } else { Status::Behind };
        assert_eq!(output.status, status);
        assert!(
            output.behind <= behind && output.work <= budget,
            "{output:?}"
        );
        assert!(!tick.flags.is_safe_state() && tick.force.force[0].is_finite());
        (slips, behind) = (slips + output.slips, output.behind);
        ticks += 1;
        tick = bench.tick(None);
    }
    assert!(ticks > 3, "{ticks} ticks");
    assert_eq!(slips, all.slips);
    assert_eq!(tick.pose, expected.pose);
    assert_eq!(bench.controller.state(), at_once.controller.state());
    assert_eq!(
        bench.controller.health().samples,
        at_once.controller.health().samples
    );
}

#[test]
fn a_body_behind_the_hand_comes_to_it_without_new_samples() {
    catches_up::<f32>();
    catches_up::<Fixed>();
}

/// While the body is behind, the springs pull at the hand's present position on its path, so that the force is that of a balance.
#[test]
fn the_force_of_a_body_behind_the_hand_is_that_of_its_springs() {
    let (mut bench, _) = dragged::<f32>(&least());
    let mut before = bench.tick(None);
    while before.output.is_some() {
        let after = bench.tick(None);
        let wrench = bench
            .controller
            .solver()
            .wrench(bench.controller.state().unwrap());
        // 5 mm deep: N = 2.5 N, and |T| up to 1.25 N.
        assert!(
            (wrench.force[1] + 2.5).abs() < 1e-3 && wrench.force[0].abs() < 1.3,
            "{wrench:?}"
        );
        before = after;
    }
}

#[test]
fn in_silence_it_comes_to_the_hand_as_well_without_a_force() {
    let farther = Hand::new(0.5, 0.045, 0.0);
    // One piece of work in every step takes longer than silence may last.
    let piecewise = Settings {
        budget: 0,
        ..least()
    };
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
}

#[test]
fn a_body_behind_the_hand_may_wait_for_the_next_sample() {
    let waiting = Settings {
        goes_on: false,
        ..least()
    };
    let (mut bench, before) = dragged::<f32>(&waiting);
    let tick = bench.tick(None);
    assert_eq!((tick.output, tick.pose), (None, before.pose));
    let tick = bench.sample(far());
    assert!(tick.pose.position[0] > before.pose.position[0]);
}

#[test]
fn a_sample_that_cannot_be_used_holds_a_body_behind_the_hand() {
    let (mut bench, before) = dragged::<f32>(&least());
    let lost = Hand::new(f32::NAN, 0.0, 0.0);
    for tick in [bench.sample(lost), bench.tick(None)] {
        assert!(tick.flags.held_last && tick.pose == before.pose);
    }
    let tick = bench.sample(far());
    assert!(!tick.flags.is_safe_state() && tick.pose.position[0] > before.pose.position[0]);
}

#[test]
fn a_reset_forgets_that_the_body_was_behind() {
    let (mut bench, _) = dragged::<f32>(&least());
    let controller: &mut Device = &mut bench.controller;
    controller.reset();
    assert_eq!(bench.tick(None).output, None);
}
