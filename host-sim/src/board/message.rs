//! The messages of a board, in a form that outlives the decoder's buffer.

use std::time::Instant;

use stiction_core::{Contact, Event, Touch, Wrench};
use stiction_wire::{
    ContactAmong, Health, Info, Mode, NumberType, Pose, Reason, Reference, Reply, Report,
    ReportAmong, Room, Subject,
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
    /// Precedes the board's description of itself.
    Room(Room),
    Pong,
}

/// [`stiction_wire::Forces`] without the wrench that the board applies to the hand, which depends on its limits.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Forces {
    pub(super) wrench: Wrench<f32>,
    pub(super) turns: i32,
    pub(super) contacts: Vec<Touched>,
}

/// A contact, on half-planes alone or among obstacles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touched {
    /// By the indices of the board's scene.
    pub(super) touch: Touch,
    /// The unit normal n towards the body; `None` without obstacles.
    pub(super) direction: Option<[f32; 2]>,
    pub(super) point: [f32; 2],
    pub(super) normal: f32,
    pub(super) friction: f32,
    pub(super) sliding: i8,
}

impl From<Contact<f32>> for Touched {
    fn from(contact: Contact<f32>) -> Self {
        Self {
            touch: Touch::Surface {
                vertex: contact.vertex,
                surface: contact.surface,
            },
            direction: None,
            point: contact.point,
            normal: contact.normal,
            friction: contact.friction,
            sliding: contact.sliding,
        }
    }
}

impl From<ContactAmong> for Touched {
    fn from(contact: ContactAmong) -> Self {
        Self {
            touch: contact.touch,
            direction: Some(contact.direction),
            point: contact.point,
            normal: contact.normal,
            friction: contact.friction,
            sliding: contact.sliding,
        }
    }
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

/// [`stiction_wire::Info`], and the room that was reported before it.
#[derive(Clone, Debug)]
pub(super) struct About {
    pub(super) name: String,
    pub(super) version: [u8; 3],
    pub(super) number: NumberType,
    pub(super) vertices: u8,
    pub(super) surfaces: u8,
    /// None if the board did not report it.
    pub(super) room: Room,
    pub(super) friction: bool,
    pub(super) weight: bool,
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
                contacts: forces.contacts.iter().map(Touched::from).collect(),
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
        }
    }
}

impl From<ReportAmong<'_>> for Said {
    fn from(report: ReportAmong<'_>) -> Self {
        match report {
            ReportAmong::Common(report) => report.into(),
            ReportAmong::Room(room) => Self::Room(room),
            ReportAmong::ForcesAmong(forces) => Self::Forces(Forces {
                wrench: forces.wrench,
                turns: forces.turns,
                contacts: forces.contacts.iter().map(Touched::from).collect(),
            }),
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
            room: Room::default(),
            friction: info.friction,
            weight: info.weight,
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
