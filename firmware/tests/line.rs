//! When samples count as silent, which of them are late and lost, and missed ticks.

use stiction_firmware::safety::{Arrival, Arrivals, Silence, Ticks};

/// The next tick of 1 kHz comes within this many µs, at the latest.
const NEXT: u32 = 1_500;

#[test]
fn silence_is_noticed_before_20_ms_have_passed() {
    // Whatever the phase of the sample between two ticks, and wherever the clock wraps.
    for start in [0, u32::MAX - 5_000, 1 << 31, (1 << 31) - 10_000] {
        for phase in [0, 1, 499, 500, 999] {
            let mut silence = Silence::new(20_000);
            assert!(silence.is_silent(start, NEXT));
            silence.restart(start);
            let at = |tick: u32| start.wrapping_add(phase + tick * 1_000);
            let zero = (0..30)
                .find(|&tick| silence.is_silent(at(tick), NEXT))
                .unwrap();
            let age = phase + zero * 1_000;
            // At the latest with the tick that could still be followed in time by one after 1.5 ms.
            assert!(age <= 19_500 && age > 18_500, "{age}");
            assert_eq!(silence.count, 1);
        }
    }
}

#[test]
fn silence_is_noticed_in_time_where_a_tick_is_late() {
    for late in [0, 2, 27, 1_000, 2_499] {
        let mut silence = Silence::new(20_000);
        silence.restart(1);
        let ticks = [5_000, 10_000, 15_000, 20_000 + late];
        let noticed = ticks.into_iter().find(|&now| silence.is_silent(now, 7_500));
        let age = noticed.unwrap() - 1;
        assert!(age <= 20_000, "{age}");
    }
}

#[test]
fn silence_lasts_until_something_is_received_however_often_the_clock_wraps() {
    let mut silence = Silence::new(20_000);
    silence.restart(0);
    let mut now = 0u32;
    for _ in 0..10_000 {
        now = now.wrapping_add(1_234_567);
        assert!(silence.is_silent(now, NEXT));
    }
    silence.restart(now);
    assert!(!silence.is_silent(now, NEXT));
    assert_eq!(silence.count, 1);
    // A time stamp slightly ahead of the clock counts as now.
    silence.restart(now.wrapping_add(3));
    assert!(!silence.is_silent(now, NEXT));
}

#[test]
fn late_and_lost_samples_are_counted() {
    let mut arrivals = Arrivals::default();
    let numbers = [65_533, 65_534, 65_534, 2, 0, 3, 2, 4];
    let new = numbers.map(|number| arrivals.arrive(number, false) == Arrival::New);
    assert_eq!(new, [true, true, false, true, false, true, false, true]);
    // 65 535, 0 and 1 are missing; 0 comes late after all; 65 534 and 2 come twice.
    assert_eq!((arrivals.lost, arrivals.late, arrivals.restarts), (3, 3, 0));
}

#[test]
fn a_sender_that_begins_anew_is_believed_in_silence_only() {
    let mut arrivals = Arrivals::default();
    for number in 1_000..1_010 {
        arrivals.arrive(number, false);
    }
    assert_eq!(arrivals.arrive(0, false), Arrival::Late);
    assert_eq!(arrivals.arrive(1, false), Arrival::Late);
    // A single one of them may be an old one.
    assert_eq!(arrivals.arrive(2, true), Arrival::Late);
    assert_eq!(arrivals.arrive(3, true), Arrival::New);
    assert_eq!(arrivals.arrive(4, true), Arrival::New);
    assert_eq!((arrivals.restarts, arrivals.late, arrivals.lost), (1, 3, 0));
    // A sender that continues where it was is accepted immediately.
    assert_eq!(arrivals.arrive(7, true), Arrival::New);
    assert_eq!(arrivals.lost, 2);
}

#[test]
fn counters_stay_at_their_largest_value() {
    let mut arrivals = Arrivals::default();
    (arrivals.lost, arrivals.late) = (u32::MAX - 1, u32::MAX);
    arrivals.arrive(0, false);
    arrivals.arrive(30_000, false);
    arrivals.arrive(5, false);
    assert_eq!((arrivals.lost, arrivals.late), (u32::MAX, u32::MAX));
    let mut ticks = Ticks::new(1_000);
    ticks.missed = u32::MAX - 1;
    ticks.done = u32::MAX;
    ticks.tick(0);
    ticks.tick(1 << 30);
    assert_eq!((ticks.missed, ticks.done), (u32::MAX, u32::MAX));
}

#[test]
fn missed_ticks_are_counted_to_the_nearest() {
    let mut ticks = Ticks::new(1_000);
    let start = u32::MAX - 1_500;
    let times = [0, 1_000, 1_990, 3_010, 4_499, 6_100, 11_100, 11_100, 10_000];
    let missed = times.map(|time| ticks.tick(start.wrapping_add(time)));
    // A clock that stands still or goes backwards misses nothing.
    assert_eq!(missed, [0, 0, 0, 0, 0, 1, 4, 0, 0]);
    assert_eq!((ticks.missed, ticks.done), (5, 9));
}
