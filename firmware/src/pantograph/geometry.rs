//! The construction of the device, a pantograph or a knob: lengths, encoders, mounting of the handle, motors. Checked
//! once.

use core::fmt;

/// The longest link (m) and the farthest origin that are accepted.
const LONGEST: f32 = 10.0;
/// The shortest link (m): a millimetre.
const SHORTEST: f32 = 1e-3;
/// The most counts of a turn: at this number f32 still resolves one count.
const MOST_COUNTS: u32 = 1 << 22;

/// An encoder and its joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encoder {
    /// Counts of one turn of the joint, four per line of the disc, including the transmission ratio; 4 to 2^22.
    pub counts_per_turn: u32,
    /// It counts up when the joint turns clockwise.
    pub reversed: bool,
    /// The joint's angle in the home position (rad), -2 pi to 2 pi.
    pub offset: f32,
}

/// The reference of the handle's encoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HandleMount {
    /// The world: the handle is driven through belts from the base.
    Base,
    /// The left distal link, from B1 to P.
    LeftLink,
    /// The right distal link, from B2 to P.
    RightLink,
}

/// The construction of the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// The middle between the base joints, in the scene's world (m).
    pub origin: [f32; 2],
    /// The distance of the base joints, A1 at -x, A2 at +x (m); 0 if they share an axis.
    pub base: f32,
    /// l1, l2: from A1 to B1 and from A2 to B2 (m).
    pub proximal: [f32; 2],
    /// r1, r2: from B1 to P and from B2 to P (m).
    pub distal: [f32; 2],
    /// Encoders of q1, q2 and the handle. An offset is the joint's angle from +x, for the handle from its mount.
    pub encoders: [Encoder; 3],
    /// How the handle is mounted.
    pub handle: HandleMount,
    /// The least sine of the angle between the distal links at which the device outputs force, 0.01 to 0.99. At 0 they
    /// are collinear and it has no force across them.
    pub least_sine: f32,
}

/// A motor with its driver, which outputs a current in proportion to the duty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorConstants {
    /// Torque at the joint per current in the motor (N·m/A), including the transmission ratio; more than 0.
    pub torque_constant: f32,
    /// The current at full duty (A), more than 0.
    pub full_current: f32,
    /// The largest torque at the joint (N·m), more than 0; at most that at full duty.
    pub torque_limit: f32,
    /// A high level at the direction pin turns the joint clockwise.
    pub reversed: bool,
}

impl Geometry {
    /// # Errors
    /// [`GeometryError`] names the first parameter that is not finite or out of its range.
    pub fn check(&self) -> Result<(), GeometryError> {
        use GeometryParameter as P;
        for value in self.origin {
            within(P::Origin, value, -LONGEST, LONGEST)?;
        }
        within(P::Base, self.base, 0.0, LONGEST)?;
        for (i, length) in self.proximal.into_iter().enumerate() {
            within(P::Proximal(i), length, SHORTEST, LONGEST)?;
        }
        for (i, length) in self.distal.into_iter().enumerate() {
            within(P::Distal(i), length, SHORTEST, LONGEST)?;
        }
        for (i, encoder) in self.encoders.iter().enumerate() {
            encoder.check(i)?;
        }
        within(P::LeastSine, self.least_sine, 0.01, 0.99)
    }
}

impl Encoder {
    /// The encoder of this index.
    fn check(&self, i: usize) -> Result<(), GeometryError> {
        use GeometryParameter as P;
        let (counts, most) = (self.counts_per_turn as f32, MOST_COUNTS as f32);
        within(P::CountsPerTurn(i), counts, 4.0, most)?;
        let turn = core::f32::consts::TAU;
        within(P::EncoderOffset(i), self.offset, -turn, turn)
    }
}

/// The construction of a knob: it moves the hand along x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnobGeometry {
    /// The position of the hand at the knob's angle zero, in the scene's world (m).
    pub origin: [f32; 2],
    /// The displacement of the hand along +x per radian (m): for a tip on the knob's rim, its radius; 1e-3 to 10.
    pub radius: f32,
    /// The encoder of the knob. Its offset is the angle at power-up, whatever the knob's position then.
    pub encoder: Encoder,
}

impl KnobGeometry {
    /// # Errors
    /// [`GeometryError`] names the first parameter that is not finite or out of its range; the encoder has the index 0.
    pub fn check(&self) -> Result<(), GeometryError> {
        use GeometryParameter as P;
        for value in self.origin {
            within(P::Origin, value, -LONGEST, LONGEST)?;
        }
        within(P::Radius, self.radius, SHORTEST, LONGEST)?;
        self.encoder.check(0)
    }
}

impl MotorConstants {
    /// # Errors
    /// [`GeometryError`] names the first parameter that is not finite or out of its range.
    pub fn check(&self) -> Result<(), GeometryError> {
        use GeometryParameter as P;
        within(P::TorqueConstant, self.torque_constant, 1e-6, 1e3)?;
        within(P::FullCurrent, self.full_current, 1e-6, 1e3)?;
        let most = self.full_torque();
        within(P::TorqueLimit, self.torque_limit, f32::MIN_POSITIVE, most)
    }

    /// The torque at full duty (N·m).
    pub fn full_torque(&self) -> f32 {
        self.torque_constant * self.full_current
    }
}

/// The parameter that a [`GeometryError`] is about. Indices: 0 left, 1 right, 2 handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GeometryParameter {
    /// The middle of the base, or the hand of a knob at angle zero (m).
    Origin,
    /// The radius of a knob (m).
    Radius,
    /// The distance of the base joints (m).
    Base,
    /// l1 or l2 (m).
    Proximal(usize),
    /// r1 or r2 (m).
    Distal(usize),
    /// Counts of a turn.
    CountsPerTurn(usize),
    /// The angle in the home position (rad).
    EncoderOffset(usize),
    /// The least sine between the distal links.
    LeastSine,
    /// Torque per current (N·m/A).
    TorqueConstant,
    /// The current at full duty (A).
    FullCurrent,
    /// The largest torque (N·m).
    TorqueLimit,
}

impl fmt::Display for GeometryParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Origin => write!(f, "origin (m)"),
            Self::Radius => write!(f, "radius (m)"),
            Self::Base => write!(f, "distance of the base joints (m)"),
            Self::Proximal(i) => write!(f, "proximal link {i} (m)"),
            Self::Distal(i) => write!(f, "distal link {i} (m)"),
            Self::CountsPerTurn(i) => write!(f, "counts per turn of encoder {i}"),
            Self::EncoderOffset(i) => write!(f, "offset of encoder {i} (rad)"),
            Self::LeastSine => write!(f, "least sine between the distal links"),
            Self::TorqueConstant => write!(f, "torque constant (N·m/A)"),
            Self::FullCurrent => write!(f, "current at full duty (A)"),
            Self::TorqueLimit => write!(f, "torque limit (N·m)"),
        }
    }
}

/// Why a device cannot be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometryError {
    /// Which parameter.
    pub parameter: GeometryParameter,
    /// Its value.
    pub value: f32,
    /// The least and the largest value allowed.
    pub allowed: [f32; 2],
}

impl fmt::Display for GeometryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [least, most] = self.allowed;
        write!(
            f,
            "{} is {}, allowed: {least} to {most}",
            self.parameter, self.value
        )
    }
}

impl core::error::Error for GeometryError {}

fn within(
    parameter: GeometryParameter,
    value: f32,
    least: f32,
    most: f32,
) -> Result<(), GeometryError> {
    // Also false for NaN.
    if value >= least && value <= most {
        return Ok(());
    }
    Err(GeometryError {
        parameter,
        value,
        allowed: [least, most],
    })
}
