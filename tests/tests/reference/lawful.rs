//! Every frame of random scenes: outside the obstacles, in balance, friction within its cone, and contacts on both shapes.

use super::worlds::{outward, placed, separation, world};
use stiction_tests::budget;
use stiction_tests::draw::Draw;
use stiction_tests::reference::{Reference, Scene, Touch};

const SCENES: usize = budget(150, 4);
const SUBSTEPS: usize = 20;
/// Depth of a body inside an obstacle, m: the accuracy with which three simultaneous contacts are seated.
const INSIDE: f64 = 1e-9;
/// Distance of a contact from both shapes, m.
const APART: f64 = 1e-9;
/// Imbalance or excess over the cone, as fractions of the load: more than the 1e-12 that the cone test of the reference tolerates,
/// divided by the sine between two contacts that are nearly parallel.
const FORCE: f64 = 1e-7;

/// Point and normal of a contact.
pub(crate) fn place(scene: &Scene, pose: [f64; 3], touch: Touch) -> ([f64; 2], [f64; 2]) {
    let body = placed(&scene.vertices, pose);
    match touch {
        Touch::Surface { vertex, surface } => (body[vertex], scene.surfaces[surface].normal),
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => (
            body[vertex],
            outward(&scene.obstacles[obstacle].vertices, side),
        ),
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => (
            scene.obstacles[obstacle].vertices[corner],
            outward(&body, body_side).map(|x| -x),
        ),
    }
}

/// The centroid of a polygon, of a rod or of a point.
fn centroid(shape: &[[f64; 2]]) -> [f64; 2] {
    let first = shape[0];
    let (mut area, mut sum) = (0.0, [0.0, 0.0]);
    for i in 2..shape.len() {
        let [a, b] = [shape[i - 1], shape[i]].map(|p| [p[0] - first[0], p[1] - first[1]]);
        let cross = a[0] * b[1] - a[1] * b[0];
        area += cross;
        sum = [0, 1].map(|k| sum[k] + cross * (a[k] + b[k]) / 3.0);
    }
    if area > 0.0 {
        return [0, 1].map(|k| first[k] + sum[k] / area);
    }
    let count = shape.len() as f64;
    [0, 1].map(|k| shape.iter().map(|p| p[k]).sum::<f64>() / count)
}

/// The law that a frame breaks, if any.
pub(crate) fn broken(scene: &Scene, body: &Reference, hand: [f64; 3]) -> Option<String> {
    let pose = body.pose();
    let shape = placed(&scene.vertices, pose);
    for (k, obstacle) in scene.obstacles.iter().enumerate() {
        let apart = separation(&shape, &obstacle.vertices);
        if apart < -INSIDE {
            return Some(format!("{:e} m inside obstacle {k}", -apart));
        }
    }
    let from = |at: [f64; 2]| [at[0] - pose[0], at[1] - pose[1]];
    let moment = |at: [f64; 2], force: [f64; 2]| {
        let arm = from(at);
        arm[0] * force[1] - arm[1] * force[0]
    };
    let grip = placed(&[scene.holding_point], pose)[0];
    let spring = [0, 1].map(|k| scene.k_h * (hand[k] - grip[k]));
    let weight = [0.0, -scene.weight];
    let middle = placed(&[centroid(&scene.vertices)], pose)[0];
    let mut force = [spring[0], spring[1] - scene.weight];
    let mut turn =
        scene.k_theta * (hand[2] - pose[2]) + moment(grip, spring) + moment(middle, weight);
    let contacts = body.contacts();
    let load = 1.0 + contacts.iter().map(|c| c.normal.abs()).sum::<f64>();
    for contact in &contacts {
        let (at, normal) = place(scene, pose, contact.touch);
        let tangent = [normal[1], -normal[0]];
        let reaction = [0, 1].map(|k| contact.normal * normal[k] + contact.friction * tangent[k]);
        force = [0, 1].map(|k| force[k] + reaction[k]);
        turn += moment(at, reaction);
        let (Touch::Side { obstacle, .. } | Touch::Corner { obstacle, .. }) = contact.touch else {
            continue;
        };
        let obstacle = &scene.obstacles[obstacle];
        let excess = contact.friction.abs() - obstacle.mu_s * contact.normal;
        if contact.normal < -FORCE * load || excess > FORCE * load {
            return Some(format!("{contact:?} is beyond its cone"));
        }
        for one in [&shape, &obstacle.vertices] {
            if one.len() > 1 && separation(one, &[at]) > APART {
                return Some(format!("{contact:?} is at no contact"));
            }
        }
    }
    let rest = force[0].abs().max(force[1].abs()).max(turn.abs());
    (rest > FORCE * load).then(|| format!("{rest:e} is out of balance"))
}

#[test]
fn no_frame_among_obstacles_breaks_a_law() {
    let mut draw = Draw::new(3);
    let mut met = std::collections::BTreeMap::<String, usize>::new();
    for i in 0..SCENES {
        let world = world(&mut draw);
        let mut body = Reference::new(world.scene.clone(), world.start, world.hands[0]);
        for (k, &hand) in world.hands.iter().enumerate().skip(1) {
            body.step(hand, SUBSTEPS);
            assert!(!body.ambiguous(), "scene {i} frame {k}: no motion fits");
            assert!(!body.skipped(), "scene {i} frame {k}: too many events");
            if let Some(fault) = broken(&world.scene, &body, hand) {
                panic!("scene {i} frame {k}: {fault}");
            }
            let corner = |touch| matches!(touch, Touch::Corner { .. });
            let kind = |c: &stiction_tests::reference::ContactForce| {
                if corner(c.touch) { 'C' } else { 'V' }
            };
            let kinds: String = body.contacts().iter().map(kind).collect();
            *met.entry(format!("{} {kinds}", body.state())).or_default() += 1;
        }
    }
    println!("{met:?}");
    if SCENES >= 150 {
        for state in [
            "edge VV",
            "edge VC",
            "edge CC",
            "two-vertex VV",
            "two-vertex VC",
            "two-vertex CC",
            "corner VV",
            "locked VVC",
        ] {
            assert!(met.contains_key(state), "{state} was not met");
        }
    }
}
