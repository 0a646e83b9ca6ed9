//! The numbers of a knob, a haptic device of one encoder and one motor, on the wire (FRAME 4.9, 5.8).

use crate::layout::{coded, layout};

/// What the maker of a knob measures or reads off data sheets; angles are counter-clockwise. A board refuses values out of its range.
///
/// ```
/// use stiction_wire::{Command, Decoder, Frame, KnobNumbers};
///
/// let numbers = KnobNumbers { radius: 0.02, counts_per_turn: 4_096, ..KnobNumbers::default() };
/// let mut wire = [0; 64];
/// let frame = Frame { sequence: 0, time: 0, message: Command::Knob(numbers) };
/// let wire = frame.encode(&mut wire).expect("room for it");
///
/// let mut board = Decoder::<64>::new();
/// let received = wire.iter().find_map(|&byte| {
///     let frame = board.push::<Command>(byte)?.ok()?;
///     Some(frame.message == Command::Knob(numbers))
/// });
/// assert_eq!(received, Some(true));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KnobNumbers {
    /// Position of the hand at power-up (m), in the world of the scene.
    pub origin: [f32; 2],
    /// Displacement of the hand along +x per radian (m): for a tip on the knob's rim, its radius.
    pub radius: f32,
    /// Counts of the encoder per turn of the knob: four per line of its disc.
    pub counts_per_turn: u32,
    /// The encoder counts up when the knob turns clockwise.
    pub encoder_reversed: bool,
    /// Torque of the motor at the knob per current (N·m/A).
    pub torque_constant: f32,
    /// Current of the motor at full duty (A).
    pub full_current: f32,
    /// The largest torque (N·m); over the radius, it is the largest force on the hand.
    pub torque_limit: f32,
    /// A high level at the direction pin turns the knob clockwise.
    pub motor_reversed: bool,
    /// Damping of the knob about its axis (N·m·s/rad): what friction of bearings and motor takes.
    pub damping: f32,
}

layout! {
    KnobNumbers {
        origin: [f32; 2], radius: f32, counts_per_turn: u32, encoder_reversed: bool, torque_constant: f32,
        full_current: f32, torque_limit: f32, motor_reversed: bool, damping: f32
    }
}

coded! {
    /// The number that a refusal is about; the name is that of the field.
    pub enum KnobNumber {
        /// m
        Origin = "origin",
        /// m
        Radius = "radius",
        /// Counts.
        CountsPerTurn = "counts-per-turn",
        /// N·m/A
        TorqueConstant = "torque-constant",
        /// A
        FullCurrent = "full-current",
        /// N·m
        TorqueLimit = "torque-limit",
        /// N·m·s/rad
        Damping = "damping",
    }
}

coded! {
    /// Where the numbers of a board's knob come from.
    pub enum KnobSource {
        /// Compiled in: none are stored on the board.
        CompiledIn = "compiled-in",
        /// Stored on the board.
        Stored = "stored",
        /// Compiled in: those that are stored are damaged, or cannot be used with the compiled-in scene. The motor is off.
        Unusable = "unusable",
    }
}

/// The knob of a board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnobInfo {
    /// Where the numbers come from.
    pub source: KnobSource,
    /// The numbers now.
    pub numbers: KnobNumbers,
}

layout! { KnobInfo { source: KnobSource, numbers: KnobNumbers } }
