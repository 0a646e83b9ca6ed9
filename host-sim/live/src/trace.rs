//! A record of the trace: a frame as JSON, every number with the fewest digits that read back to the same value of the number
//! type.

use serde::{Serialize, Serializer};
use stiction_core::Touch;
use stiction_judge::insertion::{Insertion, Meter};
use stiction_scene::WrittenScene;

use crate::meter;
use crate::record::{ContactRecord, Frame};

/// A value of the run's number type, printed with the digits of that type.
#[derive(Clone, Copy, Debug)]
pub struct Value {
    /// The value, widened without loss.
    pub value: f64,
    /// Whether it is an f32 value.
    pub single: bool,
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.single {
            serializer.serialize_f32(self.value as f32)
        } else {
            serializer.serialize_f64(self.value)
        }
    }
}

/// A record of a trace.
#[derive(Debug, Serialize)]
pub struct Record<'a> {
    /// Time (s).
    pub t: f64,
    /// x, y (m), phi (rad).
    pub hand: [Value; 3],
    /// Whether the hand holds the body.
    pub held: bool,
    /// x, y (m), theta (rad).
    pub pose: [Value; 3],
    /// Depth coordinate (m).
    pub depth: Value,
    /// Name of the contact state.
    pub state: &'static str,
    /// In the order of the solver.
    pub contacts: Vec<ContactEntry<'a>>,
    /// Force (N), moment (N·m) of the hand on the body.
    pub wrench: [Value; 3],
    /// Slips that ended.
    pub slips: u32,
    /// Names of the events.
    pub events: Vec<&'static str>,
    /// Name of the status.
    pub status: &'static str,
    /// Present if a frame has a budget.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub behind: Option<Value>,
    /// Present while a peg is in its hole.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub insertion: Option<InsertionEntry>,
}

/// A reading of Whitney's meter; `lambda` and `margin` are null if undefined.
#[derive(Debug, Serialize)]
pub struct InsertionEntry {
    /// Depth of the peg in its hole (m).
    pub depth: Value,
    /// Force across the hole, in the peg's frame (N).
    pub fx: Value,
    /// Force along it (N).
    pub fz: Value,
    /// Moment about the tip (N·m).
    pub m: Value,
    /// Depth relative to the depth that keeps a peg from jamming.
    pub lambda: Option<Value>,
    /// Margin to jamming.
    pub margin: Option<Value>,
    /// Name of the verdict.
    pub verdict: &'static str,
}

impl InsertionEntry {
    fn new(insertion: &Insertion, single: bool) -> Self {
        let value = |value| Value { value, single };
        Self {
            depth: value(insertion.depth),
            fx: value(insertion.fx),
            fz: value(insertion.fz),
            m: value(insertion.m),
            lambda: insertion.lambda.map(value),
            margin: insertion.margin.map(value),
            verdict: insertion.verdict.name(),
        }
    }
}

/// A vertex on a surface, a vertex on a side of an obstacle, or a corner of an obstacle on a side of the body.
#[derive(Debug, Serialize)]
pub struct ContactEntry<'a> {
    /// Vertex of the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vertex: Option<usize>,
    /// Corner of the obstacle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner: Option<usize>,
    /// Name of the surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<&'a str>,
    /// Name of the obstacle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub obstacle: Option<&'a str>,
    /// Side of the obstacle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<usize>,
    /// Side of the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body_side: Option<usize>,
    /// Contact point (m).
    pub point: [Value; 2],
    /// Reaction N (N).
    pub normal: Value,
    /// Friction T (N).
    pub friction: Value,
    /// 1, -1, or 0 if it sticks.
    pub sliding: i8,
    /// Present in a scene with obstacles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[Value; 2]>,
}

impl<'a> ContactEntry<'a> {
    fn new(contact: &ContactRecord, scene: &'a WrittenScene, single: bool) -> Self {
        let value = |value| Value { value, single };
        let (side, corner, body_side) = match contact.touch {
            Touch::Surface { .. } => (None, None, None),
            Touch::Side { side, .. } => (Some(side), None, None),
            Touch::Corner {
                corner, body_side, ..
            } => (None, Some(corner), Some(body_side)),
        };
        let (surface, obstacle) = (contact.touch.surface(), contact.touch.obstacle());
        Self {
            vertex: contact.touch.vertex(),
            corner,
            surface: surface.map(|k| scene.surfaces.get(k).map_or("", |of| of.name.as_str())),
            obstacle: obstacle.map(|k| scene.obstacles.get(k).map_or("", |of| of.name.as_str())),
            side,
            body_side,
            point: contact.point.map(value),
            normal: value(contact.normal),
            friction: value(contact.friction),
            sliding: contact.sliding,
            direction: (!scene.obstacles.is_empty()).then(|| contact.direction.map(value)),
        }
    }
}

impl<'a> Record<'a> {
    /// Returns the record of a frame; `single`: the numbers have the digits of f32.
    pub fn new(
        frame: &Frame,
        scene: &'a WrittenScene,
        meter: Option<&Meter>,
        single: bool,
    ) -> Self {
        let value = |value| Value { value, single };
        let contacts = frame.contacts.iter();
        let contacts = contacts.map(|contact| ContactEntry::new(contact, scene, single));
        let insertion = meter.and_then(|meter| meter::read(meter, frame));
        Self {
            t: frame.t,
            hand: frame.hand.map(value),
            held: frame.held,
            pose: frame.pose.map(value),
            depth: value(frame.depth),
            state: frame.state.name(),
            contacts: contacts.collect(),
            wrench: frame.wrench.map(value),
            slips: frame.slips,
            events: frame.events.iter().map(|event| event.name()).collect(),
            status: frame.status.name(),
            behind: frame.behind.map(value),
            insertion: insertion.map(|found| InsertionEntry::new(&found, single)),
        }
    }
}
