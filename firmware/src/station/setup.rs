//! The description of a board, and the modes that it accepts (FRAME 4.5): from ticks and bytes per second to yes, or to no with the reason.

use super::refusal::Trouble;
use crate::device::Settings;
use crate::knob::{KnobSettings, admit, check};
use crate::safety::{Limits, Passivity};
use stiction_core::{Description, Fixed, Real, Scene};
use stiction_wire::{
    KnobInfo, KnobNumbers, KnobSource, Mode, NumberType, Reason, Stepping, Subject, frame_bytes,
    scene_bytes, wire_bytes,
};

/// The description of a board and its settings after power-up.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Its name, printable ASCII.
    pub name: &'static str,
    /// The number type of its solver.
    pub number: NumberType,
    /// The capacity of its line in each direction (bytes per second): a tenth of the baud rate.
    pub line_rate: u32,
    /// The highest tick rate for which it has the time (Hz).
    pub fastest_tick: u16,
    /// Units of work per second of the chip, as measured: see the board. The budget of a step follows from it and from the tick.
    pub work_rate: u32,
    /// The limits of the force on the hand; the period of ticks is that of the mode.
    pub limits: Limits,
    /// The damping of its device, at the shortest hold of a force; `None` if it drives no motors.
    pub passivity: Option<Passivity>,
    /// The mode after power-up.
    pub mode: Mode,
    /// The scene after power-up.
    pub scene: Description<'static, f32>,
    /// The knob at its pins, if its numbers can be replaced over the line: see [`Self::with_knob`]. Otherwise `None`.
    pub knob: Option<KnobInfo>,
}

/// A number type of boards.
pub trait BoardNumber: Real<Si = f32> {
    /// Its name on the wire.
    const NUMBER: NumberType;
}

impl BoardNumber for f32 {
    const NUMBER: NumberType = NumberType::F32;
}

impl BoardNumber for Fixed {
    const NUMBER: NumberType = NumberType::Fixed;
}

/// What the type of a compiled-in scene determines: how much of the solver is in the image.
pub trait SceneType {
    /// The number type of its solver.
    type Number: BoardNumber;
    /// The maximum number of vertices.
    const VERTICES: usize;
    /// The maximum number of surfaces.
    const SURFACES: usize;
    /// The maximum number of corners of all obstacles together.
    const CORNERS: usize;
    /// The name of its number type on the wire.
    const NUMBER: NumberType = Self::Number::NUMBER;
    /// Bytes of the longest frame that contains a scene.
    const FRAME: usize = frame_bytes(scene_bytes([
        Self::VERTICES,
        Self::SURFACES,
        Self::CORNERS,
        Self::CORNERS,
    ]));
}

impl<R: BoardNumber, const V: usize, const S: usize, const C: usize> SceneType
    for Scene<R, V, S, C>
{
    type Number = R;
    const VERTICES: usize = V;
    const SURFACES: usize = S;
    const CORNERS: usize = C;
}

/// The type of the program of a board with a compiled-in scene, a [`SceneType`]: a [`Station`](crate::station::Station).
#[macro_export]
macro_rules! station_of {
    ($scene:ty) => {
        $crate::station::Station<
            <$scene as $crate::station::SceneType>::Number,
            { <$scene as $crate::station::SceneType>::VERTICES },
            { <$scene as $crate::station::SceneType>::SURFACES },
            { <$scene as $crate::station::SceneType>::CORNERS },
            { <$scene as $crate::station::SceneType>::FRAME },
        >
    };
}

/// The lowest tick rate at which silence is detected in time (Hz).
pub const SLOWEST_TICK: u16 = 100;
/// A step may take this many eighths of a tick: the rest is for the line, the forces and interrupts.
const EIGHTHS_OF_STEP: u32 = 7;
/// Bytes on the wire: a sample of the hand, a pose, the forces of two contacts, health.
const SAMPLE: u32 = wire_bytes(21) as u32;
const POSE: u32 = wire_bytes(20) as u32;
const FORCES: u32 = wire_bytes(29 + 2 * 28) as u32;
const HEALTH: u32 = wire_bytes(61) as u32;

impl Setup {
    /// The board with a knob. With numbers in the place of those that cannot be used, it outputs no force.
    #[must_use]
    pub fn with_knob(self, knob: KnobInfo) -> Self {
        let settings = KnobSettings::new(&knob.numbers);
        let mut limits = settings.limits;
        if knob.source == KnobSource::Unusable {
            limits.force = 0.0;
        }
        Self {
            limits,
            passivity: Some(settings.passivity),
            knob: Some(knob),
            ..self
        }
    }

    /// Checks that the board would start with a knob of these numbers.
    pub(crate) fn admits(&self, numbers: &KnobNumbers) -> Result<(), Trouble> {
        check(numbers).map_err(|error| Trouble::of_knob(Reason::Number, &error))?;
        let period_us = self.settings(&self.mode).limits.period_us;
        admit(numbers, self.scene.stiffness_translation, period_us)
            .map_err(|error| Trouble::of_knob(Reason::NotPassive, &error))
    }

    /// Checks that the board has the time and the line for a mode.
    pub(super) fn check(&self, mode: &Mode) -> Result<(), Trouble> {
        let rate = mode.tick_rate;
        if rate < SLOWEST_TICK {
            return Err(Trouble {
                reason: Reason::Number,
                subject: Subject::TickRate,
                value: f32::from(rate),
                limit: f32::from(SLOWEST_TICK),
                allowed: "100 or more: silence must be noted in time",
            });
        }
        if rate > self.fastest_tick {
            return Err(Trouble {
                reason: Reason::Unsupported,
                subject: Subject::TickRate,
                value: f32::from(rate),
                limit: f32::from(self.fastest_tick),
                allowed: "what the board has the time for",
            });
        }
        let bytes = self.bytes_per_second(mode);
        if bytes > self.line_rate {
            return Err(Trouble {
                reason: Reason::Unsupported,
                subject: Subject::LineRate,
                value: bytes as f32,
                limit: self.line_rate as f32,
                allowed: "what the line permits: fewer poses or forces, or a slower tick",
            });
        }
        Ok(())
    }

    /// The bytes that a mode sends, except for events and replies (bytes per second).
    fn bytes_per_second(&self, mode: &Mode) -> u32 {
        let ticks = u32::from(mode.tick_rate);
        let steps = match mode.stepping {
            Stepping::Timed => ticks,
            // As many as the samples that arrive.
            Stepping::PerSample => ticks.min(self.line_rate / SAMPLE),
        };
        let every = |much: u32, every: u16| much.checked_div(u32::from(every)).unwrap_or(0);
        let poses = every(steps.saturating_mul(POSE), mode.pose_every);
        let forces = every(steps.saturating_mul(FORCES), mode.forces_every);
        let health = every(HEALTH.saturating_mul(1_000), mode.health_every);
        poses.saturating_add(forces).saturating_add(health)
    }

    /// The maximum number of bytes that are taken from the line in a turn: twice what arrives in a tick, so that a queue becomes shorter,
    /// plus the longest sample.
    pub(super) fn bytes_per_turn(&self, mode: &Mode) -> u32 {
        let ticks = u32::from(mode.tick_rate).max(1);
        let arriving = self.line_rate.checked_div(ticks).unwrap_or(0);
        arriving.saturating_mul(2).saturating_add(64)
    }

    pub(super) fn settings(&self, mode: &Mode) -> Settings {
        let in_tick = |in_second: u32| {
            in_second
                .checked_div(u32::from(mode.tick_rate))
                .unwrap_or(u32::MAX)
        };
        let period_us = in_tick(1_000_000);
        Settings {
            evolution: mode.evolution,
            // A step takes at least one piece, however slow the chip is.
            budget: (in_tick(self.work_rate).saturating_mul(EIGHTHS_OF_STEP) / 8).max(1),
            goes_on: mode.stepping == Stepping::Timed,
            limits: Limits {
                period_us,
                ..self.limits
            },
            passivity: self
                .passivity
                .map(|passivity| passivity.at_period(period_us)),
        }
    }
}
