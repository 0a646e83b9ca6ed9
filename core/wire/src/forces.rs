//! Forces and events of a step on the wire (FRAME 5.2, 5.3).

use crate::fault::FaultKind;
use crate::fields::{Fields, Sink, at, index_of};
use crate::list::{Item, List};
use stiction_core::{Contact, Event, MAX_CONTACTS, MAX_EVENTS, Wrench};

/// The forces after a step; SI units, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forces<'a, C: Item = Contact<f32>> {
    /// Force (N, world frame) and moment (N·m, about the holding point, counter-clockwise positive) of the hand's springs on the
    /// body: the bits of the solver.
    pub wrench: Wrench<f32>,
    /// What the board outputs to the hand (N, N·m, world frame), after its limits: the opposite of `wrench` unless something limits it.
    pub feedback: Wrench<f32>,
    /// The whole turns of theta.
    pub turns: i32,
    /// The contacts, with their reactions (N); a board sends at most [`MAX_CONTACTS`](stiction_core::MAX_CONTACTS), 8.
    pub contacts: List<'a, C>,
}

/// What happened in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Events<'a> {
    /// Slips that ended at mu_d N.
    pub slips: u32,
    /// The longest of them (m) >= 0; 0 without a slip.
    pub longest_slip: f32,
    /// The events in order; a board sends at most [`MAX_EVENTS`](stiction_core::MAX_EVENTS), 16.
    pub list: List<'a, Event>,
}

impl<'a, C: Item> Forces<'a, C> {
    const HEAD_BYTES: usize = 29;
    /// With the most contacts that a state has.
    pub(crate) const LONGEST: usize = Self::HEAD_BYTES + MAX_CONTACTS * C::BYTES;

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        for wrench in [self.wrench, self.feedback] {
            sink.f32s(&wrench.force);
            sink.f32(wrench.moment);
        }
        sink.i32(self.turns);
        sink.count(self.contacts.len());
        self.contacts.write(sink);
    }

    /// Reads the payload of forces (FRAME 5.2); fails if its length does not match the number of contacts.
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(Self::HEAD_BYTES)?;
        let wrench = |fields: &mut Fields<'_>| Wrench {
            force: fields.f32s(),
            moment: fields.f32(),
        };
        let (on_body, feedback) = (wrench(fields), wrench(fields));
        let (turns, count) = (fields.i32(), usize::from(fields.u8()));
        fields.exactly(count.saturating_mul(C::BYTES))?;
        Ok(Self {
            wrench: on_body,
            feedback,
            turns,
            contacts: List::take(fields, count)?,
        })
    }
}

impl<'a> Events<'a> {
    const HEAD_BYTES: usize = 9;
    /// With the most events that a step reports.
    pub(crate) const LONGEST: usize = Self::HEAD_BYTES + MAX_EVENTS * Event::BYTES;

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        sink.u32(self.slips);
        sink.f32(self.longest_slip);
        sink.count(self.list.len());
        self.list.write(sink);
    }

    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(Self::HEAD_BYTES)?;
        let (slips, longest_slip) = (fields.u32(), fields.f32());
        let count = usize::from(fields.u8());
        fields.exactly(count)?;
        Ok(Self {
            slips,
            longest_slip,
            list: List::take(fields, count)?,
        })
    }
}

impl Item for Contact<f32> {
    const BYTES: usize = 19;
    fn put(&self, sink: &mut impl Sink) {
        sink.count(self.vertex);
        sink.count(self.surface);
        sink.f32s(&self.point);
        sink.f32s(&[self.normal, self.friction]);
        sink.byte(self.sliding.cast_unsigned());
    }
    /// Reads a contact in the order of FRAME 5.2; its bytes have already been validated.
    fn get(fields: &mut Fields<'_>) -> Self {
        let [vertex, surface] = fields.take().map(usize::from);
        let point = fields.f32s();
        let [normal, friction] = fields.f32s();
        let sliding = fields.u8().cast_signed();
        Self {
            vertex,
            surface,
            point,
            normal,
            friction,
            sliding,
        }
    }
    fn valid(bytes: &[u8]) -> bool {
        bytes
            .last()
            .is_some_and(|&byte| (-1..=1).contains(&byte.cast_signed()))
    }
}

impl Item for Event {
    const BYTES: usize = 1;
    fn put(&self, sink: &mut impl Sink) {
        sink.byte(index_of(&Event::ALL, self));
    }
    fn get(fields: &mut Fields<'_>) -> Self {
        fields.code(&Event::ALL).unwrap_or(Self::Touch)
    }
    fn valid(bytes: &[u8]) -> bool {
        bytes.iter().all(|&code| at(&Event::ALL, code).is_ok())
    }
}
