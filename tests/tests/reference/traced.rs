//! The answers of the reference as a trace for the judge. Per frame the reference reports only the number of events: an event
//! gets a name only if the contacts before and after allow no other.

use stiction_judge::{Contact, Event, Frame, State, Status};
use stiction_tests::obstacles::before_judge::touch;
use stiction_tests::reference::{ContactForce, Reference, Scene};

use super::lawful::place;
use super::worlds::placed;

/// A contact in the judge's format.
fn contact(scene: &Scene, pose: [f64; 3], force: &ContactForce) -> Contact {
    let (point, direction) = place(scene, pose, force.touch);
    Contact {
        touch: touch(force.touch),
        point,
        direction: Some(direction),
        normal: force.normal,
        friction: force.friction,
        sliding: Some(force.slides),
    }
}

/// The record of a body, given the previous one.
pub(crate) fn frame(
    scene: &Scene,
    body: &Reference,
    (t, hand): (f64, [f64; 3]),
    last: Option<&Frame>,
) -> Frame {
    let pose = body.pose();
    let grip = placed(&[scene.holding_point], pose)[0];
    let contacts = body.contacts();
    let mut frame = Frame {
        t,
        hand,
        held: true,
        pose,
        depth: 0.0,
        state: State::named(body.state()).expect("a state"),
        contacts: contacts
            .iter()
            .map(|force| contact(scene, pose, force))
            .collect(),
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
    };
    if let Some(last) = last {
        frame.events = events(last, &frame, body.events());
    }
    frame
}

/// The events of a frame. The order of several events is unknown, so they get names that leave it open.
fn events(last: &Frame, next: &Frame, count: u32) -> Vec<Event> {
    let slides = |frame: &Frame| frame.contacts.iter().any(|c| c.sliding != Some(0));
    let touches = |frame: &Frame| frame.contacts.iter().map(|c| c.touch).collect::<Vec<_>>();
    let (before, after) = (touches(last), touches(next));
    let slide = if slides(next) {
        vec![Event::Slide]
    } else {
        Vec::new()
    };
    match (count, next.slips) {
        (0, _) => Vec::new(),
        (1, 0) if before == after => match (slides(last), slides(next)) {
            (false, true) => slide,
            (true, false) => vec![Event::Stop],
            _ => vec![Event::Snap],
        },
        (1, 0) if before.iter().all(|touch| after.contains(touch)) => {
            [vec![Event::Touch], slide].concat()
        }
        (1, 0) if after.is_empty() => vec![Event::Lift],
        (1, 1) if before == after && !slides(last) => [vec![Event::Slip], slide].concat(),
        _ => vec![Event::Touch, Event::Slip, Event::Lift],
    }
}
