//! The image for the Pico 2 and a client on its serial line, see `rp2350`: its poses have the bits of this computer, and silence is no force.

use crate::bench::{Bench, Clocked};
use crate::bits::{SAMPLES, same_bits_of};
use crate::chip::PICO2;
use crate::rp2350::Chip;
use crate::silence::silence_of;
use stiction_tests::station::client::{Said, hand_path};
use stiction_wire::{Command, NumberType};

/// So many poses in each evolution.
fn same_bits(samples: u32) {
    if let Some(mut bench) = Bench::<Chip>::start(&PICO2) {
        same_bits_of::<f32>(&mut bench, NumberType::F32, samples);
    }
}

#[test]
fn poses_of_the_pico_2_are_those_of_f32() {
    same_bits(SAMPLES);
}

#[test]
#[ignore = "takes minutes"]
fn a_hundred_thousand_poses_of_the_pico_2_have_the_bits() {
    same_bits(100_000);
}

#[test]
fn silence_on_the_pico_2_is_zero_force_within_20_ms() {
    let Some(mut bench) = Bench::<Chip>::start(&PICO2) else {
        return;
    };
    silence_of(&mut bench);
}

#[test]
fn the_pico_2_misses_no_tick_along_the_hand_path() {
    let Some(mut bench) = Bench::<Chip>::start(&PICO2) else {
        return;
    };
    assert_eq!(bench.info().mode.tick_rate, 1_000);
    let missed = bench.health().missed_ticks;
    let mut poses = 0;
    for hand in hand_path(SAMPLES) {
        bench.send(Command::Hand(hand));
        bench.pass();
        let received = bench.client.inbox.drain(..);
        poses += received
            .filter(|received| matches!(received.said, Said::Pose(_)))
            .count();
    }
    let health = bench.health();
    assert_eq!((health.samples, health.lost_frames), (SAMPLES, 0));
    assert_eq!(health.missed_ticks, missed);
    assert!(poses >= SAMPLES as usize, "{poses}");
}

/// Samples that come a little later in every tick: at some time, bytes come while it goes on.
#[test]
fn a_byte_interrupts_a_tick_and_a_turn_of_the_pico_2() {
    /// UART0; TIMER0, the turn by SPARE_IRQ 0 (RP2350 datasheet, 3.2).
    const BYTE: u32 = 33;
    const LATER: [u32; 2] = [0, 46];
    /// Of the hand: each comes a 64th of a ms later than the one before.
    const COUNT: u32 = 128;
    const APART: u64 = Chip::MS + Chip::MS / 64;
    let Some(mut bench) = Bench::<Chip>::start(&PICO2) else {
        return;
    };
    let mut seen = [0; 2];
    for hand in hand_path(COUNT) {
        bench.send(Command::Hand(hand));
        for _ in 0..APART {
            bench.chip.run(1);
            for (count, later) in seen.iter_mut().zip(LATER) {
                if [BYTE, later].map(|each| bench.chip.serves(each)) == [true; 2] {
                    assert_eq!(bench.chip.serving(), Some(BYTE));
                    *count += 1;
                }
            }
        }
    }
    assert!(seen.iter().all(|cycles| *cycles > 0), "{seen:?}");
}
