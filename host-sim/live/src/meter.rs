//! Whitney's meter of a run: makes the judge's [`Meter`] from its scene, and readings from its frames.

use stiction_judge::Scene;
use stiction_judge::insertion::{Insertion, Meter, Reaction, SmallAngles, Springs};
use stiction_scene::WrittenScene;

use crate::record::{Frame, Run};

/// Returns the meter of a scene that has a peg and a hole.
pub fn of_scene(scene: &WrittenScene) -> Option<Meter> {
    Meter::find(&Scene::from(scene))
}

/// Returns the reading of a frame; none if the peg is not in its hole.
pub fn read(meter: &Meter, frame: &Frame) -> Option<Insertion> {
    let contacts: Vec<Reaction> = (frame.contacts.iter())
        .map(|contact| Reaction {
            point: contact.point,
            direction: contact.direction,
            normal: contact.normal,
            friction: contact.friction,
        })
        .collect();
    meter.read(frame.pose, &contacts)
}

/// Returns F_z by Whitney's formulas at the depth of a frame (m) while a hand holds the body.
pub fn small_angles(
    meter: &Meter,
    depth: f64,
    frame: &Frame,
    [translation, rotation]: [f64; 2],
) -> SmallAngles {
    if !frame.held {
        return SmallAngles::default();
    }
    let [x, y, _] = frame.hand;
    let springs = Springs {
        translation,
        rotation,
        hand: [x, y],
        wrench: frame.wrench,
    };
    meter.small_angles(depth, frame.pose, &springs)
}

impl Run {
    /// Returns the frames in which the peg is in its hole, with their readings.
    pub fn readings(&self) -> impl Iterator<Item = (&Frame, Insertion)> {
        let frames = self.meter.iter().flat_map(|_| &self.frames);
        frames.filter_map(|frame| Some((frame, read(self.meter.as_ref()?, frame)?)))
    }
}
