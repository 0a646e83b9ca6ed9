//! Scenes and runs among obstacles, converted for the judge of traces, which knows nothing of the solver.

use super::run::{Contact, Frame};
use super::scene::Among;
use crate::number::Number;
use crate::reference::Touch;
use stiction_core::SurfaceDescription;
use stiction_judge::{Event, Obstacle, Scene, State, Status, Surface};

/// The scene as the number type rounds it.
pub fn scene<R: Number>(among: &Among) -> Scene {
    let Among { setup, obstacles } = among.rounded::<R>();
    let surface = |(i, s): (usize, &SurfaceDescription<f64>)| {
        let [x, y] = s.normal;
        Surface {
            name: i.to_string(),
            normal: s.normal.map(|n| n / x.hypot(y)),
            offset: s.offset,
            friction_static: s.friction_static,
            friction_dynamic: s.friction_dynamic,
            memory: s.memory,
        }
    };
    let obstacle = |(i, o): (usize, &super::Obstacle)| Obstacle {
        name: i.to_string(),
        vertices: o.vertices.clone(),
        friction_static: o.friction[0],
        friction_dynamic: o.friction[1],
        memory: None,
    };
    Scene {
        start: setup.start,
        weight: setup.weight,
        holding_point: setup.holding_point,
        stiffness_translation: setup.stiffness_translation,
        stiffness_rotation: setup.stiffness_rotation,
        surfaces: setup.surfaces.iter().enumerate().map(surface).collect(),
        obstacles: obstacles.iter().enumerate().map(obstacle).collect(),
        vertices: setup.vertices,
    }
}

/// Frame `i`, one second after the frame before it.
///
/// # Panics
/// If the judge does not know a name.
pub fn frame(i: usize, frame: &Frame) -> stiction_judge::Frame {
    let contact = |c: &Contact| stiction_judge::Contact {
        touch: touch(c.touch),
        point: c.point,
        direction: Some(c.direction),
        normal: c.normal,
        friction: c.friction,
        sliding: Some(c.sliding),
    };
    stiction_judge::Frame {
        t: i as f64,
        hand: frame.hand,
        held: frame.held,
        pose: frame.pose,
        depth: 0.0,
        state: State::named(frame.state).expect("a state"),
        contacts: frame.contacts.iter().map(contact).collect(),
        complete: true,
        wrench: frame.wrench,
        slips: frame.slips,
        events: (frame.events.iter())
            .map(|event| Event::named(event.name()).expect("an event"))
            .collect(),
        status: Status::named(frame.status.name()).expect("a status"),
        behind: None,
    }
}

/// The pair of touching features.
pub fn touch(of: Touch) -> stiction_judge::Touch {
    match of {
        Touch::Surface { vertex, surface } => stiction_judge::Touch::Surface { vertex, surface },
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => stiction_judge::Touch::Side {
            vertex,
            obstacle,
            side,
        },
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => stiction_judge::Touch::Corner {
            obstacle,
            corner,
            body_side,
        },
    }
}
