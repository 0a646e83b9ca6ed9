//! Forces and events of a step on the wire (FRAME 5.2, 5.3).

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink};
use crate::list::List;
use stiction_core::{Contact, Event, MAX_CONTACTS, MAX_EVENTS, Wrench};

/// The forces after a step; SI units, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forces<'a> {
    /// Force (N, world frame) and moment (N·m, about the holding point, counter-clockwise positive) of the hand's springs on the
    /// body: the bits of the solver.
    pub wrench: Wrench<f32>,
    /// What the board outputs to the hand (N, N·m, world frame), after its limits: the opposite of `wrench` unless something limits it.
    pub feedback: Wrench<f32>,
    /// The whole turns of theta.
    pub turns: i32,
    /// The contacts, with their reactions (N); a board sends at most [`MAX_CONTACTS`](stiction_core::MAX_CONTACTS), 8.
    pub contacts: List<'a, Contact<f32>>,
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

impl<'a> Forces<'a> {
    const HEAD_BYTES: usize = 2 * Wrench::<f32>::BYTES + i32::BYTES + 1;
    /// With the most contacts that a state has.
    pub(crate) const LONGEST: usize = Self::HEAD_BYTES + MAX_CONTACTS * Contact::<f32>::BYTES;

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        self.wrench.put(sink);
        self.feedback.put(sink);
        self.turns.put(sink);
        self.contacts.len().put(sink);
        self.contacts.write(sink);
    }

    /// Reads the payload of forces (FRAME 5.2); fails if its length does not match the number of contacts.
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(Self::HEAD_BYTES)?;
        Ok(Self {
            wrench: fields.get()?,
            feedback: fields.get()?,
            turns: fields.get()?,
            contacts: List::rest(fields)?,
        })
    }
}

impl<'a> Events<'a> {
    const HEAD_BYTES: usize = u32::BYTES + f32::BYTES + 1;
    /// With the most events that a step reports.
    pub(crate) const LONGEST: usize = Self::HEAD_BYTES + MAX_EVENTS * Event::BYTES;

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        self.slips.put(sink);
        self.longest_slip.put(sink);
        self.list.len().put(sink);
        self.list.write(sink);
    }

    /// Reads the payload of events (FRAME 5.3); fails if its length does not match the number of events.
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(Self::HEAD_BYTES)?;
        Ok(Self {
            slips: fields.get()?,
            longest_slip: fields.get()?,
            list: List::rest(fields)?,
        })
    }
}
