//! What a haptic device can output and its damping, and the largest stiffness that it can display without doing work on the hand.
//!
//! # Why a stiffness below the bound is passive
//!
//! The force on the hand is F = K (g - x), piecewise constant: x is the hand in a tick, g where the body's holding point came to in the turn of
//! that tick. E = K (g - x)²/2 is what the spring holds. While the force is output the hand moves by d, and gets the work
//!
//! ```text
//! F d = E(x, g) - E(x + d, g) + K d²/2
//! ```
//!
//! Then the next turn moves the body under the hand at its new place. There it comes to rest by itself: contacts do no work on it, friction
//! takes some, and in a slip or a tip the spring pulls the body along, so that the spring, with the weight that it bears, holds less
//! afterwards than before. Summed up over any motion, among any obstacles, the hand gets no more than what the spring held at first and the
//! sum of K d²/2. In a time T, the device's damping b takes at least b d²/T: enough if b > K T/2. Thus a slip makes the force fall at once,
//! and needs no limit of rate to be passive.
//!
//! A force that leaves the device a time D after the tick was right for a hand D earlier: it differs by K v D from the force that is right now,
//! and does K v² D more work per second. Together b > K (T/2 + D). Rotation has its own spring and damping, and the same bound.
//!
//! Limits of size, and the growth of the force after a safe state, leave this as it is: see the governor.

use core::fmt;
use stiction_core::Real;

/// The largest limit of force, moment and their rates that makes sense (SI units).
const LARGEST: f32 = 1e6;
/// The longest period of ticks (µs): a tenth of a second.
const LONGEST_PERIOD: u32 = 100_000;
/// The longest silence (µs): one second.
const LONGEST_SILENCE: u32 = 1_000_000;
/// The longest time for which a force is held, the longest delay and the longest turn (µs).
const LONGEST_HOLD: u32 = 1_000_000;

/// The limits of the force on the hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The largest force (N), 0 to 1e6. See [`Self::sized`].
    pub force: f32,
    /// The largest moment (N·m), 0 to 1e6. See [`Self::sized`].
    pub moment: f32,
    /// The fastest growth of the force after a safe state, or after a change of the scene (N/s), more than 0. At any other time the force
    /// follows its demand at once: one that lags behind the hand does work on it.
    pub force_rate: f32,
    /// The fastest growth of the moment after a safe state, or after a change of the scene (N·m/s), more than 0.
    pub moment_rate: f32,
    /// The period of ticks (µs), 1 to 100 000.
    pub period_us: u32,
    /// The force is zero when the last usable sample is this old (µs): from 2 periods to one second.
    pub silence_us: u32,
    /// This many missed ticks in a row leave the force as it is; more make it zero. 0: every overrun does.
    pub missed_ticks: u16,
}

impl Default for Limits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Limits {
    /// 5 N, 0.1 N·m, both reached from zero in 50 ms after a safe state; 1 kHz; silence after 20 ms; every overrun makes the force zero.
    pub const DEFAULT: Self = Self {
        force: 5.0,
        moment: 0.1,
        force_rate: 100.0,
        moment_rate: 2.0,
        period_us: 1_000,
        silence_us: 20_000,
        missed_ticks: 0,
    };

    /// # Errors
    /// [`LimitError`] names the first limit that is not finite or out of its range.
    pub fn check(&self) -> Result<(), LimitError> {
        use LimitParameter as P;
        let least = f32::MIN_POSITIVE;
        within(P::Force, self.force, 0.0, LARGEST)?;
        within(P::Moment, self.moment, 0.0, LARGEST)?;
        within(P::ForceRate, self.force_rate, least, LARGEST)?;
        within(P::MomentRate, self.moment_rate, least, LARGEST)?;
        let (period, silence) = (self.period_us, self.silence_us);
        counted(P::Period, period, 1, LONGEST_PERIOD)?;
        counted(
            P::Silence,
            silence,
            period.saturating_mul(2),
            LONGEST_SILENCE,
        )
    }

    /// The period of ticks (s).
    pub(crate) fn period(&self) -> f32 {
        self.period_us as f32 * 1e-6
    }
}

/// The device's own damping, and the age of the hand's pose when its force is output: with them a virtual spring of stiffness K is passive
/// if b > K (T/2 + D), where T is the time for which a force is held, and D the sum of delay and turn (Colgate and Schenkel).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passivity {
    /// b of the device along the plane (N·s/m), its minimum over the workspace: friction of bearings and motors.
    pub damping_translation: f32,
    /// b of the device's handle about its axis (N·m·s/rad).
    pub damping_rotation: f32,
    /// T (µs), 1 to 1 000 000: the time between two forces that follow the hand; the period of ticks, or of samples if these come less
    /// often.
    pub hold_us: u32,
    /// The age of the hand's pose in the tick that takes it (µs), 0 to 1 000 000: 0 if the encoders are read there; on a line, the way of a
    /// sample.
    pub delay_us: u32,
    /// The longest time from a tick to the end of its turn, which outputs the force (µs), 0 to 1 000 000.
    pub turn_us: u32,
}

impl Passivity {
    /// # Errors
    /// [`LimitError`] names the first number that is not finite or out of its range.
    pub fn check(&self) -> Result<(), LimitError> {
        use LimitParameter as P;
        within(
            P::DampingTranslation,
            self.damping_translation,
            0.0,
            LARGEST,
        )?;
        within(P::DampingRotation, self.damping_rotation, 0.0, LARGEST)?;
        counted(P::Hold, self.hold_us, 1, LONGEST_HOLD)?;
        counted(P::Delay, self.delay_us, 0, LONGEST_HOLD)?;
        counted(P::Turn, self.turn_us, 0, LONGEST_HOLD)
    }

    /// The bounds of k_h (N/m) and of k_theta (N·m/rad): stiffnesses below them are passive.
    pub fn bounds(&self) -> [f32; 2] {
        let twice_us = self.twice_us() as f32;
        [self.damping_translation, self.damping_rotation].map(|b| b * 2e6 / twice_us)
    }

    /// The damping at which a stiffness ceases to be passive: N·s/m for k_h (N/m), N·m·s/rad for k_theta (N·m/rad).
    pub fn damping_of(&self, stiffness: f32) -> f32 {
        stiffness * self.twice_us() as f32 / 2e6
    }

    /// Twice T/2 + D (µs), a whole number: the bound for round numbers is round.
    fn twice_us(&self) -> u32 {
        let late_us = self.delay_us.saturating_add(self.turn_us);
        self.hold_us.saturating_add(late_us.saturating_mul(2))
    }

    /// At a period of ticks (µs): a turn begins with a tick, so that a force is held for as many of them as the longest turn needs. A turn that
    /// ends with a tick is followed by a turn after the next one.
    #[must_use]
    pub fn at_period(self, period_us: u32) -> Self {
        let whole = self.turn_us.checked_div(period_us).unwrap_or(0);
        let ticks = whole.saturating_add(1);
        let hold_us = self.hold_us.max(ticks.saturating_mul(period_us));
        Self { hold_us, ..self }
    }

    /// Refuses stiffnesses k_h (N/m) and k_theta (N·m/rad) of a hand that the device cannot display passively. No stiffness is passive
    /// without damping; 0 always is.
    ///
    /// # Errors
    /// [`LimitError`] names the stiffness and its bound.
    pub fn admit(&self, k_h: f32, k_theta: f32) -> Result<(), LimitError> {
        let [translation, rotation] = self.bounds();
        below(LimitParameter::StiffnessTranslation, k_h, translation)?;
        below(LimitParameter::StiffnessRotation, k_theta, rotation)
    }
}

/// The parameter that a [`LimitError`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LimitParameter {
    /// The largest force (N).
    Force,
    /// The largest moment (N·m).
    Moment,
    /// The fastest growth of the force (N/s).
    ForceRate,
    /// The fastest growth of the moment (N·m/s).
    MomentRate,
    /// The period of ticks (µs).
    Period,
    /// The silence after which the force is zero (µs).
    Silence,
    /// The damping along the plane (N·s/m).
    DampingTranslation,
    /// The damping of the handle (N·m·s/rad).
    DampingRotation,
    /// The time for which a force is held (µs).
    Hold,
    /// The age of the hand's pose (µs).
    Delay,
    /// The longest turn (µs).
    Turn,
    /// k_h (N/m)
    StiffnessTranslation,
    /// k_theta (N·m/rad)
    StiffnessRotation,
}

impl LimitParameter {
    /// Its name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Force => "largest force (N)",
            Self::Moment => "largest moment (N·m)",
            Self::ForceRate => "rate of force (N/s)",
            Self::MomentRate => "rate of moment (N·m/s)",
            Self::Period => "period of ticks (µs)",
            Self::Silence => "silence (µs)",
            Self::DampingTranslation => "damping of translation (N·s/m)",
            Self::DampingRotation => "damping of rotation (N·m·s/rad)",
            Self::Hold => "time for which a force is held (µs)",
            Self::Delay => "delay (µs)",
            Self::Turn => "longest turn (µs)",
            Self::StiffnessTranslation => "translational stiffness k_h (N/m)",
            Self::StiffnessRotation => "rotational stiffness k_theta (N·m/rad)",
        }
    }
}

/// What is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// From the first to the second, inclusive.
    Within(f32, f32),
    /// Finite, and less than this value, at which the device ceases to be passive; 0 is always allowed.
    PassiveBelow(f32),
}

/// Why a limit or a stiffness is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitError {
    /// Which parameter.
    pub parameter: LimitParameter,
    /// Its value, in the parameter's unit.
    pub value: f32,
    /// What is allowed, in the same unit.
    pub allowed: Allowed,
}

impl fmt::Display for LimitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, value) = (self.parameter.name(), self.value);
        match self.allowed {
            Allowed::Within(least, most) => {
                write!(f, "{name} is {value}, allowed: {least} to {most}")
            }
            Allowed::PassiveBelow(bound) => {
                write!(
                    f,
                    "{name} is {value}, allowed: less than {bound}, where the device is passive"
                )
            }
        }
    }
}

impl core::error::Error for LimitError {}

fn within(parameter: LimitParameter, value: f32, least: f32, most: f32) -> Result<(), LimitError> {
    let allowed = Allowed::Within(least, most);
    // Also false for NaN.
    refuse_unless(value >= least && value <= most, parameter, value, allowed)
}

fn counted(parameter: LimitParameter, value: u32, least: u32, most: u32) -> Result<(), LimitError> {
    // Exact up to 2^24, which is more than any bound.
    within(parameter, value as f32, least as f32, most as f32)
}

fn below(parameter: LimitParameter, value: f32, bound: f32) -> Result<(), LimitError> {
    let holds = value == 0.0 || value < bound && Real::is_finite(value);
    refuse_unless(holds, parameter, value, Allowed::PassiveBelow(bound))
}

fn refuse_unless(
    holds: bool,
    parameter: LimitParameter,
    value: f32,
    allowed: Allowed,
) -> Result<(), LimitError> {
    let error = LimitError {
        parameter,
        value,
        allowed,
    };
    if holds { Ok(()) } else { Err(error) }
}
