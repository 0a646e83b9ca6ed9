//! Frames, contacts and events as rows of numbers, the elements of numpy's structured arrays (`package/stiction/_tables.py`).

use bytemuck::{Pod, Zeroable};
use stiction_core::{Event, StateKind, Status, Touch};
use stiction_live::record::{ContactRecord, Frame};

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct FrameRow {
    t: f64,
    hand: [f64; 3],
    pose: [f64; 3],
    depth: f64,
    wrench: [f64; 3],
    longest_slip: f64,
    /// NaN without a budget.
    behind: f64,
    slips: u32,
    held: u8,
    state: u8,
    status: u8,
    padding: u8,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct ContactRow {
    point: [f64; 2],
    /// NaN if the scene has no obstacles.
    direction: [f64; 2],
    normal: f64,
    friction: f64,
    frame: u32,
    surface: i16,
    obstacle: i16,
    side: i16,
    corner: i16,
    vertex: i8,
    body_side: i8,
    sliding: i8,
    padding: u8,
}

#[repr(C, align(8))]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct EventRow {
    frame: u32,
    event: u8,
    padding: [u8; 3],
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<'a> {
    pub(crate) frames: &'a [FrameRow],
    pub(crate) contacts: &'a [ContactRow],
    pub(crate) events: &'a [EventRow],
}

impl Rows<'_> {
    /// Checks that they are the tables of a run.
    pub(crate) fn check(&self) -> Result<(), String> {
        let of_contacts = self.contacts.iter().map(|row| row.frame);
        in_order("contacts", of_contacts, self.frames.len())?;
        let of_events = self.events.iter().map(|row| row.frame);
        in_order("events", of_events, self.frames.len())?;
        let undefined = |row: &FrameRow| row.state().is_none() || row.status().is_none();
        match self.frames.iter().position(undefined) {
            Some(row) => Err(format!(
                "`frames`, row {row}: the state or status is undefined"
            )),
            None if self.events.iter().any(|row| event(row.event).is_none()) => {
                Err("`events`: an event is undefined".to_owned())
            }
            None => Ok(()),
        }
    }

    /// Their size (bytes).
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.frames) + size_of_val(self.contacts) + size_of_val(self.events)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = Frame> {
        let (mut contacts, mut events) = (self.contacts, self.events);
        (0..self.frames.len()).filter_map(move |i| {
            let of_frame = contacts.partition_point(|row| row.frame as usize <= i);
            let happened = events.partition_point(|row| row.frame as usize <= i);
            let of_frame = contacts.split_off(..of_frame)?;
            self.frame_with(i, of_frame, events.split_off(..happened)?)
        })
    }

    fn frame_with(&self, i: usize, contacts: &[ContactRow], events: &[EventRow]) -> Option<Frame> {
        let row = &self.frames[i];
        Some(Frame {
            t: row.t,
            hand: row.hand,
            held: row.held != 0,
            pose: row.pose,
            depth: row.depth,
            state: row.state()?,
            contacts: contacts.iter().map(ContactRow::record).collect(),
            wrench: row.wrench,
            slips: row.slips,
            longest_slip: row.longest_slip,
            events: events.iter().filter_map(|row| event(row.event)).collect(),
            status: row.status()?,
            behind: (!row.behind.is_nan()).then_some(row.behind),
        })
    }
}

fn in_order(
    table: &str,
    frames: impl Iterator<Item = u32> + Clone,
    count: usize,
) -> Result<(), String> {
    let known = frames.clone().all(|frame| (frame as usize) < count);
    if known && frames.is_sorted() {
        return Ok(());
    }
    Err(format!(
        "`{table}` has a column `frame` that is not in order or too large, allowed: 0 to {}, in order",
        count.saturating_sub(1)
    ))
}

fn event(number: u8) -> Option<Event> {
    Event::ALL.get(usize::from(number)).copied()
}

/// The value that represents no index.
const NONE: i8 = -1;

/// An index: at most 64 vertices, 16 surfaces, 32 obstacles and 128 corners.
fn small<T: TryFrom<usize> + From<i8>>(index: usize) -> T {
    T::try_from(index).unwrap_or(T::from(NONE))
}

fn large(index: impl Into<i64>) -> usize {
    usize::try_from(index.into()).unwrap_or(usize::MAX)
}

impl FrameRow {
    pub(crate) fn new(frame: &Frame) -> Self {
        Self {
            t: frame.t,
            hand: frame.hand,
            pose: frame.pose,
            depth: frame.depth,
            wrench: frame.wrench,
            longest_slip: frame.longest_slip,
            behind: frame.behind.unwrap_or(f64::NAN),
            slips: frame.slips,
            held: frame.held.into(),
            state: frame.state as u8,
            status: frame.status as u8,
            padding: 0,
        }
    }

    fn state(&self) -> Option<StateKind> {
        StateKind::ALL.get(usize::from(self.state)).copied()
    }

    fn status(&self) -> Option<Status> {
        Status::ALL.get(usize::from(self.status)).copied()
    }
}

impl EventRow {
    pub(crate) fn new(frame: u32, event: Event) -> Self {
        Self {
            frame,
            event: event as u8,
            padding: [0; 3],
        }
    }
}

impl ContactRow {
    pub(crate) fn new(frame: u32, contact: &ContactRecord) -> Self {
        let mut row = Self {
            point: contact.point,
            direction: contact.direction,
            normal: contact.normal,
            friction: contact.friction,
            frame,
            surface: NONE.into(),
            obstacle: NONE.into(),
            side: NONE.into(),
            corner: NONE.into(),
            vertex: NONE,
            body_side: NONE,
            sliding: contact.sliding,
            padding: 0,
        };
        match contact.touch {
            Touch::Surface { vertex, surface } => {
                (row.vertex, row.surface) = (small(vertex), small(surface));
            }
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => {
                (row.vertex, row.obstacle, row.side) =
                    (small(vertex), small(obstacle), small(side));
            }
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => {
                (row.obstacle, row.corner, row.body_side) =
                    (small(obstacle), small(corner), small(body_side));
            }
        }
        row
    }

    fn record(&self) -> ContactRecord {
        let touch = if self.surface >= 0 {
            Touch::Surface {
                vertex: large(self.vertex),
                surface: large(self.surface),
            }
        } else if self.corner >= 0 {
            Touch::Corner {
                obstacle: large(self.obstacle),
                corner: large(self.corner),
                body_side: large(self.body_side),
            }
        } else {
            Touch::Side {
                vertex: large(self.vertex),
                obstacle: large(self.obstacle),
                side: large(self.side),
            }
        };
        ContactRecord {
            touch,
            point: self.point,
            normal: self.normal,
            friction: self.friction,
            sliding: self.sliding,
            direction: self.direction,
        }
    }
}
