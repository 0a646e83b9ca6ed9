//! The records of the tracker that the paper used.

use crate::random::Random;
use crate::times;
use stiction_core::{Axis, Projection};
use stiction_tests::close;
use stiction_wire::{LogitechDecoder, LogitechRecord};

/// A record in the tracker's format: thousandths of an inch, fortieths of a degree.
fn record(flags: u8, position: [i32; 3], angles: [u16; 3]) -> [u8; 16] {
    let mut bytes = vec![0x80 | flags];
    for p in position {
        bytes.extend([14, 7, 0].map(|shift| (p >> shift) as u8 & 0x7f));
    }
    for a in angles {
        bytes.extend([7, 0].map(|shift| (a >> shift) as u8 & 0x7f));
    }
    bytes.try_into().expect("16 bytes")
}

fn read(bytes: &[u8]) -> LogitechRecord {
    let mut decoder = LogitechDecoder::new();
    let records: Vec<_> = bytes.iter().filter_map(|&b| decoder.push(b)).collect();
    let [record] = records[..] else {
        panic!("{records:?}");
    };
    record
}

/// q v conj(q)
fn rotated([x, y, z, w]: [f32; 4], v: [f64; 3]) -> [f64; 3] {
    let [x, y, z, w] = [x, y, z, w].map(f64::from);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let t = cross([x, y, z], v).map(|c| 2.0 * c);
    let u = cross([x, y, z], t);
    std::array::from_fn(|i| v[i] + w * t[i] + u[i])
}

#[test]
fn position_is_in_metres_and_signed() {
    let at = read(&record(0, [1000, -1000, -(1 << 20)], [0; 3])).position;
    close("x", f64::from(at[0]), 0.0254, 1e-8);
    close("y", f64::from(at[1]), -0.0254, 1e-8);
    close("z", f64::from(at[2]), -26.633_830_4, 1e-5);
}

#[test]
fn orientation_is_yaw_pitch_roll() {
    let mut random = Random(13);
    for _ in 0..times(1000) {
        let raw: [u16; 3] = std::array::from_fn(|_| random.below(1 << 14) as u16);
        let q = read(&record(0, [0; 3], raw)).orientation;
        let v: [f64; 3] =
            std::array::from_fn(|_| f64::from(random.below(2000) as u16) / 1000.0 - 1.0);
        let [pitch, yaw, roll] = raw.map(|a| (f64::from(a) / 40.0).to_radians());
        let [x, y, z] = v;
        let (s, c) = roll.sin_cos();
        let [x, y, z] = [c * x - s * y, s * x + c * y, z];
        let (s, c) = pitch.sin_cos();
        let [x, y, z] = [x, c * y - s * z, s * y + c * z];
        let (s, c) = yaw.sin_cos();
        let expected = [c * x + s * z, y, c * z - s * x];
        for (got, expected) in rotated(q, v).into_iter().zip(expected) {
            close("R_y R_x R_z v", got, expected, 2e-6);
        }
    }
}

#[test]
fn planar_hand_turns_on_over_a_full_roll() {
    let plane = [0, 1].map(|index| Axis {
        index,
        negative: false,
    });
    let mut projection = Projection::new(plane).expect("two axes");
    let mut last = 0.0;
    // Two turns; the tracker's angle wraps around after 14400 units.
    for step in 0..=288_u16 {
        let record = read(&record(4, [0, 0, 500], [0, 0, step % 144 * 100]));
        let hand = record
            .sample(4)
            .and_then(|s| projection.planar(&s))
            .expect("a hand");
        assert!(hand.held);
        last = f64::from(hand.angle.radians());
        close("phi", last, (f64::from(step) * 2.5).to_radians(), 1e-5);
        close("depth", f64::from(hand.depth), 0.0127, 1e-8);
    }
    close("two turns", last, 2.0 * std::f64::consts::TAU, 1e-5);
}

#[test]
fn tracker_out_of_range_is_lost() {
    let lost = read(&record(0x20, [1, 2, 3], [4; 3]));
    assert!(lost.out_of_range && lost.sample(0).is_none());
    let fringe = read(&record(0x49, [1, 2, 3], [4; 3]));
    assert!(fringe.at_fringe && fringe.buttons == 9);
    assert!(fringe.sample(1).is_some_and(|s| s.held) && fringe.sample(2).is_some_and(|s| !s.held));
}

#[test]
fn records_are_found_again_after_any_bytes() {
    let mut random = Random(14);
    let mut decoder = LogitechDecoder::new();
    for round in 0..times(2000).cast_signed() {
        for _ in 0..random.below(40) {
            decoder.push(random.byte());
        }
        let sent = record(1, [round, -round, 7], [9, 8, 7]);
        let found: Vec<_> = sent.iter().filter_map(|&b| decoder.push(b)).collect();
        assert_eq!(found, [read(&sent)]);
    }
    assert!(decoder.faults() > 0);
}

#[test]
fn lost_byte_costs_one_record() {
    let sent = record(1, [1, 2, 3], [4, 5, 6]);
    for lost in 0..16 {
        let mut decoder = LogitechDecoder::new();
        let mut short = sent.to_vec();
        short.remove(lost);
        let bytes = [sent.to_vec(), short, sent.to_vec(), sent.to_vec()].concat();
        let found = bytes
            .iter()
            .filter(|&&b| decoder.push(b).is_some_and(|r| r == read(&sent)))
            .count();
        assert_eq!(found, 3, "byte {lost}");
        assert_eq!(decoder.faults(), u32::from(lost != 0));
    }
}

/// Bit 6: at the fringe; bit 5: out of range; lower bits: the buttons.
#[test]
fn every_flag_has_its_bits() {
    for flags in 0..128_u8 {
        let record = read(&record(flags, [1, 2, 3], [4; 3]));
        assert_eq!(record.at_fringe, flags & 64 != 0, "{flags}");
        assert_eq!(record.out_of_range, flags & 32 != 0, "{flags}");
        assert_eq!(record.buttons, flags & 31, "{flags}");
    }
}
