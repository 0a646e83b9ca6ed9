//! Every law on every frame of random scenes and of the named ones, in every number type and both evolutions.

use proptest::prelude::*;
use stiction_core::{Evolution, Fixed, Status};
use stiction_tests::laws::{assert_lawful, creep};
use stiction_tests::random::{same_every_run, scenario, scenarios};
use stiction_tests::run::run;
use stiction_tests::{EVOLUTIONS, Number, Scenario, budget, scenes};

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
