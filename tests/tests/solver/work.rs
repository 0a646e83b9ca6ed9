//! What a frame takes, counted in operations on numbers: the same on every machine, so that a shortcut that is not taken
//! any more, or a search that takes more steps, shows.

use stiction_core::{Evolution, Frictionless, Full, Model, Solver};
use stiction_tests::counted::{Counted, counted};
use stiction_tests::random::scenarios;
use stiction_tests::run::planar;
use stiction_tests::setup::{SURFACES, VERTICES};
use stiction_tests::{Scenario, scenes};

const FRAMES_PER_LEG: usize = 250;

/// What every frame of a scene takes, the start not counted.
fn steps<const S: usize, M: Model>(
    scenario: &Scenario,
    (evolution, frames_per_leg): (Evolution, usize),
) -> Vec<u64> {
    let scene = (scenario.setup).scene_of::<Counted, VERTICES, S, M>();
    let solver = Solver::new(scene.expect("a sound scene"), evolution);
    let mut hands = scenario.hands(frames_per_leg).into_iter();
    let first = hands.next().expect("a path");
    let (mut state, _) = solver.start(planar::<Counted>(first));
    let steps = hands.map(|hand| counted(|| solver.step(&mut state, planar::<Counted>(hand))).1);
    steps.collect()
}

/// Mean and worst of a scene's frames.
fn work<const S: usize, M: Model>(scenario: &Scenario, evolution: Evolution) -> [u64; 2] {
    let steps = steps::<S, M>(scenario, (evolution, FRAMES_PER_LEG));
    let mean = steps.iter().sum::<u64>().div_ceil(steps.len() as u64);
    [mean, steps.into_iter().max().unwrap_or_default()]
}

/// What is above its budget; prints all.
fn exceeding<const S: usize, M: Model>(
    scenes: impl IntoIterator<Item = (&'static str, Scenario)>,
    budgets: &[(&str, [[u64; 2]; 2])],
) -> Vec<String> {
    let mut exceeded = Vec::new();
    for (name, scenario) in scenes {
        let all = Evolution::ALL.map(|evolution| work::<S, M>(&scenario, evolution));
        println!("(\"{name}\", {all:?}),");
        let budget = budgets.iter().find(|(known, _)| *known == name);
        let budget = budget.map_or([[0; 2]; 2], |(_, budget)| *budget);
        let (mut is, may) = (all.iter().flatten(), budget.iter().flatten());
        if !is.by_ref().zip(may).all(|(is, may)| is <= may) {
            exceeded.push(format!("{name}: {all:?}, allowed: {budget:?}"));
        }
    }
    exceeded
}

#[test]
fn frames_take_no_more_than_their_budget() {
    let exceeded = exceeding::<SURFACES, Full>(scenes::all(), &BUDGETS);
    assert!(exceeded.is_empty(), "{exceeded:#?}");
}

/// The scenes of one surface, without friction: contacts glide.
#[test]
fn gliding_frames_take_no_more_than_their_budget() {
    let smooth = scenes::all().into_iter().map(|(name, mut scenario)| {
        scenario.setup = scenario.setup.smooth();
        (name, scenario)
    });
    let single = smooth.filter(|(_, scenario)| scenario.setup.surfaces.len() == 1);
    let exceeded = exceeding::<1, Frictionless>(single, &GLIDING);
    assert!(exceeded.is_empty(), "{exceeded:#?}");
}

/// All frames of random scenes together.
#[test]
fn random_frames_take_no_more_than_their_budget() {
    let all = Evolution::ALL.map(|evolution| {
        let how = (evolution, 40);
        let all = scenarios(100, 4).map(|s| steps::<SURFACES, Full>(&s, how).iter().sum::<u64>());
        all.sum::<u64>() / 1000
    });
    println!("{all:?}");
    for (is, may) in all.iter().zip(&RANDOM) {
        assert!(is <= may, "{all:?}, allowed: {RANDOM:?}");
    }
}

/// Thousands of operations, as below: with path and frame evolution.
const RANDOM: [u64; 2] = [65_800, 11_200];

/// Mean and worst with path evolution, and with frame evolution. Budgets, not results: as much as the frames of a scene take,
/// and a little more. Less is better; more has to be worth it.
const BUDGETS: [(&str, [[u64; 2]; 2]); 22] = [
    ("box on a vertex", [[434, 1980], [294, 749]]),
    ("box flat", [[210, 1020], [189, 731]]),
    ("box as a ladder", [[317, 72_300], [312, 69_600]]),
    ("block against a wall", [[270, 9900], [260, 12_900]]),
    (
        "block dropped into a corner",
        [[522, 41_500], [439, 31_100]],
    ),
    ("block in a wide corner", [[735, 63_600], [596, 37_700]]),
    ("block lifted straight", [[166, 3670], [161, 1090]]),
    ("block lifted obliquely", [[247, 34_600], [155, 2290]]),
    ("block tips", [[216, 25_200], [174, 1520]]),
    ("block set down tilted", [[226, 21_100], [185, 1370]]),
    (
        "block slid flush against a slanted wall",
        [[2430, 217_000], [401, 16_300]],
    ),
    ("strut buckles", [[262, 2150], [255, 1560]]),
    ("strut buckles in a groove", [[483, 5460], [425, 5780]]),
    ("pendulum folds", [[271, 3850], [267, 1060]]),
    ("strut falls on its edge", [[293, 32_100], [203, 2270]]),
    (
        "rod slides between floor and wall",
        [[343, 21_600], [330, 21_800]],
    ),
    (
        "rod lies down between floor and wall",
        [[1680, 27_300], [1560, 28_200]],
    ),
    ("rod taken off floor and wall", [[245, 459], [245, 459]]),
    (
        "rod dropped between floor and wall",
        [[392, 20_300], [382, 20_300]],
    ),
    ("point in a corner", [[362, 41_400], [274, 1730]]),
    ("tip slides along", [[242, 16_600], [198, 1480]]),
    ("frictionless tip", [[3480, 5350], [508, 1320]]),
];

/// The same where contacts glide.
const GLIDING: [(&str, [[u64; 2]; 2]); 11] = [
    ("box on a vertex", [[301, 1140], [301, 1040]]),
    ("box flat", [[134, 134], [134, 134]]),
    ("block lifted straight", [[179, 3770], [174, 1240]]),
    ("block lifted obliquely", [[138, 2020], [132, 698]]),
    ("block tips", [[185, 2650], [184, 1740]]),
    ("block set down tilted", [[219, 2360], [217, 1600]]),
    ("strut buckles", [[134, 134], [134, 134]]),
    ("pendulum folds", [[329, 4830], [323, 1620]]),
    ("strut falls on its edge", [[234, 3140], [230, 1980]]),
    ("tip slides along", [[243, 33_000], [200, 1050]]),
    ("frictionless tip", [[283, 2300], [282, 1490]]),
];
