//! The answers of the slow reference as frames that the laws can judge.

use super::shape::{Point, outward, placed};
use crate::reference::{ContactForce, Reference, Scene};
use stiction_judge::{Contact, Frame, State, Status, Touch};

/// Point and normal of a contact of the reference.
fn place(scene: &Scene, pose: [f64; 3], touch: Touch) -> (Point, Point) {
    let body = placed(&scene.vertices, pose);
    match touch {
        Touch::Surface { vertex, surface } => (body[vertex], scene.surfaces[surface].normal),
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => {
            let normal = outward(&scene.obstacles[obstacle].vertices, side);
            (body[vertex], normal)
        }
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => {
            let point = scene.obstacles[obstacle].vertices[corner];
            (point, outward(&body, body_side).map(|x| -x))
        }
    }
}

/// The answer of the reference as a frame for the judge, without the names of its events.
pub fn frame_of(scene: &Scene, body: &Reference, (t, hand): (f64, [f64; 3])) -> Frame {
    let pose = body.pose();
    let grip = placed(&[scene.holding_point], pose)[0];
    let contact = |force: &ContactForce| {
        let (point, direction) = place(scene, pose, force.touch);
        Contact {
            touch: force.touch,
            point,
            direction: Some(direction),
            normal: force.normal,
            friction: force.friction,
            sliding: Some(force.slides),
        }
    };
    Frame {
        t,
        hand,
        held: true,
        pose,
        depth: 0.0,
        state: named(body.state()),
        contacts: body.contacts().iter().map(contact).collect(),
        complete: true,
        wrench: [
            scene.k_h * (hand[0] - grip[0]),
            scene.k_h * (hand[1] - grip[1]),
            scene.k_theta * (hand[2] - pose[2]),
        ],
        slips: body.slips(),
        events: Vec::new(),
        status: if body.ambiguous() {
            Status::Ambiguous
        } else if body.skipped() {
            Status::EventLimit
        } else {
            Status::Ok
        },
        behind: None,
    }
}

fn named(name: &str) -> State {
    let state = State::ALL.into_iter().find(|state| state.name() == name);
    state.unwrap_or_else(|| panic!("the judge does not know {name:?}"))
}
