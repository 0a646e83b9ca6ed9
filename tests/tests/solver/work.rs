//! What a frame takes, counted in operations on numbers: the same on every machine, so that a shortcut that is not taken
//! any more, or a search that takes more steps, shows.

use stiction_core::{Evolution, Solver};
use stiction_tests::counted::{Counted, counted};
use stiction_tests::run::planar;
use stiction_tests::{Scenario, scenes};

const FRAMES_PER_LEG: usize = 250;

/// Mean and worst of a scene's frames, the start not counted.
fn work(scenario: &Scenario, evolution: Evolution) -> [u64; 2] {
    let scene = scenario.setup.scene::<Counted>().expect("a sound scene");
    let solver = Solver::new(scene, evolution);
    let mut hands = scenario.hands(FRAMES_PER_LEG).into_iter();
    let first = hands.next().expect("a path");
    let (mut state, _) = solver.start(planar::<Counted>(first));
    let steps = hands.map(|hand| counted(|| solver.step(&mut state, planar::<Counted>(hand))).1);
    let steps: Vec<u64> = steps.collect();
    let mean = steps.iter().sum::<u64>().div_ceil(steps.len() as u64);
    [mean, steps.into_iter().max().unwrap_or_default()]
}

#[test]
fn frames_take_no_more_than_their_budget() {
    let mut exceeded = Vec::new();
    for (name, scenario) in scenes::all() {
        let all = Evolution::ALL.map(|evolution| work(&scenario, evolution));
        println!("(\"{name}\", {all:?}),");
        let budget = BUDGETS.iter().find(|(known, _)| *known == name);
        let budget = budget.map_or([[0; 2]; 2], |(_, budget)| *budget);
        if all
            .iter()
            .flatten()
            .zip(budget.iter().flatten())
            .any(|(is, may)| is > may)
        {
            exceeded.push(format!("{name}: {all:?}, allowed: {budget:?}"));
        }
    }
    assert!(exceeded.is_empty(), "{exceeded:#?}");
}

/// Mean and worst with path evolution, and with frame evolution. Budgets, not results: as much as the frames of a scene take,
/// and a little more. Less is better; more has to be worth it.
const BUDGETS: [(&str, [[u64; 2]; 2]); 22] = [
    ("box on a vertex", [[412, 1960], [272, 718]]),
    ("box flat", [[195, 1000], [176, 731]]),
    ("box as a ladder", [[268, 72_300], [263, 69_600]]),
    ("block against a wall", [[242, 9810], [232, 12_800]]),
    (
        "block dropped into a corner",
        [[483, 41_000], [399, 30_900]],
    ),
    ("block in a wide corner", [[710, 62_800], [564, 37_700]]),
    ("block lifted straight", [[156, 3610], [150, 1050]]),
    ("block lifted obliquely", [[236, 34_600], [144, 2290]]),
    ("block tips", [[200, 25_200], [158, 1500]]),
    ("block set down tilted", [[214, 20_800], [174, 1370]]),
    (
        "block slid flush against a slanted wall",
        [[5750, 2_190_000], [369, 16_300]],
    ),
    ("strut buckles", [[240, 2150], [233, 1560]]),
    ("strut buckles in a groove", [[452, 5410], [388, 5670]]),
    ("pendulum folds", [[271, 3850], [267, 1060]]),
    ("strut falls on its edge", [[276, 31_800], [187, 2270]]),
    (
        "rod slides between floor and wall",
        [[310, 21_500], [296, 21_700]],
    ),
    (
        "rod lies down between floor and wall",
        [[1660, 27_300], [1530, 28_200]],
    ),
    ("rod taken off floor and wall", [[187, 400], [187, 400]]),
    (
        "rod dropped between floor and wall",
        [[341, 20_200], [335, 20_200]],
    ),
    ("point in a corner", [[355, 40_400], [265, 1710]]),
    ("tip slides along", [[230, 16_300], [185, 1480]]),
    ("frictionless tip", [[1890, 3250], [483, 1320]]),
];
