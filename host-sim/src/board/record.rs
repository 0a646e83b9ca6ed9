//! Converts a sample and the board's answer to a frame of the trace, as the host's solver would have produced it. A board does
//! not report the lag of the body behind the hand: if the two are compared, it is the host's.

use stiction_core::{Angle, Hand, Status};
use stiction_scene::Indices;

use super::pending::Sent;
use super::steps::Step;
use stiction_live::record::{ContactRecord, Frame};

#[derive(Clone, Debug, Default)]
pub(super) struct Recorder {
    hand: Hand<f32>,
}

impl Recorder {
    /// The frame of an answer; nothing if a part of it was lost, or it came without forces. `indices`: the indices of the board's obstacles in the scene
    /// file, if they differ.
    pub(super) fn frame(
        &mut self,
        sent: &Sent,
        step: &Step,
        indices: Option<&Indices>,
    ) -> Option<Frame> {
        let pose = &step.pose;
        if !matches!(pose.status, Status::HeldLast | Status::Saturated) {
            self.hand = sent.hand;
        }
        if !step.is_whole {
            return None;
        }
        let forces = step.forces.as_ref()?;
        let events = step.events.clone().unwrap_or_default();
        let angle = Angle {
            turns: forces.turns,
            rest: pose.rest,
        };
        let placed = |[x, y]: [f32; 2], angle: f32| [f64::from(x), f64::from(y), f64::from(angle)];
        let frame = Frame {
            t: sent.sample.t,
            hand: placed(self.hand.position, self.hand.angle.radians()),
            held: pose.held,
            pose: placed(pose.position, angle.radians()),
            depth: f64::from(pose.depth),
            state: pose.state,
            contacts: forces
                .contacts
                .iter()
                .map(|contact| ContactRecord {
                    touch: contact.touch,
                    direction: contact.direction.map(f64::from),
                    point: contact.point.map(f64::from),
                    normal: f64::from(contact.normal),
                    friction: f64::from(contact.friction),
                    sliding: contact.sliding,
                })
                .collect(),
            wrench: placed(forces.wrench.force, forces.wrench.moment),
            slips: events.slips,
            longest_slip: f64::from(events.longest_slip),
            events: events.list,
            status: pose.status,
            behind: sent
                .expected
                .as_ref()
                .and_then(|expected| expected.behind()),
        };
        Some(frame.with_indices(indices))
    }
}
