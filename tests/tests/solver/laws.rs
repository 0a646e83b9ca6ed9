//! Every law on every frame of random scenes and of the named ones, in every number type and both evolutions.

use proptest::prelude::*;
use stiction_core::{Event, Evolution, Fixed, Status};
use stiction_tests::laws::{assert_lawful, creep};
use stiction_tests::random::{same_every_run, scenario, scenarios};
use stiction_tests::run::run;
use stiction_tests::{EVOLUTIONS, Number, Run, Scenario, Setup, budget, scenes};

fn lawful<R: Number>(scenario: &Scenario, evolution: Evolution) {
    let frames = run::<R>(&scenario.setup, evolution, &scenario.hands(40));
    assert_lawful::<R>(&scenario.setup, &frames);
    for pair in frames.windows(2) {
        let crept = creep::<R>(&scenario.setup, &pair[0], &pair[1]);
        assert!(crept.holds(), "{crept:?}: {pair:?}");
    }
}

#[test]
fn named_scenes_obey_every_law() {
    for (name, scenario) in scenes::all() {
        println!("{name}");
        for evolution in EVOLUTIONS {
            lawful::<f64>(&scenario, evolution);
            lawful::<f32>(&scenario, evolution);
            lawful::<Fixed>(&scenario, evolution);
        }
    }
}

/// Without friction every edge of a cone is there twice, and two contacts bear loads of one plane alone.
#[test]
fn scenes_without_friction_obey_every_law() {
    fn glides<R: Number>() {
        let (mut frames, mut ambiguous) = (0, 0);
        for scenario in scenarios(budget(100, 10), 8) {
            let setup = scenario.setup.clone().smooth();
            for evolution in EVOLUTIONS {
                let run = run::<R>(&setup, evolution, &scenario.hands(40));
                assert_lawful::<R>(&setup, &run);
                frames += run.len();
                ambiguous += run.iter().filter(|f| f.status == Status::Ambiguous).count();
            }
        }
        println!("{}: {ambiguous} of {frames} frames ambiguous", R::NAME);
        assert!(1000 * ambiguous <= frames);
    }
    glides::<f64>();
    glides::<f32>();
    glides::<Fixed>();
}

/// A box leans on a wall, a corner just above the floor: the turn of the hand lets that corner touch a little before balance,
/// and open again, and so the slip along the wall begins a little out of balance. It must not end so.
#[test]
fn slip_that_begins_out_of_balance_ends_in_balance() {
    fn touches_and_slips<R: Number>() {
        let setup = Setup::bench_box()
            .at([0.090_498, 0.057_828_55, -1.164_641_5])
            .weighing(1.0)
            .floor([0.5, 0.3])
            .surface([-0.8, 0.6], -0.096, [0.4, 0.3]);
        let from = [0.108_934_97, 0.067_706_65, -1.199_382_2];
        let mut touched = 0;
        for i in 0..500 {
            let hand = [0.108_861_46, 0.067_720_67, -1.199_32 + 8e-7 * f64::from(i)];
            let mut run = Run::<R>::start(&setup, Evolution::Frame, from);
            run.step(hand);
            assert_lawful::<R>(&setup, std::slice::from_ref(&run.frame));
            touched += usize::from(run.frame.events.starts_with(&[Event::Touch, Event::Lift]));
        }
        assert!(touched > 100, "{}: {touched}", R::NAME);
    }
    touches_and_slips::<f64>();
    touches_and_slips::<f32>();
    touches_and_slips::<Fixed>();
}

proptest! {
    #![proptest_config(same_every_run(budget(500, 30)))]

    #[test]
    fn path_evolution_obeys_every_law(scenario in scenario(4)) {
        lawful::<f64>(&scenario, Evolution::Path);
        lawful::<f32>(&scenario, Evolution::Path);
        lawful::<Fixed>(&scenario, Evolution::Path);
    }

    #[test]
    fn frame_evolution_obeys_every_law(scenario in scenario(4)) {
        lawful::<f64>(&scenario, Evolution::Frame);
        lawful::<f32>(&scenario, Evolution::Frame);
        lawful::<Fixed>(&scenario, Evolution::Frame);
    }
}
