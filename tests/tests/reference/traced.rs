//! The answers of the reference as a trace for the judge. Per frame the reference reports only the number of events: an event
//! gets a name only if the contacts before and after allow no other.

use stiction_judge::{Event, Frame};
use stiction_tests::obstacles::answers::frame_of;
use stiction_tests::reference::{Reference, Scene};

/// The record of a body, given the previous one.
pub(crate) fn frame(
    scene: &Scene,
    body: &Reference,
    now: (f64, [f64; 3]),
    last: Option<&Frame>,
) -> Frame {
    let mut frame = frame_of(scene, body, now);
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
