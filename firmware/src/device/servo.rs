//! The servo loop: at every tick the hand is measured and a safe force is given, wherever the solver is. A tick takes the same short
//! time whatever happens; the solver takes its turns when it can.
//!
//! ```text
//! tick    measures the hand; gives on what the solver demanded last, or nothing where that is too old
//! settle  takes the solver's demand at the end of a turn, and gives it at once
//! ```
//!
//! Both give a force: that of the end of a turn replaces that of the tick in which it ends. The limits of rate count from the
//! force at the end of the tick before, so that no tick changes it by more than one step.
//!
//! Where a turn takes longer than a tick, its force is held for longer than the bound of stiffness ([`Passivity::hold_us`]) counts on: for
//! that time the device may do work on the hand, at most as long as silence allows.
//!
//! [`Passivity::hold_us`]: crate::safety::Passivity::hold_us

use super::ports::{Actuators, Outage, Sample, Source};
use crate::safety::{Flags, Given, Governor, Health, Limits, Silence, Ticks, lateness, latest};
use stiction_core::Wrench;

/// What the solver demands at the end of a turn.
#[derive(Clone, Debug)]
pub(super) struct Demand {
    /// The force that the statics wants on the hand.
    pub(super) wrench: Wrench<f32>,
    /// The solver could not use the last sample.
    pub(super) held_last: bool,
    /// When a sample came (µs) that it could use.
    pub(super) heard_us: Option<u32>,
    /// Zero force first.
    pub(super) cut: bool,
    /// Other limits.
    pub(super) limits: Option<Limits>,
    /// All as after power-up.
    pub(super) anew: bool,
}

impl Demand {
    /// As after power-up.
    pub(super) fn new(limits: &Limits) -> Self {
        Self {
            wrench: Wrench::default(),
            held_last: false,
            heard_us: None,
            cut: false,
            limits: Some(*limits),
            anew: true,
        }
    }

    /// It was taken: the force is wanted on.
    pub(super) fn taken(&mut self) {
        self.heard_us = None;
        self.cut = false;
        self.limits = None;
        self.anew = false;
    }
}

/// What became of a demand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settled {
    pub(super) force: Wrench<f32>,
    pub(super) flags: Flags,
    pub(super) latched: bool,
    /// What the servo loop counts.
    pub(super) health: Health,
}

/// What a turn begins with.
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
    /// Where the hand is measured, and where forces go.
    pub device: D,
    now_us: u32,
    sample: Option<Sample>,
    rule: Rule,
}

/// What a force is given by.
#[derive(Clone, Debug)]
struct Rule {
    limits: Limits,
    wanted: Wrench<f32>,
    held_last: bool,
    /// At the end of the tick before.
    before: Governor,
    governor: Governor,
    silence: Silence,
    ticks: Ticks,
    /// Too many ticks are missing before the present one.
    overrun: bool,
    /// The device could not give a force of this tick.
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
            wanted: Wrench::default(),
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

    /// The force goes on from where it is, the counts as well.
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

    /// The force of now goes to a device, which is off in the safe state, and after a fault that lasts.
    // Once in an image: flash is short.
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
    /// No force until a turn of the solver has ended, which brings its limits.
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
        // A sample of this tick may still come: silence is what the next tick, if late, would find too late.
        let ahead = lateness(rule.limits.period_us);
        let silent = rule.silence.is_silent(now_us, ahead);
        rule.give(silent, &mut self.device);
    }

    /// A turn of the solver begins.
    pub(crate) fn begin(&mut self) -> Begun {
        Begun {
            now_us: self.now_us,
            sample: self.sample.take(),
        }
    }

    /// A turn of the solver ends with a demand.
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
        if let Some(heard_us) = demand.heard_us {
            rule.silence.hear(heard_us);
        }
        rule.wanted = demand.wrench;
        rule.held_last = demand.held_last;
        // The sample of the next tick may come at the end of its turn.
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

    /// Force (N) and moment (N·m) to the hand, world frame, as given last.
    pub fn force(&self) -> Wrench<f32> {
        self.rule.force
    }

    /// What the servo loop counts; all else is 0.
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

/// How a turn of the solver reaches the servo loop, which may be in another context.
pub trait LockServo<D> {
    /// Uses it for a moment, in which no tick comes.
    fn lock<T>(&mut self, used: impl FnOnce(&mut Servo<D>) -> T) -> T;
}

/// In the same context.
impl<D> LockServo<D> for Servo<D> {
    fn lock<T>(&mut self, used: impl FnOnce(&mut Self) -> T) -> T {
        used(self)
    }
}
