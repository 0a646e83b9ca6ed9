//! The cost of a frame, counted in operations on numbers: it is the same on every machine, so that a shortcut that is no
//! longer taken, or a search that needs more steps, becomes visible.

use stiction_core::{Evolution, Solver};
use stiction_tests::counted::{Counted, counted};
use stiction_tests::random::scenarios;
use stiction_tests::run::planar;
use stiction_tests::setup::{SURFACES, VERTICES};
use stiction_tests::{Scenario, scenes};

const FRAMES_PER_LEG: usize = 250;

/// The cost of every frame of a scene, excluding the start.
fn steps<const S: usize>(
    scenario: &Scenario,
    (evolution, frames_per_leg): (Evolution, usize),
) -> Vec<u64> {
    let scene = (scenario.setup).scene_of::<Counted, VERTICES, S, 0>();
    let solver = Solver::new(scene.expect("a sound scene"), evolution);
    let mut hands = scenario.hands(frames_per_leg).into_iter();
    let first = hands.next().expect("a path");
    let (mut state, _) = solver.start(planar::<Counted>(first));
    let steps = hands.map(|hand| counted(|| solver.step(&mut state, planar::<Counted>(hand))).1);
    steps.collect()
}

/// Mean and worst of a scene's frames.
fn work<const S: usize>(scenario: &Scenario, evolution: Evolution) -> [u64; 2] {
    let steps = steps::<S>(scenario, (evolution, FRAMES_PER_LEG));
    let mean = steps.iter().sum::<u64>().div_ceil(steps.len() as u64);
    [mean, steps.into_iter().max().unwrap_or_default()]
}

/// The scenes that exceed their budget; prints all.
fn exceeding<const S: usize>(
    scenes: impl IntoIterator<Item = (&'static str, Scenario)>,
    budgets: &[(&str, [[u64; 2]; 2])],
) -> Vec<String> {
    let mut exceeded = Vec::new();
    for (name, scenario) in scenes {
        let all = Evolution::ALL.map(|evolution| work::<S>(&scenario, evolution));
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
    let exceeded = exceeding::<SURFACES>(scenes::all(), &BUDGETS);
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
    let exceeded = exceeding::<1>(single, &GLIDING);
    assert!(exceeded.is_empty(), "{exceeded:#?}");
}

/// All frames of random scenes together.
#[test]
fn random_frames_take_no_more_than_their_budget() {
    let all = Evolution::ALL.map(|evolution| {
        let how = (evolution, 40);
        let all = scenarios(100, 4).map(|s| steps::<SURFACES>(&s, how).iter().sum::<u64>());
        all.sum::<u64>() / 1000
    });
    println!("{all:?}");
    for (is, may) in all.iter().zip(&RANDOM) {
        assert!(is <= may, "{all:?}, allowed: {RANDOM:?}");
    }
}

/// Thousands of operations, as below: with path and with frame evolution.
const RANDOM: [u64; 2] = [37_600, 16_600];

/// Mean and worst cost with path evolution, and with frame evolution. These are budgets, not results: slightly more than the
/// frames of a scene cost. A lower number is better; a higher one has to be justified.
const BUDGETS: [(&str, [[u64; 2]; 2]); 23] = [
    ("box on a vertex", [[419, 1970], [419, 1920]]),
    ("box flat", [[212, 1070], [222, 1170]]),
    ("box as a ladder", [[294, 41_900], [294, 42_000]]),
    ("block against a wall", [[333, 64_100], [338, 64_200]]),
    (
        "block dropped into a corner",
        [[423, 38_400], [419, 38_300]],
    ),
    ("block in a wide corner", [[1140, 32_600], [624, 32_600]]),
    ("block lifted straight", [[162, 3430], [159, 1800]]),
    ("block lifted obliquely", [[185, 2850], [182, 2600]]),
    ("block tips", [[192, 5690], [186, 2640]]),
    ("block set down tilted", [[204, 4050], [202, 2430]]),
    (
        "block slid flush against a slanted wall",
        [[716, 2760], [717, 2730]],
    ),
    ("strut buckles", [[245, 2150], [245, 2180]]),
    ("strut buckles in a groove", [[537, 14_500], [538, 14_400]]),
    ("pendulum folds", [[258, 1650], [259, 1860]]),
    ("strut falls on its edge", [[242, 12_100], [221, 2860]]),
    (
        "rod slides between floor and wall",
        [[277, 10_600], [277, 10_600]],
    ),
    (
        "rod lies down between floor and wall",
        [[1340, 35_600], [1340, 35_600]],
    ),
    (
        "rod buckles between smooth walls",
        [[7150, 129_000], [7140, 137_000]],
    ),
    ("rod taken off floor and wall", [[247, 9300], [247, 9350]]),
    (
        "rod dropped between floor and wall",
        [[333, 12_300], [333, 12_300]],
    ),
    ("point in a corner", [[348, 9600], [340, 2740]]),
    ("tip slides along", [[217, 5310], [214, 2640]]),
    ("frictionless tip", [[374, 2490], [372, 1400]]),
];

/// Mean and worst cost where contacts glide.
const GLIDING: [(&str, [[u64; 2]; 2]); 11] = [
    ("box on a vertex", [[340, 1290], [340, 1290]]),
    ("box flat", [[160, 160], [160, 160]]),
    ("block lifted straight", [[197, 3540], [194, 2180]]),
    ("block lifted obliquely", [[157, 2260], [158, 2570]]),
    ("block tips", [[216, 2370], [216, 2280]]),
    ("block set down tilted", [[244, 2080], [245, 2300]]),
    ("strut buckles", [[160, 160], [160, 160]]),
    ("pendulum folds", [[312, 2030], [314, 2320]]),
    ("strut falls on its edge", [[269, 3390], [272, 3810]]),
    ("tip slides along", [[217, 1170], [218, 1550]]),
    ("frictionless tip", [[318, 2030], [318, 1650]]),
];
