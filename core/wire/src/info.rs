//! What a board is, on the wire (FRAME 5.5).

use crate::fault::FaultKind;
use crate::fields::{Fields, Sink};
use crate::list::Text;
use crate::mode::Mode;

/// The number type of a board's solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum NumberType {
    /// `f32`.
    #[default]
    F32,
    /// [`Fixed`](stiction_core::Fixed).
    Fixed,
}

impl NumberType {
    /// Both, in the order of their codes.
    pub const ALL: [Self; 2] = [Self::F32, Self::Fixed];

    /// The name, as on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::Fixed => "fixed",
        }
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
    /// Its solver has friction.
    pub friction: bool,
    /// Its solver has weight.
    pub weight: bool,
    /// It outputs forces to the hand.
    pub actuators: bool,
    /// The longest frame that it accepts, in bytes before COBS.
    pub longest_frame: u16,
    /// The most ticks per second (Hz).
    pub fastest_tick: u16,
    /// The budget of a step in units of work, see [`Solver::with_budget`](stiction_core::Solver::with_budget): it follows from the tick.
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
    const HEAD_BYTES: usize = 44 + Mode::BYTES;
    /// With the longest name.
    pub(crate) const LONGEST: usize = Self::HEAD_BYTES + Text::LONGEST;

    /// Writes the payload of info (FRAME 5.5).
    pub(crate) fn write(&self, sink: &mut impl Sink) {
        sink.put(&self.version);
        sink.code(&NumberType::ALL, &self.number);
        sink.put(&[self.vertices, self.surfaces]);
        let has = [self.friction, self.weight, self.actuators];
        let [friction, weight, actuators] = has.map(u8::from);
        sink.parts(&[friction, weight << 1, actuators << 2]);
        sink.u16(self.longest_frame);
        sink.u16(self.fastest_tick);
        sink.u32(self.budget);
        for pair in [self.stiffest, self.stiffness, self.friction_now] {
            sink.f32s(&pair);
        }
        sink.option(self.memory_now);
        self.mode.write(sink);
        self.name.write(sink);
    }

    /// Reads the payload of info (FRAME 5.5); fails if it is too short, or if a code, a bit or a character is not permitted.
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(Self::HEAD_BYTES)?;
        let version = fields.take();
        let number = fields.code(&NumberType::ALL)?;
        let [vertices, surfaces, has] = fields.take();
        if has > 7 {
            return Err(FaultKind::Value);
        }
        Ok(Self {
            version,
            number,
            vertices,
            surfaces,
            friction: has & 1 != 0,
            weight: has & 2 != 0,
            actuators: has & 4 != 0,
            longest_frame: fields.u16(),
            fastest_tick: fields.u16(),
            budget: fields.u32(),
            stiffest: fields.f32s(),
            stiffness: fields.f32s(),
            friction_now: fields.f32s(),
            memory_now: fields.option()?,
            mode: Mode::read(fields)?,
            name: Text::read(fields.remaining()).ok_or(FaultKind::Value)?,
        })
    }
}
