//! The pose on the wire (FRAME 5.1): 33 bytes including all framing, with the bits of the solver.

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink, code_of, entry_of, require};
use stiction_core::{Angle, Event, Output, StateKind, Status};

/// A set of events: a bit for each one, in the order of [`Event::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct EventSet {
    bits: u16,
}

impl EventSet {
    /// The bits of all events.
    const ALL: u16 = (1 << Event::ALL.len()) - 1;

    /// The events of a list.
    pub fn of(events: &[Event]) -> Self {
        let mut set = Self::default();
        for &event in events {
            set.insert(event);
        }
        set
    }
    /// Adds an event.
    pub fn insert(&mut self, event: Event) {
        self.bits |= Self::bit(event);
    }
    /// Events of this set or of the other one.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self {
            bits: self.bits | other.bits,
        }
    }
    /// The event is in the set.
    pub fn contains(self, event: Event) -> bool {
        self.bits & Self::bit(event) != 0
    }
    /// The bit of an event: bit k for event k of [`Event::ALL`].
    fn bit(event: Event) -> u16 {
        let code = u32::from(code_of(&Event::ALL, &event));
        1_u16.checked_shl(code).unwrap_or_default()
    }
}

/// The pose of the body after a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position of the body's origin (m), world frame.
    pub position: [f32; 2],
    /// The remainder of theta (rad), in [-pi, pi], counter-clockwise positive.
    pub rest: f32,
    /// The whole turns of theta modulo 8; [`Pose::angle`] determines the full number.
    pub turns: u8,
    /// Depth coordinate (m), as in the sample of the hand.
    pub depth: f32,
    /// The contact state.
    pub state: StateKind,
    /// What limited the answer.
    pub status: Status,
    /// The hand holds the body.
    pub held: bool,
    /// The board outputs no force to the hand; [`Health::drive`](crate::Health::drive) has the reason.
    pub force_off: bool,
    /// What happened since the last pose that was sent.
    pub events: EventSet,
    /// Sequence number of the newest sample of the hand that this pose follows.
    pub sample: u8,
}

/// Turns are sent modulo this power of two.
const TURNS: i32 = 8;
/// The bits of the flags: the code of the status, and two flags.
const STATUS: u8 = 0b1111;
const HELD: u8 = 1 << 4;
const FORCE_OFF: u8 = 1 << 5;
/// The turns are the upper bits of the events.
const TURNS_FROM: u32 = 13;
const TURNS_BITS: u16 = 0b111 << TURNS_FROM;

impl Pose {
    /// The pose of an answer of the solver, bit for bit. `events` are those since the last pose that was sent, including those of this
    /// answer.
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

    /// Theta with all its turns: of the numbers that fit, the one nearest to the turns of an earlier pose.
    ///
    /// ```
    /// use stiction_core::Angle;
    /// use stiction_wire::Pose;
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

    /// The lower bits of the type.
    pub(crate) fn state_code(&self) -> u8 {
        code_of(&StateKind::ALL, &self.state)
    }

    pub(crate) const BYTES: usize = 20;

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        let [x, y] = self.position;
        [x, y, self.rest, self.depth].put(sink);
        let held = if self.held { HELD } else { 0 };
        let off = if self.force_off { FORCE_OFF } else { 0 };
        (status_code(self.status) | held | off).put(sink);
        (self.events.bits | u16::from(self.turns) << TURNS_FROM).put(sink);
        self.sample.put(sink);
    }

    /// Reads the payload of a pose (FRAME 5.1) whose type has the state in its lower bits; fails if the length is wrong or a bit is set
    /// that must be 0.
    pub(crate) fn read(state: u8, fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        fields.exactly(Self::BYTES)?;
        let [x, y, rest, depth] = fields.get()?;
        let (flags, happened): (u8, u16) = (fields.get()?, fields.get()?);
        let events = happened & !TURNS_BITS;
        let known = flags & !(STATUS | HELD | FORCE_OFF) == 0 && events & !EventSet::ALL == 0;
        require(known, FaultKind::Value)?;
        let [turns, _] = (happened >> TURNS_FROM).to_le_bytes();
        Ok(Self {
            position: [x, y],
            rest,
            turns,
            depth,
            state: entry_of(&StateKind::ALL, state)?,
            status: status(flags & STATUS),
            held: flags & HELD != 0,
            force_off: flags & FORCE_OFF != 0,
            events: EventSet { bits: events },
            sample: fields.get()?,
        })
    }
}

/// The code of a status. Codes never change; a new status takes the next one, wherever it is in [`Status::ALL`].
const fn status_code(status: Status) -> u8 {
    match status {
        Status::Ok => 0,
        Status::EventLimit => 1,
        Status::IterationLimit => 2,
        Status::Ambiguous => 3,
        Status::Saturated => 4,
        Status::HeldLast => 5,
        Status::Jammed => 6,
        Status::Twist => 7,
        Status::Behind => 8,
    }
}

/// The status of a code. A code of a future status counts as [`Status::Ambiguous`]: the pose may be out of balance.
fn status(code: u8) -> Status {
    let known = Status::ALL
        .into_iter()
        .find(|&one| status_code(one) == code);
    known.unwrap_or(Status::Ambiguous)
}

/// Turns modulo 8.
fn low_turns(turns: i32) -> u8 {
    let [low, ..] = turns.to_le_bytes();
    low & 7
}
