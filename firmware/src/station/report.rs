//! The reports that a board sends by itself (FRAME 5.1 to 5.3, 5.6): pose, forces, events, health, each as often as the mode requests; and
//! its description on request (5.5).

use super::{Desk, Link};
use crate::device::Turn;
use crate::model::BoardModel;
use stiction_core::{Output, Real, Status};
use stiction_wire::{
    Drive, EventSet, Events, Faults, Forces, Health, Info, List, Pose, Report, Text,
};

const VERSION: [u8; 3] = [
    number(env!("CARGO_PKG_VERSION_MAJOR")),
    number(env!("CARGO_PKG_VERSION_MINOR")),
    number(env!("CARGO_PKG_VERSION_PATCH")),
];

const fn number(text: &str) -> u8 {
    match u8::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => u8::MAX,
    }
}

/// What was reported and what is still to be reported.
#[derive(Clone, Debug)]
pub(super) struct Reported {
    /// What happened since the last pose that was sent.
    events: EventSet,
    /// The status of the last answer of the solver.
    status: Status,
    /// The sequence number of the newest sample in it.
    sample: u8,
    /// No sample arrived for so long that the pose is held.
    pub(super) silent: bool,
    /// Steps since a pose and since forces were due.
    since_pose: u16,
    since_forces: u16,
    /// When health was due last (µs).
    health_us: Option<u32>,
}

impl Reported {
    pub(super) fn new() -> Self {
        Self {
            events: EventSet::default(),
            status: Status::HeldLast,
            sample: 0,
            silent: true,
            since_pose: 0,
            since_forces: 0,
            health_us: None,
        }
    }

    /// The body starts again, and waits for a sample.
    pub(super) fn begin_anew(&mut self) {
        self.events = EventSet::default();
        self.status = Status::HeldLast;
    }

    pub(super) fn follows(&mut self, sample: u8) {
        self.sample = sample;
    }

    /// A new mode: everything is due at its own pace from now on.
    pub(super) fn count_anew(&mut self) {
        self.since_pose = 0;
        self.since_forces = 0;
        self.health_us = None;
    }
}

/// Counts one more step; returns whether the report is due.
fn due(since: &mut u16, every: u16) -> bool {
    *since = since.saturating_add(1);
    let is_due = every != 0 && *since >= every;
    if is_due {
        *since = 0;
    }
    is_due
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, M: BoardModel> Desk<R, V, S, M> {
    /// Sends a report that every board has; see [`Outbox::send`](super::Outbox::send).
    pub(super) fn say(&mut self, now_us: u32, report: Report<'_>, link: &mut impl Link) -> bool {
        self.outbox.send(now_us, report, link)
    }

    /// An answer of the solver: its events are reported immediately, or with the next pose.
    pub(super) fn happened(&mut self, output: &Output<f32>, now_us: u32, link: &mut impl Link) {
        self.reported.status = output.status;
        let list = output.events();
        if list.is_empty() {
            return;
        }
        self.reported.events = self.reported.events.union(EventSet::of(list));
        if self.mode.events {
            let events = Events {
                slips: output.slips,
                longest_slip: output.longest_slip,
                list: List::from(list),
            };
            self.say(now_us, Report::Events(events), link);
        }
    }

    pub(super) fn tell_step(&mut self, turn: &Turn, now_us: u32, link: &mut impl Link) {
        if due(&mut self.reported.since_pose, self.mode.pose_every) {
            let pose = Report::Pose(self.pose(turn));
            if self.say(now_us, pose, link) {
                self.reported.events = EventSet::default();
            }
        }
        if due(&mut self.reported.since_forces, self.mode.forces_every) {
            self.tell_forces(turn, now_us, link);
        }
    }

    fn pose(&self, turn: &Turn) -> Pose {
        let pose = &turn.pose;
        Pose {
            position: pose.position,
            rest: pose.angle.rest,
            // 0 to 7.
            turns: u8::try_from(pose.angle.turns.rem_euclid(8)).unwrap_or(0),
            depth: pose.depth,
            state: pose.state,
            status: if self.reported.silent {
                Status::HeldLast
            } else {
                self.reported.status
            },
            held: pose.held,
            force_off: self.latched || turn.flags.is_safe_state(),
            events: self.reported.events,
            sample: self.reported.sample,
        }
    }

    #[inline(never)]
    fn tell_forces(&mut self, turn: &Turn, now_us: u32, link: &mut impl Link) {
        let solver = self.controller.solver();
        let state = self.controller.state();
        let contacts = state.map(|state| solver.contacts(state));
        let forces = Forces {
            wrench: state.map(|state| solver.wrench(state)).unwrap_or_default(),
            feedback: turn.force,
            turns: turn.pose.angle.turns,
            contacts: List::from(contacts.as_deref().unwrap_or_default()),
        };
        self.outbox.send(now_us, Report::Forces(forces), link);
    }

    pub(super) fn tell_health(&mut self, faults: &Faults, now_us: u32, link: &mut impl Link) {
        let every_us = u32::from(self.mode.health_every).saturating_mul(1_000);
        let last = *self.reported.health_us.get_or_insert(now_us);
        if every_us == 0 || now_us.wrapping_sub(last) < every_us {
            return;
        }
        self.reported.health_us = Some(last.wrapping_add(every_us));
        let health = self.health(faults);
        self.say(now_us, Report::Health(health), link);
    }

    pub(super) fn health(&self, faults: &Faults) -> Health {
        let loops = self.controller.health();
        Health {
            drive: self.drive(),
            ticks: loops.ticks,
            missed_ticks: loops.missed_ticks,
            samples: self.intake.samples,
            late_samples: self.intake.late,
            lost_frames: self.intake.lost,
            unsent: self.outbox.unsent,
            worst_step: loops.worst_step,
            worst_tick: self.worst_tick,
            faults: *faults,
        }
    }

    fn drive(&self) -> Drive {
        if self.latched {
            Drive::Latched
        } else if self.flags.is_safe_state() {
            Drive::Silent
        } else {
            Drive::On
        }
    }

    #[inline(never)]
    pub(super) fn tell_info(&mut self, longest_frame: usize, now_us: u32, link: &mut impl Link) {
        let store = self.controller.store();
        let passivity = self.controller.settings().passivity;
        let (friction_now, memory_now) = store.first_friction().unwrap_or_default();
        let info = Info {
            version: VERSION,
            number: self.setup.number,
            vertices: u8::try_from(V).unwrap_or(u8::MAX),
            surfaces: u8::try_from(S).unwrap_or(u8::MAX),
            friction: M::FRICTION,
            weight: M::WEIGHT,
            corners: u8::try_from(M::CORNERS).unwrap_or(u8::MAX),
            actuators: passivity.is_some(),
            longest_frame: u16::try_from(longest_frame).unwrap_or(u16::MAX),
            fastest_tick: self.setup.fastest_tick,
            budget: self.controller.solver().budget(),
            stiffest: passivity.map_or([f32::INFINITY; 2], |passivity| passivity.bounds()),
            stiffness: store.stiffness(),
            friction_now,
            memory_now,
            mode: self.mode,
            name: Text::new(self.setup.name),
        };
        self.outbox.send(now_us, Report::Info(info), link);
    }
}
