//! What a board is, and which modes it takes (FRAME 4.5): from ticks and bytes per second to yes, or no and why.

use super::refusal::Trouble;
use crate::device::Settings;
use crate::model::BoardModel;
use crate::safety::{Limits, Passivity};
use stiction_core::frame::{
    Mode, NumberType, Reason, Stepping, Subject, frame_bytes, scene_bytes, wire_bytes,
};
use stiction_core::{Description, Fixed, Real, Scene};

/// What a board is and how it works after power-up.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Its name, printable ASCII.
    pub name: &'static str,
    /// The number type of its solver.
    pub number: NumberType,
    /// What its line carries in each direction (bytes per second): a tenth of the baud.
    pub line_rate: u32,
    /// The most ticks for which it has the time (Hz).
    pub fastest_tick: u16,
    /// Units of work that the chip does in a second, measured: see the board. The budget of a step follows from it and from the tick.
    pub work_rate: u32,
    /// What may go to the hand; the period of ticks is that of the mode.
    pub limits: Limits,
    /// What its device damps, at the shortest hold of a force; `None` where it drives no motors.
    pub passivity: Option<Passivity>,
    /// How it works after power-up.
    pub mode: Mode,
    /// The scene after power-up.
    pub scene: Description<'static, f32>,
}

/// A number type of boards.
pub trait BoardNumber: Real<Si = f32> {
    /// How the wire calls it.
    const NUMBER: NumberType;
}

impl BoardNumber for f32 {
    const NUMBER: NumberType = NumberType::F32;
}

impl BoardNumber for Fixed {
    const NUMBER: NumberType = NumberType::Fixed;
}

/// What a compiled-in scene says by its type: how much of the solver is in the image.
pub trait SceneType {
    /// What its solver computes with.
    type Number: BoardNumber;
    /// Its model.
    type Model: BoardModel;
    /// Room for so many vertices.
    const VERTICES: usize;
    /// Room for so many surfaces.
    const SURFACES: usize;
    /// How the wire calls its number type.
    const NUMBER: NumberType = Self::Number::NUMBER;
    /// Bytes of the longest frame that brings a scene.
    const FRAME: usize =
        frame_bytes(scene_bytes(Self::VERTICES, Self::SURFACES) + Self::Model::OBSTACLE_BYTES);
}

impl<R: BoardNumber, const V: usize, const S: usize, M: BoardModel> SceneType
    for Scene<R, V, S, M>
{
    type Number = R;
    type Model = M;
    const VERTICES: usize = V;
    const SURFACES: usize = S;
}

/// The type of the program of a board with a compiled-in scene, a [`SceneType`]: a [`Station`](crate::station::Station).
#[macro_export]
macro_rules! station_of {
    ($scene:ty) => {
        $crate::station::Station<
            <$scene as $crate::station::SceneType>::Number,
            { <$scene as $crate::station::SceneType>::VERTICES },
            { <$scene as $crate::station::SceneType>::SURFACES },
            <$scene as $crate::station::SceneType>::Model,
            { <$scene as $crate::station::SceneType>::FRAME },
        >
    };
}

/// The fewest ticks with which silence is found in time (Hz).
pub const SLOWEST_TICK: u16 = 100;
/// Of the eighths of a tick a step may take so many: the rest is for the line, the forces and interrupts.
const EIGHTHS_OF_STEP: u32 = 7;
/// On the wire: a sample of the hand, a pose, health.
const SAMPLE: u32 = wire_bytes(21) as u32;
const POSE: u32 = wire_bytes(20) as u32;
const HEALTH: u32 = wire_bytes(61) as u32;

impl Setup {
    /// The mode is one that the board has the time and the line for.
    pub(super) fn check<M: BoardModel>(&self, mode: &Mode) -> Result<(), Trouble> {
        let rate = mode.tick_rate;
        if rate < SLOWEST_TICK {
            return Err(Trouble {
                reason: Reason::Number,
                subject: Subject::TickRate,
                value: f32::from(rate),
                limit: f32::from(SLOWEST_TICK),
                allowed: "100 or more: silence must be found in time",
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
        // Those of two contacts.
        let forces = const { wire_bytes(29 + 2 * M::CONTACT_BYTES) as u32 };
        let bytes = self.bytes_per_second(mode, forces);
        if bytes > self.line_rate {
            return Err(Trouble {
                reason: Reason::Unsupported,
                subject: Subject::LineRate,
                value: bytes as f32,
                limit: self.line_rate as f32,
                allowed: "what the line carries: fewer poses or forces, or a slower tick",
            });
        }
        Ok(())
    }

    /// What a mode sends, but for events and replies (bytes per second).
    fn bytes_per_second(&self, mode: &Mode, forces: u32) -> u32 {
        let ticks = u32::from(mode.tick_rate);
        let steps = match mode.stepping {
            Stepping::Timed => ticks,
            // As many as samples come.
            Stepping::PerSample => ticks.min(self.line_rate / SAMPLE),
        };
        let every = |much: u32, every: u16| much.checked_div(u32::from(every)).unwrap_or(0);
        let poses = every(steps.saturating_mul(POSE), mode.pose_every);
        let forces = every(steps.saturating_mul(forces), mode.forces_every);
        let health = every(HEALTH.saturating_mul(1_000), mode.health_every);
        poses.saturating_add(forces).saturating_add(health)
    }

    /// So many bytes are taken from the line in a turn, at most: what comes in a tick, twice, so that a queue becomes shorter,
    /// and the longest sample.
    pub(super) fn bytes_per_turn(&self, mode: &Mode) -> u32 {
        let ticks = u32::from(mode.tick_rate).max(1);
        let arriving = self.line_rate.checked_div(ticks).unwrap_or(0);
        arriving.saturating_mul(2).saturating_add(64)
    }

    /// The settings of the device's loops in a mode.
    pub(super) fn settings(&self, mode: &Mode) -> Settings {
        let in_tick = |in_second: u32| {
            in_second
                .checked_div(u32::from(mode.tick_rate))
                .unwrap_or(u32::MAX)
        };
        let period_us = in_tick(1_000_000);
        Settings {
            evolution: mode.evolution,
            budget: in_tick(self.work_rate).saturating_mul(EIGHTHS_OF_STEP) / 8,
            goes_on: mode.stepping == Stepping::Timed,
            limits: Limits {
                period_us,
                ..self.limits
            },
            passivity: self.passivity.map(|passivity| Passivity {
                hold_us: passivity.hold_us.max(period_us),
                ..passivity
            }),
        }
    }
}
