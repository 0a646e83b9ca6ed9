//! The reference among obstacles, checked by the judge: the cases with known answers and random worlds are lawful, frame after
//! frame, and every fault introduced into a lawful frame is found.

use std::collections::{BTreeMap, BTreeSet};

use stiction_judge::{
    Bounds, Contact, Evolution, Finding, Frame, Judge, Obstacle, Scene, Status, Surface, Touch, law,
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

/// The laws that a frame breaks, given the frames before it.
fn broken_by(scene: &Scene, before: &[Frame], frame: Frame) -> BTreeSet<&'static str> {
    let mut judge = Judge::new(scene.clone(), EXACT[1], Evolution::Path);
    for known in before {
        judge.next(known.clone());
    }
    let findings = judge.next(frame).into_iter();
    (findings.filter(|finding| !finding.holds()))
        .map(|finding| finding.law)
        .collect()
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

/// Introduces a fault into a lawful frame, at the contact with this index; returns whether that contact can have it.
type Fault = fn(&Scene, &mut Frame, usize) -> bool;

fn moved(frame: &mut Frame, way: [f64; 2], by: f64) {
    for (place, way) in frame.pose.iter_mut().zip(way) {
        *place += by * way;
    }
}

fn deeper(_: &Scene, frame: &mut Frame, k: usize) -> bool {
    let normal = frame.contacts[k].direction.expect("a direction");
    moved(frame, normal, -1e-4);
    true
}

/// Moves the contact towards the end of its side, and past it by a hundredth of a body size.
fn off_its_end(scene: &Scene, frame: &mut Frame, k: usize) -> bool {
    let Touch::Side { obstacle, side, .. } = frame.contacts[k].touch else {
        return false;
    };
    let shape = &scene.obstacles[obstacle].vertices;
    let (end, at) = (shape[side], frame.contacts[k].point);
    let way = [end[0] - at[0], end[1] - at[1]];
    let length = way[0].hypot(way[1]);
    let by = 1.0 + 0.01 / length;
    moved(frame, way, by);
    for (place, way) in frame.hand.iter_mut().zip(way) {
        *place += by * way;
    }
    for contact in &mut frame.contacts {
        contact.point = [0, 1].map(|k| contact.point[k] + by * way[k]);
    }
    true
}

fn other_side(scene: &Scene, frame: &mut Frame, k: usize) -> bool {
    match &mut frame.contacts[k].touch {
        Touch::Surface { .. } => return false,
        Touch::Side { obstacle, side, .. } => {
            *side = (*side + 1) % scene.obstacles[*obstacle].vertices.len();
        }
        Touch::Corner { body_side, .. } => *body_side = (*body_side + 1) % scene.vertices.len(),
    }
    true
}

fn turned(_: &Scene, frame: &mut Frame, k: usize) -> bool {
    let [x, y] = frame.contacts[k].direction.expect("a direction");
    frame.contacts[k].direction = Some([x - 1e-5 * y, y + 1e-5 * x]);
    true
}

/// Forces as small as the tolerance are skipped.
fn pulls(_: &Scene, frame: &mut Frame, k: usize) -> bool {
    let contact = &mut frame.contacts[k];
    contact.normal = -contact.normal;
    contact.normal < -1e-3
}

fn out_of_its_cone(scene: &Scene, frame: &mut Frame, k: usize) -> bool {
    let contact = &mut frame.contacts[k];
    let (Touch::Side { obstacle, .. } | Touch::Corner { obstacle, .. }) = contact.touch else {
        return false;
    };
    contact.friction = 1.001 * scene.obstacles[obstacle].friction_static * contact.normal;
    contact.normal > 1e-2
}

fn missing(_: &Scene, frame: &mut Frame, k: usize) -> bool {
    let contact = frame.contacts.remove(k);
    contact.normal > 1e-3
}

/// Faults, each with the laws that detect it.
const FAULTS: [(&str, Fault, &[&str]); 7] = [
    ("deeper", deeper, &[law::OUTSIDE, law::ON_SURFACE]),
    ("off its end", off_its_end, &[law::ON_SIDE]),
    ("on another side", other_side, &[law::DIRECTION]),
    ("turned", turned, &[law::DIRECTION]),
    ("pulls", pulls, &[law::PUSH]),
    ("out of its cone", out_of_its_cone, &[law::CONE]),
    ("missing", missing, &[law::FORCES]),
];

#[test]
fn every_fault_of_a_contact_is_found() {
    let mut draw = Draw::new(15);
    let mut found = [0; FAULTS.len()];
    for _ in 0..number_of_scenes() / 2 + 1 {
        let (scene, frames) = traced(&crowded(&mut draw));
        for (i, frame) in frames.iter().enumerate().step_by(7) {
            for k in 0..frame.contacts.len() {
                for (count, (name, fault, laws)) in found.iter_mut().zip(FAULTS) {
                    let mut faulty = frame.clone();
                    if frame.status != Status::Ok || !fault(&scene, &mut faulty, k) {
                        continue;
                    }
                    let broken = broken_by(&scene, &frames[..i], faulty);
                    let by = laws.iter().any(|law| broken.contains(law));
                    assert!(by, "{name}, contact {k}, {broken:?}: {frame:?}");
                    *count += 1;
                }
            }
        }
    }
    println!("{found:?}");
    assert!(found.iter().all(|&count| count > 5), "{found:?}");
}
