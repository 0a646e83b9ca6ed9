//! The operating mode of a board: evolution, ticks, plane of the tracker, and what it sends (FRAME 4.5).

use crate::fault::FaultKind;
use crate::fields::{Fields, Sink, require};
use stiction_core::{Axis, Evolution};

/// When a board makes a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Stepping {
    /// With every tick of its clock, with the newest sample.
    #[default]
    Timed,
    /// With every sample, once: every sample gets a step, as in a file.
    PerSample,
}

impl Stepping {
    /// Both, in the order of their codes.
    pub const ALL: [Self; 2] = [Self::Timed, Self::PerSample];

    /// The name in a log.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Timed => "timed",
            Self::PerSample => "per-sample",
        }
    }
}

/// The operating mode of a board. The default is path evolution at 1 kHz in the x-y plane, with every pose and its
/// events. A board refuses values out of its range (FRAME 4.5).
///
/// ```
/// use stiction_core::Evolution;
/// use stiction_wire::{Command, Decoder, Frame, Mode};
///
/// // The paper's evolution, with a pose every 2 steps and forces every 10.
/// let mode = Mode {
///     evolution: Evolution::Frame,
///     pose_every: 2,
///     forces_every: 10,
///     ..Mode::default()
/// };
/// let mut wire = [0; 64];
/// let command = Frame { sequence: 7, time: 0, message: Command::Mode(mode) };
/// let wire = command.encode(&mut wire).expect("room for it");
///
/// let mut board = Decoder::<64>::new();
/// let received = wire.iter().find_map(|&byte| {
///     let frame = board.push::<Command>(byte)?.ok()?;
///     Some((frame.sequence, matches!(frame.message, Command::Mode(got) if got == mode)))
/// });
/// assert_eq!(received, Some((7, true)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// The evolution within a frame of the hand.
    pub evolution: Evolution,
    /// When it makes a step.
    pub stepping: Stepping,
    /// The tracker's axes that become x and y of the scene; two different ones of 0, 1, 2.
    pub plane: [Axis; 2],
    /// [`Report::Events`](crate::Report::Events) is sent when something happened.
    pub events: bool,
    /// Ticks per second (Hz), 100 to [`Info::fastest_tick`](crate::Info::fastest_tick).
    pub tick_rate: u16,
    /// Steps per pose; 0: no poses.
    pub pose_every: u16,
    /// Steps per forces; 0: no forces.
    pub forces_every: u16,
    /// Milliseconds per health; 0: never.
    pub health_every: u16,
}

/// +x, +y, +z, nothing, -x, -y, -z: bit 2 is the sign.
const NEGATIVE: u8 = 4;

impl Default for Mode {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Mode {
    /// The default, for constants.
    pub const DEFAULT: Self = Self {
        evolution: Evolution::Path,
        stepping: Stepping::Timed,
        plane: [axis_along(0), axis_along(1)],
        events: true,
        tick_rate: 1000,
        pose_every: 1,
        forces_every: 0,
        health_every: 1000,
    };

    pub(crate) const BYTES: usize = 13;

    /// Writes the payload of mode (FRAME 4.5); refuses an axis other than 0, 1, 2.
    pub(crate) fn write(&self, sink: &mut impl Sink) {
        sink.code(&Evolution::ALL, &self.evolution);
        sink.code(&Stepping::ALL, &self.stepping);
        for axis in self.plane {
            let sign = if axis.negative { NEGATIVE } else { 0 };
            match u8::try_from(axis.index) {
                Ok(index @ 0..=2) => sink.parts(&[index, sign]),
                _ => sink.refuse(),
            }
        }
        sink.byte(u8::from(self.events));
        sink.u16(self.tick_rate);
        sink.u16(self.pose_every);
        sink.u16(self.forces_every);
        sink.u16(self.health_every);
    }

    /// Reads the payload of mode (FRAME 4.5); fails if a code or flag has no meaning, or if both axes are the same.
    pub(crate) fn read(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        let evolution = fields.code(&Evolution::ALL)?;
        let stepping = fields.code(&Stepping::ALL)?;
        let plane = [axis(fields.u8())?, axis(fields.u8())?];
        let [first, second] = plane;
        require(first.index != second.index, FaultKind::Value)?;
        Ok(Self {
            evolution,
            stepping,
            plane,
            events: fields.flag()?,
            tick_rate: fields.u16(),
            pose_every: fields.u16(),
            forces_every: fields.u16(),
            health_every: fields.u16(),
        })
    }
}

const fn axis_along(index: usize) -> Axis {
    Axis {
        index,
        negative: false,
    }
}

fn axis(code: u8) -> Result<Axis, FaultKind> {
    let index = code & !NEGATIVE;
    require(index < 3, FaultKind::Value)?;
    Ok(Axis {
        index: usize::from(index),
        negative: code & NEGATIVE != 0,
    })
}
