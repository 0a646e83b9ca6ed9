//! Ordinary use: the random scenes of the tests, and these without friction or with little to hold the angle.

use crate::case::Case;
use stiction_tests::draw::Draw;
use stiction_tests::haptic::{Kind, scene};
use stiction_tests::obstacles::rooms::room;
use stiction_tests::obstacles::worlds::{World, world};
use stiction_tests::obstacles::{Among, Obstacle};
use stiction_tests::random::{Scenario, scenarios};
use stiction_tests::{Number, Setup};

/// Frames of a haptic case after the first.
const FRAMES: usize = 2000;

pub(super) fn haptic(seed: u64) -> Option<Case> {
    let kind = [Kind::StickSlip, Kind::Equal][usize::from(seed % 2 == 1)];
    Some(of(scene(kind, seed / 2)))
}

pub(super) fn soft(seed: u64) -> Option<Case> {
    Some(of(scene(Kind::Soft, seed)))
}

pub(super) fn free(seed: u64) -> Option<Case> {
    Some(of(scene(Kind::Free, seed)))
}

pub(super) fn smooth(seed: u64) -> Option<Case> {
    let mut scenario = scene(Kind::Equal, seed);
    scenario.setup = scenario.setup.smooth();
    Some(of(scenario))
}

pub(super) fn heavy(seed: u64) -> Option<Case> {
    let mut scenario = scene(Kind::StickSlip, seed);
    let setup = &mut scenario.setup;
    let unit = setup.stiffness_translation * setup.size();
    let (light, weight) = (setup.weight, Draw::new(seed).power(-1.7, -0.3) * unit);
    setup.weight = f32::rounded(weight);
    // The hand was raised by what the weight pulls the body down.
    let raise = (setup.weight - light) / setup.stiffness_translation;
    for hand in &mut scenario.keyframes {
        hand[1] = f32::rounded(hand[1] + raise);
    }
    Some(of(scenario))
}

pub(super) fn drags(seed: u64) -> Option<Case> {
    let index = usize::try_from(seed).ok()?;
    let scenario = scenarios(index + 1, 6).last()?;
    let hands = scenario.hands(1000);
    Some(Case::new(planes(scenario.setup), hands))
}

pub(super) fn worlds(seed: u64) -> Option<Case> {
    Some(among(&world(seed)))
}

pub(super) fn worlds_soft(seed: u64) -> Option<Case> {
    let mut case = worlds(seed)?;
    case.among.setup.stiffness_rotation /= 100.0;
    Some(case)
}

pub(super) fn worlds_free(seed: u64) -> Option<Case> {
    let mut case = worlds(seed)?;
    case.among.setup.stiffness_rotation = 0.0;
    Some(case)
}

pub(super) fn worlds_smooth(seed: u64) -> Option<Case> {
    let mut case = worlds(seed)?;
    case.among.setup = case.among.setup.smooth();
    for Obstacle { friction, .. } in &mut case.among.obstacles {
        *friction = [0.0; 2];
    }
    Some(case)
}

pub(super) fn rooms(seed: u64) -> Option<Case> {
    // The narrowest type represents these, too.
    Some(among(&room(seed, 8.0)))
}

/// The first frames of a haptic scenario.
pub(super) fn of(scenario: Scenario) -> Case {
    let mut hands = scenario.keyframes;
    hands.truncate(FRAMES + 1);
    Case::new(planes(scenario.setup), hands)
}

fn planes(setup: Setup) -> Among {
    Among {
        setup,
        obstacles: Vec::new(),
    }
}

fn among(world: &World) -> Case {
    Case::new(world.among.clone(), world.hands())
}
