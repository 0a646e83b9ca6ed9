//! Frames, contacts and events as rows of numbers: numpy has them as structured arrays with the same fields (`stiction/_tables.py`).

use bytemuck::{Pod, Zeroable};
use stiction_core::{Event, StateKind, Status, Touch};
use stiction_host_sim::record::{ContactRecord, Frame};

/// A frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct FrameRow {
    t: f64,
    hand: [f64; 3],
    pose: [f64; 3],
    depth: f64,
    wrench: [f64; 3],
    longest_slip: f64,
    /// Not a number where there is no budget.
    behind: f64,
    slips: u32,
    held: u8,
    state: u8,
    status: u8,
    padding: u8,
}

/// A contact of a frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct ContactRow {
    point: [f64; 2],
    /// Not a number where the scene has no obstacles.
    direction: [f64; 2],
    normal: f64,
    friction: f64,
    frame: u32,
    vertex: i16,
    surface: i16,
    obstacle: i16,
    side: i16,
    corner: i16,
    body_side: i16,
    sliding: i8,
    padding: [u8; 7],
}

/// An event of a frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct EventRow {
    frame: u32,
    event: u8,
    padding: [u8; 3],
}

/// No index.
const NONE: i16 = -1;

/// A run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    pub(crate) frames: Vec<FrameRow>,
    pub(crate) contacts: Vec<ContactRow>,
    pub(crate) events: Vec<EventRow>,
}

impl Rows {
    /// With room for so many frames.
    pub(crate) fn with_room(frames: usize) -> Self {
        Self {
            frames: Vec::with_capacity(frames),
            ..Self::default()
        }
    }

    /// Of tables.
    ///
    /// # Errors
    /// A row is of a frame that is not there, is out of order, or has a number that stands for nothing.
    pub(crate) fn of(
        frames: Vec<FrameRow>,
        contacts: Vec<ContactRow>,
        events: Vec<EventRow>,
    ) -> Result<Self, String> {
        let count = frames.len();
        let of_contacts: Vec<u32> = contacts.iter().map(|row| row.frame).collect();
        let of_events: Vec<u32> = events.iter().map(|row| row.frame).collect();
        for (name, list) in [("contacts", &of_contacts), ("events", &of_events)] {
            let known = list.iter().all(|&frame| (frame as usize) < count);
            if !known || !list.is_sorted() {
                return Err(format!(
                    "`{name}` has a column `frame` that is not in order or too large, allowed: 0 to {}, in order",
                    count.saturating_sub(1)
                ));
            }
        }
        let rows = Self {
            frames,
            contacts,
            events,
        };
        match (0..count).find(|&i| rows.frame_with((i, &[], &[])).is_none()) {
            Some(row) => Err(format!("`frames`, row {row}: state or status stands for nothing")),
            None if rows.events.iter().any(|row| event(row.event).is_none()) => {
                Err("`events`: an event stands for nothing".to_owned())
            }
            None => Ok(rows),
        }
    }

    /// Adds a frame.
    pub(crate) fn add(&mut self, frame: &Frame) {
        // A run of more frames than that does not fit into memory.
        let index = u32::try_from(self.frames.len()).unwrap_or(u32::MAX);
        self.frames.push(FrameRow {
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
        });
        let contacts = frame.contacts.iter().map(|contact| ContactRow::new(index, contact));
        self.contacts.extend(contacts);
        let event = |&event: &Event| EventRow {
            frame: index,
            event: event as u8,
            padding: [0; 3],
        };
        self.events.extend(frame.events.iter().map(event));
    }

    /// The frames, in their order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Frame> + '_ {
        let (mut contacts, mut events) = (&self.contacts[..], &self.events[..]);
        (0..self.frames.len()).filter_map(move |i| {
            let count = contacts.partition_point(|row| row.frame as usize <= i);
            let (of_frame, rest) = contacts.split_at(count);
            contacts = rest;
            let count = events.partition_point(|row| row.frame as usize <= i);
            let (told, rest) = events.split_at(count);
            events = rest;
            self.frame_with((i, of_frame, told))
        })
    }

    fn frame_with(&self, (i, contacts, events): (usize, &[ContactRow], &[EventRow])) -> Option<Frame> {
        let row = &self.frames[i];
        Some(Frame {
            t: row.t,
            hand: row.hand,
            held: row.held != 0,
            pose: row.pose,
            depth: row.depth,
            state: *StateKind::ALL.get(usize::from(row.state))?,
            contacts: contacts.iter().map(ContactRow::record).collect(),
            wrench: row.wrench,
            slips: row.slips,
            longest_slip: row.longest_slip,
            events: events.iter().filter_map(|row| event(row.event)).collect(),
            status: *Status::ALL.get(usize::from(row.status))?,
            behind: (!row.behind.is_nan()).then_some(row.behind),
        })
    }
}

/// The event of a number.
fn event(number: u8) -> Option<Event> {
    Event::ALL.get(usize::from(number)).copied()
}

fn small(index: usize) -> i16 {
    i16::try_from(index).unwrap_or(i16::MAX)
}

fn large(index: i16) -> usize {
    usize::try_from(index).unwrap_or(usize::MAX)
}

impl ContactRow {
    fn new(frame: u32, contact: &ContactRecord) -> Self {
        let mut row = Self {
            point: contact.point,
            direction: contact.direction.unwrap_or([f64::NAN; 2]),
            normal: contact.normal,
            friction: contact.friction,
            frame,
            vertex: NONE,
            surface: NONE,
            obstacle: NONE,
            side: NONE,
            corner: NONE,
            body_side: NONE,
            sliding: contact.sliding,
            padding: [0; 7],
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
                (row.vertex, row.obstacle, row.side) = (small(vertex), small(obstacle), small(side));
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
        let touch = if self.surface != NONE {
            Touch::Surface {
                vertex: large(self.vertex),
                surface: large(self.surface),
            }
        } else if self.corner != NONE {
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
            direction: (!self.direction[0].is_nan()).then_some(self.direction),
        }
    }
}
