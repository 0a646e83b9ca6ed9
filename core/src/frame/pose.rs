//! The pose on the wire (FRAME 5.1): 32 bytes with everything around it, and the bits of the solver.

use super::fault::FaultKind;
use super::fields::{Fields, Sink, at, index_of};
use crate::event::{Event, StateKind, Status};
use crate::geometry::Angle;
use crate::output::Output;

/// A set of events. Grasp and release are one entry of it; which one it was, is told by [`Pose::held`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct EventSet {
    bits: u8,
}

impl EventSet {
    /// The events of a list.
    pub fn of(events: &[Event]) -> Self {
        let mut set = Self::default();
        for &event in events {
            set.insert(event);
        }
        set
    }
    /// Adds an event.
    pub const fn insert(&mut self, event: Event) {
        self.bits |= Self::bit(event);
    }
    /// Events of this set or of the other one.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self {
            bits: self.bits | other.bits,
        }
    }
    /// The event is in the set; grasp and release both are where one of them is.
    pub const fn contains(self, event: Event) -> bool {
        self.bits & Self::bit(event) != 0
    }
    const fn bit(event: Event) -> u8 {
        match event {
            Event::Touch => 1,
            Event::Lift => 1 << 1,
            Event::Slip => 1 << 2,
            Event::Tip => 1 << 3,
            Event::Land => 1 << 4,
            Event::Snap => 1 << 5,
            Event::Jam => 1 << 6,
            Event::Grasp | Event::Release => 1 << 7,
            Event::Slide | Event::Stop => 0,
        }
    }
}

/// The pose of the body after a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position of the body's origin (m), world frame.
    pub position: [f32; 2],
    /// The remainder of theta (rad), in [-pi, pi], counter-clockwise positive.
    pub rest: f32,
    /// The whole turns of theta modulo 8; [`Pose::angle`] tells which ones they are.
    pub turns: u8,
    /// Depth coordinate (m), as in the sample of the hand.
    pub depth: f32,
    /// The contact state.
    pub state: StateKind,
    /// What limited the answer.
    pub status: Status,
    /// The hand holds the body.
    pub held: bool,
    /// The board gives no force to the hand; [`Health::drive`](super::Health::drive) tells why.
    pub force_off: bool,
    /// What happened since the last pose that was sent.
    pub events: EventSet,
    /// Sequence number of the newest sample of the hand that this pose follows.
    pub sample: u8,
}

/// Turns are sent modulo this power of two.
const TURNS: i32 = 8;

impl Pose {
    /// The pose of an answer of the solver: its bits. `events` are those since the last pose that was sent, the ones of
    /// this answer among them.
    pub fn new(output: &Output<f32>, events: EventSet, sample: u8) -> Self {
        Self {
            position: output.position,
            rest: output.angle.rest,
            turns: low_turns(output.angle.turns),
            depth: output.depth,
            state: output.state,
            status: output.status,
            held: output.held,
            force_off: false,
            events,
            sample,
        }
    }

    /// Theta with all its turns: of those that fit, the ones nearest to the turns of an earlier pose.
    ///
    /// ```
    /// use stiction_core::Angle;
    /// use stiction_core::frame::Pose;
    ///
    /// let pose = Pose { rest: -3.1, turns: 1, ..Pose::default() };
    /// let before = Angle { turns: 8, rest: 3.1 };
    /// assert_eq!(pose.angle(before).turns, 9);
    /// ```
    pub fn angle(&self, before: Angle<f32>) -> Angle<f32> {
        let ahead = i32::from(self.turns).wrapping_sub(before.turns) & (TURNS - 1);
        let change = if ahead < TURNS / 2 {
            ahead
        } else {
            ahead.wrapping_sub(TURNS)
        };
        Angle {
            turns: before.turns.wrapping_add(change),
            rest: self.rest,
        }
    }

    /// This event happened since the last pose that was sent; of grasp and release only the last one is told.
    pub fn saw(&self, event: Event) -> bool {
        let told = match event {
            Event::Grasp => self.held,
            Event::Release => !self.held,
            _ => true,
        };
        told && self.events.contains(event)
    }

    /// The lower bits of the type.
    pub(super) fn state_code(&self) -> u8 {
        index_of(&StateKind::ALL, &self.state)
    }

    pub(super) fn write(&self, sink: &mut impl Sink) {
        sink.f32s(&self.position);
        sink.f32(self.rest);
        sink.f32(self.depth);
        let status = index_of(&Status::ALL, &self.status);
        let held = if self.held { 1 << 3 } else { 0 };
        let off = if self.force_off { 1 << 4 } else { 0 };
        sink.parts(&[status, held, off, (self.turns & 7) << 5]);
        sink.byte(self.events.bits);
        sink.byte(self.sample);
    }

    pub(super) fn read(state: u8, fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        fields.exactly(19)?;
        let [x, y, rest, depth] = fields.f32s();
        let [flags, events, sample] = fields.take();
        Ok(Self {
            position: [x, y],
            rest,
            turns: flags >> 5,
            depth,
            state: at(&StateKind::ALL, state)?,
            status: at(&Status::ALL, flags & 7)?,
            held: flags & (1 << 3) != 0,
            force_off: flags & (1 << 4) != 0,
            events: EventSet { bits: events },
            sample,
        })
    }
}

/// Turns modulo 8.
fn low_turns(turns: i32) -> u8 {
    let [low, ..] = turns.to_le_bytes();
    low & 7
}
