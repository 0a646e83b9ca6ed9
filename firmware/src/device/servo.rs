//! The servo loop: at every tick the hand is measured and a safe force is output, wherever the solver is. A tick takes the same short time
//! whatever happens; the solver takes its turns when it can.
//!
//! ```text
//! tick    measures the hand; outputs the last demand of the solver, or zero if that is too old
//! settle  takes the solver's demand at the end of a turn, and outputs it immediately
//! ```
//!
//! Both output a force: that of the end of a turn replaces that of the tick in which it ends. A force that grows after a safe state does so
//! from the end of the previous tick, so that it grows by no more than one step in a tick.
//!
//! If a turn takes longer than the bound of stiffness assumes ([`Passivity::turn_us`]), as one with a command may, its predecessor's force is
//! held for longer. Once, that gives the hand no more than this force on the hand's way in the time beyond, which silence limits.
//!
//! [`Passivity::turn_us`]: crate::safety::Passivity::turn_us

use super::ports::{Actuators, Outage, Sample, Source};
use crate::safety::{
    Flags, Given, Governor, Health, Limits, Silence, Ticks, Wanted, lateness, latest,
};
use stiction_core::Wrench;

/// The demand of the solver at the end of a turn.
#[derive(Clone, Debug)]
pub(super) struct Demand {
    /// The force on the hand according to statics.
    pub(super) wanted: Wanted,
    /// The solver could not use the last sample.
    pub(super) held_last: bool,
    /// When a sample that it could use arrived (µs).
    pub(super) received_us: Option<u32>,
    /// First sets the force to zero.
    pub(super) cut: bool,
    /// The scene is another one: what it demands beyond the present force, of this size, is not the hand's work, and the force grows to it.
    pub(super) grows_from: Option<f32>,
    pub(super) limits: Option<Limits>,
    /// Everything as after power-up.
    pub(super) anew: bool,
}

impl Demand {
    pub(super) fn new(limits: &Limits) -> Self {
        Self {
            wanted: Wanted::default(),
            held_last: false,
            received_us: None,
            cut: false,
            grows_from: None,
            limits: Some(*limits),
            anew: true,
        }
    }

    /// The demand was taken: only its force remains wanted.
    pub(super) fn taken(&mut self) {
        self.received_us = None;
        self.cut = false;
        self.grows_from = None;
        self.limits = None;
        self.anew = false;
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Settled {
    pub(super) force: Wrench<f32>,
    pub(super) flags: Flags,
    pub(super) latched: bool,
    pub(super) health: Health,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Begun {
    /// When the last tick came (µs, wrapping).
    pub(crate) now_us: u32,
    /// The hand as the device measured it, once.
    pub(crate) sample: Option<Sample>,
}

/// The servo loop of a device D.
#[derive(Clone, Debug)]
pub struct Servo<D> {
    /// The device that measures the hand and outputs forces.
    pub device: D,
    now_us: u32,
    sample: Option<Sample>,
    rule: Rule,
}

#[derive(Clone, Debug)]
struct Rule {
    limits: Limits,
    wanted: Wanted,
    held_last: bool,
    /// Its state at the end of the previous tick.
    before: Governor,
    governor: Governor,
    silence: Silence,
    ticks: Ticks,
    /// Too many ticks are missing before the present one.
    overrun: bool,
    /// The device could not output a force of this tick.
    failed: bool,
    /// No force until everything is reset.
    latched: bool,
    actuator_faults: u32,
    force: Wrench<f32>,
    flags: Flags,
}

impl Rule {
    fn new(limits: &Limits) -> Self {
        Self {
            limits: *limits,
            wanted: Wanted::default(),
            held_last: false,
            before: Governor::new(limits),
            governor: Governor::new(limits),
            silence: Silence::new(limits.silence_us),
            ticks: Ticks::new(limits.period_us),
            overrun: false,
            failed: false,
            latched: false,
            actuator_faults: 0,
            force: Wrench::default(),
            flags: Flags::default(),
        }
    }

    /// The force continues from its present value, and so do the counts.
    fn set_limits(&mut self, limits: &Limits) {
        self.limits = *limits;
        self.before.set_limits(limits);
        self.governor.set_limits(limits);
        self.silence.set_longest(limits.silence_us);
        self.ticks.set_period(limits.period_us);
    }

    fn tick(&mut self, now_us: u32) {
        let missed = self.ticks.tick(now_us);
        self.overrun = missed > u32::from(self.limits.missed_ticks);
        self.failed = false;
        self.before = self.governor;
    }

    fn cut(&mut self) -> Given {
        let _ = self.before.cut();
        self.governor.cut()
    }

    /// The present force is output to a device, which is off in the safe state, and after a fault that lasts.
    // Compiled once per image: flash is limited.
    #[inline(never)]
    fn give(&mut self, silent: bool, device: &mut impl Actuators) {
        let mut flags = Flags {
            silent,
            held_last: self.held_last,
            overrun: self.overrun,
            actuator_fault: self.failed,
            ..Flags::default()
        };
        self.governor = self.before;
        let given = if flags.is_safe_state() {
            self.cut()
        } else {
            self.governor.toward(&self.wanted)
        };
        flags.size_limited = given.size_limited;
        flags.rate_limited = given.rate_limited;
        flags.not_finite = given.not_finite;
        self.force = given.wrench;
        let failed = if self.latched || flags.is_safe_state() {
            device.off();
            self.latched
        } else if let Err(fault) = device.give(&self.force) {
            device.off();
            self.latched = fault.into() == Outage::Lasting;
            true
        } else {
            false
        };
        if failed {
            flags.actuator_fault = true;
            self.force = self.cut().wrench;
            if !self.failed {
                self.failed = true;
                self.actuator_faults = self.actuator_faults.saturating_add(1);
            }
        }
        self.flags = flags;
    }
}

impl<D: Source + Actuators> Servo<D> {
    /// No force until a turn of the solver has ended, which sets its limits.
    pub fn new(device: D) -> Self {
        Self {
            device,
            now_us: 0,
            sample: None,
            rule: Rule::new(&Limits::DEFAULT),
        }
    }

    /// One tick, at a time (µs, wrapping) of the device's clock.
    pub fn tick(&mut self, now_us: u32) {
        self.now_us = now_us;
        if let Some(sample) = self.device.sample(now_us) {
            self.sample = Some(sample);
        }
        let rule = &mut self.rule;
        rule.tick(now_us);
        // A sample of this tick may still arrive: silence is what the next tick, if late, would detect too late.
        let ahead = lateness(rule.limits.period_us);
        let silent = rule.silence.is_silent(now_us, ahead);
        rule.give(silent, &mut self.device);
    }

    pub(crate) fn begin(&mut self) -> Begun {
        Begun {
            now_us: self.now_us,
            sample: self.sample.take(),
        }
    }

    pub(super) fn settle(&mut self, demand: &Demand) -> Settled {
        let rule = &mut self.rule;
        if let Some(limits) = &demand.limits {
            if demand.anew {
                *rule = Rule::new(limits);
                rule.tick(self.now_us);
            } else {
                rule.set_limits(limits);
            }
        }
        if demand.cut {
            let _ = rule.cut();
        }
        if let Some(size) = demand.grows_from {
            rule.before.grow(size);
        }
        if let Some(received_us) = demand.received_us {
            rule.silence.restart(received_us);
        }
        rule.wanted = demand.wanted;
        rule.held_last = demand.held_last;
        // The sample of the next tick may arrive at the end of its turn.
        let ahead = latest(rule.limits.period_us);
        let silent = rule.silence.is_silent(self.now_us, ahead);
        rule.give(silent, &mut self.device);
        Settled {
            force: rule.force,
            flags: rule.flags,
            latched: rule.latched,
            health: self.health(),
        }
    }

    /// The device is off immediately, and until everything is reset.
    pub(crate) fn latch(&mut self) {
        self.rule.latched = true;
        self.rule.force = self.rule.cut().wrench;
        self.device.off();
    }

    /// Force (N) and moment (N·m) on the hand, world frame, as last output.
    pub fn force(&self) -> Wrench<f32> {
        self.rule.force
    }

    /// The counts of the servo loop; all others are 0.
    fn health(&self) -> Health {
        let rule = &self.rule;
        Health {
            ticks: rule.ticks.done,
            missed_ticks: rule.ticks.missed,
            silences: rule.silence.count,
            actuator_faults: rule.actuator_faults,
            ..Health::default()
        }
    }
}

/// How a turn of the solver accesses the servo loop, which may be in another context.
pub trait LockServo<D> {
    /// Uses it for a short time in which no tick comes.
    fn lock<T>(&mut self, used: impl FnOnce(&mut Servo<D>) -> T) -> T;
}

/// In the same context.
impl<D> LockServo<D> for Servo<D> {
    fn lock<T>(&mut self, used: impl FnOnce(&mut Self) -> T) -> T {
        used(self)
    }
}
