//! Health on its way from the tick to a context that waits for nothing and logs it: each number is consistent, but not all are from the
//! same tick.

use core::sync::atomic::{AtomicU32, Ordering};
use stiction_wire::{Drive, Health};

/// The part of [`Health`] that a log shows.
#[derive(Debug)]
pub struct Watch {
    drive: AtomicU32,
    ticks: AtomicU32,
    missed_ticks: AtomicU32,
    samples: AtomicU32,
    lost_frames: AtomicU32,
    faults: AtomicU32,
    unsent: AtomicU32,
    worst_tick: AtomicU32,
}

/// The values that a log shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// See [`Health`].
    pub drive: Drive,
    /// See [`Health`].
    pub ticks: u32,
    /// See [`Health`].
    pub missed_ticks: u32,
    /// See [`Health`].
    pub samples: u32,
    /// See [`Health`].
    pub lost_frames: u32,
    /// Frames that were not accepted, of all kinds.
    pub faults: u32,
    /// See [`Health`].
    pub unsent: u32,
    /// See [`Health`].
    pub worst_tick: u32,
}

impl Seen {
    const fn force(&self) -> &'static str {
        match self.drive {
            Drive::On => "on",
            Drive::Silent => "off",
            Drive::Latched => "off until everything is reset",
        }
    }
}

impl Default for Watch {
    fn default() -> Self {
        Self::new()
    }
}

const ON: u32 = 0;
const SILENT: u32 = 1;
const LATCHED: u32 = 2;

impl Watch {
    /// Nothing seen yet, and no force.
    pub const fn new() -> Self {
        Self {
            drive: AtomicU32::new(SILENT),
            ticks: AtomicU32::new(0),
            missed_ticks: AtomicU32::new(0),
            samples: AtomicU32::new(0),
            lost_frames: AtomicU32::new(0),
            faults: AtomicU32::new(0),
            unsent: AtomicU32::new(0),
            worst_tick: AtomicU32::new(0),
        }
    }

    /// Stores the values after a tick.
    pub fn show(&self, health: &Health) {
        let drive = match health.drive {
            Drive::On => ON,
            Drive::Silent => SILENT,
            Drive::Latched => LATCHED,
        };
        let put = |place: &AtomicU32, value| place.store(value, Ordering::Relaxed);
        put(&self.drive, drive);
        put(&self.missed_ticks, health.missed_ticks);
        put(&self.samples, health.samples);
        put(&self.lost_frames, health.lost_frames);
        put(&self.faults, health.faults.total());
        put(&self.unsent, health.unsent);
        put(&self.worst_tick, health.worst_tick);
        put(&self.ticks, health.ticks);
    }

    /// The values that were stored last.
    pub fn seen(&self) -> Seen {
        let get = |place: &AtomicU32| place.load(Ordering::Relaxed);
        Seen {
            drive: match get(&self.drive) {
                ON => Drive::On,
                SILENT => Drive::Silent,
                _ => Drive::Latched,
            },
            ticks: get(&self.ticks),
            missed_ticks: get(&self.missed_ticks),
            samples: get(&self.samples),
            lost_frames: get(&self.lost_frames),
            faults: get(&self.faults),
            unsent: get(&self.unsent),
            worst_tick: get(&self.worst_tick),
        }
    }
}

/// The news of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum News {
    /// The state of the force on the hand, in the words of a log.
    Force(&'static str),
    /// Everything was reset.
    Reset,
    /// The counts of about the last second.
    Counts(Seen),
}

/// What was logged last.
#[derive(Debug)]
pub struct Log {
    last: Seen,
    drive: Option<Drive>,
    /// Ticks from one report of counts to the next.
    period: u32,
}

impl Log {
    /// Counts are reported once in this many ticks.
    pub fn new(watch: &Watch, period: u16) -> Self {
        Self {
            last: watch.seen(),
            drive: None,
            period: period.into(),
        }
    }

    /// Passes what is new to a function.
    pub fn look(&mut self, watch: &Watch, mut tell: impl FnMut(News)) {
        let seen = watch.seen();
        if self.drive != Some(seen.drive) {
            self.drive = Some(seen.drive);
            tell(News::Force(seen.force()));
        }
        if seen.ticks < self.last.ticks {
            self.last = seen;
            tell(News::Reset);
        }
        if seen.ticks.saturating_sub(self.last.ticks) >= self.period {
            self.last = seen;
            tell(News::Counts(seen));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_says_what_is_new_and_nothing_twice() {
        let watch = Watch::new();
        let mut log = Log::new(&watch, 10);
        let mut news = |drive, ticks| {
            let health = Health {
                drive,
                ticks,
                ..Health::default()
            };
            watch.show(&health);
            let mut said = [None; 3];
            let mut places = said.iter_mut();
            log.look(&watch, |news| *places.next().unwrap() = Some(news));
            said
        };
        let off = Some(News::Force("off"));
        assert_eq!(news(Drive::Silent, 1), [off, None, None]);
        assert_eq!(news(Drive::Silent, 9), [None; 3]);
        let [force, counts, _] = news(Drive::On, 10);
        assert_eq!(force, Some(News::Force("on")));
        assert!(matches!(counts, Some(News::Counts(Seen { ticks: 10, .. }))));
        assert_eq!(news(Drive::On, 19), [None; 3]);
        assert_eq!(news(Drive::On, 3), [Some(News::Reset), None, None]);
    }
}
