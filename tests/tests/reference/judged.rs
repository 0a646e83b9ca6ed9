//! The reference among obstacles, checked by the judge: the cases with known answers and random worlds are lawful, frame after
//! frame.

use std::collections::BTreeMap;

use stiction_judge::{
    Bounds, Contact, Evolution, Finding, Frame, Judge, Obstacle, Scene, Status, Surface, law,
};
use stiction_tests::draw::Draw;
use stiction_tests::obstacles::survey::kind;
use stiction_tests::reference::{self, Reference};
use stiction_tests::times;

use super::cases::{cases, run};
use super::traced::frame;
use super::worlds::{World, crowded, world};

fn number_of_scenes() -> usize {
    times(4, 75)
}
const SUBSTEPS: usize = 20;

/// The scene of the reference in the judge's format, except for what the reference does not know.
fn scene(of: &reference::Scene, start: [f64; 3]) -> Scene {
    let obstacle = |(i, obstacle): (usize, &reference::Obstacle)| Obstacle {
        name: i.to_string(),
        vertices: obstacle.vertices.clone(),
        friction_static: obstacle.mu_s,
        friction_dynamic: obstacle.mu_d,
        memory: Some(obstacle.memory),
    };
    let surface = |(i, surface): (usize, &reference::Surface)| Surface {
        name: i.to_string(),
        normal: surface.normal,
        offset: surface.offset,
        friction_static: surface.mu_s,
        friction_dynamic: surface.mu_d,
        memory: Some(surface.memory),
    };
    Scene {
        vertices: of.vertices.clone(),
        start,
        weight: of.weight,
        holding_point: Some(of.holding_point),
        stiffness_translation: of.k_h,
        stiffness_rotation: of.k_theta,
        surfaces: of.surfaces.iter().enumerate().map(surface).collect(),
        obstacles: of.obstacles.iter().enumerate().map(obstacle).collect(),
    }
}

/// The reference is less exact than the solver.
const EXACT: [Bounds; 2] = [
    Bounds {
        residual: 2e-3,
        gap: 2e-5,
        slip: 1e-4,
        exact: 4e-5,
        ..Bounds::SINGLE
    },
    Bounds {
        residual: 1e-6,
        gap: 1e-6,
        far: false,
        slip: 1e-9,
        exact: 2e-6,
        ..Bounds::DOUBLE
    },
];

/// The first finding of the judge in frames that report only the number of events, not their names.
fn broken(scene: &Scene, frames: &[Frame], bounds: Bounds) -> Option<(usize, Finding)> {
    let mut judge = Judge::new(scene.clone(), bounds, Evolution::Path);
    (frames.iter().enumerate()).find_map(|(i, frame)| {
        let findings = judge.next(frame.clone());
        let is_known = |finding: &Finding| !law::OF_EVENTS.contains(&finding.law);
        let unlawful = (findings.into_iter()).find(|finding| is_known(finding) && !finding.holds());
        unlawful.map(|finding| (i, finding))
    })
}

/// Frames rounded to single precision.
fn single(frames: &[Frame]) -> Vec<Frame> {
    let round = |x: f64| f64::from(x as f32);
    let contact = |contact: &Contact| Contact {
        point: contact.point.map(round),
        direction: contact.direction.map(|n| n.map(round)),
        normal: round(contact.normal),
        friction: round(contact.friction),
        ..*contact
    };
    let frame = |frame: &Frame| Frame {
        hand: frame.hand.map(round),
        pose: frame.pose.map(round),
        contacts: frame.contacts.iter().map(contact).collect(),
        wrench: frame.wrench.map(round),
        ..frame.clone()
    };
    frames.iter().map(frame).collect()
}

/// The scene and the frames of a world.
fn traced(world: &World) -> (Scene, Vec<Frame>) {
    let mut body = Reference::new(world.scene.clone(), world.start, world.hands[0]);
    let mut frames = vec![frame(&world.scene, &body, (0.0, world.hands[0]), None)];
    for (k, &hand) in world.hands.iter().enumerate().skip(1) {
        body.step(hand, SUBSTEPS);
        let next = frame(&world.scene, &body, (k as f64, hand), frames.last());
        frames.push(next);
    }
    (scene(&world.scene, world.start), frames)
}

#[test]
fn cases_are_lawful() {
    for case in cases() {
        let mut frames: Vec<Frame> = Vec::new();
        run(&case.among, &case, |i, body, (hand, _)| {
            let next = frame(
                &case.among.reference(),
                body,
                (i as f64, hand),
                frames.last(),
            );
            frames.push(next);
        });
        for (frames, bounds) in [(single(&frames), EXACT[0]), (frames, EXACT[1])] {
            assert_eq!(broken(&case.scene, &frames, bounds), None, "{}", case.name);
        }
    }
}

/// The states that seventy-five random worlds of each kind reach, with the kinds of their contacts.
const STATES: [&str; 8] = [
    "edge VV",
    "edge VC",
    "edge CC",
    "two-vertex VV",
    "two-vertex VC",
    "two-vertex CC",
    "corner VV",
    "locked VVC",
];

/// Among few obstacles the reference never gives up.
#[test]
fn random_worlds_are_lawful() {
    let mut met = BTreeMap::<String, usize>::new();
    let (mut few, mut many) = (Draw::new(3), Draw::new(14));
    for i in 0..number_of_scenes() {
        for (world, is_easy) in [(world(&mut few), true), (crowded(&mut many), false)] {
            let (scene, frames) = traced(&world);
            for (frames, bounds) in [(&single(&frames), EXACT[0]), (&frames, EXACT[1])] {
                let found = broken(&scene, frames, bounds);
                let place = found.map(|(k, _)| &frames[k.saturating_sub(1)..=k]);
                assert_eq!(found, None, "scene {i}: {place:?}");
            }
            for frame in &frames {
                let is_followed = frame.status == Status::Ok;
                assert!(is_followed || !is_easy, "scene {i}: {frame:?}");
                *met.entry(kind(frame)).or_default() += 1;
            }
        }
    }
    println!("{met:?}");
    for state in STATES {
        let is_met = number_of_scenes() < 75 || met.contains_key(state);
        assert!(is_met, "{state}: {met:?}");
    }
}
