//! The F405 with its own device. The emulator has no encoders: in encoder mode its counters go on counting time, 1 GHz, so
//! that the mechanism seems to whirl. What a hand feels is tested on this machine; here, that the image runs, whatever is
//! measured.

use crate::board::Board;
use crate::budgets::Budget;
use crate::chip::PANTOGRAPH;
use std::collections::HashMap;
use stiction_core::Hand;
use stiction_firmware::devices::pantograph::{TURN_F405_US, passivity};
use stiction_tests::station::client::Said;
use stiction_wire::{Command, Drive, Mode, Reason};

#[test]
fn the_f405_with_a_pantograph_steps_by_itself() {
    let Some(mut board) = Board::start(&PANTOGRAPH) else {
        return;
    };
    assert_eq!(board.image.contents.panics(), [""; 0]);
    let budget = Budget::of(&PANTOGRAPH);
    budget.holds("flash", board.image.contents.flash);
    budget.holds("variables", board.image.contents.variables);
    let info = board.info();
    // Ticks at 1 kHz.
    let bounds = passivity(TURN_F405_US).at_period(1_000).bounds();
    assert!(info.actuators && info.stiffest == bounds, "{info:?}");
    board.send(Command::Hand(Hand::new(0.0, 0.045, 0.0)));
    let answer = board.wait(|_, said| match said {
        Said::Reply(answer) => Some(*answer),
        _ => None,
    });
    assert_eq!(answer.reason, Reason::Unsupported, "{answer:?}");
    board.done(Command::Mode(Mode {
        health_every: 100,
        pose_every: 2,
        forces_every: 2,
        ..info.mode
    }));
    let before = board.health();
    let (mut poses, mut states) = (0_u32, HashMap::<_, u32>::new());
    while poses < 1_500 {
        let force = board.wait(|_, said| match said {
            Said::Pose(pose) => {
                poses += 1;
                *states
                    .entry((pose.status.name(), pose.force_off))
                    .or_default() += 1;
                assert!(pose.position.iter().all(|x| x.is_finite()) && pose.rest.is_finite());
                None
            }
            Said::Forces { feedback, .. } => Some(*feedback),
            _ => None,
        });
        let [x, y] = force.force;
        assert!(x.hypot(y) <= 5.0 && force.moment.abs() <= 0.1, "{force:?}");
    }
    let after = board.health();
    println!("{states:?} {after:?}");
    // A hand that leaps through the scene costs ticks; they are counted, and the board goes on: from the first pose to the last, two each.
    assert!(after.ticks - before.ticks >= 2 * (1_500 - 1));
    assert!(after.samples > before.samples, "its own samples");
    assert!(after.drive != Drive::Latched && after.lost_frames == 0);
}
