//! The reference among obstacles before the judge: the cases with known answers and random worlds are lawful, frame after frame.

use std::path::Path;

use stiction_judge::{Bounds, Evolution, Frame, Judge, Obstacle, Scene};
use stiction_tests::budget;
use stiction_tests::draw::Draw;
use stiction_tests::reference::{self, Reference};

use super::cases::{cases, named, run, text};
use super::traced::frame;
use super::worlds::world;

const SCENES: usize = budget(150, 150);
const SUBSTEPS: usize = 20;

/// The scene of the reference as the judge has it, but for what the reference does not know.
fn scene(of: &reference::Scene, start: [f64; 3]) -> Scene {
    let obstacle = |(i, obstacle): (usize, &reference::Obstacle)| Obstacle {
        name: i.to_string(),
        vertices: obstacle.vertices.clone(),
        friction_static: obstacle.mu_s,
        friction_dynamic: obstacle.mu_d,
        memory: Some(obstacle.memory),
    };
    Scene {
        vertices: of.vertices.clone(),
        start,
        weight: of.weight,
        holding_point: Some(of.holding_point),
        stiffness_translation: of.k_h,
        stiffness_rotation: of.k_theta,
        surfaces: Vec::new(),
        obstacles: of.obstacles.iter().enumerate().map(obstacle).collect(),
    }
}

/// What a judge finds in frames, and which laws it looked at.
fn broken(scene: &Scene, frames: &[Frame]) -> Vec<String> {
    let mut judge = Judge::new(scene.clone(), Bounds::DOUBLE, Evolution::Path);
    let mut found = Vec::new();
    for (i, frame) in frames.iter().enumerate() {
        for finding in judge.next(frame.clone()) {
            if !finding.holds() {
                let last = i.checked_sub(1).map(|i| &frames[i]);
                found.push(format!("frame {i}: {finding:?}: {last:?} {frame:?}"));
            }
        }
    }
    found
}

#[test]
fn cases_are_lawful() {
    for case in cases() {
        let named = named(&case["geometry"]);
        let scene = Scene::parse(Path::new("scene.toml"), text(&case["scene"]));
        let scene = scene.expect("a sound scene");
        let mut frames: Vec<Frame> = Vec::new();
        run(&named, &case, |i, body, (hand, _)| {
            let next = frame(&named.scene, body, (i as f64, hand), frames.last());
            frames.push(next);
        });
        let found = broken(&scene, &frames);
        println!("{}: {}", case["name"], found.len());
        for finding in found.iter().take(3) {
            println!("    {finding}");
        }
    }
}

#[test]
fn random_worlds_are_lawful() {
    let mut draw = Draw::new(std::env::var("SEED").map_or(4, |s| s.parse().unwrap()));
    let mut all = 0;
    for i in 0..SCENES {
        let world = world(&mut draw);
        let mut body = Reference::new(world.scene.clone(), world.start, world.hands[0]);
        let mut frames = vec![frame(&world.scene, &body, (0.0, world.hands[0]), None)];
        for (k, &hand) in world.hands.iter().enumerate().skip(1) {
            body.step(hand, SUBSTEPS);
            let next = frame(&world.scene, &body, (k as f64, hand), frames.last());
            frames.push(next);
        }
        let found = broken(&scene(&world.scene, world.start), &frames);
        all += found.len();
        for finding in found.iter().take(2) {
            println!("scene {i}: {finding}\n {:?}\n", world.scene);
        }
    }
    println!("{all}");
}
