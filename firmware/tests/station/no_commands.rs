//! Undamaged frames that are not commands are answered with the reason (FRAME 2 and 5.4).

use super::rig::Rig;
use stiction_tests::station::client::Said;
use stiction_wire::{Reason, VERSION};

#[test]
fn undamaged_frames_that_are_no_commands_are_answered() {
    let mut rig = Rig::<f32>::new();
    // FRAME 2: version, type, sequence, time, payload, CRC. The codec's own test does COBS by hand; here its encoder is
    // used.
    let frame = |bytes: &[u8]| {
        let mut frame = bytes.to_vec();
        frame.extend(crc32(bytes).to_le_bytes());
        cobs_of(&frame)
    };
    let cases: [(&[u8], Reason); 6] = [
        (&[VERSION - 1, 7, 40, 0, 0, 0, 0], Reason::Version),
        (&[VERSION, 0x55, 41, 0, 0, 0, 0], Reason::UnknownType),
        (&[VERSION, 0x80, 42, 0, 0, 0, 0], Reason::UnknownType),
        (&[VERSION, 7, 43, 0, 0, 0, 0, 9], Reason::Length),
        (&[VERSION, 8, 44, 0, 0, 0, 0], Reason::Length),
        (&[VERSION, 8, 45, 0, 0, 0, 0, 2], Reason::Code),
    ];
    for (bytes, reason) in cases {
        rig.line.to_board.extend(frame(bytes));
        rig.client.inbox.clear();
        rig.tick();
        let received = rig.received();
        let Said::Reply(answer) = &received[0].said else {
            panic!("{received:?}")
        };
        assert_eq!(answer.reason, reason, "{bytes:?}");
        assert_eq!(
            (answer.command.code, answer.command.sequence),
            (bytes[1], bytes[2])
        );
    }
    // They are frames of the line all the same: none is lost.
    assert_eq!(rig.health().lost_frames, 0);
    assert_eq!(rig.health().faults.total(), 6);
    // A damaged one is not answered.
    let mut damaged = frame(&[VERSION, 7, 46, 0, 0, 0, 0]);
    damaged[3] ^= 0x10;
    rig.line.to_board.extend(damaged);
    rig.tick();
    assert!(
        rig.received()
            .iter()
            .all(|h| matches!(h.said, Said::Pose(_)))
    );
}

/// CRC-32/ISO-HDLC, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for &byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 {
                crc >> 1 ^ 0xedb8_8320
            } else {
                crc >> 1
            };
        }
    }
    !crc
}

/// COBS of less than 254 bytes, with its delimiter.
fn cobs_of(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    for part in bytes.split(|&byte| byte == 0) {
        out.push(part.len() as u8 + 1);
        out.extend(part);
    }
    out.push(0);
    out
}
