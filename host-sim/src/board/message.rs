//! The messages of a board, in a form that outlives the decoder's buffer.

use std::time::Instant;

use stiction_core::{Contact, Event, Wrench};
use stiction_wire::{
    Health, Info, KnobInfo, Mode, NumberType, Pose, Reason, Reference, Reply, Report, Subject,
};

#[derive(Clone, Debug)]
pub(super) struct Received {
    /// Arrival time of its last byte.
    pub(super) at: Instant,
    /// The board's clock (µs).
    pub(super) time: u32,
    pub(super) said: Said,
}

#[derive(Clone, Debug)]
pub(super) enum Said {
    Pose(Pose),
    Forces(Forces),
    Events(Events),
    Answer(Answer),
    About(About),
    Health(Health),
    Pong,
    Knob(KnobInfo),
}

/// [`stiction_wire::Forces`] without the wrench that the board applies to the hand, which depends on its limits.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Forces {
    pub(super) wrench: Wrench<f32>,
    pub(super) turns: i32,
    pub(super) contacts: Vec<Contact<f32>>,
}

/// [`stiction_wire::Events`].
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Events {
    pub(super) slips: u32,
    pub(super) longest_slip: f32,
    pub(super) list: Vec<Event>,
}

impl Events {
    /// These events and later ones, of which at most `most` are listed.
    pub(super) fn merge(&mut self, later: Self, most: usize) {
        self.slips = self.slips.saturating_add(later.slips);
        self.longest_slip = self.longest_slip.max(later.longest_slip);
        let room = most.saturating_sub(self.list.len());
        self.list.extend(later.list.into_iter().take(room));
    }
}

/// [`stiction_wire::Reply`].
#[derive(Clone, Debug)]
pub(super) struct Answer {
    pub(super) command: Reference,
    pub(super) reason: Reason,
    pub(super) subject: Subject,
    pub(super) value: f32,
    pub(super) limit: f32,
    pub(super) allowed: String,
}

/// [`stiction_wire::Info`].
#[derive(Clone, Debug)]
pub(super) struct About {
    pub(super) name: String,
    pub(super) version: [u8; 3],
    pub(super) number: NumberType,
    pub(super) vertices: u8,
    pub(super) surfaces: u8,
    pub(super) corners: u8,
    pub(super) actuators: bool,
    pub(super) longest_frame: u16,
    pub(super) fastest_tick: u16,
    pub(super) budget: u32,
    pub(super) stiffest: [f32; 2],
    pub(super) stiffness: [f32; 2],
    pub(super) friction_now: [f32; 2],
    pub(super) memory_now: Option<f32>,
    pub(super) mode: Mode,
}

impl From<Report<'_>> for Said {
    fn from(report: Report<'_>) -> Self {
        match report {
            Report::Pose(pose) => Self::Pose(pose),
            Report::Forces(forces) => Self::Forces(Forces {
                wrench: forces.wrench,
                turns: forces.turns,
                contacts: forces.contacts.iter().collect(),
            }),
            Report::Events(events) => Self::Events(Events {
                slips: events.slips,
                longest_slip: events.longest_slip,
                list: events.list.iter().collect(),
            }),
            Report::Reply(reply) => Self::Answer(reply.into()),
            Report::Info(info) => Self::About(info.into()),
            Report::Health(health) => Self::Health(health),
            Report::Pong(_) => Self::Pong,
            Report::KnobInfo(info) => Self::Knob(info),
        }
    }
}

impl From<Reply<'_>> for Answer {
    fn from(reply: Reply<'_>) -> Self {
        Self {
            command: reply.command,
            reason: reply.reason,
            subject: reply.subject,
            value: reply.value,
            limit: reply.limit,
            allowed: reply.allowed.to_string(),
        }
    }
}

impl From<Info<'_>> for About {
    fn from(info: Info<'_>) -> Self {
        Self {
            name: info.name.to_string(),
            version: info.version,
            number: info.number,
            vertices: info.vertices,
            surfaces: info.surfaces,
            corners: info.corners,
            actuators: info.actuators,
            longest_frame: info.longest_frame,
            fastest_tick: info.fastest_tick,
            budget: info.budget,
            stiffest: info.stiffest,
            stiffness: info.stiffness,
            friction_now: info.friction_now,
            memory_now: info.memory_now,
            mode: info.mode,
        }
    }
}
