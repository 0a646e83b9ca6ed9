//! Every law on every frame of random scenes and of the named ones, in every number type and both evolutions.

use proptest::prelude::*;
use stiction_core::{Evolution, Fixed};
use stiction_tests::laws::{assert_lawful, creep};
use stiction_tests::random::{same_every_run, scenario};
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
