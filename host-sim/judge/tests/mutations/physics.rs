//! Frames with a displaced body and consistent springs and reactions, so that only the position is wrong.

use stiction_judge::{Contact, Frame, State, Touch, centroid};
use stiction_tests::obstacles::shape::{dot, placed, sub};

use crate::truth::Truth;

type Vec2 = [f64; 2];

fn cross(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// n at the contact of a vertex.
pub(crate) fn normal(truth: &Truth, contact: &Contact) -> Vec2 {
    match contact.touch {
        Touch::Surface { surface, .. } => truth.scene.surfaces[surface].normal,
        _ => contact.direction.expect("reported among obstacles"),
    }
}

/// t
pub(crate) fn tangent(truth: &Truth, contact: &Contact) -> Vec2 {
    let [x, y] = normal(truth, contact);
    [y, -x]
}

/// The hand of a frame, with the body where it was.
pub(crate) fn frozen(last: &Frame, next: &Frame) -> Frame {
    Frame {
        pose: last.pose,
        state: last.state,
        contacts: last.contacts.clone(),
        wrench: last.wrench,
        ..next.clone()
    }
}

/// A frame whose body is displaced along the tangent of its first contact (m), with its reactions.
pub(crate) fn moved(truth: &Truth, frame: &Frame, by: f64) -> Frame {
    let way = tangent(truth, &frame.contacts[0]).map(|x| by * x);
    let mut frame = frame.clone();
    for (k, x) in way.into_iter().enumerate() {
        frame.pose[k] += x;
        frame.contacts.iter_mut().for_each(|c| c.point[k] += x);
    }
    loaded(truth, &frame)
}

/// A frame of a vertex or an edge with the correct wrench of the springs, and reactions that bear it.
pub(crate) fn loaded(truth: &Truth, frame: &Frame) -> Frame {
    let scene = &truth.scene;
    let Some(grip) = scene.holding_point else {
        return frame.clone();
    };
    let mut frame = frame.clone();
    let [holding, heavy] = [grip, centroid(&scene.vertices)].map(|p| placed(&[p], frame.pose)[0]);
    let k = scene.stiffness_translation;
    let force = [0, 1].map(|i| k * (frame.hand[i] - holding[i]));
    let moment = scene.stiffness_rotation * (frame.hand[2] - frame.pose[2]);
    frame.wrench = [force[0], force[1], moment];
    let load = [force[0], force[1] - scene.weight];
    let moment = moment + cross(sub(heavy, holding), [0.0, -scene.weight]);
    let Some(first) = frame.contacts.first().copied() else {
        return frame;
    };
    let (n, t) = (normal(truth, &first), tangent(truth, &first));
    let (all, along) = (-dot(n, load), -dot(t, load));
    match (frame.state, frame.contacts.as_mut_slice()) {
        (State::SingleVertex, [one]) => (one.normal, one.friction) = (all, along),
        (State::Edge, [a, b]) => {
            let about = moment - cross(sub(a.point, holding), load);
            b.normal = -about / cross(sub(b.point, a.point), n);
            a.normal = all - b.normal;
            for contact in [a, b] {
                contact.friction = along * contact.normal / all;
            }
        }
        _ => {}
    }
    frame
}
