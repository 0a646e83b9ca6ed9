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
const RANDOM: [u64; 2] = [45_800, 21_700];

/// Mean and worst with path evolution, and with frame evolution. Budgets, not results: as much as the frames of a scene take,
/// and a little more. Less is better; more has to be worth it.
const BUDGETS: [(&str, [[u64; 2]; 2]); 23] = [
    ("box on a vertex", [[435, 1990], [435, 1940]]),
    ("box flat", [[216, 1060], [226, 1170]]),
    ("box as a ladder", [[391, 116_000], [392, 116_000]]),
    ("block against a wall", [[392, 81_800], [397, 81_900]]),
    (
        "block dropped into a corner",
        [[723, 111_000], [719, 111_000]],
    ),
    ("block in a wide corner", [[4540, 94_500], [1050, 84_900]]),
    ("block lifted straight", [[168, 3440], [164, 1800]]),
    ("block lifted obliquely", [[188, 2900], [185, 2610]]),
    ("block tips", [[199, 5910], [194, 2660]]),
    ("block set down tilted", [[213, 4240], [210, 2490]]),
    (
        "block slid flush against a slanted wall",
        [[724, 2940], [725, 2900]],
    ),
    ("strut buckles", [[260, 2170], [260, 2200]]),
    ("strut buckles in a groove", [[612, 33_200], [612, 33_100]]),
    ("pendulum folds", [[268, 1640], [269, 1840]]),
    ("strut falls on its edge", [[253, 12_500], [231, 2880]]),
    (
        "rod slides between floor and wall",
        [[385, 34_700], [385, 34_700]],
    ),
    (
        "rod lies down between floor and wall",
        [[2920, 73_700], [2920, 73_700]],
    ),
    (
        "rod buckles between smooth walls",
        [[37_900, 421_000], [37_700, 411_000]],
    ),
    (
        "rod taken off floor and wall",
        [[266, 23_600], [266, 23_600]],
    ),
    (
        "rod dropped between floor and wall",
        [[543, 34_600], [542, 34_500]],
    ),
    ("point in a corner", [[351, 9810], [343, 2770]]),
    ("tip slides along", [[227, 5530], [223, 2660]]),
    ("frictionless tip", [[386, 2600], [384, 1410]]),
];

/// The same where contacts glide.
const GLIDING: [(&str, [[u64; 2]; 2]); 11] = [
    ("box on a vertex", [[356, 1290], [356, 1290]]),
    ("box flat", [[165, 165], [165, 165]]),
    ("block lifted straight", [[205, 3550], [202, 2160]]),
    ("block lifted obliquely", [[161, 2260], [161, 2570]]),
    ("block tips", [[223, 2370], [224, 2280]]),
    ("block set down tilted", [[252, 2080], [253, 2300]]),
    ("strut buckles", [[165, 165], [165, 165]]),
    ("pendulum folds", [[329, 2040], [331, 2320]]),
    ("strut falls on its edge", [[277, 3410], [280, 3830]]),
    ("tip slides along", [[226, 1160], [227, 1540]]),
    ("frictionless tip", [[331, 2030], [330, 1650]]),
];
