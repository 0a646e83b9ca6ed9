//! What a board is, on the wire (FRAME 5.5).

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink};
use crate::layout::coded;
use crate::list::Text;
use crate::mode::Mode;

coded! {
    /// The number type of a board's solver.
    pub enum NumberType {
        /// `f32`.
        F32 = "f32",
        /// [`Fixed`](stiction_core::Fixed).
        Fixed = "fixed",
    }
}

/// What a board is and its present settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Info<'a> {
    /// Version of the firmware: major, minor, patch.
    pub version: [u8; 3],
    /// The number type of its solver.
    pub number: NumberType,
    /// The maximum number of vertices.
    pub vertices: u8,
    /// The maximum number of surfaces.
    pub surfaces: u8,
    /// The maximum number of corners of all obstacles together.
    pub corners: u8,
    /// It outputs forces to the hand.
    pub actuators: bool,
    /// The longest frame that it accepts, in bytes before COBS.
    pub longest_frame: u16,
    /// The most ticks per second (Hz).
    pub fastest_tick: u16,
    /// The budget of a step in pieces of work, see [`Solver::with_budget`](stiction_core::Solver::with_budget): it follows from the tick.
    pub budget: u32,
    /// Below these k_h (N/m) and k_theta (N·m/rad) its haptic device is passive at its tick rate; infinite without actuators.
    pub stiffest: [f32; 2],
    /// k_h (N/m) and k_theta (N·m/rad) now.
    pub stiffness: [f32; 2],
    /// mu_s and mu_d of the first surface now; 0 without one.
    pub friction_now: [f32; 2],
    /// Its memory length (m) now; `None`: L / 4096, or there is no surface.
    pub memory_now: Option<f32>,
    /// Its present operating mode.
    pub mode: Mode,
    /// Name of the board.
    pub name: Text<'a>,
}

impl<'a> Info<'a> {
    const HEAD_BYTES: usize = 45 + Mode::BYTES;
    /// With the longest name.
    pub(crate) const LONGEST: usize = Self::HEAD_BYTES + Text::LONGEST;

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        self.version.put(sink);
        self.number.put(sink);
        [self.vertices, self.surfaces, self.corners].put(sink);
        self.actuators.put(sink);
        [self.longest_frame, self.fastest_tick].put(sink);
        self.budget.put(sink);
        [self.stiffest, self.stiffness, self.friction_now].put(sink);
        self.memory_now.put(sink);
        self.mode.put(sink);
        self.name.write(sink);
    }

    /// Reads the payload of info (FRAME 5.5); fails if it is too short, or if a code, a bit or a character is not permitted.
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(Self::HEAD_BYTES)?;
        let (version, number) = (fields.get()?, fields.get()?);
        let [vertices, surfaces, corners] = fields.take();
        Ok(Self {
            version,
            number,
            vertices,
            surfaces,
            corners,
            actuators: fields.get()?,
            longest_frame: fields.get()?,
            fastest_tick: fields.get()?,
            budget: fields.get()?,
            stiffest: fields.get()?,
            stiffness: fields.get()?,
            friction_now: fields.get()?,
            memory_now: fields.get()?,
            mode: fields.get()?,
            name: Text::read(fields)?,
        })
    }
}
