//! A box with weight that is pressed on the floor and dragged along: an edge contact, of which every frame is known in closed
//! form (STATICS 4): it breaks away when the hand leads by mu_s N / k_h, and stops when the hand leads by mu_d N / k_h. Then
//! the hand lets go, returns to another position and grasps again.

use stiction_judge::{Contact, Event, Frame, Scene, State};

use crate::write::{frame, on, scene};

const K: f64 = 500.0;
const WEIGHT: f64 = 1.0;
const WIDTH: f64 = 0.10;
/// Height of the centroid and of the initial holding point (m).
const CENTROID: f64 = 0.03;
const GRIP: f64 = 0.05;
const STATIC: f64 = 0.5;
const DYNAMIC: f64 = 0.3;
/// The hand's displacement per frame (m).
const STRIDE: f64 = 0.0007;

pub(crate) const SCENE: &str = r#"
spring = { translation = 500.0, rotation = 0.5 }
[body]
vertices = [[-0.05, 0.0], [0.05, 0.0], [0.05, 0.06], [-0.05, 0.06]]
start = [0.0, 0.0, 0.0]
weight = 1

[grasp]
point = [0.0, 0.05]

[[surface]]
name = "floor"
normal = [0.0, 2.0]
offset = 0.0

[[surface]]
name = "wall"
normal = [-1.0, 0.0]
offset = -1.0

[friction]
static = 0.5
dynamic = 0.3
"#;

pub(crate) fn drag_scene() -> Scene {
    scene(SCENE)
}

/// A frame with the box at `x` and the hand at `hand`, holding it at `grip` (body frame).
pub(crate) fn pressed(t: f64, hand: [f64; 3], x: f64, grip: [f64; 2]) -> Frame {
    let force = [K * (hand[0] - x - grip[0]), K * (hand[1] - grip[1])];
    let normal = WEIGHT - force[1];
    let lever = [grip[0] + WIDTH / 2.0, grip[1]];
    let moment = lever[0] * force[1] - lever[1] * force[0] - WIDTH / 2.0 * WEIGHT;
    let second = -moment / WIDTH;
    let contact = |vertex: usize, share: f64| Contact {
        touch: on(vertex, 0),
        direction: None,
        point: [x + WIDTH * (vertex as f64 - 0.5), 0.0],
        normal: share,
        friction: -force[0] * share / normal,
        sliding: None,
    };
    Frame {
        state: State::Edge,
        contacts: vec![contact(0, normal - second), contact(1, second)],
        wrench: [force[0], force[1], 0.0],
        ..frame(t, hand, [x, 0.0, 0.0])
    }
}

/// The whole trace; `jumps`: the hand jumps from frame to frame.
pub(crate) fn drag(jumps: bool) -> Vec<Frame> {
    let normal = WEIGHT + K * 0.01;
    let lead = STATIC * normal / K;
    let (mut x, mut t) = (0.0, 1.0);
    let mut frames = vec![
        pressed(0.0, [0.0, GRIP, 0.0], x, [0.0, GRIP]),
        pressed(1.0, [0.0, GRIP - 0.01, 0.0], x, [0.0, GRIP]),
    ];
    for i in 1..=40 {
        t += 1.0;
        let hand = [STRIDE * f64::from(i), GRIP - 0.01, 0.0];
        let slips = hand[0] - x > lead;
        if slips {
            let least = DYNAMIC * normal / K;
            let before = if jumps { hand[0] - x } else { lead };
            x += before - least;
        }
        let mut frame = pressed(t, hand, x, [0.0, GRIP]);
        if slips {
            (frame.slips, frame.events) = (1, vec![Event::Slip]);
        }
        frames.push(frame);
    }
    frames.extend(regrasped(t, x));
    frames
}

/// The hand lets go, moves until the box's centroid is 10 mm to its left, grasps, turned by 0.2 rad, and presses.
fn regrasped(t: f64, x: f64) -> Vec<Frame> {
    let place = [x + 0.01, CENTROID, 0.2];
    let mut frames = Vec::new();
    for (i, hand) in [[x, 0.2, 0.0], place].into_iter().enumerate() {
        let mut frame = pressed(t + 1.0 + i as f64, hand, x, [0.0, GRIP]);
        frame.held = false;
        frame.wrench = [0.0; 3];
        for contact in &mut frame.contacts {
            (contact.normal, contact.friction) = (0.0, 0.0);
        }
        frames.push(frame);
    }
    frames[0].events = vec![Event::Release];
    for (i, down) in [0.0, 0.001].into_iter().enumerate() {
        let hand = [place[0], place[1] - down, place[2]];
        frames.push(pressed(t + 3.0 + i as f64, hand, x, [0.01, CENTROID]));
    }
    frames[2].events = vec![Event::Grasp];
    frames
}
