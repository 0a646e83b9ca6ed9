//! Scenes that are physically equivalent: a mirror image, body and world exchanged, an obstacle in two pieces, a floor and a block.

use super::worlds::{World, friction, world};
use stiction_tests::draw::Draw;
use stiction_tests::obstacles::shape::placed;
use stiction_tests::reference::{Foot, Obstacle, Reference, Surface, Touch};
use stiction_tests::times;

fn number_of_scenes() -> usize {
    times(2, 50)
}
const SUBSTEPS: usize = 20;
/// Largest difference between two equal poses, m and rad: touches are known to 1e-12 m, and every slip and fold after them
/// amplifies that error.
const SAME: f64 = 1e-7;

/// The difference between two poses.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    [0, 1, 2]
        .map(|k| (a[k] - b[k]).abs())
        .into_iter()
        .fold(0.0, f64::max)
}

/// Runs two scenes in parallel; each pose of the second is compared after the mapping `seen`.
fn follow(name: &str, [one, other]: [&World; 2], seen: impl Fn([f64; 3]) -> [f64; 3]) {
    let new = |w: &World| Reference::new(w.scene.clone(), w.start, w.hands[0]);
    let (mut first, mut second) = (new(one), new(other));
    for (k, (&hand, &image)) in one.hands.iter().zip(&other.hands).enumerate().skip(1) {
        first.step(hand, SUBSTEPS);
        second.step(image, SUBSTEPS);
        let difference = apart(first.pose(), seen(second.pose()));
        assert!(difference < SAME, "{name} frame {k}: {difference:e}");
        assert_eq!(first.state(), second.state(), "{name} frame {k}");
        assert_eq!(first.slips(), second.slips(), "{name} frame {k}");
        assert_eq!(first.stiction(), second.stiction(), "{name} frame {k}");
    }
}

fn mirrored(world: &World) -> World {
    let point = |p: &[f64; 2]| [-p[0], p[1]];
    let pose = |p: &[f64; 3]| [-p[0], p[1], -p[2]];
    let shape = |points: &[[f64; 2]]| points.iter().rev().map(point).collect::<Vec<_>>();
    let mut image = world.clone();
    image.scene.vertices = shape(&world.scene.vertices);
    image.scene.holding_point = point(&world.scene.holding_point);
    for obstacle in &mut image.scene.obstacles {
        obstacle.vertices = shape(&obstacle.vertices);
    }
    image.start = pose(&world.start);
    image.hands = world.hands.iter().map(pose).collect();
    image
}

#[test]
fn a_mirror_image_behaves_like_a_mirror_image() {
    let mut draw = Draw::new(21);
    for i in 0..number_of_scenes() {
        let world = world(&mut draw);
        let image = mirrored(&world);
        follow(&format!("scene {i}"), [&world, &image], |p| {
            [-p[0], p[1], -p[2]]
        });
    }
}

/// The part of a polygon where `way` . p >= `least`.
fn cut(shape: &[[f64; 2]], way: [f64; 2], least: f64) -> Vec<[f64; 2]> {
    let above = |p: [f64; 2]| way[0] * p[0] + way[1] * p[1] - least;
    let mut left = Vec::new();
    for (i, &from) in shape.iter().enumerate() {
        let to = shape[(i + 1) % shape.len()];
        let (a, b) = (above(from), above(to));
        if a >= 0.0 {
            left.push(from);
        }
        if a * b < 0.0 {
            left.push([0, 1].map(|k| from[k] + a / (a - b) * (to[k] - from[k])));
        }
    }
    left
}

#[test]
fn an_obstacle_in_two_pieces_is_the_whole() {
    let mut draw = Draw::new(22);
    for i in 0..number_of_scenes() {
        let world = world(&mut draw);
        let mut split = world.clone();
        split.scene.obstacles.clear();
        for obstacle in &world.scene.obstacles {
            let (sin, cos) = draw.between(-3.0, 3.0).sin_cos();
            let middle: f64 = obstacle
                .vertices
                .iter()
                .map(|p| cos * p[0] + sin * p[1])
                .sum();
            let middle = middle / obstacle.vertices.len() as f64;
            let overlap = 0.02;
            let pieces = if obstacle.vertices.len() < 3 {
                vec![obstacle.vertices.clone()]
            } else {
                vec![
                    cut(&obstacle.vertices, [cos, sin], middle - overlap),
                    cut(&obstacle.vertices, [-cos, -sin], -middle - overlap),
                ]
            };
            split
                .scene
                .obstacles
                .extend(pieces.into_iter().map(|vertices| Obstacle {
                    vertices,
                    ..obstacle.clone()
                }));
        }
        follow(&format!("scene {i}"), [&world, &split], |p| p);
    }
}

#[test]
fn a_large_block_is_a_floor() {
    let mut draw = Draw::new(23);
    for i in 0..number_of_scenes() {
        let mut block = world(&mut draw);
        // A soft body that may turn over is let go by the rule of half-planes whenever its free pose is clear of them.
        block.scene.k_theta = draw.between(30.0, 300.0);
        let [mu_s, mu_d] = friction(&mut draw);
        let memory = 1.0 / 1024.0;
        let corners = [[-50.0, -60.0], [50.0, -60.0], [50.0, -0.6], [-50.0, -0.6]];
        block.scene.obstacles = vec![Obstacle {
            vertices: corners.to_vec(),
            mu_s,
            mu_d,
            memory,
        }];
        let mut plane = block.clone();
        plane.scene.obstacles.clear();
        plane.scene.surfaces.push(Surface {
            normal: [0.0, 1.0],
            offset: -0.6,
            mu_s,
            mu_d,
            memory,
        });
        follow(&format!("scene {i}"), [&block, &plane], |p| p);
    }
}

/// The pose of the world in the body's frame.
fn inverse([x, y, angle]: [f64; 3]) -> [f64; 3] {
    let back = placed(&[[-x, -y]], [0.0, 0.0, -angle])[0];
    [back[0], back[1], -angle]
}

/// The contact between the exchanged shapes.
fn exchanged(touch: Touch) -> Touch {
    match touch {
        Touch::Surface { .. } => touch,
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => Touch::Corner {
            obstacle,
            corner: vertex,
            body_side: side,
        },
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => Touch::Side {
            vertex: corner,
            obstacle,
            side: body_side,
        },
    }
}

/// The springs do not know which of the two shapes is the body. While the hand keeps its position and only turns, the obstacle can
/// equally be held at the hand's position and turned the other way against the body.
#[test]
fn body_and_obstacle_may_be_exchanged_under_a_hand_that_turns() {
    let mut draw = Draw::new(24);
    let mut met = std::collections::BTreeMap::<&str, usize>::new();
    for i in 0..number_of_scenes() {
        let mut world = world(&mut draw);
        world.scene.weight = 0.0;
        world.scene.obstacles.truncate(1);
        let turn = draw.between(-0.8, 0.8);
        let mut body = Reference::new(world.scene.clone(), world.start, world.hands[0]);
        for (k, &hand) in world.hands.iter().enumerate().skip(1) {
            body.step(hand, SUBSTEPS);
            // Starts from every tenth frame with a contact.
            if k % 10 != 0 || body.state() == "non-contact" {
                continue;
            }
            let mut here = body.clone();
            let mut scene = world.scene.clone();
            scene.vertices = world.scene.obstacles[0].vertices.clone();
            scene.obstacles[0].vertices = world.scene.vertices.clone();
            scene.holding_point = [hand[0], hand[1]];
            let feet: Vec<_> = here
                .contacts()
                .iter()
                .map(|contact| Foot {
                    touch: exchanged(contact.touch),
                    slides: contact.slides,
                })
                .collect();
            let [x, y] = world.scene.holding_point;
            let held = (feet.as_slice(), here.stiction());
            let start = [x, y, -hand[2]];
            let mut there = Reference::resumed(scene, inverse(here.pose()), held, start);
            for step in 1..=10 {
                let phi = hand[2] + 0.1 * turn * f64::from(step);
                here.step([hand[0], hand[1], phi], SUBSTEPS);
                there.step([x, y, -phi], SUBSTEPS);
                // In the air, the straight paths differ.
                if here.state() == "non-contact" {
                    break;
                }
                let difference = apart(inverse(here.pose()), there.pose());
                assert!(
                    difference < SAME,
                    "scene {i} frame {k} step {step}: {difference:e}"
                );
                assert_eq!(
                    here.slips(),
                    there.slips(),
                    "scene {i} frame {k} step {step}"
                );
                assert_eq!(
                    here.state(),
                    there.state(),
                    "scene {i} frame {k} step {step}"
                );
                *met.entry(here.state()).or_default() += 1;
            }
        }
    }
    println!("{met:?}");
}
