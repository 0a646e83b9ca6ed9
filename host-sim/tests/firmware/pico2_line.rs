//! The image for the Pico 2 and a client on its serial line, see `rp2350`: its poses have the bits of this computer, and silence is no force.

use crate::bench::Bench;
use crate::bits::{SAMPLES, same_bits_of};
use crate::chip::PICO2;
use crate::client::{Said, hand_path};
use crate::rp2350::Chip;
use crate::silence::silence_of;
use stiction_core::frame::{Command, NumberType};

#[test]
fn poses_of_the_pico_2_are_those_of_f32() {
    let Some(mut bench) = Bench::<Chip>::start(&PICO2) else {
        return;
    };
    same_bits_of::<f32>(&mut bench, NumberType::F32, SAMPLES);
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
        let heard = bench.client.heard.drain(..);
        poses += heard
            .filter(|heard| matches!(heard.said, Said::Pose(_)))
            .count();
    }
    let health = bench.health();
    assert_eq!((health.samples, health.lost_frames), (SAMPLES, 0));
    assert_eq!(health.missed_ticks, missed);
    assert!(poses >= SAMPLES as usize, "{poses}");
}
