//! The operating mode of a board: evolution, ticks, plane of the tracker, and what it sends (FRAME 4.5).

use crate::layout::{coded, layout};
use stiction_core::{Axis, Evolution};

coded! {
    /// When a board makes a step.
    pub enum Stepping {
        /// With every tick of its clock, with the newest sample.
        Timed = "timed",
        /// With every sample, once: every sample gets a step, as in a file.
        PerSample = "per-sample",
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

layout! {
    Mode {
        evolution: Evolution, stepping: Stepping, plane: [Axis; 2], events: bool, tick_rate: u16,
        pose_every: u16, forces_every: u16, health_every: u16
    } if |mode| { let [x, y] = mode.plane; x.index != y.index }
}

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
}

const fn axis_along(index: usize) -> Axis {
    Axis {
        index,
        negative: false,
    }
}
